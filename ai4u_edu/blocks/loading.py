"""Running of a user's own Python files: for the blocks in them, or for a driver."""

import hashlib
import importlib.util
import sys
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType

from ai4u_edu.base.errors import SetupError, text_of
from ai4u_edu.blocks.block import Block, is_built_in
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join

PREFIX = "own_"
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
    if path.suffix != ".py" or not path.is_file():
        raise SetupError(
            _("{path}: expected a Python file (.py) with blocks of your own", path=str(path))
        )
    file, before = path.absolute(), Block.types
    with _taken_back_after_an_error(_module_name(file)):
        run_file(path)
        found = _new_blocks(before)
        if not found:
            raise SetupError(
                _(
                    "{path}: defines no block; expected a class made from Sensor, Actuator, "
                    "RewardFunc, Brain or Controller",
                    path=str(path),
                )
            )
    _loaded.pop(file, None)  # what is loaded again comes last
    _loaded[file] = found
    return found.copy()


def run_file(path: Path, shown: str = "") -> ModuleType:
    """Run a Python file without any sandbox, and return its module.

    Blocks that it defines are registered.

    Args:
        path: path of the file; it can import modules from its folder.
        shown: the file's name in errors; its path if empty.

    Raises:
        SetupError: the file can't be run, with the line of the mistake, or gives a block the name
            of a built-in one; then no new classes are registered.
    """
    shown, file, before = shown or str(path), path.absolute(), Block.types
    name = _module_name(file)
    spec = importlib.util.spec_from_file_location(name, file)
    if not path.is_file() or spec is None or spec.loader is None:
        raise SetupError(_("{path}: expected a Python file (.py)", path=shown))
    beside = str(path.parent.resolve())
    if beside not in sys.path:
        sys.path.append(beside)
    problem: str = ""
    with _taken_back_after_an_error(name):
        module = sys.modules[name] = importlib.util.module_from_spec(spec)
        try:
            spec.loader.exec_module(module)
        except (Exception, SystemExit) as error:  # a user's code may raise anything
            problem = join([_place(shown, file, error), type(error).__name__, _text(error)], ": ")
        found = _new_blocks(before)
        taken = [cls.__name__ for cls in found if is_built_in(before.get(cls.__name__, cls))]
        if taken:
            problem = _(
                "{path}: {name} is the name of a built-in block; expected another name",
                path=shown,
                name=taken[0],
            )
        if problem:
            raise SetupError(problem)
    if found and file in _loaded:  # it ran for a driver now, and has made its classes again
        _loaded[file] = found
    return module


@contextmanager
def _taken_back_after_an_error(module: str) -> Iterator[None]:
    """Forget the new classes, and put an earlier module back, if something is raised."""
    types, earlier = Block.types, sys.modules.get(module)
    try:
        yield
    except BaseException:
        Block.types = types
        sys.modules.pop(module, None)
        if earlier is not None:
            sys.modules[module] = earlier
        raise


def _new_blocks(before: dict[str, type[Block]]) -> list[type[Block]]:
    return [cls for name, cls in Block.types.items() if before.get(name) is not cls]


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


def _place(shown: str, file: Path, error: BaseException) -> str:
    """Return the file, and the line in it that raised the error."""
    compiled_as = str(file)
    if isinstance(error, SyntaxError) and error.filename == compiled_as:
        return _("{path}, line {line}", path=shown, line=error.lineno or 0)
    lines = [
        frame.lineno
        for frame in traceback.extract_tb(error.__traceback__)
        if frame.filename == compiled_as
    ]
    return _("{path}, line {line}", path=shown, line=lines[-1] or 0) if lines else shown


def _text(error: BaseException) -> str:
    return error.msg if isinstance(error, SyntaxError) else text_of(error)
