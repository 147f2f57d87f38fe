"""The file of a network: ONNX, written and read byte by byte.

Before: :mod:`~ai4u_edu.learn.small.actor_critic`. New here is the file. ONNX is a format that many
programs run: it has a list of operations (``Gemm``: multiply by a matrix and add; ``Tanh``; ...),
each with the names of what goes in and comes out, and the numbers that they need. So everything
that drives, explains or plays with a trained network takes these files, whoever trained it.

ONNX is stored as Protocol Buffers. All that takes is below: a message is a row of fields; a field
is a number that says which one it is and of what type, then its value: a whole number, four bytes
of a real number, or the count of bytes that follow. The numbers of fields are those of
https://github.com/onnx/onnx/blob/main/onnx/onnx.proto.

The graph has one input for each sensor, by its perception key, and two outputs: the action by its
actuator's name, and the critic's value. Readings are scaled before they go into a network, and
actions after they come out; both are only multiplications, so they are multiplied into the first
and the last matrix, and the file has nothing but layers:

    readings -> Flatten -> Concat -> Gemm -> Tanh -> Gemm -> Tanh -> Gemm -> Max, Min -> action
                                  -> Gemm -> Tanh -> Gemm -> Tanh -> Gemm -> critic_value

A network that chooses has ``ArgMax`` in place of ``Max`` and ``Min``: the number of the largest
output. If it chooses among the actions of keys, ``Gather`` takes the action from a list of them.
"""

import hashlib
import json
import struct
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import SetupError, text_of
from ai4u_edu.base.version import __version__
from ai4u_edu.blocks.brains.network import MAX_LOADED_NETWORK_BYTES, TRAINING_KEY, VALUE_OUTPUT
from ai4u_edu.learn.envs.spaces_of import (
    Observer,
    action_space_of,
    described_blocks,
    inputs_of,
    outputs_of,
)
from ai4u_edu.learn.small.actor_critic import ActorCritic
from ai4u_edu.learn.small.neural_network import Mlp
from ai4u_edu.locale import gettext as _

OPSET = 18
"""Version of the list of operations."""
IR_VERSION = 10
"""Version of the format."""
FLOAT, INT64 = 1, 7
"""ONNX's numbers for the types of arrays that we write."""
TYPES: dict[str, int] = {"float32": 1, "uint8": 2, "int32": 6, "int64": 7, "bool": 9}
"""ONNX's numbers for the types of readings."""
INT_ATTRIBUTE = 2
"""ONNX's number for the type of an option that is a whole number."""
ACTOR, CRITIC = "actor", "critic"
"""Beginnings of the names of the layers' numbers, as in ``actor.0.weight``."""

KEY_ACTIONS = "key_actions"
"""Name of the actions that a network chooses from."""

Field = tuple[int, "int | str | bytes"]
"""Number and value of a field. Bytes may be those of another message."""


def write_network(
    network: ActorCritic, agent: BasicAgent, about: Mapping[str, Any], path: Path
) -> Path:
    """Write a network for an agent to a file; atomically.

    Args:
        network: for the agent's flat observation.
        agent: whose sensors are the inputs, and whose only actuator is the output.
        about: what the file says of its origin, besides agent and version: ``scene``,
            ``algorithm``, ``seed``, ``steps`` and the like; or another rhythm than the agent's
            (``skip_frame``, ``repeat_action``).
        path: of the file.
    """
    write_atomically(path, network_bytes(network, agent, about))
    return path


def network_bytes(network: ActorCritic, agent: BasicAgent, about: Mapping[str, Any]) -> bytes:
    """Return the content of a network's file; see :func:`write_network`.

    The same network and the same ``about`` give the same bytes.
    """
    inputs = inputs_of(agent)
    (output,) = outputs_of(agent)
    model = _model(_graph(network, inputs, output))
    described = {
        "skip_frame": agent.brain.skip_frame,
        "repeat_action": agent.brain.repeat_action,
        **about,
        "version": __version__,
        **described_blocks(agent),
        "hash": hashlib.sha256(model).hexdigest(),
    }
    entry = _message((1, TRAINING_KEY), (2, json.dumps(described, sort_keys=True)))
    # fields of a message may come in any order, so another one can simply be added at the end
    return model + _message((14, entry))


