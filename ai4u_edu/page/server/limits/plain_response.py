"""HTTP responses that are written without an app."""

from http import HTTPStatus

from ai4u_edu.locale import translate


def plain_response(status: int, text: str, *, retry_after: int = 0) -> bytes:
    r"""Return the bytes of an HTTP response, after which the connection is closed.

    Args:
        status: the status code.
        text: the reason, in a sentence.
        retry_after: seconds in the header Retry-After; 0 for none.

    >>> print(plain_response(408, "too slow").decode().replace("\r", ""))
    HTTP/1.1 408 Request Timeout
    Content-Type: text/plain; charset=utf-8
    Content-Length: 9
    Cache-Control: no-store
    Connection: close
    <BLANKLINE>
    too slow
    <BLANKLINE>
    """
    body = f"{translate(text)}\n".encode()
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
