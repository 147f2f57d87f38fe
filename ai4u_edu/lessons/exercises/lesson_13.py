"""Using networks: a brain from a file."""

import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, cast

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import BlockError, text_of
from ai4u_edu.base.optional_deps import need
from ai4u_edu.blocks import (
    FallReward,
    LocalBrain,
    NeuralNetController,
    Percept,
    RBMoveActuator,
    Sensor,
    TouchRewardFunc,
    trained_brain,
)
from ai4u_edu.blocks.brains.network import TRAINING_KEY
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, a_list_of, exercise, named
from ai4u_edu.lessons.exercises.lesson_12 import ZOO, decide
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.numeric import chance_for, difference, finite_number, is_close
from ai4u_edu.lessons.rollouts import drives, seeds_of
from ai4u_edu.lessons.worlds import plate
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.serialization import from_plain

SCENES = ("box_chase", "sample_scene", "yardstick")
"""Scenes whose networks decide at three different intervals."""


def put_to(sensors: Sequence[Sensor]) -> ControlRequestor:
    """Return a robot on a plate with these sensors, driven by the box chase's network."""
    agent = BasicAgent(
        body="robot",
        sensors=list(sensors),
        actuators=[RBMoveActuator(move_amount=5, turn_amount=5)],
        rewards=[
            TouchRewardFunc(target="box", reward=1, cause_episode_to_end=True),
            FallReward(),
        ],
        brains=[trained_brain(ZOO)],
    )
    return ControlRequestor(plate(), [agent], success="touch")


def percepts_of(scene: str = "box_chase", count: int = 50) -> list[dict[str, Any]]:
    """Return percepts of a robot that its network drives, from one episode after another."""
    sim = Scene.load(scene).build()
    agent = sim.agents[0]
    brain = trained_brain(f"zoo:{scene}", repeat=False)
    keys = [port.name for port in cast(NeuralNetController, brain.controller).network.inputs]
    agent.use_brain(brain)
    found: list[dict[str, Any]] = []
    seed = 0
    while len(found) < count:
        sim.reset(seed)
        while not agent.done and len(found) < count:
            found.append({key: np.copy(agent.percept[key]) for key in keys})
            sim.step()
        seed += 1
    return found


def blinded(*keys: str) -> LocalBrain:
    """Return the box chase's network as a brain that reads zeros for some of its inputs."""

    def drive(percept: Percept) -> dict[str, list[float]]:
        return {"move": decide(percept, **{key: np.zeros_like(percept[key]) for key in keys})}

    return LocalBrain(controller=drive, skip_frame=9)


@exercise(
    "13.1",
    _("A brain for each file"),
    hints={
        "controller": _(
            "A controller alone does not decide when it is asked. Put it into a brain: "
            "`LocalBrain(controller=...)`."
        ),
        "begin": _(
            "A brain is needed, with a controller in it that asks the network: "
            "`LocalBrain(controller=NeuralNetController(model_path=path))`."
        ),
        "default": _(
            "It is asked more or less often than it learned to be: you left `skip_frame` as "
            'it is. `controller.network.about["skip_frame"]` is the one of its training.'
        ),
        "fixed": _(
            "The number of ticks fits one network and not the others. Ask each network: "
            '`controller.network.about["skip_frame"]`.'
        ),
        "path": _("It is the same network for each robot. Use the `path` that you are given."),
    },
)
def is_a_brain(driver: Any) -> Done:
    """Check the brains that are made from three files."""
    make = a_function(driver)
    interval = int(chance_for("13.1", driver).integers(10, 30))
    with TemporaryDirectory() as folder:
        told = _told_of_brains(make, _network_of_interval(interval, Path(folder)))
    return Done(
        _("Each at the interval of its training. Worlds won: {listed}.", listed=join(told, ", "))
    )


def _told_of_brains(make: Callable[..., Any], unknown: Path) -> list[str]:
    """Return what the brains of the library's networks won, in words.

    Args:
        make: a student's function.
        unknown: a network whose interval no message has told.
    """
    told: list[str] = []
    for scene in (*SCENES, ""):
        path = f"zoo:{scene}" if scene else str(unknown)
        wanted = NeuralNetController(model_path=path).network.about["skip_frame"]
        brain = _brain_of(make(path), path)
        if brain.skip_frame != wanted:
            if not scene:
                raise NotYet(
                    _(
                        "A fourth network, which is in no library, decided at another "
                        "interval when it learned than your brain asks it."
                    ),
                    hint="fixed",
                )
            default = brain.skip_frame == LocalBrain(controller=lambda _: {}).skip_frame
            raise NotYet(
                _(
                    "The network {path} decided every {wanted} ticks when it learned. Your "
                    "brain asks it every {skip_frame} ticks.",
                    path=path,
                    wanted=wanted + 1,
                    skip_frame=brain.skip_frame + 1,
                ),
                hint="default" if default and scene == SCENES[0] else "fixed",
            )
        if scene:
            worlds = seeds_of("13.1", 5)
            won = sum(each.won for each in drives(scene, brain, worlds, limit=200))
            told.append(_("{scene} {won} of {count}", scene=scene, won=won, count=len(worlds)))
    return told


