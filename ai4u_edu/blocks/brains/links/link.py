"""The interface between a RemoteBrain and a transport to its script, and a link's own thread."""

import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType
from typing import Any, NamedTuple, Protocol

from gymnasium import spaces

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.brain import Answer
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.blocks.sensors import AgentArraySensor

_POLL_S = 0.05
"""Interval at which a link's thread looks for a newer observation, and for its end."""


class LinkState(StrEnum):
    """States of the connection to a script."""

    WAITING = "waiting"
    """No script has connected yet, or the last one said goodbye."""
    CONNECTED = "connected"
    LOST = "lost"
    """The script is gone; it may come back, or another one may connect."""


class ReadingSpec(NamedTuple):
    """The description of one sensor's reading in the percept."""

    name: str
    """Its perception key."""
    kind: str
    """AI4U's type: sfloatarray, simage, ..."""
    space: spaces.Space[Any]
    """The space of the values in the percept, normalised and stacked."""
    unit: str
    is_input: bool
    """True if it is part of a policy's observation."""


class OutputSpec(NamedTuple):
    """The description of one actuator's action."""

    name: str
    is_continuous: bool
    space: spaces.Space[Any]
    is_output: bool
    """True if a policy has to give it an action."""


@dataclass(frozen=True, slots=True)
class AgentSpec:
    """The description of an agent, sent to a script once."""

    agent: str
    """The agent's id."""
    max_steps: int
    """Decisions after which an episode is truncated; 0 for no limit."""
    skip_frame: int
    repeat_action: bool
    tick: float
    """Duration of a tick in seconds."""
    readings: tuple[ReadingSpec, ...]
    """Readings of the agent's own sensors; every percept has ``done`` and ``id`` too."""
    outputs: tuple[OutputSpec, ...]
    rewards: tuple[str, ...]
    """Names of the reward's terms."""
    fields: tuple[str, ...] = ()
    """Names of fields of a script that sensors read."""


class Observation(NamedTuple):
    """Everything that a script gets before it answers."""

    number: int
    """Counted by the brain, from 1; each observation gets at most one answer."""
    episode: int
    """Counted by the agent, from 1."""
    percept: Percept
    reward: float
    """Reward of the last decision."""
    terms: Mapping[str, float]
    """The same reward by named term."""
    steps: int
    """Decisions taken in this episode."""
    tick: int
    """Ticks of the world since its reset."""
    done: bool
    """True if the episode is over: terminated or truncated."""
    truncated: bool
    """True if the episode was cut off: by its limit, or by a reset that is not the script's."""
    paused: bool
    stopped: bool
    episode_reward: float = 0.0
    """Reward of all decisions of this episode; a script may miss some of them."""


class ResetRequest(NamedTuple):
    """An answer that asks for a new episode: of the world, or of one of several agents."""

    seed: int | None = None
    """With a seed, the whole world is reset, with this seed."""


class Reply(NamedTuple):
    """A script's answer, and the observation that it answers."""

    answer: Answer | ResetRequest
    """An action, unchecked; PAUSE, RESUME or STOP; WAIT for "no action; ask me again at the next
    tick"; or a :class:`ResetRequest`."""
    observation: Observation | None
    """None if it answers no observation, such as a reset by a script that has just connected."""
    warning: str = ""
    """A sentence about parts of it, or messages before it, that have no effect; empty for none."""
    fields: Mapping[str, tuple[str, ...]] = MappingProxyType({})
    """Fields that a script sends besides the action, by name."""


