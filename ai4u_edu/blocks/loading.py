"""Loading of a user's own blocks from a Python file, which runs with all rights."""

import importlib.util
import sys
import traceback
from pathlib import Path

from ai4u_edu.base.errors import SetupError, text_of
from ai4u_edu.blocks.block import Block, is_built_in
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join

PREFIX = "own_blocks_"
"""Prefix of the names of modules that are made from such files."""


def load_blocks(path: Path) -> list[type[Block]]:
    """Run a Python file, so that scenes can use the blocks that it defines.

    Use it only for files that a person has named: the code is not sandboxed.

    Args:
        path: path of the file; it can import modules from its folder.

    Returns:
        The new classes of blocks.

    Raises:
        SetupError: the file can't be read or run, defines no block, or one with the name of a
            built-in one; then no new classes are registered.
    """
    name = f"{PREFIX}{path.stem}"
    spec = importlib.util.spec_from_file_location(name, path)
    if path.suffix != ".py" or not path.is_file() or spec is None or spec.loader is None:
        raise SetupError(
            _("{path}: expected a Python file (.py) with blocks of your own", path=str(path))
        )
    before = Block.types
    module = sys.modules[name] = importlib.util.module_from_spec(spec)
    beside = str(path.parent.resolve())
    if beside not in sys.path:
        sys.path.append(beside)
    problem: str = ""
    try:
        spec.loader.exec_module(module)
    except (Exception, SystemExit) as error:  # a user's code may raise anything
        problem = join([_place(path, error), type(error).__name__, _text(error)], ": ")
    found = {name: cls for name, cls in Block.types.items() if before.get(name) is not cls}
    taken = [name for name in found if name in before and is_built_in(before[name])]
    if taken:
        problem = _(
            "{path}: {name} is the name of a built-in block; expected another name",
            path=str(path),
            name=taken[0],
        )
    elif not problem and not found:
        problem = _(
            "{path}: defines no block; expected a class made from Sensor, Actuator, RewardFunc, "
            "Brain or Controller",
            path=str(path),
        )
    if problem:
        Block.types = before
        raise SetupError(problem)
    return list(found.values())


def own_files() -> list[Path]:
    """Return the files whose blocks are loaded, so that a child process can load them too."""
    modules = {cls.__module__ for cls in Block.types.values()}
    files = [
        getattr(sys.modules.get(name), "__file__", None)
        for name in sorted(modules)
        if name.startswith(PREFIX)
    ]
    return [Path(file) for file in files if file]


def _place(path: Path, error: BaseException) -> str:
    """Return the file, and the line in it that raised the error."""
    if isinstance(error, SyntaxError) and error.filename == str(path):
        return _("{path}, line {line}", path=str(path), line=error.lineno or 0)
    lines = [
        frame.lineno
        for frame in traceback.extract_tb(error.__traceback__)
        if frame.filename == str(path)
    ]
    return _("{path}, line {line}", path=str(path), line=lines[-1] or 0) if lines else str(path)


def _text(error: BaseException) -> str:
    return error.msg if isinstance(error, SyntaxError) else text_of(error)
