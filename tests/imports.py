"""The imports of the package's files, followed through the packages that pass names on."""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def needed_by(path: str) -> set[str]:
    """Return the files of the package whose names a file imports, wherever in the file it does."""
    found = {
        file for module, name in _imported_names(ROOT / path) for file in _definers(module, name)
    }
    return {file for file in found if not file.endswith("__init__.py")} - {path}


@cache
def _module_path(name: str) -> Path | None:
    """Return the file of a module; None if there is no such module."""
    path = ROOT / Path(*name.split("."))
    files = path.with_suffix(".py"), path / "__init__.py"
    return next((file for file in files if file.is_file()), None)


@cache
def _imported_names(file: Path) -> tuple[tuple[str, str], ...]:
    """Return (module, name) of all that a file imports from the package."""
    return tuple(
        (node.module, alias.name)
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
        if isinstance(node, ast.ImportFrom) and node.module and _is_ours(node.module)
        for alias in node.names
    )


def _is_ours(module: str) -> bool:
    return module.partition(".")[0] == "ai4u_edu"


def _definers(module: str, name: str) -> Iterator[str]:
    """Yield the file that defines an imported name."""
    inner = _module_path(f"{module}.{name}")
    if inner is not None:
        yield str(inner.relative_to(ROOT))
        return
    file = _module_path(module)
    assert file is not None, module
    for origin, known in _imported_names(file) if file.name == "__init__.py" else ():
        if known == name or (known == "*" and name in _exports_of(origin)):
            yield from _definers(origin, name)
            return
    yield str(file.relative_to(ROOT))


@cache
def _exports_of(package: str) -> frozenset[str]:
    file = _module_path(package)
    assert file is not None, package
    return frozenset(known for _, known in _imported_names(file))
