"""The network inside: inputs, outputs, and nothing but numbers in between."""

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any, cast

import numpy as np
import numpy.typing as npt

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import BlockError
from ai4u_edu.base.optional_deps import need
from ai4u_edu.blocks import (
    BearingSensor,
    FallReward,
    LocalBrain,
    NeuralNetController,
    Percept,
    RBMoveActuator,
    Sensor,
    TouchRewardFunc,
    trained_brain,
)
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, a_list_of, exercise, named
from ai4u_edu.lessons.numeric import (
    chance_for,
    difference,
    finite_number,
    finite_numbers,
    is_close,
)
from ai4u_edu.lessons.rollouts import drives, seeds_of
from ai4u_edu.lessons.worlds import plate
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.serialization import from_plain

Array = npt.NDArray[np.float64]
Layer = tuple[Array, Array]

ZOO = "zoo:box_chase"
CLOSE = 1e-4


def layers_of(path: str = ZOO) -> list[Layer]:
    """Return the weights (outputs, inputs) and biases (outputs,) of each layer of a network.

    Args:
        path: the file of a network such as PPO's: layers one after the other.
    """
    need("train", "onnx")
    import onnx
    from onnx import numpy_helper

    graph = onnx.load(str(NeuralNetController(model_path=path).network.path)).graph
    numbers = {each.name: numpy_helper.to_array(each) for each in graph.initializer}
    return [
        (np.array(numbers[node.input[1]], float), np.array(numbers[node.input[2]], float))
        for node in graph.node
        if node.op_type == "Gemm"
    ]


def inputs_of(percept: Mapping[str, Any], path: str = ZOO) -> Array:
    """Return a network's inputs from a percept as one row of numbers, in its order."""
    ports = NeuralNetController(model_path=path).network.inputs
    return np.concatenate([np.ravel(percept[port.name]) for port in ports]).astype(float)


def first_percept(seed: int = 1) -> Percept:
    """Return the first percept of the box chase's robot."""
    sim = Scene.load("box_chase").build()
    sim.reset(seed)
    return sim.agents[0].percept


def decide(percept: Mapping[str, Any], **changes: Any) -> list[float]:
    """Return the box chase network's action for a percept: forward, turn, jump, forward jump.

    Args:
        percept: the robot's percept.
        changes: readings to replace, such as ``orientation=[-1, 0.2]``.
    """
    network = NeuralNetController(model_path=ZOO).network
    (action,) = network.decide({**percept, **changes}).values()
    return [float(each) for each in action]


def by_hand(weights: Any, bias: Any) -> ControlRequestor:
    """Return a robot on a plate that is driven by two neurons: forward and turn.

    Args:
        weights: two rows (forward, turn) of two numbers (sine, cosine of the direction to the box).
        bias: two numbers.
    """
    w, b = _array(weights, (2, 2), "weights"), _array(bias, (2,), "bias")

    def drive(percept: Percept) -> dict[str, list[float]]:
        forward, turn = np.tanh(w @ np.asarray(percept["bearing"]) + b)
        return {"move": [float(forward), float(turn), 0, 0]}

    agent = BasicAgent(
        body="robot",
        sensors=[BearingSensor(target="box")],
        actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
        rewards=[
            TouchRewardFunc(target="box", reward=1, cause_episode_to_end=True),
            FallReward(),
        ],
        brains=[LocalBrain(controller=drive)],
    )
    return ControlRequestor(plate(), [agent], success="touch")


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


def _array(given: Any, shape: tuple[int, ...], name: str) -> Array:
    try:
        found = np.array(given, float)
    except (TypeError, ValueError, OverflowError):
        found = np.array(np.nan)
    if found.shape != shape or not np.isfinite(found).all():
        rows = "two rows of two numbers" if len(shape) == 2 else f"{shape[0]} numbers"
        raise NotYet(f"`{name}`: expected {rows}, got {named(given)}.")
    return found


