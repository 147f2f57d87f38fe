"""Sphinx extension: references between the package's names, and the list of external links."""

import builtins
import contextlib
import re
import sys
import types
import typing
from collections import defaultdict
from collections.abc import Sequence
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.addnodes import pending_xref
from sphinx.application import Sphinx
from sphinx.domains.python import PythonDomain
from sphinx.environment import BuildEnvironment
from sphinx.util.nodes import make_refnode

from ai4u_edu.locale import LANGUAGES, SOURCE

ROOT = Path(__file__).resolve().parents[2]
EXTERNAL_LINKS = "external_links.txt"
"""File beside the pages with all links to other hosts, which the build does not fetch."""


def setup(app: Sphinx) -> dict[str, Any]:
    """Add the extension to Sphinx."""
    texts = AttributeTexts()
    app.connect("autodoc-process-docstring", texts.keep, priority=400)  # before Napoleon
    app.connect("autodoc-process-docstring", texts.restore, priority=600)
    app.connect("missing-reference", resolve)
    app.connect("html-page-context", add_languages)
    app.connect("build-finished", write_external_links)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}


def add_languages(
    app: Sphinx, page: str, template: str, context: dict[str, Any], doctree: nodes.document | None
) -> None:
    """Tell the template of a page where the page is in the other languages."""
    own = app.config.language
    root = "../" * (page.count("/") + (own != SOURCE))
    places = {code: "" if code == SOURCE else f"{code}/" for code in LANGUAGES if code != own}
    context["languages"] = [
        (code.replace("_", "-"), LANGUAGES[code], f"{root}{place}{page}.html")
        for code, place in places.items()
    ]


class AttributeTexts:
    """Keeps the texts of attributes from Napoleon, which takes words before a colon for a type."""

    def __init__(self) -> None:
        self._kept: list[str] = []

    def keep(
        self, app: Sphinx, what: str, name: str, value: object, options: object, lines: list[str]
    ) -> None:
        """Copy a text."""
        self._kept = lines.copy()

    def restore(
        self, app: Sphinx, what: str, name: str, value: object, options: object, lines: list[str]
    ) -> None:
        """Put back the text of an attribute."""
        if what in {"attribute", "data", "property"}:
            lines[:] = self._kept


def resolve(
    app: Sphinx, env: BuildEnvironment, node: pending_xref, contnode: nodes.TextElement
) -> nodes.Element | None:
    """Resolve a reference to a Python name by the last part of the name.

    A class is documented under its public name (``ai4u_edu.Scene``), and annotations give the place
    of its definition (``ai4u_edu.scenes.scene.Scene``). A name that exists and has no entry, such
    as one of another library, stays plain text. For anything else Sphinx warns.
    """
    if node.get("refdomain") != "py":
        return None
    domain = env.domains["py"]
    assert isinstance(domain, PythonDomain)
    target = str(node["reftarget"])
    found = _documented(domain, target)
    if found is not None:
        name, entry = found
        place = node.get("refdoc") or env.docname
        return make_refnode(app.builder, place, entry.docname, entry.node_id, contnode, name)
    return contnode if exists(target) else None


def _documented(domain: PythonDomain, target: str) -> tuple[str, Any] | None:
    """Return the only entry whose name ends like a reference's target."""
    first = target.partition(".")[0]
    if first != "ai4u_edu" and first.islower() and "." in target:
        return None  # of another package
    for length in (2, 1):  # Class.method, or Class
        ending = "." + ".".join(target.split(".")[-length:])
        found = [each for each in domain.objects.items() if each[0].endswith(ending)]
        if len(found) == 1:
            return found[0]
    return None


@cache
def exists(target: str) -> bool:
    """Return True if there is such a name: in any package, or in a module of this one.

    Annotations and docstrings use the names of the module in which they stand, which autodoc does
    not tell.
    """
    name = target.partition("[")[0].removeprefix("types.")  # types.Annotated, says Sphinx
    if hasattr(builtins, name.partition(".")[0]) or _has_attributes(types, name.split(".")):
        return True
    own = [module for key, module in sys.modules.items() if key.startswith("ai4u_edu")]
    parts = name.split(".")
    if name.isidentifier() and _is_defined(name):
        return True  # in a module that nobody has imported
    if any(_has_attributes(module, parts) for module in [typing, *own]):
        return True
    for length in range(len(parts), 0, -1):
        with contextlib.suppress(ImportError, ValueError):
            return _has_attributes(import_module(".".join(parts[:length])), parts[length:])
        if _is_module(parts[:length]):  # it imports what is not installed
            return not parts[length:] or _is_defined(parts[length])
    return False


def _is_module(parts: Sequence[str]) -> bool:
    """Return True for the name of a module or package of this package."""
    path = ROOT.joinpath(*parts)
    return path.with_suffix(".py").is_file() or (path / "__init__.py").is_file()


def _is_defined(name: str) -> bool:
    """Return True if some module of this package defines a name."""
    return re.search(rf"^ *(class |def )?{name}\b.*[:=]", _sources(), re.MULTILINE) is not None


@cache
def _sources() -> str:
    """Return the source of all modules of the package."""
    files = sorted((ROOT / "ai4u_edu").rglob("*.py"))
    return "\n".join(file.read_text(encoding="utf-8") for file in files)


def _has_attributes(value: Any, names: Sequence[str]) -> bool:
    """Return True if a value has an attribute, which has the next one, and so on."""
    for name in names:
        if name in getattr(value, "__annotations__", {}):
            return True
        if name not in dir(value):
            return False
        value = getattr(value, name)
    return True


def write_external_links(app: Sphinx, error: Exception | None) -> None:
    """Write all links to other hosts into a file, each with the pages that have it."""
    if error is not None or app.builder.name != "html":
        return
    pages: dict[str, set[str]] = defaultdict(set)
    for docname in sorted(app.env.found_docs):
        for node in app.env.get_doctree(docname).findall(nodes.reference):
            if re.match("https?://", address := str(node.get("refuri", ""))):
                pages[address].add(docname)
    lines = [f"{address}  {' '.join(sorted(names))}" for address, names in sorted(pages.items())]
    (app.outdir / EXTERNAL_LINKS).write_text("\n".join(lines) + "\n", encoding="utf-8")
