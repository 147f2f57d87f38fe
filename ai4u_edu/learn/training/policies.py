"""Drivers for evaluations and ``--brain``: models, networks, programs, controllers, chance."""

import tokenize
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import AI4UError, BlockError, SetupError, suggest
from ai4u_edu.base.optional_deps import need
from ai4u_edu.blocks import (
    Block,
    Brain,
    Controller,
    LocalBrain,
    NeuralNetController,
    Percept,
    trained_brain,
)
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.address import brain_at
from ai4u_edu.blocks.brains.brain import Action
from ai4u_edu.blocks.brains.network import ZOO_PREFIX
from ai4u_edu.blocks.loading import run_file
from ai4u_edu.learn.envs.spaces_of import Observer, outputs_of
from ai4u_edu.learn.training.prepare import prepare
from ai4u_edu.learn.training.run import Config, run_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.program import Program, ProgramError, obstacle_in
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.serialization import is_serializable
from ai4u_edu.world import WorldView

ZOO = "zoo"
"""Name of the scene's own network in the package."""
SCHEME = "ai4u://"
FORMS = _(
    "a training's folder, a model (.zip), a network (.onnx, zoo:SCENE, or zoo "
    "for the scene's own), FILE.py:NAME, an AI4U script "
    "(ai4u://127.0.0.1:8080), random, scene, or a controller"
)
"""Forms in which a command line names a driver."""
CALL_LIMIT_S = 5.0
"""Longest time that a program outside the page may take for a decision, and for loading."""


def _as_it_is(scene: Scene) -> Scene:
    return scene


@dataclass(frozen=True)
class Entrant:
    """Description of a driver, and how to make its brain."""

    name: str
    brain: Callable[[BasicAgent], Brain]
    """Make a brain for an agent; a trained policy acts deterministically."""
    scene: str = ""
    """Scene that it was made for, a name or a file; empty for any."""
    fitted: Callable[[Scene], Scene] = _as_it_is
    """Adapt a scene so that its agent observes as in the training."""
    agent: str = ""
    """Id of the agent that it drives; empty for the one that acts first."""
    is_remote: bool = False
    """True for a script on the other side of a connection, which needs a served world."""


def entrant(spec: str, scene: str = "", *, receive_timeout: int = 2000) -> Entrant:
    """Parse the name of a driver; the one place that does.

    Args:
        spec: a training's folder or a model in it (.zip); a network (.onnx,
            ``zoo:SCENE``, or ``zoo`` for the scene's own); a function from percept to action or a
            Controller, in a Python file of one's own (FILE.py:NAME), which runs as in the page if
            it could run there, see :mod:`ai4u_edu.program`; an AI4U script by its address
            (``ai4u://HOST:PORT``); a controller by its name; ``random``; ``scene`` for the
            controller that the scene's file names.
        scene: the name of the scene that ``zoo`` means.
        receive_timeout: milliseconds for which the world waits for an AI4U script whose address
            names no ``receive_timeout``.

    Raises:
        AI4UError: there is nothing of that name.
    """
    path = Path(spec)
    if spec == "random":
        return Entrant("random", _by_chance)
    if spec == "scene":
        return Entrant("scene", lambda agent: agent.brain)
    if spec == ZOO and scene:
        return _network(f"{ZOO_PREFIX}{scene}")
    if spec.startswith(ZOO_PREFIX) or path.suffix == ".onnx":
        return _network(spec)
    if spec.startswith(SCHEME):
        brain_at(spec)  # so that its mistakes are told before a world is built

        def remote(agent: BasicAgent) -> Brain:
            return brain_at(spec, receive_timeout=receive_timeout, **_rhythm(agent))

        return Entrant(spec, remote, is_remote=True)
    if path.is_dir() or path.suffix == ".zip":
        return _model(path)
    file, _colon, name = spec.rpartition(":")
    if file.endswith(".py"):
        return Entrant(name, _of_file(Path(file), name))
    controllers = {
        name: cls
        for name, cls in Block.types.items()
        if issubclass(cls, Controller)
        and is_serializable(cls)
        and not any(field.is_required() for field in cls.parameters().values())
    }
    if spec in controllers:
        return Entrant(spec, _in_rhythm(controllers[spec]))
    raise SetupError(
        _(
            "nobody is called {spec!r}: expected {forms}; {hint}",
            spec=spec,
            forms=FORMS,
            hint=suggest(spec, controllers),
        )
    )


