"""A checkout as small as can be, which installs without a network."""

import shutil
import zipfile
from pathlib import Path

REPO = Path(__file__).resolve().parent.parent
PYPROJECT = """
[build-system]
requires = []
build-backend = "backend"
backend-path = ["."]

[project]
name = "ai4u-edu"
version = "1"
"""
# The smallest PEP 517 backend: it notes each call in builds.log, and installs one module.
BACKEND = """
import zipfile
def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    open("builds.log", "a").write("built\\n")
    name, info = "ai4u_edu-1-py3-none-any.whl", "ai4u_edu-1.dist-info/"
    with zipfile.ZipFile(wheel_directory + "/" + name, "w") as wheel:
        wheel.writestr("some_dependency.py", "")
        wheel.writestr(info + "METADATA", "Metadata-Version: 2.1\\nName: ai4u-edu\\nVersion: 1\\n"
            "Provides-Extra: dev\\nProvides-Extra: train\\n")
        wheel.writestr(info + "WHEEL", "Wheel-Version: 1.0\\nTag: py3-none-any\\n"
            "Root-Is-Purelib: true\\n")
        wheel.writestr(info + "RECORD", "")
    return name
"""
CLI = "import sys, some_dependency\ndef main(): print(sys.prefix, *sys.argv[1:])"


def make_checkout(root: Path) -> Path:
    package = root / "ai4u_edu"
    (package / "cli").mkdir(parents=True)
    for name in ("__main__.py", "bootstrap.py"):
        shutil.copy(REPO / "ai4u_edu" / name, package)
    (package / "__init__.py").touch()
    (package / "cli" / "__init__.py").touch()
    (package / "cli" / "main.py").write_text(CLI)
    (root / "pyproject.toml").write_text(PYPROJECT)
    (root / "backend.py").write_text(BACKEND)
    return root


def make_wheel(folder: Path, name: str, version: str) -> None:
    """A package with one empty module, to be installed without a network."""
    folder.mkdir()
    info = f"{name}-{version}.dist-info/"
    with zipfile.ZipFile(folder / f"{name}-{version}-py3-none-any.whl", "w") as wheel:
        wheel.writestr(f"{name}.py", "")
        wheel.writestr(
            info + "METADATA", f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n"
        )
        wheel.writestr(
            info + "WHEEL", "Wheel-Version: 1.0\nTag: py3-none-any\nRoot-Is-Purelib: true\n"
        )
        wheel.writestr(info + "RECORD", "")
