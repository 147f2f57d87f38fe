"""The reference of the Python API: a page for each package with public names."""

import ast
import inspect
from enum import Enum
from functools import cache
from importlib import import_module
from itertools import pairwise
from types import ModuleType

from pydantic import BaseModel

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks.docs import ParameterRow, built_in_blocks, schema_rows
from ai4u_edu.blocks.parameterized import Parameterized, field_docs
from tests.docs_site import rst
from tests.docs_site.staging import ROOT, Staging

FOLDER = "api"
PACKAGES = (
    "ai4u_edu",
    "ai4u_edu.agent",
    "ai4u_edu.base.errors",
    "ai4u_edu.check",
    "ai4u_edu.learn.envs",
    "ai4u_edu.explain",
    "ai4u_edu.games.jobs",
    "ai4u_edu.lessons",
    "ai4u_edu.program",
    "ai4u_edu.recording",
    "ai4u_edu.remote",
    "ai4u_edu.room",
    "ai4u_edu.scenes",
    "ai4u_edu.snapshot",
    "ai4u_edu.learn.training",
    "ai4u_edu.world",
)
"""Packages for users. The others make up the program: see the page on architecture."""


def documented_names() -> dict[str, list[str]]:
    """Return the names that each package's page documents; a name is documented once only.

    Blocks have pages of their own.
    """
    blocks = [cls for members in built_in_blocks().values() for cls in members]
    seen = {(cls.__name__, id(cls)) for cls in blocks}
    found: dict[str, list[str]] = {}
    for package in PACKAGES:
        module = import_module(package)
        for name in sorted(_public(module), key=str.lower):
            entry = name, id(getattr(module, name))
            if name.startswith("__") or entry in seen:
                continue
            seen.add(entry)
            found.setdefault(package, []).append(name)
    return found


def _public(module: ModuleType) -> list[str]:
    """Return a package's ``__all__``; of the module of errors, all errors."""
    if hasattr(module, "__all__"):
        return list(module.__all__)
    return [name for name, value in vars(module).items() if _is_error(value)]


def _is_error(value: object) -> bool:
    return inspect.isclass(value) and issubclass(value, AI4UError)


def add_api(site: Staging) -> None:
    """Write a page for each package, and the list of them."""
    names = documented_names()
    for package, own in names.items():
        site.write(f"{FOLDER}/{package}.rst", _page(package, own))
    rows = [f"- [{package}]({FOLDER}/{package}.rst): {_first_line(package)}" for package in names]
    entries = "\n".join(f"{FOLDER}/{package}" for package in names)
    listed = "\n".join(rows)
    site.append("api.md", f"{listed}\n\n```{{toctree}}\n:hidden:\n\n{entries}\n```\n")


def _first_line(package: str) -> str:
    text = (import_module(package).__doc__ or "").strip().partition("\n")[0]
    return text.replace("``", "`")


def _page(package: str, names: list[str]) -> str:
    module = import_module(package)
    parts = [rst.title(package), f".. automodule:: {package}\n"]
    rows = [(f":py:obj:`{name} <{package}.{name}>`", _summary(module, name)) for name in names]
    parts.append(rst.table(("name", "what it is"), rows, (1, 3)))
    parts += [_entry(module, name) for name in names]
    others = sorted({each for each in _public(module) if not each.startswith("__")} - {*names})
    if others:
        links = ", ".join(f":py:obj:`{each} <{each}>`" for each in others)
        parts.append(f"Also in this package, and described elsewhere: {links}.\n")
    return "\n".join(parts)


def _summary(module: ModuleType, name: str) -> str:
    """Return the first sentence about a name."""
    value = getattr(module, name)
    if inspect.isclass(value) or inspect.isroutine(value):
        return (inspect.getdoc(value) or "").partition("\n")[0]
    return constant_text(module.__name__, name)


def _entry(module: ModuleType, name: str) -> str:
    value, full = getattr(module, name), f"{module.__name__}.{name}"
    if inspect.isclass(value):
        rows = _rows(value)
        if not rows:
            undocumented = "   :undoc-members:\n" if issubclass(value, Enum) else ""
            return f".. autoclass:: {full}\n   :members:\n{undocumented}"
        fields = ", ".join({*value.__annotations__, *(row.name for row in rows)})
        return (
            f".. autoclass:: {full}(**parameters)\n   :members:\n"
            f"   :exclude-members: model_config, {fields}\n\n"
            f".. rubric:: Parameters of {name}\n\n{rst.parameters(rows)}"
        )
    if inspect.isroutine(value):
        return f".. autofunction:: {full}\n"
    text = constant_text(module.__name__, name)
    return f".. py:data:: {full}\n   :value: {value!r}\n\n   {text}\n"


def constant_text(module: str, name: str) -> str:
    """Return the text under a constant or type alias, where the module or a package got it from.

    Sphinx finds the text of a class and a function in the object, and a constant has none.
    """
    own = _module_body(module)
    for assigned, text in pairwise(own):
        match assigned, text:
            case (
                ast.Assign(targets=[ast.Name(id=each)]) | ast.AnnAssign(target=ast.Name(id=each)),
                ast.Expr(value=ast.Constant(value=str(words))),
            ) if each == name:
                return " ".join(words.split())
    for node in own:
        match node:
            case ast.ImportFrom(module=str(other), names=names):
                for alias in names:
                    if (alias.asname or alias.name) == name:
                        return constant_text(other, alias.name)
    return ""


@cache
def _module_body(module: str) -> list[ast.stmt]:
    """Return the statements of a module of this package, and of its stub; none of any other."""
    path = ROOT / module.replace(".", "/")
    file = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
    files = [each for each in (file, file.with_suffix(".pyi")) if each.is_file()]
    return [node for each in files for node in ast.parse(each.read_text(encoding="utf-8")).body]


def _rows(cls: type) -> list[ParameterRow]:
    """Return the parameters of a class that declares them as annotated fields; else none."""
    if issubclass(cls, Parameterized):
        return schema_rows(cls.json_schema())
    if not issubclass(cls, BaseModel):
        return []
    schema, texts = cls.model_json_schema(), field_docs(cls)
    for name, about in schema["properties"].items():
        about.setdefault("description", texts.get(name, ""))
        if "$ref" in about:
            about["type"] = about["$ref"].rpartition("/")[2]
    return schema_rows(schema)
