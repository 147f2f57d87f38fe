"""The messages of the input socket: from a page, and to it with the keys that it may use."""

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.driving_keys import keys_of
from ai4u_edu.base.parameters import explain, format_problems
from ai4u_edu.blocks import (
    Actuator,
    ArrowController,
    Brain,
    DiscreteActuator,
    DiscreteArrowController,
    WASDRBMoveController,
)
from ai4u_edu.page.server.api import finite
from ai4u_edu.page.server.bindings import has_stick
from ai4u_edu.page.server.control_lock import ControlLock
from ai4u_edu.page.server.human_override import HumanOverride
from ai4u_edu.recording.snapshot import Snapshot
from ai4u_edu.recording.snapshot.outcome import outcome

CODE = r"^[A-Za-z0-9]{1,24}$"
Code = Annotated[str, Field(pattern=CODE)]
"""Physical key, as in the browser's ``KeyboardEvent.code``."""


class _Message(BaseModel):
    model_config = ConfigDict(extra="forbid", strict=True)


Deflection = Annotated[float, Field(ge=-1, le=1, allow_inf_nan=False)]
"""Deflection of a stick along one axis, from -1 to 1."""


class StickPosition(_Message):
    """Position of a stick on the screen or a gamepad; ahead and to the right are positive."""

    forward: Deflection = 0.0
    turn: Deflection = 0.0


class Keys(_Message):
    """All keys that are held now, and the position of the stick.

    A page sends it at each change, and ten times a second while any key is held.
    """

    type: Literal["keys"]
    held: Annotated[list[Code], Field(max_length=16)]
    stick: StickPosition = StickPosition()


class Take(_Message):
    """Request for control."""

    type: Literal["take"]


class Release(_Message):
    """Release of control."""

    type: Literal["let_go"]


class Start(_Message):
    """Start of a world that waits for a key, by a key that the agent does not know."""

    type: Literal["start"]


class Command(_Message):
    """Command for the runner.

    ``reset`` begins an episode with the given seed; without one, with a new seed or the locked one.
    ``try_again`` repeats the present seed, ``new_start`` draws a new one. While the seed is locked
    (``lock_seed``, ``unlock_seed``), every other reset repeats it too.
    """

    type: Literal["command"]
    name: Literal["reset", "try_again", "new_start", "lock_seed", "unlock_seed", "pause", "resume"]
    seed: Annotated[int, Field(ge=0, lt=2**53)] | None = None


Message = Keys | Take | Release | Start | Command
_KINDS: dict[str, type[_Message]] = {
    "keys": Keys,
    "take": Take,
    "let_go": Release,
    "start": Start,
    "command": Command,
}
_READER: TypeAdapter[Message] = TypeAdapter(Annotated[Message, Field(discriminator="type")])


def read(text: str | bytes) -> Message:
    """Return the message in a JSON text.

    Raises:
        ValueError: it is no such message; the text says what was expected.

    >>> read('{"type": "keys", "held": ["KeyW"]}')
    Keys(type='keys', held=['KeyW'], stick=StickPosition(forward=0.0, turn=0.0))
    >>> read('{"type": "kyes"}')
    Traceback (most recent call last):
    ...
    ValueError: unknown type 'kyes'; did you mean 'keys'?
    """
    try:
        return _READER.validate_json(text)
    except ValidationError as error:
        found = error.errors()
        if found[0]["type"] == "json_invalid":
            raise ValueError(f"expected JSON, got {text[:40]!r}: {found[0]['msg']}") from None
        kind = _KINDS.get(str(next(iter(found[0]["loc"]), "")), Keys)
        raise ValueError(format_problems(explain(found, kind.model_fields))) from None


Event = dict[str, Any]
_MOTIONS = {
    (1, 0, 0): "forward",
    (-1, 0, 0): "back",
    (0, 1, 0): "right",
    (0, -1, 0): "left",
    (0, 0, 1): "jump",
    (1, 0, 1): "jump forward",
}
"""Label of a motion, by the signs of (forward, turn, jump of either kind)."""

_JUMPS = ("jump", "jump_forward")
_CHOICES = ("right", "left", "up", "down", "accept")
"""Names of a DiscreteArrowController's choices, from 1 on."""


def hello_event(agent: BasicAgent, number: int, override: HumanOverride) -> Event:
    """Return the page's number, its agent, and the keys that drive the agent.

    Args:
        agent: the page's agent.
        number: the page's number.
        override: the agent's.
    """
    brain = override.brain
    return {
        "type": "hello",
        "you": number,
        "agent": agent.id,
        "name": agent.body_name,
        "brain": agent.brain.title(),
        "keys": usable_keys(agent, brain),
        "captions": key_labels(agent, brain),
        "stick": has_stick(brain),
        "others": override.current_driver,
        "instead": override.next_driver,
    }


