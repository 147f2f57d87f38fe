"""Runs a Python file with drivers."""

import runpy
import traceback
from pathlib import Path
from typing import Any

from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks import Block
from ai4u_edu.blocks.block import is_built_in


def run_file(path: Path) -> dict[str, Any]:
    """Run a file without any sandbox, and return its globals by name.

    Raises:
        SetupError: it can't be run, or gives a block the name of a built-in one.
    """
    before = dict(Block.types)
    problem = ""
    found: dict[str, Any] = {}
    try:
        found = runpy.run_path(str(path))
    except (Exception, SystemExit) as error:  # a user's code may raise anything
        lines = [
            frame.lineno
            for frame in traceback.extract_tb(error.__traceback__)
            if frame.filename == str(path)
        ]
        line = f", line {lines[-1]}" if lines else ""
        problem = f"{path.name}{line}: {type(error).__name__}: {error}"
    taken = [
        name
        for name, cls in Block.types.items()
        if before.get(name, cls) is not cls and is_built_in(before[name])
    ]
    if taken:
        problem = f"{path.name}: {taken[0]} is the name of a built-in block; expected another name"
    if problem:
        Block.types.clear()
        Block.types.update(before)
        raise SetupError(problem)
    return found
