"""Loading of a user's own blocks from a Python file, which runs with all rights."""

import hashlib
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

_loaded: dict[Path, list[type[Block]]] = {}
"""Blocks of each file that was loaded, in the order in which the files were."""


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
    file = path.absolute()
    name = _module_name(file)
    spec = importlib.util.spec_from_file_location(name, file)
    if path.suffix != ".py" or not path.is_file() or spec is None or spec.loader is None:
        raise SetupError(
            _("{path}: expected a Python file (.py) with blocks of your own", path=str(path))
        )
    before, module_before = Block.types, sys.modules.get(name)
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
        sys.modules.pop(name, None)
        if module_before is not None:
            sys.modules[name] = module_before
        raise SetupError(problem)
    _loaded.pop(file, None)  # what is loaded again comes last
    _loaded[file] = list(found.values())
    return _loaded[file].copy()


def own_files() -> list[Path]:
    """Return the files whose blocks are loaded, so that a child process can load them too.

    Returns:
        Absolute paths, in the order in which the files were loaded: of two blocks with one name,
        the last holds there as well.
    """
    return [
        file
        for file, classes in _loaded.items()
        if any(Block.types.get(cls.__name__) is cls for cls in classes)
    ]


def _module_name(file: Path) -> str:
    """Return a module's name that no file in another folder has; equal in every process."""
    digest = hashlib.sha256(str(file).encode()).hexdigest()
    return f"{PREFIX}{file.stem.replace('.', '_')}_{digest[:16]}"


def _place(path: Path, error: BaseException) -> str:
    """Return the file, and the line in it that raised the error."""
    file = str(path.absolute())  # the name that its code was compiled with
    if isinstance(error, SyntaxError) and error.filename == file:
        return _("{path}, line {line}", path=str(path), line=error.lineno or 0)
    lines = [
        frame.lineno
        for frame in traceback.extract_tb(error.__traceback__)
        if frame.filename == file
    ]
    return _("{path}, line {line}", path=str(path), line=lines[-1] or 0) if lines else str(path)


def _text(error: BaseException) -> str:
    return error.msg if isinstance(error, SyntaxError) else text_of(error)
