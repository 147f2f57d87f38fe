"""Shows things under a cell; where there is no notebook, prints their words."""

import base64
import html
from collections.abc import Callable, Iterable
from typing import Any

from ai4u_edu.base.colors import PALETTE


def in_notebook() -> bool:
    """Whether a Jupyter kernel runs this."""
    return _shell() is not None


def cells_so_far() -> list[str]:
    """The code of the notebook's cells, in the order in which they were run."""
    shell = _shell()
    return [] if shell is None else list(shell.user_ns.get("In", ()))


def after_each_cell(function: Callable[..., object]) -> None:
    """Has something done whenever a cell has run; once, however often that is asked for."""
    shell = _shell()
    if shell is not None and function not in shell.events.callbacks["post_run_cell"]:
        shell.events.register("post_run_cell", function)


def put(page: str, words: str, handle: str = "") -> None:
    """Shows HTML under the cell.

    Args:
        page: the HTML; everything in it escaped.
        words: the same in words, for where no HTML is shown.
        handle: a name by which :func:`replace` finds it again.
    """
    if not in_notebook():
        print(words)  # noqa: T201 - there is nowhere else to say it
        return
    _publish(page, words, transient={"display_id": handle} if handle else None)


def replace(page: str, words: str, handle: str) -> None:
    """Shows other HTML in the place of what was shown before."""
    if in_notebook():
        _publish(page, words, transient={"display_id": handle}, update=True)


def card(colour: str, sign: str, lines: Iterable[str], picture: bytes = b"") -> str:
    """A framed note: a coloured edge, a sign in words, lines, a picture.

    Args:
        colour: a name out of the palette.
        sign: what the colour says, in words; never the colour alone.
        lines: plain text; what stands between backquotes is code.
        picture: PNG or GIF.
    """
    first = f'<b style="color:{PALETTE[colour]}">{html.escape(sign)}</b> '
    paragraphs = "".join(
        f'<p style="margin:.3em 0">{first if not number else ""}{_marked(line)}</p>'
        for number, line in enumerate(lines)
    )
    return (
        f'<div style="border-left:5px solid {PALETTE[colour]};padding:.2em .9em;max-width:44em">'
        f"{paragraphs}{image(picture)}</div>"
    )


def image(picture: bytes, alt: str = "what happened") -> str:
    """A picture inside the page itself; nothing for none."""
    if not picture:
        return ""
    return f'<img alt="{html.escape(alt)}" style="max-width:100%" src="{address(picture)}">'


def address(picture: bytes) -> str:
    """A picture as a ``data:`` address."""
    kind = "gif" if picture.startswith(b"GIF8") else "png"
    return f"data:image/{kind};base64,{base64.b64encode(picture).decode()}"


def _marked(line: str) -> str:
    pieces = html.escape(line).split("`")
    if len(pieces) % 2 == 0:  # a backquote alone
        return html.escape(line)
    return "".join(
        f"<code>{piece}</code>" if number % 2 else piece for number, piece in enumerate(pieces)
    )


def _shell() -> Any:
    """The notebook's, or None."""
    try:
        from IPython.core.getipython import get_ipython
    except ImportError:
        return None
    shell: Any = get_ipython()
    return shell if hasattr(shell, "kernel") else None


def _publish(page: str, words: str, **options: Any) -> None:
    from IPython import display

    publish: Any = display.publish_display_data
    publish({"text/html": page, "text/plain": words}, **options)
