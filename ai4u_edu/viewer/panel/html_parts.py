"""Pieces of HTML that all parts of the panel use."""

from collections.abc import Iterable, Sequence
from html import escape


def section(*parts: str, kind: str = "") -> str:
    """Join pieces of HTML into one element with our styles; ``kind`` adds CSS classes."""
    return f'<div class="ai4u{f" {kind}" if kind else ""}">{"".join(parts)}</div>'


def heading(text: str) -> str:
    """Return a heading."""
    return f"<p>{escape(text)}</p>"


def table(rows: Iterable[Sequence[str]]) -> str:
    """Return a table of HTML cells; each row's first cell is its heading."""
    lines = [
        f"<tr><th>{name}</th>{''.join(f'<td>{cell}</td>' for cell in cells)}</tr>"
        for name, *cells in rows
    ]
    return f"<table>{''.join(lines)}</table>"