def _network_of_interval(interval: int, folder: Path) -> Path:
    """Write the box chase's network, as one that decides every `skip_frame + 1` ticks.

    Args:
        interval: ticks that are left out after each decision, as ``skip_frame``.
        folder: of the file.
    """
    need("train", "onnx")
    import onnx

    network = onnx.load(str(NeuralNetController(model_path=ZOO).network.path))
    for entry in network.metadata_props:
        if entry.key == TRAINING_KEY:
            entry.value = json.dumps(json.loads(entry.value) | {"skip_frame": interval})
    path = folder / "unknown.onnx"
    path.write_bytes(network.SerializeToString())
    return path


def _brain_of(given: Any, path: str) -> LocalBrain:
    """Return a student's brain, if it asks the network at a path."""
    if given is None:
        raise NotYet(
            _("Your function returned nothing (None). Is `return` missing?"), hint="no-return"
        )
    if isinstance(given, NeuralNetController):
        raise NotYet(_("For {path} you returned a controller alone.", path=path), hint="controller")
    if not isinstance(given, LocalBrain):
        raise NotYet(_("Expected a `LocalBrain`, got {got}.", got=named(given)), hint="begin")
    controller = given.controller
    if not isinstance(controller, NeuralNetController):
        raise NotYet(
            _("The brain for {path} asks no `NeuralNetController`, but something else.", path=path),
            hint="begin",
        )
    if controller.model_path != path:
        raise NotYet(
            _(
                "The brain for {path} asks the network {model_path}.",
                path=path,
                model_path=controller.model_path,
            ),
            hint="path",
        )
    return given


@exercise(
    "13.2",
    _("What it looks at"),
    hints={
        "same": _(
            "Both times it is asked about the same percept. The second time the reading "
            "`key` should be zeros: `{**percept, key: 0 * percept[key]}` is such a percept."
        ),
        "begin": _(
            "That is the turn without the reading. By how much does it differ from the turn "
            "with it?"
        ),
        "spoiled": _(
            "You changed the percept that you were given: it is not yours alone. Make a new "
            "one: `{**percept, key: ...}`."
        ),
        "forward": _("That is how much *forward* changes. Turn is the second number: `[1]`."),
        "signed": _("A change to the left counts as much as one to the right: `abs(...)`."),
        "part": _("All numbers of the reading have to be 0, not only the first one."),
        "ones": _("Zeros are asked for, not ones."),
        "other": _("Everything but `key` is zeros in your percept. Only `key` should be."),
    },
)
def measures_influence(influence: Any) -> str:
    """Check how much the turn changes if a reading is zeros."""
    measure = a_function(influence)
    chance = chance_for("13.2", influence)
    for case in range(6):
        shapes = {"rays": (2, 3), "bearing": (2,), "speed": (3,)}
        percept = {key: chance.normal(size=shape) for key, shape in shapes.items()}
        weights = {key: chance.normal(size=(4, *shape)) for key, shape in shapes.items()}

        def ask(seen: Mapping[str, Any], weights: Mapping[str, Any] = weights) -> list[float]:
            sums = [np.sum(w * np.asarray(seen[key]), axis=tuple(range(1, w.ndim)))
                    for key, w in weights.items()]  # fmt: skip
            return [float(each) for each in np.tanh(np.sum(sums, axis=0) / 2)]

        key = list(shapes)[case % 3]
        given = {name: each.copy() for name, each in percept.items()}
        got = finite_number(measure(ask, given, key))
        _compare_influence(
            ask, percept, key, got, _("`{key}` of {shape} numbers", key=key, shape=str(shapes[key]))
        )
        if any(not np.array_equal(given[name], each) for name, each in percept.items()):
            raise NotYet(_("After the call the percept is another one."), hint="spoiled")
    percepts = percepts_of(count=10)
    found = {
        key: np.mean([finite_number(measure(decide, dict(each), key)) for each in percepts])
        for key in ("vision", "orientation", "last_action")
    }
    told = ", ".join(f"{key} {each:.2f}" for key, each in found.items())
    return _("Six percepts, all right. For the box chase's network: {told}.", told=told)


