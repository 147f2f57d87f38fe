"""Check what is published: ``python .ci/check_artifacts.py dist again``.

``dist`` and ``again`` are the folders of two builds, which have to give the same bytes::

    python -m build --outdir dist && python -m build --outdir again

With one folder, only contents and names are checked.
"""

import hashlib
import sys
import tarfile
import zipfile
from pathlib import Path

NEEDED = (
    "ai4u_edu/blocks/brains/zoo/box_chase.onnx",
    "ai4u_edu/lessons/course/00_start_here.py",
    "ai4u_edu/py.typed",
    "ai4u_edu/scenes/library/box_chase.yaml",
    "ai4u_edu/web/fonts/LICENSE",
    "ai4u_edu/web/page/main.js",
    "ai4u_edu/web/vendor/pyodide/LICENSE",
    "ai4u_edu/world/native/rays.c",
)
"""Files that each wheel has."""
SOURCES = ".ci/wheel_hook.py", "pyproject.toml", "tests/conftest.py", "web/page/main.js"
"""Files that the source distribution has besides the package."""
MAX_WHEEL_BYTES = 20_000_000


def main(folder: Path, again: Path | None) -> int:
    """Print what is wrong; return the exit status."""
    artifacts = sorted([*folder.glob("*.whl"), *folder.glob("*.tar.gz")])
    problems = [] if artifacts else [f"{folder}: expected wheels, and there are none"]
    for path in artifacts:
        check = wheel_problems if path.suffix == ".whl" else source_problems
        problems += [f"{path.name}: {each}" for each in check(path)]
        if again is not None:
            problems += [f"{path.name}: {each}" for each in differences(path, again / path.name)]
        checksum = hashlib.sha256(path.read_bytes()).hexdigest()
        print(f"{checksum}  {path.name}, {path.stat().st_size:,} bytes")
    print("\n".join(problems) or "all is well")
    return int(bool(problems))


def wheel_problems(path: Path) -> list[str]:
    """Return what is wrong with a wheel."""
    with zipfile.ZipFile(path) as packed:
        names = set(packed.namelist())
    tag = path.stem.split("-", 2)[2]
    libraries = [name for name in names if name.endswith((".dll", ".dylib", ".so"))]
    problems = [f"{name} is missing" for name in NEEDED if name not in names]
    outside = {name.partition("/")[0] for name in names} - {"ai4u_edu"}
    if len(outside) != 1 or not next(iter(outside)).endswith(".dist-info"):
        problems.append(f"expected only ai4u_edu and its dist-info, got {sorted(outside)}")
    if not tag.startswith("py3-none-"):
        problems.append(f"expected a tag for every Python 3, got {tag}")
    if len(libraries) != (tag != "py3-none-any"):
        problems.append(f"{tag}: {len(libraries)} compiled libraries")
    if any("__pycache__" in name for name in names):
        problems.append("holds compiled Python")
    if path.stat().st_size > MAX_WHEEL_BYTES:
        problems.append(f"is larger than {MAX_WHEEL_BYTES:,} bytes")
    return problems


def source_problems(path: Path) -> list[str]:
    """Return what is wrong with a source distribution."""
    with tarfile.open(path) as packed:
        names = {name.partition("/")[2] for name in packed.getnames()}
    problems = [f"{name} is missing" for name in SOURCES if name not in names]
    return problems + [f"holds {name}" for name in names if name.endswith((".dll", ".so"))]


def differences(path: Path, other: Path) -> list[str]:
    """Return a sentence if two builds differ."""
    if not other.exists():
        return [f"{other} is missing"]
    return [] if path.read_bytes() == other.read_bytes() else ["two builds give other bytes"]


if __name__ == "__main__":
    folders = [Path(each) for each in sys.argv[1:3]]
    if not folders:
        sys.exit("usage: python .ci/check_artifacts.py DIST [AGAIN]")
    sys.exit(main(folders[0], folders[1] if len(folders) > 1 else None))