def expect_here(who: Entrant) -> Entrant:
    """Return a driver that needs no served world.

    Raises:
        SetupError: it is a script on the other side of a connection.
    """
    if who.is_remote:
        raise SetupError(
            _(
                "{name}: a script drives in a served world only; expected: ai4u-edu play "
                "SCENE --brain {name} (with --record DIR to keep the episodes)",
                name=who.name,
            )
        )
    return who


def entrant_of(who: Any) -> Entrant:
    """Return the driver for anything that can drive.

    Args:
        who: a function from percept to action, a Controller (or its class), the result of a
            training or a cloning, or as for :func:`entrant`.
    """
    if isinstance(who, Entrant):
        return who
    if isinstance(who, str | Path):
        return entrant(str(who))
    for place in ("folder", "path"):  # of a training, of a clone
        if hasattr(who, place):
            return entrant(str(getattr(who, place)))
    if isinstance(who, Controller):
        return Entrant(type(who).__name__, _in_rhythm(lambda: who))
    if isinstance(who, type) and issubclass(who, Controller):
        return Entrant(who.__name__, _in_rhythm(who))
    if callable(who):
        return Entrant(getattr(who, "__name__", "function"), _in_rhythm(lambda: who))
    raise SetupError(
        _(
            "expected a function from percept to action, a Controller, what train() or "
            "clone() gave, or a name as in ai4u-edu evaluate --help; got {who!r}",
            who=who,
        )
    )


def _network(spec: str) -> Entrant:
    about = NeuralNetController(model_path=spec).network.about
    return Entrant(
        Path(spec).name, lambda _agent: trained_brain(spec), scene=str(about.get("scene", ""))
    )


def _model(path: Path) -> Entrant:
    run = run_of(path)
    config = run.config()
    settings = config.settings
    if config.trainer == "small":
        network = str(run.best_network)
        return Entrant(
            path.name,
            lambda _agent: trained_brain(network),
            scene=str(run.folder / "scene.yaml"),
            fitted=lambda scene: prepare(scene, settings, learning=False),
            agent=settings.agent,
        )
    need("train", "torch", "stable_baselines3")
    from ai4u_edu.learn.training.algorithms import load_model

    model = load_model(config.algorithm, run.best if path.is_dir() else path)

    def brain(agent: BasicAgent) -> Brain:
        drive = driver_of(config, agent, lambda: model)
        return LocalBrain(controller=drive, skip_frame=agent.brain.skip_frame)

    return Entrant(
        path.name,
        brain,
        scene=str(run.folder / "scene.yaml"),
        fitted=lambda scene: prepare(scene, settings, learning=False),
        agent=settings.agent,
    )


def driver_of(
    config: Config, agent: BasicAgent, latest: Callable[[], Any]
) -> Callable[[Percept], dict[str, Any]]:
    """Return a controller that asks a Stable-Baselines3 model for deterministic actions.

    Args:
        config: its training's set-up.
        agent: the agent it drives.
        latest: the model; asked at each decision.
    """
    from ai4u_edu.learn.training.worlds import table_for

    settings = config.settings
    observer = Observer(agent, settings.observation)
    ((output, actuator),) = outputs_of(agent).items()
    space: Any = actuator.space()
    chooses = config.algorithm == "dqn" and hasattr(space, "low")
    table = table_for(space, settings.actions) if chooses else None

    def drive(percept: Percept) -> dict[str, Any]:
        action, _ = latest().predict(observer.observe(percept), deterministic=True)
        return {output: action if table is None else table[action]}

    return drive


def _by_chance(agent: BasicAgent) -> Brain:
    spaces = {name: actuator.space() for name, actuator in outputs_of(agent).items()}
    view = agent.view

    def drive(_percept: Percept) -> dict[str, Any]:
        chance = view.random("random entrant")
        return {name: _drawn(space, chance) for name, space in spaces.items()}

    return _in_rhythm(lambda: drive)(agent)


def _drawn(space: Any, chance: np.random.Generator) -> Any:
    if hasattr(space, "n"):
        return int(space.start + chance.integers(space.n))
    return chance.uniform(space.low, space.high)


