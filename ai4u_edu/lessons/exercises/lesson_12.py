"""The network inside: inputs, outputs, and nothing but numbers in between."""

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.optional_deps import need
from ai4u_edu.blocks import (
    BearingSensor,
    FallReward,
    LocalBrain,
    NeuralNetController,
    Percept,
    RBMoveActuator,
    TouchRewardFunc,
)
from ai4u_edu.blocks.brains.network import VALUE_OUTPUT
from ai4u_edu.lessons.exercise import Done, NotYet, a_function, exercise, named
from ai4u_edu.lessons.exit_ticket import Question, exit_ticket
from ai4u_edu.lessons.numeric import (
    chance_for,
    difference,
    finite_number,
    finite_numbers,
    is_close,
)
from ai4u_edu.lessons.rollouts import drives, seeds_of
from ai4u_edu.lessons.worlds import plate
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import ngettext
from ai4u_edu.scenes import Scene

Array = npt.NDArray[np.float64]
Layer = tuple[Array, Array]

ZOO = "zoo:box_chase"
CLOSE = 1e-4


def layers_of(path: str = ZOO) -> list[Layer]:
    """Return the weights (outputs, inputs) and biases (outputs,) of each layer of a policy.

    Args:
        path: the file of a network such as PPO's: layers in a row. Those of a critic
            beside them are left out.
    """
    need("train", "onnx")
    import onnx
    from onnx import numpy_helper

    network = NeuralNetController(model_path=path).network
    graph = onnx.load(str(network.path)).graph
    numbers = {each.name: numpy_helper.to_array(each) for each in graph.initializer}
    needed = {port.name for port in network.outputs if port.name != VALUE_OUTPUT}
    layers: list[Layer] = []
    for node in reversed(graph.node):  # each of them comes after those whose outputs it takes
        if needed.isdisjoint(node.output):
            continue
        needed.update(node.input)
        if node.op_type == "Gemm":
            _inputs, weights, bias = node.input
            layers.append((np.array(numbers[weights], float), np.array(numbers[bias], float)))
    return layers[::-1]


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


class TwoNeurons(NamedTuple):
    """Weights and bias of two neurons: forward and turn."""

    weights: list[list[float]]
    bias: list[float]


def two_neurons(
    forward_sine: float,
    forward_cosine: float,
    forward_bias: float,
    turn_sine: float,
    turn_cosine: float,
    turn_bias: float,
) -> TwoNeurons:
    """Return two neurons, each with its two weights and its bias."""
    weights = [[forward_sine, forward_cosine], [turn_sine, turn_cosine]]
    return TwoNeurons(weights, [forward_bias, turn_bias])


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


def _array(given: Any, shape: tuple[int, ...], name: str) -> Array:
    try:
        found = np.array(given, float)
    except (TypeError, ValueError, OverflowError):
        found = np.array(np.nan)
    if found.shape != shape or not np.isfinite(found).all():
        rows = ngettext("{n} number", "{n} numbers", shape[0])
        if len(shape) == 2:
            rows = _("two rows of two numbers")
        raise NotYet(
            _("`{name}`: expected {rows}, got {got}.", name=name, rows=rows, got=named(given))
        )
    return found


@exercise(
    "12.1",
    _("One neuron"),
    hints={
        "sum": _(
            "Multiply each input by its weight, and add all that up: `sum(w * x for w, x in "
            "zip(weights, inputs))`. Then the bias, then `math.tanh`."
        ),
        "bias": _("The bias is missing: add it to the sum, before `math.tanh`."),
        "late-bias": _("The bias is added once, to the sum, before `math.tanh`."),
        "each": _("The bias is added once, not once for each input: it stands outside the loop."),
        "weights": _("Each input counts as much as its weight says: multiply it by its weight."),
        "squash": _(
            "The sum itself can be any number. A neuron's output lies between -1 and 1: "
            "`math.tanh(...)` of the whole."
        ),
    },
)
def is_a_neuron(neuron: Any) -> str:
    """Check one neuron's output."""
    chance = chance_for("12.1", neuron)
    for count in (2, 1, 5, 3, 8):
        inputs, weights = chance.normal(size=(2, count)).round(2).tolist()
        bias = round(float(chance.normal()), 2)
        total = float(np.dot(inputs, weights))
        got = finite_number(a_function(neuron)(list(inputs), list(weights), bias))
        if not is_close(got, np.tanh(total + bias), CLOSE):
            slips = {
                "sum": (_("the same whatever comes in"), 0.0),
                "squash": (_("right without `math.tanh`"), total + bias),
                "bias": (_("right without the bias"), float(np.tanh(total))),
                "late-bias": (_("right if the bias came last"), float(np.tanh(total)) + bias),
                "each": (
                    _("right if the bias were added for each input"),
                    float(np.tanh(total + count * bias)),
                ),
                "weights": (
                    _("right without the weights"),
                    float(np.tanh(sum(inputs) + bias)),
                ),
            }
            slip = difference(got, slips, CLOSE)
            raise NotYet(
                _(
                    "Inputs {inputs}, weights {weights}, bias {bias}: expected {tanh:.3f}, "
                    "got {got:.3f}{words}.",
                    inputs=inputs,
                    weights=weights,
                    bias=bias,
                    tanh=np.tanh(total + bias),
                    got=got,
                    words=slip.words,
                ),
                hint=slip.name,
            )
    return _("Five neurons of different sizes, all of them right.")


