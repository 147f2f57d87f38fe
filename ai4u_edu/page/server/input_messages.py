"""The messages of the input socket: from a page, and to it with the keys that it may use."""

from collections.abc import Mapping
from typing import Annotated

from msgspec import UNSET, Meta, Struct, UnsetType

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.driving_keys import keys_of
from ai4u_edu.blocks import (
    Actuator,
    ArrowController,
    Brain,
    DiscreteActuator,
    DiscreteArrowController,
    WASDRBMoveController,
)
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import library_text
from ai4u_edu.page.messages import Message, MessageReader
from ai4u_edu.page.server.api import finite
from ai4u_edu.page.server.bindings import has_stick
from ai4u_edu.page.server.control_lock import ControlLock
from ai4u_edu.page.server.human_override import HumanOverride
from ai4u_edu.page.server.run_commands import RUN_COMMANDS
from ai4u_edu.snapshot import Snapshot
from ai4u_edu.snapshot.theme import latest_said

CODE = r"^[A-Za-z0-9]{1,24}$"
Code = Annotated[str, Meta(pattern=CODE)]
"""Physical key, as in the browser's ``KeyboardEvent.code``."""
Deflection = Annotated[float, Meta(ge=-1, le=1)]
"""Deflection of a stick along one axis, from -1 to 1."""


class StickPosition(Struct, frozen=True, forbid_unknown_fields=True):
    """Position of a stick on the screen or a gamepad."""

    forward: Deflection = 0.0
    """Deflection ahead, from -1 to 1."""
    turn: Deflection = 0.0
    """Deflection to the right, from -1 to 1."""


class Keys(Message, tag="keys"):
    """All keys that are held now, and the position of the stick.

    A page sends it at each change, and ten times a second while any key is held.
    """

    held: Annotated[list[Code], Meta(max_length=16)]
    """Codes of physical keys, as in ``KeyboardEvent.code``."""
    stick: StickPosition = StickPosition()


class Take(Message, tag="take"):
    """Request for control."""


class Release(Message, tag="let_go"):
    """Release of control."""


class Start(Message, tag="start"):
    """Start of a world that waits for a key, by a key that the agent does not know."""


INPUT_READER: MessageReader[Keys | Take | Release | Start] = MessageReader(
    (Keys, Take, Release, Start), RUN_COMMANDS
)
"""Reads what a page sends over its input socket.

>>> INPUT_READER.read('{"type": "keys", "held": ["KeyW"]}')
Keys(held=['KeyW'], stick=StickPosition(forward=0.0, turn=0.0))
>>> INPUT_READER.read('{"type": "kyes"}')
Traceback (most recent call last):
...
ValueError: unknown type 'kyes'; did you mean 'keys'?
"""


class InputEvent(Struct, frozen=True, tag_field="type"):
    """A message to a page."""


class HelloEvent(InputEvent, frozen=True, tag="hello"):
    """The page's number, its agent, and the keys that drive the agent."""

    you: int
    """Number of the page."""
    agent: str
    """Id of its agent."""
    name: str
    """Name of the agent's body."""
    brain: str
    """Title of the agent's brain."""
    keys: dict[str, list[str]]
    """Codes of physical keys by action, without those for actions that the body can't do."""
    captions: dict[str, str]
    """Labels of actions that do something else in this scene than their name says."""
    stick: bool
    """True if it is driven by a stick, too."""
    others: str
    """Title of the network or script that drives the agent now; empty if a person may."""
    instead: str
    """Title of what drives it once the person lets go; empty if nothing does."""
    is_network: bool
    """True if a network drives the agent now."""


class SeatEvent(InputEvent, frozen=True, tag="seat"):
    """The page that drives the agent."""

    driver: int | None
    """Number of the page that drives; null if none does."""
    pages: int
    """Count of the pages at this agent."""
    seat: int | UnsetType = UNSET
    """Number of the seat of a class at which the driving page is; left out if it is at none."""


