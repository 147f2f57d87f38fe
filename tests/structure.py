"""Measure the structure of the package: ``python -m tests.structure``.

A stranger pays for what a piece of code reaches, for circles, and for each way into a package. The
figures that may only get better stand in ``structure.json``; ``--write`` puts today's there.

An import inside a function counts, and so does a name given to ``import_module``. Names that a
package imports at first access count where they are used. The modules that ``base/options.py``
names do not count, since whatever loads one works without it; ``tests/room/test_options.py`` and
``tests/learn/envs/test_without_page.py`` refuse them and try that.
"""

import argparse
import ast
import json
import subprocess
import sys
import textwrap
import tomllib
from collections import Counter
from collections.abc import Iterable, Iterator
from functools import cached_property
from pathlib import Path

import grimp

ROOT = Path(__file__).resolve().parent.parent
LIMITS = Path(__file__).with_suffix(".json")
LEFT_OUT = {"__main__", "bootstrap", "registration"}
"""Modules beside the packages: entry points."""
STARTS = {
    "SceneEnv": "ai4u_edu.learn.envs.scene_env",
    "play": "ai4u_edu.cli.play",
    "remote.connect": "ai4u_edu.remote.robot",
    "Scene.build": "ai4u_edu.scenes.scene",
}
"""Module from which each closure begins."""
PROGRAMS = {
    "SceneEnv": """
        from ai4u_edu.learn.envs import SceneEnv
        env = SceneEnv("box_chase")
        env.reset(seed=1)
        for _ in range(10):
            env.step(env.action_space.sample())
        """,
    "remote.connect": "from ai4u_edu import remote; remote.connect",
    "Scene.build": """
        from ai4u_edu import Scene
        sim = Scene.load("box_chase").build()
        sim.reset(seed=1)
        for _ in range(10):
            sim.step()
        """,
}
"""Programs that are run to see which modules they really load."""


class Structure:
    """A package's modules and their imports.

    Args:
        package: name of an importable package.
        folder: the folder that has it.
    """

    def __init__(self, package: str = "ai4u_edu", folder: Path = ROOT) -> None:
        self.package = package
        self._folder = folder
        self._graph = grimp.build_graph(package, cache_dir=None)
        self._at_run_time = grimp.build_graph(
            package, cache_dir=None, exclude_type_checking_imports=True
        )
        self._files = {
            name: file for name in self._graph.modules if (file := self._file(name)) is not None
        }
        self._trees = {
            name: ast.parse(file.read_text(encoding="utf-8")) for name, file in self._files.items()
        }

    @property
    def modules(self) -> set[str]:
        """Names of all modules that have a file."""
        return set(self._files)

    @property
    def top_packages(self) -> set[str]:
        """Names of the packages at the top, such as ``agent``."""
        folders = (self._folder / self.package).iterdir()
        return {each.name for each in folders if list(each.glob("*.py"))}

    @cached_property
    def arrows(self) -> set[tuple[str, str]]:
        """Pairs of packages at the top of which the first imports the second."""
        found = set()
        for importer in self._graph.modules:
            for imported in self._graph.find_modules_directly_imported_by(importer):
                pair = self._top(importer), self._top(imported)
                if pair[0] != pair[1] and self.top_packages.issuperset(pair):
                    found.add(pair)
        return found

    def upward(self, rows: list[list[str]]) -> set[tuple[str, str]]:
        """Return the arrows that do not lead to a lower row.

        Args:
            rows: the packages of each layer, the topmost layer first.
        """
        place = {name: number for number, row in enumerate(rows) for name in row}
        return {pair for pair in self.arrows if place.get(pair[0], 0) >= place.get(pair[1], 0)}

    @property
    def floors(self) -> int:
        """Length of the longest chain of packages, each of which imports the next."""
        targets: dict[str, set[str]] = {name: set() for name in self.top_packages}
        for importer, imported in self.arrows:
            targets[importer].add(imported)
        height: dict[str, int] = {}
        for _ in targets:  # longer than that many arrows a chain without a circle can't be
            height = {
                name: 1 + max((height.get(each, 0) for each in imported), default=0)
                for name, imported in targets.items()
            }
        return max(height.values())

    @cached_property
    def circles(self) -> list[list[str]]:
        """Groups of modules that reach each other when they run."""
        return _circles(self._at_run_time)

    @cached_property
    def circles_of_types(self) -> list[list[str]]:
        """Groups of modules that reach each other, imports for a type checker included."""
        return [each for each in _circles(self._graph) if each not in self.circles]

    @property
    def single_importers(self) -> list[str]:
        """Modules that one module alone imports, of the same folder."""
        found = []
        for name in sorted(self.modules):
            importers = self._graph.find_modules_that_directly_import(name)
            folder = name.rpartition(".")[0]
            if folder != self.package and {each.rpartition(".")[0] for each in importers} == {
                folder
            }:
                found += [name] * (len(importers) == 1)
        return found

    @property
    def repeated_classes(self) -> list[str]:
        """Names of classes that stand in several files."""
        names = Counter(
            node.name
            for tree in self._trees.values()
            for node in tree.body
            if isinstance(node, ast.ClassDef)
        )
        return sorted(name for name, count in names.items() if count > 1)

    def closure(self, *starts: str) -> set[str]:
        """Return the modules that may be loaded once these are: theirs, and whatever they name."""
        found: set[str] = set()
        waiting = list(starts)
        while waiting:
            name = waiting.pop()
            if name not in found and name in self._graph.modules:
                found.add(name)
                waiting += self._at_run_time.find_modules_directly_imported_by(name)
                waiting += self._named_in(name)
                waiting += [name.rpartition(".")[0]]
        return found & self.modules

    def lines(self, modules: Iterable[str]) -> int:
        """Return the number of lines of these modules' files."""
        return sum(len(self._files[each].read_text("utf-8").splitlines()) for each in modules)

    def _named_in(self, name: str) -> Iterator[str]:
        """Yield the modules whose names a module gives to ``import_module``."""
        is_door = self._files[name].name == "__init__.py" if name in self._files else True
        for node in ast.walk(self._trees[name]) if not is_door else ():
            if isinstance(node, ast.Call) and ast.unparse(node.func).endswith("import_module"):
                argument = node.args[0]
                if isinstance(argument, ast.JoinedStr):
                    argument = argument.values[0]  # all modules whose names begin so
                if isinstance(argument, ast.Constant):
                    start = str(argument.value)
                    yield from (each for each in self._files if each.startswith(start))

    def _file(self, name: str) -> Path | None:
        path = self._folder / name.replace(".", "/")
        candidates = (path / "__init__.py", path.with_suffix(".py"))
        return next((each for each in candidates if each.is_file()), None)

    def _top(self, name: str) -> str:
        """Return the package at the top in which a module lies."""
        return (name + "..").split(".")[1]


