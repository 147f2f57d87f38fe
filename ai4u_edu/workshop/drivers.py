"""Who may drive an agent in place of its own brain, by a name that a page can send."""

import ast
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ai4u_edu.blocks import Block, Brain, Controller, LocalBrain, ReplayController
from ai4u_edu.errors import SetupError, suggest
from ai4u_edu.recording import Episode
from ai4u_edu.syntax import parsed
from ai4u_edu.workshop.script import run_file

SCRIPT, RECORDING = "script:", "recording:"


@dataclass(frozen=True)
class Driver:
    """Somebody who may drive."""

    name: str
    """By which :meth:`Workshop.drive` knows it."""
    title: str
    """What a person calls it."""


class Drivers:
    """The scripts and recordings from which a page may choose.

    A page sends names, never code: a script is a file that whoever started the world has named, or
    that lies in a folder that was named.

    Args:
        places: Python files and ``.episode`` files, and folders of them.
    """

    def __init__(self, places: Iterable[Path] = ()) -> None:
        self._places = tuple(places)
        self._taken: dict[str, tuple[Episode, str]] = {}

    def offered(self) -> list[Driver]:
        """All that there are now; files that came since the start too."""
        scripts = [
            Driver(f"{SCRIPT}{path.name}:{name}", f"{path.name}: {name}")
            for path in self._files(".py")
            for name in _drivers_in(path)
        ]
        recordings = [
            Driver(f"{RECORDING}{path.name}", f"Recording {path.stem}")
            for path in self._files(".episode")
        ]
        kept = [Driver(name, f"Recording {name.removeprefix(RECORDING)}") for name in self._taken]
        return [*scripts, *recordings, *kept]

    def keep(self, episode: Episode, name: str, agent: str = "") -> str:
        """Offers an episode that lies in no file; the name by which it is known then."""
        full = f"{RECORDING}{name}"
        self._taken[full] = episode, agent
        return full

    def brain(self, name: str, agent_id: str, like: Brain) -> Brain:
        """A new brain.

        Args:
            name: of a driver.
            agent_id: whom it is to drive.
            like: decides as often as this one, where the driver has no rhythm of its own.

        Raises:
            AI4UError: there is no such driver, or its file can't be read or run.
        """
        rhythm: dict[str, Any] = {
            "skip_frame": like.skip_frame,
            "repeat_action": like.repeat_action,
        }
        if name in self._taken:
            return _again(*self._taken[name], agent_id)
        if name.startswith(RECORDING):
            path = self._file(name.removeprefix(RECORDING), ".episode")
            return _again(Episode.load(path), "", agent_id)
        file, _, function = name.removeprefix(SCRIPT).rpartition(":")
        path = self._file(file, ".py")
        if function not in _drivers_in(path):
            raise SetupError(
                f"{path.name} has no driver {function!r}; {suggest(function, _drivers_in(path))}"
            )
        found = run_file(path)[function]
        controller = found() if isinstance(found, type) else found
        return LocalBrain(controller=controller, **rhythm)

    def _files(self, ending: str) -> list[Path]:
        found: dict[str, Path] = {}
        for place in self._places:
            inside = sorted(place.glob(f"*{ending}")) if place.is_dir() else [place]
            for path in inside:
                if path.suffix == ending and path.is_file():
                    found.setdefault(path.name, path)
        return list(found.values())

    def _file(self, name: str, ending: str) -> Path:
        known = {path.name: path for path in self._files(ending)}
        if name not in known:
            raise SetupError(
                f"no {ending} file {name!r} is offered here; {suggest(name, known)}; files are "
                "offered that were named when the world was started (--offer FILE or FOLDER)"
            )
        return known[name]


def _drivers_in(path: Path) -> list[str]:
    """Functions of one argument and controllers in a file, found without running it."""
    try:
        tree = parsed(path.read_text(encoding="utf-8"))
    except (OSError, SyntaxError, ValueError, RecursionError):
        return []
    return [
        each.name
        for each in tree.body
        if (isinstance(each, ast.FunctionDef) and _takes_a_percept(each))
        or (isinstance(each, ast.ClassDef) and _is_controller(each))
    ]


def _takes_a_percept(function: ast.FunctionDef) -> bool:
    arguments = function.args
    needed = len(arguments.args) + len(arguments.posonlyargs) - len(arguments.defaults)
    return needed == 1 and not function.name.startswith("_")


def _is_controller(cls: ast.ClassDef) -> bool:
    bases = [getattr(base, "attr", getattr(base, "id", "")) for base in cls.bases]
    return any(issubclass(Block.types.get(name, Block), Controller) for name in bases)


def _again(episode: Episode, recorded: str, agent_id: str) -> Brain:
    """A brain that does what was done in an episode; begins anew with each reset."""
    record = episode.agent(recorded or (agent_id if agent_id in episode.ids else None))
    if not len(record):
        raise SetupError(f"agent {record.id!r} took no decision in this recording")
    actions: list[Mapping[str, Any]] = [decision.action for decision in record]
    first = record[0]
    controller = ReplayController(actions=[dict(each) for each in actions])
    return LocalBrain(
        controller=controller, skip_frame=first.skip_frame, repeat_action=first.repeat_action
    )
