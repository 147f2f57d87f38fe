"""Drivers that can replace an agent's own brain, by names that a page can send."""

import ast
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.base.syntax import parsed
from ai4u_edu.blocks import (
    Block,
    Brain,
    Controller,
    LocalBrain,
    NeuralNetController,
    ReplayController,
)
from ai4u_edu.blocks.brains.address import brain_at
from ai4u_edu.blocks.loading import run_file
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording import Episode

SCRIPT, RECORDING, NETWORK, REMOTE = "script:", "recording:", "network:", "ai4u://"
ENDINGS = (".py", ".episode", ".onnx")
"""Suffixes of files that contain drivers."""


@dataclass(frozen=True)
class Driver:
    """A driver that a page can choose."""

    name: str
    """Name to pass to :meth:`SceneEditor.set_driver`."""
    title: str
    """Title to show to a person."""


class DriverRegistry:
    """Scripts, recordings, networks and addresses that pages can choose drivers from.

    A page sends names, never code. Scripts, networks outside the scene's folder and AI4U scripts on
    other machines have to be named, or lie in a folder that was named, when the server is started.

    Args:
        places: Python files, ``.episode`` files and ``.onnx`` files, and folders of them; addresses
            of AI4U scripts (``ai4u://HOST:PORT``).

    Raises:
        SetupError: one of them does not exist, or is of another kind.
    """

    def __init__(self, places: Iterable[Path | str] = ()) -> None:
        given = list(places)
        remote = [str(each) for each in given if str(each).startswith(REMOTE)]
        self._places = [_checked(Path(each)) for each in given if str(each) not in remote]
        self._remotes = {each: brain_at(each) for each in remote}
        self._kept_episodes: dict[str, tuple[Episode, str]] = {}
        self.own_networks: Callable[[], Mapping[Path, str]] = dict
        """Returns titles of networks that were made here for the present scene, by their files."""

    def offered(self) -> list[Driver]:
        """Return all drivers, those in files that were added since the start too."""
        scripts = [
            Driver(f"{SCRIPT}{path.name}:{name}", f"{path.name}: {name}")
            for path in self._files(".py")
            for name in _driver_names(path)
        ]
        recordings = [
            Driver(f"{RECORDING}{path.name}", _("Recording {name}", name=path.stem))
            for path in self._files(".episode")
        ]
        kept = [
            Driver(name, _("Recording {name}", name=name.removeprefix(RECORDING)))
            for name in self._kept_episodes
        ]
        networks = [
            Driver(f"{NETWORK}{path.name}", _("Network {name}", name=title))
            for path, title in self._networks().items()
        ]
        remotes = [
            Driver(name, _("AI4U script at {address}", address=f"{brain.host}:{brain.port}"))
            for name, brain in self._remotes.items()
        ]
        return [*scripts, *networks, *recordings, *kept, *remotes]

    def has(self, name: str) -> bool:
        """Return True if a name is one of this registry's, whether or not the file exists."""
        if name.startswith((SCRIPT, RECORDING)):
            return True  # `brain` raises if it does not exist
        networks = [f"{NETWORK}{path.name}" for path in self._networks()]
        return name in networks or name in self._remotes

    def keep(self, episode: Episode, name: str, agent: str = "") -> str:
        """Offer an episode that is in no file, and return its driver's name."""
        full = f"{RECORDING}{name}"
        self._kept_episodes[full] = episode, agent
        return full

    def brain(self, name: str, agent_id: str, like: Brain) -> Brain:
        """Make a brain of a driver.

        Args:
            name: of the driver.
            agent_id: the agent that it will drive.
            like: brain whose ``skip_frame`` and ``repeat_action`` are used, if the driver has none.

        Raises:
            AI4UError: there is no such driver, or its file can't be read or run.
        """
        rhythm: dict[str, Any] = {
            "skip_frame": like.skip_frame,
            "repeat_action": like.repeat_action,
        }
        if name in self._kept_episodes:
            return _replay_brain(*self._kept_episodes[name], agent_id)
        if name.startswith(RECORDING):
            path = self._file(name.removeprefix(RECORDING), ".episode")
            return _replay_brain(Episode.load(path), "", agent_id)
        if name in self._remotes:
            return brain_at(name, **rhythm)
        if name.startswith(NETWORK):
            path = self._network(name.removeprefix(NETWORK))
            network = NeuralNetController(model_path=str(path.absolute()))
            return LocalBrain(controller=network, **(rhythm | network.network.rhythm))
        file, _colon, function = name.removeprefix(SCRIPT).rpartition(":")
        path = self._file(file, ".py")
        if function not in _driver_names(path):
            raise SetupError(
                _(
                    "{file} has no driver {name!r}; {hint}",
                    file=path.name,
                    name=function,
                    hint=suggest(function, _driver_names(path)),
                )
            )
        driver = getattr(run_file(path, path.name), function)
        controller = driver() if isinstance(driver, type) else driver
        return LocalBrain(controller=controller, **rhythm)

    def _networks(self) -> dict[Path, str]:
        """Return titles of networks by their files; of those that were named, the file's name."""
        return {path: path.name for path in self._files(".onnx")} | dict(self.own_networks())

    def _network(self, name: str) -> Path:
        own = next((each for each in self.own_networks() if each.name == name), None)
        return self._file(name, ".onnx") if own is None else own

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
                _(
                    "no {ending} file {name!r} is offered here; {hint}; files are offered that "
                    "were named when the world was started (--offer FILE or FOLDER)",
                    ending=ending,
                    name=name,
                    hint=suggest(name, known),
                )
            )
        return known[name]


def _checked(place: Path) -> Path:
    if place.is_dir() or (place.is_file() and place.suffix in ENDINGS):
        return place
    got = _("another kind of file") if place.exists() else _("nothing there")
    raise SetupError(
        _(
            "--offer {place}: expected a Python file (.py), a recorded episode (.episode), a "
            "network (.onnx), a folder of such files, or an AI4U script's address "
            "(ai4u://HOST:PORT), got {got}",
            place=str(place),
            got=got,
        )
    )


def _driver_names(path: Path) -> list[str]:
    """Return the functions of one argument and the controllers in a file, without running it."""
    try:
        tree = parsed(path.read_text(encoding="utf-8"))
    except (OSError, SyntaxError, ValueError, RecursionError):
        return []
    return [
        each.name
        for each in tree.body
        if (isinstance(each, ast.FunctionDef) and _has_one_argument(each))
        or (isinstance(each, ast.ClassDef) and _is_controller(each))
    ]


def _has_one_argument(function: ast.FunctionDef) -> bool:
    arguments = function.args
    needed = len(arguments.args) + len(arguments.posonlyargs) - len(arguments.defaults)
    return needed == 1 and not function.name.startswith("_")


def _is_controller(cls: ast.ClassDef) -> bool:
    bases = [getattr(base, "attr", getattr(base, "id", "")) for base in cls.bases]
    return any(issubclass(Block.types.get(name, Block), Controller) for name in bases)


def _replay_brain(episode: Episode, recorded: str, agent_id: str) -> Brain:
    """Make a brain that repeats a recorded agent's actions; it starts again at each reset."""
    record = episode.agent(recorded or (agent_id if agent_id in episode.ids else None))
    if not len(record):
        raise SetupError(_("agent {agent!r} took no decision in this recording", agent=record.id))
    actions: list[Mapping[str, Any]] = [decision.action for decision in record]
    first = record[0]
    controller = ReplayController(actions=[dict(each) for each in actions])
    return LocalBrain(
        controller=controller, skip_frame=first.skip_frame, repeat_action=first.repeat_action
    )
