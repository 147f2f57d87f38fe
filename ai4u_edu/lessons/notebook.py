"""Notebooks as text, in the part of jupytext's percent format that the course needs.

A cell begins with ``# %%``; a cell of text with ``# %% [markdown]``, each of its lines a comment.
``tags=["setup"]`` may follow.
"""

import json
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ai4u_edu.base.errors import SetupError

_HEAD = re.compile(r"# %%(?P<text> \[markdown\])?(?: tags=(?P<tags>\[[^\]]*\]))?")
KERNEL = {"display_name": "Python 3 (ipykernel)", "language": "python", "name": "python3"}
EXERCISE = "exercise-"
"""Prefix of the tag of a cell in which a student writes, such as ``exercise-04.2``."""


@dataclass(frozen=True)
class Cell:
    """Cell of a notebook."""

    source: str
    is_text: bool = False
    tags: tuple[str, ...] = ()
    line: int = 0
    """First line of its source in the file, from 1 on."""

    @property
    def exercise(self) -> str:
        """Id of the exercise that is solved here, such as ``04.2``; empty for none."""
        found = [tag.removeprefix(EXERCISE) for tag in self.tags if tag.startswith(EXERCISE)]
        return found[0] if found else ""


def cells_of(text: str, name: str = "notebook") -> list[Cell]:
    r"""Return the cells of a percent script.

    Args:
        text: the script.
        name: its name in messages.

    Raises:
        SetupError: a line that begins a cell can't be read.

    >>> text = "# %% [markdown]\n# Hi\n\n# %%\n1 + 1"
    >>> [(cell.source, cell.is_text) for cell in cells_of(text)]
    [('Hi', True), ('1 + 1', False)]
    """
    cells: list[Cell] = []
    head: re.Match[str] | None = None
    lines: list[str] = []
    begin = 0

    def end() -> None:
        if head is not None:
            tags = tuple(json.loads(head["tags"] or "[]"))
            cells.append(_cell(lines, bool(head["text"]), tags, begin))

    for number, line in enumerate(text.splitlines(), 1):
        if not line.startswith("# %%"):
            lines.append(line)
            continue
        end()
        head = _HEAD.fullmatch(line.rstrip())
        if head is None:
            raise SetupError(
                f"{name}, line {number}: expected '# %%' or '# %% [markdown]', perhaps with "
                f'tags=["..."], got {line!r}'
            )
        lines, begin = [], number + 1
    end()
    return cells


def read_cells(path: Path) -> list[Cell]:
    """Return the cells of a file."""
    return cells_of(path.read_text(encoding="utf-8"), path.name)


def to_notebook(cells: Iterable[Cell]) -> dict[str, Any]:
    """Return a notebook (nbformat 4.5) without outputs; the same cells give the same text."""
    return {
        "cells": [_plain(cell, index) for index, cell in enumerate(cells)],
        "metadata": {"kernelspec": KERNEL, "language_info": {"name": "python"}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }


def dumps(cells: Iterable[Cell]) -> str:
    """Return the text of a .ipynb file."""
    return json.dumps(to_notebook(cells), indent=1, ensure_ascii=False) + "\n"


def _cell(lines: list[str], is_text: bool, tags: tuple[str, ...], begin: int) -> Cell:
    if is_text:
        lines = [line.removeprefix("#").removeprefix(" ") for line in lines]
    blank = next((number for number, line in enumerate(lines) if line.strip()), 0)
    source = "\n".join(lines).strip("\n")
    return Cell(source, is_text, tags, begin + blank)


def _plain(cell: Cell, index: int) -> dict[str, Any]:
    # a slip of a key (D D in command mode) shall delete none of the cells that were handed out
    metadata: dict[str, Any] = {"deletable": False}
    if cell.is_text:
        metadata["editable"] = False
    if cell.tags:
        metadata["tags"] = list(cell.tags)
    source = cell.source.splitlines(keepends=True)
    plain: dict[str, Any] = {"id": f"cell-{index}", "metadata": metadata, "source": source}
    if cell.is_text:
        return {"cell_type": "markdown", **plain}
    return {"cell_type": "code", "execution_count": None, "outputs": [], **plain}