@exercise(
    "11.1",
    "One neuron",
    hints={
        "sum": "Multiply each input by its weight, and add all that up: "
        "`sum(w * x for w, x in zip(weights, inputs))`. Then the bias, then `math.tanh`.",
        "bias": "The bias is missing: add it to the sum, before `math.tanh`.",
        "late-bias": "The bias is added once, to the sum, before `math.tanh`.",
        "each": "The bias is added once, not once for each input: it stands outside the loop.",
        "weights": "Each input counts as much as its weight says: multiply it by its weight.",
        "squash": "The sum itself can be any number. A neuron's output lies between -1 and 1: "
        "`math.tanh(...)` of the whole.",
    },
)
def is_a_neuron(neuron: Any) -> str:
    """Check one neuron's output."""
    chance = chance_for("11.1", neuron)
    for count in (2, 1, 5, 3, 8):
        inputs, weights = chance.normal(size=(2, count)).round(2).tolist()
        bias = round(float(chance.normal()), 2)
        total = float(np.dot(inputs, weights))
        got = finite_number(a_function(neuron)(list(inputs), list(weights), bias))
        if not is_close(got, np.tanh(total + bias), CLOSE):
            slips = {
                "sum": ("the same whatever comes in", 0.0),
                "squash": ("right without `math.tanh`", total + bias),
                "bias": ("right without the bias", float(np.tanh(total))),
                "late-bias": ("right if the bias came last", float(np.tanh(total)) + bias),
                "each": (
                    "right if the bias were added for each input",
                    float(np.tanh(total + count * bias)),
                ),
                "weights": (
                    "right without the weights",
                    float(np.tanh(sum(inputs) + bias)),
                ),
            }
            slip = difference(got, slips, CLOSE)
            raise NotYet(
                f"Inputs {inputs}, weights {weights}, bias {bias}: expected "
                f"{np.tanh(total + bias):.3f}, got {got:.3f}{slip.words}.",
                hint=slip.name,
            )
    return "Five neurons of different sizes, all of them right."


@exercise(
    "11.2",
    "Two neurons by hand",
    hints={
        "begin": "All weights are 0, so whatever it senses, it does the same. Begin with the "
        "forward neuron: a bias of 1 makes it drive, always. Then let the turn neuron look at the "
        "sine.",
        "swapped": "The turn neuron does not look at the sine: has a row changed places with a "
        "column? A row is a neuron (forward, turn), a column an input (sine, cosine).",
        "blind": "The turn neuron does not look at the sine, so it can't know the box's side: the "
        "first number of the second row.",
        "still": "It never drives: give the forward neuron a bias above 0.",
        "weak": "The signs are right. Let it turn more for the same sine, or drive more slowly.",
        "mirrored": "It turns away from the box. The sine is above 0 when the box is on the left, "
        "and turn above 0 is to the right: the weight between them has to be below 0.",
    },
)
def drives_by_hand(weights: Any, bias: Any) -> Done:
    """Check weights with which two neurons find the box."""
    worlds = 20
    for done in drives(lambda: by_hand(weights, bias), None, seeds_of("11.2", worlds), limit=300):
        if not done.won:
            how = "fell" if done.fell else "did not get there"
            raise done.not_yet(f"The robot {how} ({{where}}).", _wiring(weights, bias))
    return Done(f"With six numbers it found the box in {worlds} worlds.", done.picture())


def _wiring(weights: Any, bias: Any) -> str:
    """Return the diagnosis that fits six numbers that don't find the box."""
    w, b = _array(weights, (2, 2), "weights"), _array(bias, (2,), "bias")
    if not w.any() and not b.any():
        return "begin"
    if w[1, 0] == 0 and w[0, 1] < 0:
        return "swapped"
    if w[1, 0] == 0:
        return "blind"
    if w[1, 0] > 0:
        return "mirrored"
    return "still" if not w[0].any() and b[0] <= 0 else "weak"