def _circles(graph: grimp.ImportGraph) -> list[list[str]]:
    reached = {name: graph.find_upstream_modules(name) for name in graph.modules}
    groups = {
        tuple(sorted({name, *(each for each in reached[name] if name in reached[each])}))
        for name in graph.modules
    }
    return sorted(list(each) for each in groups if len(each) > 1)


def layers() -> list[list[str]]:
    """Return the packages of each layer of pyproject.toml's contract, the topmost layer first."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    contract = next(
        c for c in project["tool"]["importlinter"]["contracts"] if c["type"] == "layers"
    )
    rows = [[name.strip() for name in row.split("|")] for row in contract["layers"]]
    # in parentheses: a row for a package that may come
    kept = [[name for name in row if name not in LEFT_OUT and name[0] != "("] for row in rows]
    return [row for row in kept if row]


def figures(structure: Structure) -> dict[str, int]:
    """Return all figures, those without a limit included."""
    found = {
        "files": len(structure.modules),
        "lines": structure.lines(structure.modules),
        "packages at the top": len(structure.top_packages),
        "arrows between packages": len(structure.arrows),
        "floors": structure.floors,
        "upward arrows": len(structure.upward(layers())),
        "circles": len(structure.circles),
        "files in circles": sum(map(len, structure.circles)),
        "circles of types alone": len(structure.circles_of_types),
        "files with a single importer in their folder": len(structure.single_importers),
        "class names in several files": len(structure.repeated_classes),
    }
    for name, start in STARTS.items():
        modules = structure.closure(start)
        without_blocks = {each for each in modules if not each.startswith("ai4u_edu.blocks.")}
        found[f"{name}: files"] = len(modules)
        found[f"{name}: lines"] = structure.lines(modules)
        found[f"{name}: files without blocks"] = len(without_blocks)
    return found


def loaded_by(program: str) -> set[str]:
    """Return the modules of the package that a program has loaded at its end."""
    code = f"{textwrap.dedent(program)}\nimport sys; print(*sys.modules)"
    command = [sys.executable, "-c", code]
    output = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    return {each for each in output.split() if (each + ".").startswith("ai4u_edu.")}


def limits() -> dict[str, int]:
    """Return the figures that may only fall."""
    known: dict[str, int] = json.loads(LIMITS.read_text(encoding="utf-8"))
    return known


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(prog="python -m tests.structure", description=__doc__)
    parser.add_argument("--write", action="store_true", help="make today's figures the limits")
    parser.add_argument("--list", action="store_true", help="list the modules behind the figures")
    options = parser.parse_args()
    structure = Structure()
    measured = figures(structure)
    known = limits()
    for name, program in PROGRAMS.items():
        measured[f"{name}: files really loaded"] = len(loaded_by(program) & structure.modules)
    for name, figure in measured.items():
        print(f"{name:<46}{figure:>8,}" + (f"   limit {known[name]:,}" if name in known else ""))
    if options.list:
        for title, groups in {
            "circles": structure.circles,
            "circles of types alone": structure.circles_of_types,
            "single importers": [structure.single_importers],
            "classes": [structure.repeated_classes],
        }.items():
            print(f"\n{title}:")
            for group in groups:
                print("  " + "\n    ".join(group))
    if options.write:
        new = {name: measured[name] for name in known}
        LIMITS.write_text(json.dumps(new, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
