"""A program for each built-in block, made of its sample, and run when the docs are built.

A block that takes a function, which no source can be written of, has an example in its docstring.
"""

import contextlib
import io
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from gymnasium import spaces

from ai4u_edu import (
    Actuator,
    BasicAgent,
    Block,
    Controller,
    LocalBrain,
    RewardFunc,
    Sensor,
)
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import ParameterError
from ai4u_edu.check.rollout import SCRIPTED
from tests.check.samples.sample import Sample

MAX_CALL_CHARS = 64
"""A longer call gets a line for each argument."""
NESTED = 10_000
"""Length of a call inside of another one, which stays on its line."""
NAMES = ("perception_key", "action_name", "name")
"""Parameters that are derived from the class if they are left out."""
FORWARD = {"move": [1, 0, 0, 0]}
"""Action of the robot in the checks' world."""
CURVE = {"move": [0.5, -0.5, 0, 0]}
"""Action that changes what nearly every sensor reads."""
DECISIONS, SENSING_DECISIONS = 10, 3
MAX_PRINTED_LINES = 12
"""Longest reading that is printed; of a longer one, only the shape is."""


class NoSourceError(Exception):
    """A value that can't be written as an expression, such as a function."""


@dataclass(frozen=True)
class Example:
    """A program, what it prints, and the agent that it ends with."""

    source: str
    printed: str
    sim: ControlRequestor

    @property
    def agent(self) -> BasicAgent:
        """The agent with the block."""
        return self.sim.agents[0]


def example_of(sample: Sample) -> Example | None:
    """Return a program that shows a block, after running it; None if it can't be written down."""
    try:
        block = source_of(sample.block)
    except NoSourceError:
        return None
    used = {type(each).__name__ for each in nested(sample.block)}
    source = _program(sample, block, used)
    example = _run(source)
    if example.printed.count("\n") > MAX_PRINTED_LINES:
        return _run(source.replace("])\n", "].shape)\n"))
    return example


def _run(source: str) -> Example:
    names: dict[str, Any] = {}
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        exec(compile(source, "<example of a block>", "exec"), names)  # noqa: S102 - our own
    return Example(source, printed.getvalue(), names["sim"])


def _program(sample: Sample, block: str, used: set[str]) -> str:
    kind, lines = sample.block, []
    extra = {type(each).__name__ for each in sample.actuators}
    driven = {"LocalBrain"} if isinstance(kind, Actuator | RewardFunc | Sensor) else set()
    scene = {"Scene"} if sample.scene else set()
    imports = sorted({*used, *extra, *driven, *scene})
    lines.append(f"from ai4u_edu import {', '.join(imports)}")
    if sample.scene:
        lines += ["", f'sim = Scene.load("{sample.scene}").build()']
    else:
        lines += ["from ai4u_edu.check import standard_scene", "", "sim = standard_scene().build()"]
    lines += ["agent = sim.agents[0]", *_use(sample, block), "sim.reset(seed=1)"]
    decisions = SENSING_DECISIONS if isinstance(kind, Sensor) else DECISIONS
    lines += [f"for _ in range({decisions}):", *_keys(kind), "    sim.step()"]
    return "\n".join([*lines, _shown(kind)]) + "\n"


def _use(sample: Sample, block: str) -> list[str]:
    """Return the lines that give the block to the agent."""
    setup = "agent.setup(sim.world)"
    match sample.block:
        case Sensor():
            return [f"sensor = {block}", "agent.sensors.append(sensor)", _brain(CURVE), setup]
        case Actuator() as actuator:
            put = "append(actuator)" if needs_motion(actuator) else "[:] = [actuator]"
            put = put if put.startswith("[") else f".{put}"
            return [
                f"actuator = {block}",
                f"agent.actuators{put}",
                _brain(action_of(actuator)),
                setup,
            ]
        case RewardFunc():
            return [f"reward = {block}", "agent.rewards[:] = [reward]", _brain(FORWARD), setup]
        case Controller():
            lines = [f"agent.actuators[:] = [{source_of(each)}]" for each in sample.actuators]
            own = [f"controller = {block}", "agent.use_brain(controller)"]
            return [*lines, *([setup] if lines else []), *own]
    return [f"brain = {block}", "agent.use_brain(brain)"]