def _in_rhythm(make: Callable[[], Any]) -> Callable[[BasicAgent], Brain]:
    """Return a LocalBrain that decides as often as the agent's own brain."""
    return lambda agent: LocalBrain(controller=make(), **_rhythm(agent))


def _rhythm(agent: BasicAgent) -> dict[str, Any]:
    """Return ``skip_frame`` and ``repeat_action`` of an agent's own brain."""
    brain = agent.brain
    return {"skip_frame": brain.skip_frame, "repeat_action": brain.repeat_action}


def _of_file(path: Path, name: str) -> Callable[[BasicAgent], Brain]:
    """Return how to make a brain from a function or a controller in a user's Python file."""
    if not path.is_file():
        raise SetupError(_("{path}: there is no such Python file", path=str(path)))
    source = program_text(path)
    if source is None:
        return _in_rhythm(_from_file(path, name))
    load_program(source, path, name)  # so that its mistakes are told before a world is built
    return lambda agent: _in_rhythm(lambda: program_controller(source, path, name, agent))(agent)


def _from_file(path: Path, name: str) -> Callable[[], Any]:
    """Run a Python file that the user named, and return a function or a controller from it."""
    module = run_file(path)
    if not hasattr(module, name):
        known = [each for each in vars(module) if not each.startswith("_")]
        raise AI4UError(
            _(
                "{path} has no {name!r}; {hint}",
                path=str(path),
                name=name,
                hint=suggest(name, known),
            )
        )
    value = getattr(module, name)
    if isinstance(value, type) and issubclass(value, Controller):
        return value
    return lambda: value


class ProgramController(Controller):
    """Asks a program for its decisions, as the page does.

    It gets plain Python numbers as readings, and the numbers of its actions are rounded to nine
    digits; so it decides here as there.
    """

    program: Program
    """The program, loaded."""

    abstract = True  # a scene file can't name it

    def on_reset(self, agent: AgentView, view: WorldView) -> None:  # noqa: ARG002  # a hook's form
        """Begin an episode of the program."""
        try:
            self.program.begin()
        except ProgramError as error:
            raise BlockError(self._told(error)) from error

    def get_action(self, percept: Percept) -> Action:
        """Return the program's action.

        Raises:
            BlockError: a mistake in the program, with its line.
        """
        try:
            return self.program.decide(percept)
        except ProgramError as error:
            raise BlockError(self._told(error)) from error

    def _told(self, error: ProgramError) -> str:
        return _mistake_text(Path(self.program.file), error)


def program_text(path: Path) -> str | None:
    """Return the text of a file that could run in the page; None for one that could not.

    The others import numpy, another package or blocks of ai4u_edu, or have a Controller that looks
    at its agent or its world.

    Raises:
        SetupError: the file can't be read.
    """
    try:
        with tokenize.open(path) as file:
            source = file.read()
    except (OSError, SyntaxError, ValueError) as error:
        raise SetupError(
            _(
                "{path}: expected a text of Python in UTF-8: {problem}",
                path=str(path),
                problem=str(error),
            )
        ) from error
    return None if obstacle_in(source) else source


def load_program(source: str, path: Path, entry: str, agent: BasicAgent | None = None) -> Program:
    """Load a program from a file's text.

    Args:
        source: the text.
        path: of the file, for messages.
        entry: name of a function, a class with ``get_action`` or such an object.
        agent: its actuators are checked; None for none.

    Raises:
        SetupError: a mistake in the program, with its line.
    """
    outputs = None
    if agent is not None:
        actuators = agent.bound_blocks.actuators
        outputs = {name: each.limits() for name, each in actuators.items()}
    try:
        return Program.load(
            source, str(path), entry, outputs, limit_s=CALL_LIMIT_S, keeps_lines=False
        )
    except ProgramError as error:
        raise SetupError(_mistake_text(path, error)) from error


def program_controller(source: str, path: Path, entry: str, agent: BasicAgent) -> ProgramController:
    """Return a controller that asks a program that was loaded anew for this agent."""
    return ProgramController(program=load_program(source, path, entry, agent))


def _mistake_text(path: Path, error: ProgramError) -> str:
    """Return the sentence on a mistake with its file and line."""
    has_file = not error.line and error.text.startswith(str(path))
    return error.text if has_file else error.in_file(str(path))
