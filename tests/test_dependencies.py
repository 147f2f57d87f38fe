"""Every package that ai4u_edu imports stands in pyproject.toml, and every one there is imported."""

import ast
import re
import sys
import tomllib
from importlib.metadata import packages_distributions
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
OWN = {"ai4u_edu", "tests"}
NOT_IMPORTED = {
    "jupyterlab",  # started as a program
    "jupyterlab-language-pack-pt-br",  # jupyterlab finds it
    "ipykernel",  # the kernel that jupyterlab starts
    "jupyterhub",  # starts a student's server
    "jupyter-server-proxy",  # brings worlds into the browser
    "onnxscript",  # torch.onnx imports it
    "tensorboard",  # Stable-Baselines3 imports it
}
"""Declared packages that are needed without an import of ours."""
FOR_TESTS = {"dev", "docs", "fuzz", "test"}
"""Extras that only the tests and the docs site use."""


def names(requirements: list[str]) -> set[str]:
    found = {normal(re.split(r"[^\w.-]", each, maxsplit=1)[0]) for each in requirements}
    return found - {"ai4u-edu"}


def normal(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def imported(folder: Path) -> dict[str, str]:
    """Return the file that first imports each foreign package, by the module's name."""
    found: dict[str, str] = {}
    for path in sorted(folder.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            modules: list[str] = []
            if isinstance(node, ast.Import):
                modules = [each.name for each in node.names]
            elif isinstance(node, ast.ImportFrom) and node.module:
                modules = [node.module]
            for top in {module.partition(".")[0] for module in modules}:
                if top not in sys.stdlib_module_names and top not in OWN:
                    found.setdefault(top, str(path.relative_to(ROOT)))
    return found


def test_all_imports_are_declared_and_all_declared_packages_are_used() -> None:
    project: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = project["optional-dependencies"]
    declared = names(project["dependencies"]).union(
        *(names(extras[each]) for each in extras.keys() - FOR_TESTS)
    )
    of_module = packages_distributions()
    used: set[str] = set()
    undeclared = {}
    for module, where in imported(ROOT / "ai4u_edu").items():
        packages = {normal(each) for each in of_module.get(module, [module])}
        used |= packages
        if not packages & declared:
            undeclared[module] = where
    assert undeclared == {}, "imported, and not declared in pyproject.toml"
    assert declared - used - NOT_IMPORTED == set(), "declared in pyproject.toml, and never imported"