def _compare_influence(
    ask: Any, percept: Mapping[str, Any], key: str, got: float, which: str
) -> None:
    """Raise NotYet if a change of the turn is not the right one."""

    def asked(**changes: Any) -> list[float]:
        return cast("list[float]", ask({**percept, **changes}))

    before, after = asked(), asked(**{key: 0 * percept[key]})
    right = abs(after[1] - before[1])
    if is_close(got, right, 1e-6):
        return
    first = percept[key].copy()
    first.flat[0] = 0
    first_row = percept[key].copy()
    first_row[0] = 0
    others = {name: 0 * each for name, each in percept.items() if name != key}
    slips = {
        "same": (_("no change at all"), 0.0),
        "signed": (_("right but for its sign"), -right),
        "forward": (_("the change of the first number, forward"), abs(after[0] - before[0])),
        "part": (
            _("right if only its first number were 0"),
            abs(asked(**{key: first})[1] - before[1]),
        ),
        "ones": (
            _("right if the reading were ones"),
            abs(asked(**{key: 0 * percept[key] + 1})[1] - before[1]),
        ),
        "other": (_("right if all others were zeros"), abs(asked(**others)[1] - before[1])),
        "begin": (_("the turn without the reading"), after[1]),
    }
    slip = difference(got, slips, 1e-6)
    name = slip.name
    if not name and is_close(got, abs(asked(**{key: first_row})[1] - before[1]), 1e-6):
        name = "part"
    raise NotYet(
        _(
            "Without {which} the turn goes from {before:.3f} to {after:.3f}: expected "
            "{right:.3f}, got {got:.3f}{words}.",
            which=which,
            before=before[1],
            after=after[1],
            right=right,
            got=got,
            words=slip.words,
        ),
        hint=name,
    )


@exercise(
    "13.3",
    _("Sensors that fit"),
    hints={
        "missing": _(
            "The message says which sensor is missing, and of which type it was. Add it to "
            "the list, with the perception key that stands in quotes: `perception_key=...`."
        ),
        "shape": _(
            "A sensor has the right name, but gives another number of readings. The "
            "network's inputs are (4, 2, 3, 5): 4 moments (`stacked_observations`), 2 "
            "numbers a ray (with `return_distance`), 3 rows, 5 columns."
        ),
        "meaning": _(
            "The shapes fit, and yet it does not get there: the numbers mean something else "
            "than they did when it learned."
        ),
    },
)
def fits(senses: Any) -> Done:
    """Check sensors with which the box chase's network finds the box."""
    sensors = a_list_of(Sensor, a_function(senses)())
    worlds = 20
    won = 0
    try:
        _compare(sensors)
        for done in drives(lambda: put_to(sensors), None, seeds_of("13.3", worlds), limit=100):
            won += done.won
    except BlockError as error:
        hint = "shape" if "has the shape" in text_of(error) else "missing"
        raise NotYet(_("It does not fit: {error}", error=text_of(error)), hint=hint) from None
    return Done(
        _(
            "The same readings as where it learned; it finds the box in {won} of {worlds} worlds.",
            won=won,
            worlds=worlds,
        ),
        done.picture(),
    )


def _learned_with(about: Mapping[str, Any]) -> Sensor:
    """Return a sensor as a network's file describes it."""
    made = from_plain(Sensor, {name: each for name, each in about.items() if name != "shape"})
    return cast(Sensor, made)


def _compare(sensors: Sequence[Sensor]) -> None:
    """Raise NotYet if sensors read other numbers than those with which the network learned."""
    described = NeuralNetController(model_path=ZOO).network.about["sensors"]
    theirs = put_to([_learned_with(about) for about in described.values()])
    yours = put_to(sensors)
    for seed in seeds_of("13.3", 6):
        theirs.reset(seed)
        yours.reset(seed)
        for _number in range(6):
            for key in described:
                wanted, got = (each.agents[0].percept.get(key) for each in (theirs, yours))
                if got is None or wanted is None or np.shape(got) != np.shape(wanted):
                    return  # the network itself says so, with the type of the sensor
                if not is_close(got, wanted, 1e-4):
                    raise NotYet(
                        _(
                            "It fits, and nobody complains. But with seed {seed} `{key}` "
                            "reads other numbers than the sensor with which the network "
                            "learned: it is told something else than it believes.",
                            seed=seed,
                            key=key,
                        ),
                        hint="meaning",
                    )
            if theirs.agents[0].done:
                break
            theirs.step()
            yours.step()


exit_ticket(
    "13.exit",
    Question(
        "c",
        {
            "a": _("Shapes are checked, and they fit. The rhythm is not checked."),
            "b": _("Nothing in the file changes while it drives: it has stopped learning."),
        },
    ),
    Question(
        "a",
        {
            "b": _("It compares names and shapes. Swapped codes have the same shape."),
            "c": _("A network multiplies and adds whatever comes in. It can't refuse anything."),
        },
    ),
    Question(
        "b",
        {
            "a": _(
                "A large influence is not yet a need: the box chase's network usually got "
                "along without it."
            ),
            "c": _("You have not measured the others. Several readings can matter at once."),
        },
    ),
)
