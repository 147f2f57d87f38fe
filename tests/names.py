"""Files that are derived from the blocks, so that a new block is named in one place.

``python -m tests.names`` lists those that are out of date; ``--write`` writes them again:

- the ``__init__.py`` of each folder of blocks: a module's ``__all__``, or else its public blocks;
- ``ai4u_edu/__init__.pyi``: the names of all blocks. The other packages' lines are kept;
- the table of AI4U's names in ``docs/from-ai4u.md``, from the docstrings.
"""

import importlib
import pkgutil
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import ai4u_edu
import ai4u_edu.blocks
from ai4u_edu import Block

PACKAGE = Path(ai4u_edu.__file__).parent
AI4U_PAGE = Path(__file__).parents[1] / "docs" / "from-ai4u.md"
FOLDERS = ("actuators", "brains", "brains/controllers", "rewards", "sensors")
"""The folders of ``ai4u_edu/blocks`` whose modules define blocks."""

TABLE = re.compile(r"(<!-- coming from AI4U -->\n)(.*?)(\n?<!-- end -->)", re.DOTALL)


def exports_of(module: ModuleType) -> list[str]:
    """Return a module's ``__all__``; without one, the names of the public blocks in it."""
    if hasattr(module, "__all__"):
        return list(module.__all__)
    return [
        name
        for name, value in vars(module).items()
        if isinstance(value, type)
        and issubclass(value, Block)
        and value.__module__ == module.__name__
        and not name.startswith("_")
        and not value.__dict__.get("abstract")
    ]


def folder_exports(folder: str) -> dict[str, list[str]]:
    """Return the exports of a folder of blocks, by module."""
    found = {}
    for each in pkgutil.iter_modules([str(PACKAGE / "blocks" / folder)]):
        if not each.ispkg:
            name = f"{package_of(folder)}.{each.name}"
            found[name] = exports_of(importlib.import_module(name))
    return {module: names for module, names in found.items() if names}


def package_of(folder: str) -> str:
    """Return the full name of a folder of blocks."""
    return f"ai4u_edu.blocks.{folder.replace('/', '.')}"


def folder_source(folder: str, old: str) -> str:
    """Return the source of a folder's ``__init__.py``; its docstring is kept."""
    exports = folder_exports(folder)
    docstring = re.match(r'""".*?"""\n', old, re.DOTALL)
    imports = [f"from {module} import {', '.join(names)}" for module, names in exports.items()]
    listed = [repr(name) for names in exports.values() for name in names]
    text = f"{docstring[0] if docstring else ''}\n" + "\n".join(imports)
    return formatted(f"{text}\n\n__all__ = [{', '.join(listed)},]\n")


def stub_source(old: str) -> str:
    """Return the source of ``ai4u_edu/__init__.pyi``."""
    kept = [line for line in old.splitlines() if not line.startswith("from ai4u_edu.blocks import")]
    blocks = [f"from ai4u_edu.blocks import {name} as {name}" for name in block_names()]
    return formatted("\n".join([*kept, *blocks]) + "\n", "pyi")


def block_names() -> Iterator[str]:
    """Yield the names that ``ai4u_edu.blocks`` exports: those of its folders, and its own."""
    own = set(ai4u_edu.blocks.__all__)
    for folder in FOLDERS:
        own.difference_update(importlib.import_module(package_of(folder)).__all__)
        for names in folder_exports(folder).values():
            yield from names
    yield from sorted(own)


def ai4u_page_source(old: str) -> str:
    """Return the page for users of AI4U with its table of names."""
    from ai4u_edu.blocks.docs import coming_from_ai4u

    return TABLE.sub(lambda match: f"{match[1]}{coming_from_ai4u()}\n<!-- end -->", old)


def table_in(text: str) -> str:
    """Return the table of AI4U's names as it stands in the page."""
    found = TABLE.search(text)
    return found[2] if found else ""


def formatted(source: str, ending: str = "py") -> str:
    """Return a source as ruff sorts and formats it."""
    name = f"--stdin-filename={PACKAGE / f'__init__.{ending}'}"
    sort = ["check", "--quiet", "--fix", "--select=I,RUF022", "--ignore=F401", name, "-"]
    for arguments in (sort, ["format", "--quiet", name, "-"]):
        command = [sys.executable, "-m", "ruff", *arguments]
        run = subprocess.run(command, input=source, capture_output=True, text=True, check=True)
        source = run.stdout
    return source


def derived() -> Iterator[tuple[Path, str]]:
    """Yield each derived file and what should stand in it."""
    for folder in FOLDERS:
        file = PACKAGE / "blocks" / folder / "__init__.py"
        yield file, folder_source(folder, file.read_text(encoding="utf-8"))
    stub = PACKAGE / "__init__.pyi"
    yield stub, stub_source(stub.read_text(encoding="utf-8"))
    yield AI4U_PAGE, ai4u_page_source(AI4U_PAGE.read_text(encoding="utf-8"))


def stale() -> list[Path]:
    """Return the derived files that are out of date."""
    return [file for file, text in derived() if file.read_text(encoding="utf-8") != text]


def main() -> None:
    """List the files that are out of date; with ``--write``, write them."""
    files = stale()
    if "--write" in sys.argv:
        for file, text in derived():
            file.write_text(text, encoding="utf-8")
    print(*files, sep="\n")
    sys.exit(bool(files) and "--write" not in sys.argv)


if __name__ == "__main__":
    main()