class Link(Protocol):
    """The connection to one script over some transport. The runner's thread calls all methods.

    A link never raises because of what a script does or sends: that changes its ``state``,
    ``reason`` and ``ignored``.
    """

    @property
    def state(self) -> LinkState:
        """The state of the connection."""

    @property
    def reason(self) -> str:
        """A sentence for the page about the last event; empty if there is nothing to report."""

    @property
    def ignored(self) -> int:
        """The number of messages that were no answer: malformed, repeated, late, from others."""

    @property
    def time_asked_at(self) -> float:
        """The time at which the script last asked for more time; 0 for never.

        It is of the brain's clock, by default time.monotonic, and stays 0 if the transport has no
        such message.
        """

    @property
    def expects_reply(self) -> bool:
        """True while the script owes an answer, so that a world in lockstep waits for it."""

    @property
    def will_notify(self) -> bool:
        """True while it owes an answer, and the runner will be notified when it arrives."""

    def open(self, spec: AgentSpec) -> None:
        """Begin to wait for a script; close the connection that was open before."""

    def tell(self, observation: Observation) -> None:
        """Send an observation before it is asked about, if that is possible now.

        The script can compute its answer while the world finishes its tick, and what it gets is not
        a tick old.
        """

    def ask(self, observation: Observation, timeout: float) -> Reply | None:
        """Return the script's answer, as soon as it is there.

        The observation is sent unless another one is in flight: there is at most one. With no
        script connected, look for one and return at once.

        Args:
            observation: the current one; one with the same number is a repeated question.
            timeout: seconds to wait; 0 to return at once.

        Returns:
            An answer, possibly to an earlier observation; None if there is none yet.
        """

    def refuse(self, reply: Reply, reason: str) -> bool:
        """Report to the script, if the transport can, that its answer can't be carried out.

        Returns:
            True if the script may answer the same observation again.
        """

    def note(self, warning: str) -> None:
        """Keep a sentence about what had no effect, for the script's next observation.

        A transport that reports to the script in another way ignores it.
        """

    def idle(self) -> None:
        """Keep the connection alive while the world stands still; called now and then."""

    def close(self, reason: str) -> None:
        """Say goodbye. It may be called twice; ``open`` begins again."""


class LinkThread:
    """A thread that talks to a script, and a mailbox between it and the runner's thread.

    The mailbox holds one observation and one answer. The runner's thread calls ``put``,
    ``exchange`` and ``close``; the thread itself calls ``talk``. A condition guards both.

    Args:
        talk: continues the dialogue until a deadline (s, of the clock) or an answer.
        name: of the thread.
        clock: seconds.
    """

    def __init__(
        self,
        talk: Callable[[Observation | None, float], Reply | None],
        name: str,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._talk = talk
        self._clock = clock
        self._changed = threading.Condition()
        self._latest: Observation | None = None
        self._reply: Reply | None = None
        self._answered_number = 0
        """Number of the observation that was answered last; the next one has a higher number."""
        self._is_closing = False
        self._error: AI4UError | None = None
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def put(self, observation: Observation) -> None:
        """Replace the observation in the mailbox."""
        with self._changed:
            self._latest = observation
            self._changed.notify_all()

    def exchange(self, observation: Observation, timeout: float) -> Reply | None:
        """Replace the observation, and take the answer if there is one within the timeout (s).

        Raises:
            AI4UError: the dialogue raised it, for example for an observation that can't be sent.
        """
        with self._changed:
            self._latest = observation
            self._changed.notify_all()
            if timeout and self._reply is None:
                self._changed.wait_for(lambda: self._reply is not None, timeout)
            if self._error is not None:
                raise self._error
            reply, self._reply = self._reply, None
            if reply is not None and isinstance(reply.answer, ResetRequest):
                self._latest = None  # of the episode that ends: the script waits for another one
        return reply

    def close(self) -> None:
        """End the thread, and wait until it has ended."""
        self.end()
        self._thread.join()

    def end(self) -> None:
        """End the thread soon."""
        with self._changed:
            self._is_closing = True
            self._changed.notify_all()

    def _run(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(self._has_work)
                if self._is_closing:
                    return
                observation = self._latest
            try:
                reply = self._talk(observation, self._clock() + _POLL_S)
            except AI4UError as error:
                self._error = error
                return
            if reply is not None:
                with self._changed:
                    self._reply = reply
                    if observation is not None:
                        self._answered_number = observation.number
                    self._changed.notify_all()

    def _has_work(self) -> bool:
        """Return True if there is an observation to send, or the thread has to end."""
        is_new = self._latest is not None and self._latest.number > self._answered_number
        return self._is_closing or (is_new and self._reply is None)


def describe_agent(
    agent: AgentView, *, skip_frame: int, repeat_action: bool, tick: float
) -> AgentSpec:
    """Return the description of an agent for its script."""
    return AgentSpec(
        agent=agent.id,
        max_steps=agent.max_steps_per_episode,
        skip_frame=skip_frame,
        repeat_action=repeat_action,
        tick=tick,
        readings=tuple(
            ReadingSpec(
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
            OutputSpec(
                actuator.action_name,
                actuator.is_continuous,
                actuator.space(),
                actuator.is_output,
            )
            for actuator in agent.actuators
            if actuator.is_active
        ),
        rewards=tuple(reward.name for reward in agent.rewards if reward.is_active),
        fields=tuple(
            sensor.perception_key
            for sensor in agent.sensors
            if sensor.is_active and isinstance(sensor, AgentArraySensor)
        ),
    )