def read_network(data: bytes, agent: BasicAgent) -> ActorCritic:
    """Return a network that :func:`network_bytes` wrote, to learn on from it.

    Args:
        data: content of the file. Whoever wrote it, nothing in it is run.
        agent: with the same sensors and the same actuator.

    Raises:
        SetupError: the file is of another kind, or of another agent's network.
    """
    if len(data) > MAX_LOADED_NETWORK_BYTES:
        raise SetupError(
            _("expected a network of at most {most} MB", most=MAX_LOADED_NETWORK_BYTES // 2**20)
        )
    try:
        graph = dict(_fields(data))[7]
        numbers = dict(map(_read_array, (part for field, part in _fields(graph) if field == 5)))
        depth = sum(name.startswith(f"{ACTOR}.") for name in numbers) // 2
        layers = [len(numbers[f"{ACTOR}.{layer}.bias"]) for layer in range(depth - 1)]
        network = ActorCritic(
            Observer(agent, "flat").space, action_space_of(agent), layers, numbers.get(KEY_ACTIONS)
        )
        for name, mlp in ((ACTOR, network.actor), (CRITIC, network.critic)):
            for layer, (weights, biases) in enumerate(zip(mlp.weights, mlp.biases, strict=True)):
                _fill(weights, numbers[f"{name}.{layer}.weight"])
                _fill(biases, numbers[f"{name}.{layer}.bias"])
    except (ValueError, KeyError, IndexError, TypeError, struct.error) as error:
        raise SetupError(
            _(
                "expected a network that was taught in the page for this agent, got: {problem}",
                problem=text_of(error),
            )
        ) from None
    # take back what _scaled_in has multiplied in
    unit = np.ones(1) if network.chooses else np.where(network.unit > 0.0, network.unit, 1.0)
    network.actor.weights[-1][:] /= np.reshape(unit, (-1, 1))
    network.actor.biases[-1][:] /= unit
    for mlp in (network.actor, network.critic):
        mlp.biases[0][:] += mlp.weights[0] @ network.middle
        mlp.weights[0][:] *= network.size
    return network


# --- the graph


def _graph(
    network: ActorCritic,
    inputs: Mapping[str, tuple[tuple[int, ...], np.dtype[Any]]],
    output: str,
) -> bytes:
    """Return the graph: operations, numbers, inputs and outputs."""
    nodes: list[bytes] = []
    arrays: list[bytes] = []
    for key, (_place, dtype) in inputs.items():
        source = key
        if dtype != np.float32:
            source = f"{key}/float"
            nodes.append(_node("Cast", [key], source, to=FLOAT))
        nodes.append(_node("Flatten", [source], f"{key}/flat", axis=1))
    nodes.append(_node("Concat", [f"{key}/flat" for key in inputs], "readings", axis=1))
    unit = np.ones(1) if network.chooses else network.unit
    last = f"{ACTOR}/outputs"
    _add_layers(nodes, arrays, ACTOR, last, _scaled_in(network, network.actor, unit))
    _add_layers(nodes, arrays, CRITIC, VALUE_OUTPUT, _scaled_in(network, network.critic))
    if network.chooses:
        is_choice = network.key_actions is None and not network.first_choice
        best = output if is_choice else f"{output}/index"
        nodes.append(_node("ArgMax", [last], best, axis=1, keepdims=0))
        if network.key_actions is not None:
            arrays.append(_array(KEY_ACTIONS, network.key_actions))
            nodes.append(_node("Gather", [KEY_ACTIONS, best], output, axis=0))
        elif network.first_choice:
            arrays.append(_array("first choice", np.array(network.first_choice)))
            nodes.append(_node("Add", [best, "first choice"], output))
        is_number = network.key_actions is not None
        action = _port(output, *((FLOAT, network.low.shape) if is_number else (INT64, ())))
    else:
        arrays += [_array("low", network.low), _array("high", network.high)]
        nodes.append(_node("Max", [last, "low"], f"{ACTOR}/not below"))
        nodes.append(_node("Min", [f"{ACTOR}/not below", "high"], output))
        action = _port(output, FLOAT, network.low.shape)
    ports = [_port(key, TYPES[dtype.name], shape) for key, (shape, dtype) in inputs.items()]
    return _message(
        *((1, node) for node in nodes),
        (2, "actor and critic"),
        *((5, array) for array in arrays),
        *((11, port) for port in ports),
        (12, action),
        (12, _port(VALUE_OUTPUT, FLOAT, (1,))),
    )


def _scaled_in(
    network: ActorCritic, mlp: Mlp, unit: npt.NDArray[Any] | None = None
) -> list[tuple[npt.NDArray[Any], npt.NDArray[Any]]]:
    """Return weights and biases of layers that take readings as they are.

    ``weights @ ((readings - middle) / size) + biases`` is the same as
    ``(weights / size) @ readings + (biases - (weights / size) @ middle)``.

    Args:
        network: for the scaling.
        mlp: its actor or its critic.
        unit: (outputs,) or (1,) factors of the outputs; left out, 1.
    """
    # in double precision, since the rounding errors of a large row would add up
    layers: list[tuple[npt.NDArray[Any], npt.NDArray[Any]]] = [
        (weights.astype(np.float64), biases.astype(np.float64))
        for weights, biases in zip(mlp.weights, mlp.biases, strict=True)
    ]
    weights, biases = layers[0]
    weights = weights / network.size
    layers[0] = weights, biases - weights @ network.middle.astype(np.float64)
    if unit is not None:
        weights, biases = layers[-1]
        layers[-1] = weights * unit[:, None], biases * unit
    return layers


def _add_layers(
    nodes: list[bytes],
    arrays: list[bytes],
    name: str,
    output: str,
    layers: Sequence[tuple[npt.NDArray[Any], npt.NDArray[Any]]],
) -> None:
    """Add the operations and numbers of some layers that begin at the readings."""
    source = "readings"
    for index, (weights, biases) in enumerate(layers):
        layer = f"{name}.{index}"
        arrays += [
            _array(f"{layer}.weight", weights.astype(np.float32)),
            _array(f"{layer}.bias", biases.astype(np.float32)),
        ]
        is_last = index == len(layers) - 1
        sums = output if is_last else f"{layer}/sums"
        nodes.append(_node("Gemm", [source, f"{layer}.weight", f"{layer}.bias"], sums, transB=1))
        if not is_last:
            source = f"{layer}/outputs"
            nodes.append(_node("Tanh", [sums], source))


# --- ONNX's messages


def _model(graph: bytes) -> bytes:
    return _message(
        (1, IR_VERSION),
        (2, "ai4u-edu"),
        (3, __version__),
        (7, graph),
        (8, _message((1, ""), (2, OPSET))),
    )


def _node(operation: str, inputs: Sequence[str], output: str, **options: int) -> bytes:
    return _message(
        *((1, name) for name in inputs),
        (2, output),
        (3, output),  # a node's own name
        (4, operation),
        *(
            (5, _message((1, name), (3, value), (20, INT_ATTRIBUTE)))
            for name, value in options.items()
        ),
    )


def _array(name: str, numbers: npt.NDArray[Any]) -> bytes:
    kind = FLOAT if numbers.dtype.kind == "f" else INT64
    data = numbers.astype("<f4" if kind == FLOAT else "<i8").tobytes()
    return _message(*((1, size) for size in numbers.shape), (2, kind), (8, name), (9, data))


def _port(name: str, kind: int, shape: Sequence[int]) -> bytes:
    """Return an input or output; its first axis has any length, one for each decision."""
    axes = [_message((2, "batch")), *(_message((1, size)) for size in shape)]
    tensor = _message((1, kind), (2, _message(*((1, axis) for axis in axes))))
    return _message((1, name), (2, _message((1, tensor))))


# --- Protocol Buffers


def _message(*fields: Field) -> bytes:
    """Return the bytes of a message.

    >>> _message((1, 150), (2, "testing")).hex(" ")
    '08 96 01 12 07 74 65 73 74 69 6e 67'
    """
    parts = []
    for field, value in fields:
        if isinstance(value, int):
            parts += [_varint(field << 3), _varint(value)]
        else:
            data = value.encode() if isinstance(value, str) else value
            parts += [_varint(field << 3 | 2), _varint(len(data)), data]
    return b"".join(parts)


def _varint(number: int) -> bytes:
    """Return a whole number from 0 on: seven bits a byte, the lowest ones first.

    The eighth bit of a byte says that another one follows.
    """
    parts = bytearray()
    while number > 127:
        parts.append(number & 127 | 128)
        number >>= 7
    parts.append(number)
    return bytes(parts)


def _fields(message: Any) -> Iterator[tuple[int, Any]]:
    """Yield number and value of each field of a message: whole numbers and bytes.

    Raises:
        ValueError: it is no message.
    """
    place = 0

    def varint() -> int:
        nonlocal place
        number = 0
        for shift in range(0, 70, 7):
            part: int = message[place]
            place += 1
            number |= (part & 127) << shift
            if part < 128:
                return number
        raise ValueError(_("a number is too long"))

    while place < len(message):
        key = varint()
        if key & 7 == 0:
            yield key >> 3, varint()
            continue
        size = varint() if key & 7 == 2 else {1: 8, 5: 4}.get(key & 7, len(message))
        if size > len(message) - place:
            raise ValueError(_("it ends in the middle"))
        yield key >> 3, message[place : place + size]
        place += size


def _read_array(message: bytes) -> tuple[str, npt.NDArray[Any]]:
    """Return name and numbers of an array that :func:`_array` wrote."""
    shape: list[int] = []
    parts: dict[int, Any] = {}
    for field, value in _fields(message):
        if field == 1:
            shape.append(value)
        else:
            parts[field] = value
    numbers = np.frombuffer(parts[9], "<f4" if parts[2] == FLOAT else "<i8")
    return parts[8].decode(), numbers.reshape(shape)


def _fill(place: npt.NDArray[Any], numbers: npt.NDArray[Any]) -> None:
    if place.shape != numbers.shape or not np.isfinite(numbers).all():
        raise ValueError(
            _(
                "expected finite numbers of the shape {shape}, got the shape {shape2}",
                shape=str(place.shape),
                shape2=str(numbers.shape),
            )
        )
    place[:] = numbers