@exercise(
    "11.3",
    "All of it",
    hints={
        "begin": "Go through the layers: `for weights, bias in layers`. What comes out of one goes "
        "into the next: `signal = weights @ signal + bias`.",
        "between": "Without `np.tanh` between the layers all of them together can do no more than "
        "one. Squash what comes out of each layer but the last.",
        "biases": "The biases are missing: `weights @ signal + bias`.",
        "last": "The last layer is not squashed here: what it says is the action as it is. Leave "
        "`np.tanh` out after it.",
    },
)
def thinks(think: Any) -> Done:
    """Check the whole network, and a robot that is driven by it."""
    chance = chance_for("11.3", think)
    for sizes in ((3, 4, 2), (2, 1), (5, 6, 4, 3), (126, 8, 4)):
        layers = [
            (chance.normal(size=(after, before)), chance.normal(size=after))
            for before, after in pairwise(sizes)
        ]
        inputs = chance.normal(size=sizes[0])
        right = _through(inputs, layers)
        got = np.array(finite_numbers(a_function(think)(inputs.copy(), list(layers)), len(right)))
        if not is_close(got, right, CLOSE):
            slips = {
                "between": _through(inputs, layers, between=False),
                "last": _through(inputs, layers, last=True),
                "begin": np.zeros_like(right),
                "biases": _through(inputs, [(w, 0 * b) for w, b in layers]),
            }
            near = (name for name, each in slips.items() if is_close(got, each, CLOSE))
            raise NotYet(
                f"A network with {len(layers)} layers, {sizes[0]} inputs: expected "
                f"{right.round(2).tolist()}, got {got.round(2).tolist()}.",
                hint=next(near, ""),
            )
    layers = layers_of()

    def drive(percept: Percept) -> dict[str, Any]:
        return {"move": np.clip(think(inputs_of(percept), layers), [-1, -1, 0, 0], 1)}

    brain = LocalBrain(controller=drive, skip_frame=9)
    for done in drives("box_chase", brain, seeds_of("11.3", 5), limit=100):
        if not done.won:
            raise done.not_yet("With the weights of the box chase it did not get there ({where}).")
    return Done("Your lines do what the network does, and drive to the box.", done.picture())


def _through(
    inputs: Array, layers: Sequence[Layer], *, between: bool = True, last: bool = False
) -> Array:
    signal = inputs
    for number, (weights, bias) in enumerate(layers, 1):
        signal = weights @ signal + bias
        if last if number == len(layers) else between:
            signal = np.tanh(signal)
    return signal


@exercise(
    "11.4",
    "Sensors that fit",
    hints={
        "missing": "The message says which sensor is missing, and of which type it was. Add it to "
        "the list, with the perception key that stands in quotes: `perception_key=...`.",
        "shape": "A sensor has the right name, but gives another number of readings. The network's "
        "inputs are (4, 2, 3, 5): 4 moments (`stacked_observations`), 2 numbers a ray (with "
        "`return_distance`), 3 rows, 5 columns.",
        "meaning": "The shapes fit, and yet it does not get there: the numbers mean something else "
        "than they did when it learned.",
    },
)
def fits(senses: Any) -> Done:
    """Check sensors with which the box chase's network finds the box."""
    sensors = a_list_of(Sensor, a_function(senses)())
    worlds = 20
    won = 0
    try:
        _compare(sensors)
        for done in drives(lambda: put_to(sensors), None, seeds_of("11.4", worlds), limit=100):
            won += done.won
    except BlockError as error:
        hint = "shape" if "has the shape" in str(error) else "missing"
        raise NotYet(f"It does not fit: {error}", hint=hint) from None
    return Done(
        f"The same readings as where it learned; it finds the box in {won} of {worlds} worlds.",
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
    for seed in seeds_of("11.4", 6):
        theirs.reset(seed)
        yours.reset(seed)
        for _ in range(6):
            for key in described:
                wanted, got = (each.agents[0].percept.get(key) for each in (theirs, yours))
                if got is None or wanted is None or np.shape(got) != np.shape(wanted):
                    return  # the network itself says so, with the type of the sensor
                if not is_close(got, wanted, 1e-4):
                    raise NotYet(
                        f"It fits, and nobody complains. But with seed {seed} `{key}` reads other "
                        "numbers than the sensor with which the network learned: it is told "
                        "something else than it believes.",
                        hint="meaning",
                    )
            if theirs.agents[0].done:
                break
            theirs.step()
            yours.step()
