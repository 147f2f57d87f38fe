"""Pieces of reStructuredText, which docstrings are written in."""

import re
import textwrap
from collections.abc import Iterable, Sequence

from ai4u_edu.blocks.docs import ParameterRow


def title(text: str, line: str = "=") -> str:
    """Return a heading.

    >>> print(title("Blocks"))
    Blocks
    ======
    <BLANKLINE>
    """
    return f"{text}\n{line * len(text)}\n"


def table(header: Sequence[str], rows: Iterable[Sequence[str]], widths: Sequence[int]) -> str:
    """Return a table.

    Args:
        header: a title for each column.
        rows: the cells' text.
        widths: relative widths of the columns; a column that is empty in all rows is left out.
    """
    rows = list(rows)
    used = [place for place in range(len(header)) if any(row[place] for row in rows)]
    header, widths = [header[place] for place in used], [widths[place] for place in used]
    rows = [[row[place] for place in used] for row in rows]
    lines = [
        ".. list-table::",
        "   :header-rows: 1",
        f"   :widths: {' '.join(map(str, widths))}",
        "",
    ]
    for row in [header, *rows]:
        for place, cell in enumerate(row):
            lines.append(f"   {'*' if place == 0 else ' '} - {' '.join(cell.split())}".rstrip())
    return "\n".join(lines) + "\n"


PARAMETERS = ("name", "type", "default", "unit", "what it is")
"""Titles of the columns of a table of parameters."""


def parameters(rows: Iterable[ParameterRow], header: Sequence[str] = PARAMETERS) -> str:
    """Return a table of parameters."""
    cells = [
        (
            literal(each.name),
            each.values.replace(" | ", ", "),
            each.default if each.default.startswith("(") else literal(each.default),
            each.unit,
            each.text,
        )
        for each in rows
    ]
    return table(header, cells, (4, 3, 3, 2, 8))


def code(source: str, language: str = "python") -> str:
    """Return a block of code."""
    return f".. code-block:: {language}\n\n{textwrap.indent(source.strip(), '   ')}\n"


def literal(text: str) -> str:
    """Return text in the type of code; empty stays empty.

    >>> literal("a b"), literal("")
    ('``a b``', '')
    """
    return f"``{text}``" if text else ""


def hidden_toctree(entries: Iterable[str]) -> str:
    """Return a table of contents that shows in the side bar only."""
    return "\n".join([".. toctree::", "   :hidden:", "", *(f"   {each}" for each in entries), ""])


def escaped(text: str) -> str:
    r"""Return plain text so that it is read as plain text.

    >>> escaped("2 * x | y_")
    '2 \\* x \\| y\\_'
    """
    return re.sub(r"([*`|\\]|_\b)", r"\\\1", text)


def from_markdown(text: str) -> str:
    """Return a line of Markdown, with code and without links.

    >>> from_markdown("run `play` now")
    'run ``play`` now'
    """
    return re.sub(r"`([^`]+)`", r"``\1``", text)