class StateEvent(InputEvent, frozen=True, tag="state"):
    """The state of the world and of the page's agent."""

    paused: bool
    waiting: str
    """``key`` while the world waits for a person to press a key, ``teacher`` while a teacher holds
    it; empty otherwise."""
    past: str
    """Label of the moment of the past that is shown; empty for the present."""
    error: str
    """Sentence about the error that stopped the world; empty if none did."""
    episode: int
    """Number of the world's episode."""
    agent_episode: int
    """Episodes that the agent has begun, alone or with the world."""
    seed_locked: bool
    """True if each reset repeats the seed."""
    terminated: bool
    """True if the agent's episode ended by what happened in it."""
    truncated: bool
    """True if the agent's episode ended by the step limit."""
    fallen: bool
    """True if its body has fallen off the floor."""
    title: str
    """Title of the scene."""
    goal: str
    """Goal of the scene in words."""
    outcome: str
    """End of the agent's episode: ``goal``, ``won``, ``lost``, ``fell``, ``time`` or ``over``.
    It is empty before."""
    seconds: float | None
    """Time (s) of an episode that is over; null before, since it would change at each tick."""
    reward: float | None
    """Reward of the agent in the episode; null if it is not finite."""
    terms: dict[str, float | None]
    """The same by reward term."""
    held: list[str]
    """Codes of the keys that the agent sees held."""
    bumps: int
    """Contacts of its body with others that have begun since the world's reset."""
    collects: int
    """Things that it has collected, and stages that it has passed, in this episode."""
    said: int
    """Number that grows when somebody in the world says something, at most every 0.6 s of the
    world's time; 0 before."""


class ErrorEvent(InputEvent, frozen=True, tag="error"):
    """An error in words: of the page's message, or of the world."""

    text: str


_MOTIONS = {
    (1, 0, 0): _("forward"),
    (-1, 0, 0): _("back"),
    (0, 1, 0): _("right"),
    (0, -1, 0): _("left"),
    (0, 0, 1): _("jump"),
    (1, 0, 1): _("jump forward"),
}
"""Label of a motion, by the signs of (forward, turn, jump of either kind)."""

_JUMPS = ("jump", "jump_forward")
_CHOICES = ("right", "left", "up", "down", "accept")
"""Names of a DiscreteArrowController's choices, from 1 on."""


def hello_event(agent: BasicAgent, number: int, override: HumanOverride) -> HelloEvent:
    """Return the page's number, its agent, and the keys that drive the agent.

    Args:
        agent: the page's agent.
        number: the page's number.
        override: the agent's.
    """
    brain = override.brain
    return HelloEvent(
        you=number,
        agent=agent.id,
        name=agent.body_name,
        brain=agent.brain.title(),
        keys=usable_keys(agent, brain),
        captions=key_labels(agent, brain),
        stick=has_stick(brain),
        others=override.current_driver,
        instead=override.next_driver,
        is_network=override.is_network,
    )


def seat_event(lock: ControlLock, seats: Mapping[int, int]) -> SeatEvent:
    """Return the number of the page that drives, and of all pages at this agent.

    Args:
        lock: of the agent.
        seats: numbers of the seats of a class by the numbers of their pages.
    """
    seat = 0 if lock.driver is None else seats.get(lock.driver, 0)
    return SeatEvent(lock.driver, lock.page_count, seat or UNSET)


def state_event(picture: Snapshot, agent_id: str, title: str = "") -> StateEvent | None:
    """Return the state of the world and the agent; None if the world has no such agent."""
    agent = next((agent for agent in picture.agents if agent.id == agent_id), None)
    if agent is None:
        return None
    body = next(body for body in picture.bodies if body.name == agent.body)
    end = agent.outcome(picture.agents, picture.static_scene.success)
    return StateEvent(
        paused=picture.paused,
        waiting=picture.waiting,
        past=picture.past,
        error=picture.error,
        episode=picture.episode,
        agent_episode=agent.episode,
        seed_locked=picture.is_seed_locked,
        terminated=agent.terminated,
        truncated=agent.truncated,
        fallen=body.fallen,
        title=library_text(title),
        goal=library_text(picture.static_scene.goal),
        outcome=end,
        # not before the end, since this event is sent whenever it changes
        seconds=round(picture.episode_time, 1) if end else None,
        reward=finite(agent.episode_reward),
        terms={name: finite(value) for name, value in agent.episode_terms.items()},
        held=sorted(agent.held_keys),
        bumps=agent.bumps,
        collects=agent.collects,
        said=latest_said(picture),
    )


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
    names: dict[str, str] = {}
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
