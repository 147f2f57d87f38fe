"""Answers of a server that does not get as far as its app."""

from http import HTTPStatus


def refusal(status: int, text: str, *, retry_after: int = 0) -> bytes:
    r"""Return a whole HTTP answer, after which the connection ends.

    Args:
        status: of the answer.
        text: why, in a sentence.
        retry_after: seconds after which it may be tried again; 0 to say nothing of it.

    >>> print(refusal(408, "too slow").decode().replace("\r", ""))
    HTTP/1.1 408 Request Timeout
    Content-Type: text/plain; charset=utf-8
    Content-Length: 9
    Cache-Control: no-store
    Connection: close
    <BLANKLINE>
    too slow
    <BLANKLINE>
    """
    body = f"{text}\n".encode()
    lines = [
        f"HTTP/1.1 {status} {HTTPStatus(status).phrase}",
        "Content-Type: text/plain; charset=utf-8",
        f"Content-Length: {len(body)}",
        "Cache-Control: no-store",
        "Connection: close",
    ]
    if retry_after:
        lines.append(f"Retry-After: {retry_after}")
    return "\r\n".join([*lines, "", ""]).encode() + body