def _brain(action: Mapping[str, Any]) -> str:
    function = f"lambda percept: {source_of(action)}"
    return f"agent.brains[:] = [LocalBrain(controller={function})]"


def _keys(kind: Block) -> list[str]:
    """Return the line that presses a key, for controllers that read the keyboard."""
    name = type(kind.controller if isinstance(kind, LocalBrain) else kind).__name__
    if "WASD" in name:
        return ['    agent.keyboard.hold(["KeyW"])']
    return ['    agent.keyboard.hold(["ArrowUp"])'] if "Arrow" in name else []


def _shown(block: Block) -> str:
    match block:
        case Sensor():
            return f'print(agent.percept["{block.perception_key}"])'
        case Actuator():
            return "print([round(each, 2) for each in agent.body.position])"
        case RewardFunc():
            return "print(agent.ledger.episode_terms)"
    return "print(agent.last_action)"


def needs_motion(actuator: Actuator) -> bool:
    """Return True for an actuator that does not move the body: another one is kept for that."""
    return len(actuator.limits()[0]) < 2 and isinstance(actuator.space(), spaces.Box)


def action_of(actuator: Actuator) -> dict[str, Any]:
    """Return an action that shows what an actuator does: its first number at its highest."""
    space, (_, high) = actuator.space(), actuator.limits()
    if isinstance(space, spaces.Discrete):
        return {actuator.action_name: 1}
    own = {actuator.action_name: [high[0], *[0] * (len(high) - 1)]} if high else {}
    return {**FORWARD, **own} if needs_motion(actuator) else own


def source_of(value: Any, room: int = MAX_CALL_CHARS) -> str:
    """Return an expression that makes a value again.

    Args:
        value: a block, or the value of a parameter.
        room: length of a line; a longer block gets a line for each parameter.

    Raises:
        NoSourceError: there is none.
    """
    match value:
        case Block():
            if any(getattr(value, name, None) is not None for name in SCRIPTED):
                raise NoSourceError(f"{value!r} with a script")
            given = [f"{name}={source_of(each, NESTED)}" for name, each in _needed(value).items()]
            one_line = f"{type(value).__name__}({', '.join(given)})"
            if len(one_line) <= room:
                return one_line
            lines = "".join(f"    {each},\n" for each in given)
            return f"{type(value).__name__}(\n{lines})"
        case Mapping():
            pairs = (f"{source_of(key)}: {source_of(each, NESTED)}" for key, each in value.items())
            return "{" + ", ".join(pairs) + "}"
        case list() | tuple():
            inside = [source_of(each, NESTED) for each in value]
            end = "," if isinstance(value, tuple) and len(inside) == 1 else ""
            text = ", ".join(inside) + end
            return f"[{text}]" if isinstance(value, list) else f"({text})"
        case bool() | int() | float() | str() | None:
            return json.dumps(value) if isinstance(value, str) else repr(value)
    raise NoSourceError(repr(value))


def _needed(block: Block) -> dict[str, Any]:
    """Return the parameters that make a block: those with no default, without derived names."""
    given = block.given()
    for name in NAMES:
        rest = {each: value for each, value in given.items() if each != name}
        with contextlib.suppress(ParameterError):
            if name in given and getattr(type(block)(**rest), name, None) == given[name]:
                given = rest
    return given


def nested(value: Any) -> list[Block]:
    """Return a block and the blocks inside it."""
    if isinstance(value, Block):
        return [value, *(each for inside in _needed(value).values() for each in nested(inside))]
    if isinstance(value, Mapping):
        return [each for inside in value.values() for each in nested(inside)]
    if isinstance(value, list | tuple):
        return [each for inside in value for each in nested(inside)]
    return []


def has_docstring_example(cls: type[Block]) -> bool:
    """Return True if the docstring has an example of its own, which runs as a test."""
    return ">>>" in (cls.__doc__ or "")
