"""What a RemoteBrain and a transport say to each other."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, NamedTuple, Protocol

from gymnasium import spaces

from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.command import Answer
from ai4u_edu.blocks.percept import Percept


class LinkState(StrEnum):
    """Whether a script is at the other end."""

    WAITING = "waiting"
    """No script has come yet, or the last one said goodbye."""
    CONNECTED = "connected"
    LOST = "lost"
    """A script was there and is gone; it may come back, or another one may come."""


class Reading(NamedTuple):
    """What one sensor puts into the percept."""

    name: str
    """Its perception key."""
    kind: str
    """AI4U's type: sfloatarray, simage, ..."""
    space: spaces.Space[Any]
    """Of what stands in the percept: normalised and stacked."""
    unit: str
    is_input: bool
    """Whether a policy gets it as part of its observation."""


class Output(NamedTuple):
    """What one actuator takes."""

    name: str
    is_continuous: bool
    space: spaces.Space[Any]
    is_output: bool
    """Whether a policy has to give it an action."""


@dataclass(frozen=True, slots=True)
class Offer:
    """What a script is told of an agent, once."""

    agent: str
    """The agent's id."""
    max_steps: int
    """Decisions after which an episode is cut off; 0 for no limit."""
    skip_frame: int
    repeat_action: bool
    tick: float
    """Seconds of a tick."""
    readings: tuple[Reading, ...]
    """Of the agent's own sensors; every percept has ``done`` and ``id`` besides."""
    outputs: tuple[Output, ...]
    rewards: tuple[str, ...]
    """The names of the reward's terms."""


class Situation(NamedTuple):
    """What a script is told before each of its answers."""

    number: int
    """Counted from 1 on, by the brain; each is answered once."""
    episode: int
    """The agent's, counted from 1 on."""
    percept: Percept
    reward: float
    """Of the last decision."""
    terms: Mapping[str, float]
    """The same, by named term."""
    steps: int
    """Decisions taken in this episode."""
    tick: int
    """Of the world, since its reset."""
    done: bool
    """Whether the episode is over, in whatever way."""
    truncated: bool
    """Whether it was cut off: by its limit, or by somebody else's reset."""
    paused: bool
    stopped: bool


class Reset(NamedTuple):
    """An answer that asks for a new episode: of the world, or of this agent if it has company."""

    seed: int | None = None
    """Given, it is the whole world that begins anew, from this seed."""


class Answered(NamedTuple):
    """What a script answered, and what it had been told."""

    answer: Answer | Reset
    """An action, as it came; PAUSE, RESUME, STOP; WAIT for "nothing; tell me again at the next
    tick"; or a :class:`Reset`."""
    situation: Situation | None
    """None if it answered nothing in particular, as one that just came and asks for a reset."""


class Link(Protocol):
    """One transport's way to a script. All methods are called by the runner's thread.

    A link never raises because of what a script does or sends: that ends in its ``state``, its
    ``reason`` and its counts.
    """

    state: LinkState
    reason: str
    """What happened last, in a sentence for the page; empty while there is nothing to say."""
    ignored: int
    """How much came that was no answer: garbage, repeated, too late, from somebody else."""
    heard: float
    """When the script said last (time.monotonic) that it needs more time; 0 for never. A transport
    whose scripts can't say so leaves it at 0."""

    @property
    def expecting(self) -> bool:
        """Whether the script owes an answer, so that a world in lockstep has to wait for it."""

    @property
    def will_call(self) -> bool:
        """Whether it owes one, and the world's runner is called as soon as it is there."""

    def open(self, offer: Offer) -> None:
        """Begins to look out for a script. What was open before is closed."""

    def tell(self, situation: Situation) -> None:
        """The agent's now, sooner than it is asked about.

        A link that can sends it at once: a script sees what is new and not a tick old, and thinks
        while the world finishes its tick.
        """

    def ask(self, situation: Situation, timeout: float) -> Answered | None:
        """The script's answer, as soon as it is there.

        Sends the situation, unless one is on its way already: there is one in flight at most. With
        no script there, looks out for one, and returns at once.

        Args:
            situation: the agent's now; one with the same number is the same one, asked again.
            timeout: how long to wait (s); 0 to look only.

        Returns:
            An answer, possibly to an earlier situation; None if there is none yet.
        """

    def refuse(self, answered: Answered, reason: str) -> bool:
        """The answer can't be carried out; tells the script, where the transport can.

        Returns:
            Whether the script may answer the same situation again.
        """

    def idle(self) -> None:
        """Called now and then while the world stands still: stay in touch, ask for nothing new."""

    def close(self, reason: str) -> None:
        """Says goodbye. Closing twice is fine, and ``open`` begins anew."""


def offer_of(agent: AgentView, *, skip_frame: int, repeat_action: bool, tick: float) -> Offer:
    """What a script is told of an agent."""
    return Offer(
        agent=agent.id,
        max_steps=agent.max_steps_per_episode,
        skip_frame=skip_frame,
        repeat_action=repeat_action,
        tick=tick,
        readings=tuple(
            Reading(
                sensor.perception_key,
                sensor.reading_kind(),
                sensor.observation_space(),
                sensor.unit,
                sensor.is_input,
            )
            for sensor in agent.sensors
            if sensor.is_active
        ),
        outputs=tuple(
            Output(
                actuator.action_name,
                actuator.is_continuous,
                actuator.space(),
                actuator.is_output,
            )
            for actuator in agent.actuators
            if actuator.is_active
        ),
        rewards=tuple(reward.name for reward in agent.rewards if reward.is_active),
    )