@exercise(
    "12.2",
    _("Two neurons by hand"),
    hints={
        "begin": _(
            "All weights are 0, so whatever it senses, it does the same. Begin with the "
            "forward neuron: a bias of 1 makes it drive, always. Then let the turn neuron "
            "look at the sine."
        ),
        "swapped": _(
            "The turn neuron does not look at the sine: has a row changed places with a "
            "column? A row is a neuron (forward, turn), a column an input (sine, cosine)."
        ),
        "blind": _(
            "The turn neuron does not look at the sine, so it can't know the box's side: the "
            "first number of the second row."
        ),
        "still": _("It never drives: give the forward neuron a bias above 0."),
        "weak": _("The signs are right. Let it turn more for the same sine, or drive more slowly."),
        "mirrored": _(
            "It turns away from the box. The sine is above 0 when the box is on the left, "
            "and turn above 0 is to the right: the weight between them has to be below 0."
        ),
    },
)
def drives_by_hand(weights: Any, bias: Any = None) -> Done:
    """Check weights with which two neurons find the box; sliders give weights and bias as one."""
    if bias is None and isinstance(weights, TwoNeurons):
        weights, bias = weights
    worlds = 20
    for done in drives(lambda: by_hand(weights, bias), None, seeds_of("12.2", worlds), limit=300):
        if not done.won:
            how = _("fell") if done.fell else _("did not get there")
            raise done.not_yet(
                _("The robot {how} ({where}).", how=how, where=done.where), _wiring(weights, bias)
            )
    return Done(
        _("With six numbers it found the box in {worlds} worlds.", worlds=worlds), done.picture()
    )


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
    "12.3",
    _("All of it"),
    hints={
        "begin": _(
            "Go through the layers: `for weights, bias in layers`. What comes out of one "
            "goes into the next: `signal = weights @ signal + bias`."
        ),
        "between": _(
            "Without `np.tanh` between the layers all of them together can do no more than "
            "one. Squash what comes out of each layer but the last."
        ),
        "biases": _("The biases are missing: `weights @ signal + bias`."),
        "last": _(
            "The last layer is not squashed here: what it says is the action as it is. Leave "
            "`np.tanh` out after it."
        ),
    },
)
def thinks(think: Any) -> Done:
    """Check the whole network, and a robot that is driven by it."""
    chance = chance_for("12.3", think)
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
                ngettext(
                    "A network with {n} layer, {inputs} inputs: expected {expected}, got {got}.",
                    "A network with {n} layers, {inputs} inputs: expected {expected}, got {got}.",
                    len(layers),
                    inputs=sizes[0],
                    expected=str(right.round(2).tolist()),
                    got=str(got.round(2).tolist()),
                ),
                hint=next(near, ""),
            )
    layers = layers_of()

    def drive(percept: Percept) -> dict[str, Any]:
        return {"move": np.clip(think(inputs_of(percept), layers), [-1, -1, 0, 0], 1)}

    brain = LocalBrain(controller=drive, skip_frame=9)
    for done in drives("box_chase", brain, seeds_of("12.3", 5), limit=100):
        if not done.won:
            raise done.not_yet(
                _(
                    "With the weights of the box chase it did not get there ({where}).",
                    where=done.where,
                )
            )
    return Done(_("Your lines do what the network does, and drive to the box."), done.picture())


def _through(
    inputs: Array, layers: Sequence[Layer], *, between: bool = True, last: bool = False
) -> Array:
    signal = inputs
    for number, (weights, bias) in enumerate(layers, 1):
        signal = weights @ signal + bias
        if last if number == len(layers) else between:
            signal = np.tanh(signal)
    return signal


exit_ticket(
    "12.exit",
    Question(
        "b",
        {
            "a": _("The sum doubles, and then `tanh` squashes it: the output stays below 1."),
            "c": _(
                "`tanh` squashes a larger sum to a larger output, as long as there is room below 1."
            ),
        },
    ),
    Question(
        "a",
        {
            "b": _("Each row is one neuron, and gives one output. So how many come out?"),
            "c": _("The table has 15 weights. Each row is multiplied by the same inputs."),
        },
    ),
    Question(
        "c",
        {
            "a": _("Without squashing, two tables can be multiplied into one. Something is lost."),
            "b": _(
                "The numbers still fit, so Python does not complain. That makes it hard to notice."
            ),
        },
    ),
)
