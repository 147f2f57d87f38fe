"""Output under a notebook's cell, or as text where there is no notebook."""

import base64
import html
from collections.abc import Callable, Sequence
from typing import Any

from ai4u_edu.base.colors import PALETTE
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate


def in_notebook() -> bool:
    """Return True in a Jupyter kernel."""
    return _shell() is not None


def cells_so_far() -> list[str]:
    """Return the code of the notebook's cells in the order of execution."""
    shell = _shell()
    return [] if shell is None else list(shell.user_ns.get("In", ()))


def after_each_cell(function: Callable[..., object]) -> None:
    """Register a function to run after each cell; registering it again has no effect."""
    shell = _shell()
    if shell is not None and function not in shell.events.callbacks["post_run_cell"]:
        shell.events.register("post_run_cell", function)


def put(page: str, words: str, handle: str = "") -> None:
    """Show HTML under the cell.

    Args:
        page: the HTML; everything in it escaped.
        words: the same as text, for where no HTML is shown.
        handle: the display id for :func:`replace`.
    """
    if not in_notebook():
        print(words)  # noqa: T201 - there is nowhere else to say it
        return
    _publish(page, words, transient={"display_id": handle} if handle else None)


def tell(colour: str, sign: str, lines: Sequence[str], picture: bytes = b"") -> None:
    """Show a framed note under the cell, in the reader's language; see :func:`card`."""
    first, *more = map(translate, lines)
    words = "\n".join([f"{translate(sign)} {first}", *more])
    put(card(colour, sign, lines, picture), words)


def replace(page: str, words: str, handle: str) -> None:
    """Replace HTML that was shown before."""
    if in_notebook():
        _publish(page, words, transient={"display_id": handle}, update=True)


def card(colour: str, sign: str, lines: Sequence[str], picture: bytes = b"") -> str:
    """Return a framed note in the reader's language: an edge, a sign in words, lines, a picture.

    Args:
        colour: a colour's name.
        sign: the colour's meaning in words; never the colour alone.
        lines: plain text; text between backquotes is code.
        picture: PNG or GIF.
    """
    first = f'<b style="color:{PALETTE[colour]}">{html.escape(translate(sign))}</b> '
    paragraphs = "".join(
        f'<p style="margin:.3em 0">{first if not number else ""}{marked(translate(line))}</p>'
        for number, line in enumerate(lines)
    )
    return (
        f'<div style="border-left:5px solid {PALETTE[colour]};padding:.2em .9em;max-width:44em">'
        f"{paragraphs}{image(picture)}</div>"
    )


def image(picture: bytes, alt: str = _("what happened")) -> str:
    """Return an <img> element with the picture inside; empty for none."""
    if not picture:
        return ""
    return (
        f'<img alt="{html.escape(translate(alt))}" style="max-width:100%" src="{address(picture)}">'
    )


def address(picture: bytes) -> str:
    """Return a picture as a ``data:`` URL."""
    kind = "gif" if picture.startswith(b"GIF8") else "png"
    return f"data:image/{kind};base64,{base64.b64encode(picture).decode()}"


def marked(line: str) -> str:
    """Return a line as HTML; text between backquotes is code."""
    pieces = html.escape(line).split("`")
    if len(pieces) % 2 == 0:  # a backquote alone
        return html.escape(line)
    return "".join(
        f"<code>{piece}</code>" if number % 2 else piece for number, piece in enumerate(pieces)
    )


def _shell() -> Any:
    """Return the notebook's shell, or None."""
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