def lock_event(lock: ControlLock, seats: Mapping[int, int]) -> Event:
    """Return the number of the page that drives, and of all pages at this agent.

    Args:
        lock: of the agent.
        seats: numbers of the seats of a class by the numbers of their pages.
    """
    event: Event = {"type": "seat", "driver": lock.driver, "pages": lock.page_count}
    seat = 0 if lock.driver is None else seats.get(lock.driver, 0)
    return {**event, "seat": seat} if seat else event


def state_event(picture: Snapshot, agent_id: str, title: str = "") -> Event | None:
    """Return the state of the world and the agent; None if the world has no such agent."""
    agent = next((agent for agent in picture.agents if agent.id == agent_id), None)
    if agent is None:
        return None
    body = next(body for body in picture.bodies if body.name == agent.body)
    end = outcome(agent, picture.agents, picture.static_scene.success)
    return {
        "type": "state",
        "paused": picture.paused,
        "waiting": picture.waiting,
        "past": picture.past,
        "error": picture.error,
        "episode": picture.episode,
        "agent_episode": agent.episode,
        "seed_locked": picture.is_seed_locked,
        "terminated": agent.terminated,
        "truncated": agent.truncated,
        "fallen": body.fallen,
        "title": title,
        "goal": picture.static_scene.goal,
        "outcome": end,
        # not before the end, since this event is sent whenever it changes
        "seconds": round(picture.episode_time, 1) if end else None,
        "reward": finite(agent.episode_reward),
        "terms": {name: finite(value) for name, value in agent.episode_terms.items()},
        "held": sorted(agent.held_keys),
    }


def error_event(text: str) -> Event:
    """Return an error in words: of the page's message, or of the world."""
    return {"type": "error", "text": text}


def usable_keys(agent: BasicAgent, brain: Brain | None = None) -> dict[str, list[str]]:
    """Return an agent's keys without those for actions that its body can't do.

    Args:
        agent: the agent to drive.
        brain: the brain to ask; default: the agent's own.
    """
    brain = brain or agent.brain
    useless = _useless_actions(agent, brain)
    keys = keys_of(agent, brain)
    return {action: codes for action, codes in keys.items() if action not in useless}


def key_labels(agent: BasicAgent, brain: Brain | None = None) -> dict[str, str]:
    """Return the labels of actions that do something else in this scene than their name says."""
    brain = brain or agent.brain
    actuator = _actuator(agent, brain)
    controller = getattr(brain, "controller", None)
    if not isinstance(actuator, DiscreteActuator) or actuator.handler is not None:
        return {}
    if not isinstance(controller, DiscreteArrowController):
        return {}
    names = {}
    for action, row in zip(_CHOICES, actuator.table[1:], strict=False):
        forward, turn, jump, forward_jump = row
        name = _MOTIONS.get((_sign(forward), _sign(turn), _sign(jump + forward_jump)))
        if name is not None:
            names[action] = name
    return names


def _useless_actions(agent: BasicAgent, brain: Brain) -> set[str]:
    """Return the actions that the controller knows and the body can't do."""
    controller, actuator = getattr(brain, "controller", None), _actuator(agent, brain)
    if isinstance(actuator, Actuator) and isinstance(controller, DiscreteArrowController):
        return set(_CHOICES[int(actuator.limits()[1][0]) :])
    if actuator is None or not isinstance(controller, WASDRBMoveController | ArrowController):
        return set()
    numbers = len(actuator.limits()[0])
    parts = getattr(controller, "components", None) or (
        _JUMPS if numbers >= 4 else ()  # the smallest action that includes jumps
    )
    jump = getattr(actuator, "jump_power", 1.0)
    forward = jump or getattr(actuator, "jump_forward_power", 1.0)
    can = {"jump": jump and "jump" in parts, "jump_forward": forward and "jump_forward" in parts}
    return {action for action in _JUMPS if not can[action]}


def _actuator(agent: BasicAgent, brain: Brain) -> Actuator | None:
    """Return the actuator that a brain's controller drives."""
    controller = getattr(brain, "controller", None)
    return agent.bound_blocks.actuators.get(getattr(controller, "actuator_name", ""))


def _sign(number: float) -> int:
    return (number > 0) - (number < 0)
