"""The link between a RemoteBrain and a script that connects by WebSocket.

What both have said is in a state machine, :class:`Exchange`.
"""

import time
from collections import deque
from collections.abc import Callable, Mapping
from enum import Enum, auto
from threading import Lock
from typing import Any

from ai4u_edu.blocks import Answer, Command
from ai4u_edu.blocks.brains.links.link import AgentSpec, LinkState, Observation, Reply, ResetRequest
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.server.loop_queue import LoopQueue
from ai4u_edu.page.server.scripts.outbox import Outbox
from ai4u_edu.page.server.scripts.welcome import ObservationSubset
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.wire import native


class Session:
    """One script that drives one agent, over any number of connections in turn.

    It is the brain's :class:`~ai4u_edu.blocks.brains.links.link.Link`. The runner's thread calls
    the link's methods; the server's event loop calls ``attach``, ``detach``, ``mark_lost`` and
    ``hear``. The state that both change is in a thread-safe :class:`Exchange`.

    Args:
        runner: the room's.
        on_close: called in the event loop when the agent's brain is closed.
        may_seed: whether a reset may have a seed, which resets the whole world.
        queue: of calls for the event loop, shared by a room; default: a new one.
        report_mistake: called with the reason why an action has no effect, in any thread.
    """

    def __init__(
        self,
        runner: Runner,
        on_close: Callable[[str], None],
        *,
        may_seed: bool = True,
        queue: LoopQueue | None = None,
        report_mistake: Callable[[str], object] = lambda _reason: None,
    ) -> None:
        self.state = LinkState.CONNECTED
        self.reason = ""
        self.time_asked_at = 0.0
        self.subset: ObservationSubset
        """The readings that the script gets; set in the runner's thread before the first one."""
        self.exchange = Exchange()
        self.outbox: Outbox | None = None
        """The connection; None while it is lost. Only the event loop changes it."""
        self._runner = runner
        self._queue = queue or LoopQueue()
        self._on_close = on_close
        self._may_seed = may_seed
        self._report_mistake = report_mistake
        self._rewards = _RewardSum()
        self._readable: tuple[str, ...] = ()
        """Names of the fields that the agent's sensors read."""
        self._unread = ""
        """The latest sentence about fields that no sensor reads."""

    # -- for the brain, in the runner's thread ---------------------------------------------------

    @property
    def ignored(self) -> int:
        """Messages that were no answer."""
        return self.exchange.ignored

    @property
    def expects_reply(self) -> bool:
        """True while the brain can expect an answer to the latest percept."""
        return self.exchange.turn is not Turn.IDLE

    @property
    def will_notify(self) -> bool:
        """True while the script owes an answer, of which the runner will be notified."""
        return self.exchange.turn is Turn.ASKED

    def open(self, spec: AgentSpec) -> None:
        """Note what the agent reads; the script is connected, and knows it from its welcome."""
        self._readable = spec.fields

    def tell(self, observation: Observation) -> None:
        """Send an observation in advance, unless the script still computes its last answer."""
        if self.outbox is not None and self.exchange.turn is not Turn.ASKED:
            self._rewards.add(observation)
            self._send_percept(observation)

    def ask(self, observation: Observation, timeout: float) -> Reply | None:
        """Return the script's answer if it is there; if not, the runner is notified of it later."""
        self._rewards.add(observation)
        reply = self.exchange.take()
        if reply is None:
            asked = self.exchange.observation
            if asked is None or (self.outbox is None and _replaces(observation, asked)):
                self._send_percept(observation)
            if timeout:  # the world waits for it
                self._runner.expect_answer()
            return None
        is_late = reply.observation is not observation
        if is_late and not self.expects_reply and not isinstance(reply.answer, ResetRequest):
            self._send_percept(observation)  # the late answer counts now; the observation is new
        return reply

    def note(self, warning: str) -> None:
        """Do nothing: the world's reports reach the script in messages of their own."""

    def refuse(self, reply: Reply, reason: str) -> bool:
        """Tell the script that its action can't be carried out."""
        observation = reply.observation
        if observation is None:
            return False
        self._report_mistake(reason)
        may_answer_again = self.exchange.ask_again(observation)
        problem = native.Problem("bad_action", reason, observation.number)
        self._call_in_loop(self._send_problem, problem)
        return may_answer_again

    def idle(self) -> None:
        """Do nothing: WebSocket pings keep the connection alive."""

    def close(self, reason: str) -> None:
        """End the session: the agent has another brain, or the world has ended."""
        self.state, self.reason = LinkState.WAITING, reason
        self.exchange.cancel()
        self._call_in_loop(self._on_close, reason)

    # -- for the connections, in the event loop --------------------------------------------------

    def attach(self, outbox: Outbox) -> None:
        """Use this connection from now on; repeat a percept that waits for its answer."""
        self.outbox = outbox
        self._repeat_percept()
        self.state, self.reason = LinkState.CONNECTED, ""

    def detach(self) -> None:
        """Forget the connection, which is lost."""
        self.outbox = None

    def mark_lost(self, reason: str, *, is_waited_for: bool) -> None:
        """Note that the script has been away for more than a moment.

        Args:
            reason: for the page.
            is_waited_for: whether the world waits for it to come back.
        """
        self.reason = reason
        if not is_waited_for:
            self.state = LinkState.LOST

    def hear(self, message: native.Answer) -> native.Problem | None:
        """Handle an answer; if it answers nothing, ignore it and repeat the latest percept.

        Returns:
            The reason why it can't be an answer to the latest percept, if it was meant as one.
        """
        asks_for_time = is_request_for_time(message)
        asked = self.exchange.observation_for(message.seq)
        if asked is None:
            if not asks_for_time:
                self.exchange.ignored += 1
                self._repeat_percept()
            return None
        if asks_for_time:
            self.time_asked_at = time.monotonic()
            return None
        agents = len(self._runner.sim.agents)
        problem = _find_problem(message, asked, agents=agents, may_seed=self._may_seed)
        if problem is not None:
            self._report_mistake(problem.text)
            return problem
        reply = Reply(_to_brain_answer(message), asked)
        if not isinstance(message, native.Order) and message.fields:
            unread = native.without_reader(message.fields, self._readable)
            # a script sends its fields with each answer; the mistake is told once
            warning, self._unread = "" if unread == self._unread else unread, unread
            reply = reply._replace(fields=message.fields, warning=warning)
        if self.exchange.answer(reply):
            self._runner.notify_answer()
        return None

    # -- frames ------------------------------------------------------------------------------------

    def _send_percept(self, observation: Observation) -> None:
        if self.exchange.turn is Turn.RESETTING:
            return
        data, texts = self.subset.extract(observation.percept)
        frame = native.encode(
            native.Percept(
                episode=observation.episode,
                step=observation.steps,
                seq=observation.number,
                tick=observation.tick,
                reward=self._rewards.total,
                terms=self._rewards.terms,
                terminated=observation.done and not observation.truncated,
                truncated=observation.truncated,
                paused=observation.paused,
                stopped=observation.stopped,
                data=data,
                texts=texts,
            )
        )
        if not self.exchange.ask(observation, frame):
            return
        self._rewards.clear()
        if self.outbox is not None:  # else it is sent with the next connection
            self._call_in_loop(self._send, frame)

    def _repeat_percept(self) -> None:
        frame = self.exchange.unanswered_frame()
        if frame is not None:
            self._send(frame)

    def _send(self, frame: bytes) -> None:
        if self.outbox is not None:
            self.outbox.send(frame)

    def _send_problem(self, problem: native.Problem) -> None:
        if self.outbox is not None:
            self.outbox.send_problem(problem)

    def _call_in_loop(self, function: Callable[[Any], None], argument: object) -> None:
        try:
            self._queue.call(function, argument)
        except RuntimeError:  # the server has ended before the world
            self.state, self.reason = LinkState.LOST, _("the server has ended")


def _replaces(observation: Observation, asked: Observation) -> bool:
    """Return True if a script that is away is to see this in place of what it was asked.

    The first percept of an episode stays, since it is the result of a reset.
    """
    is_first = asked.steps == 0 and asked.episode == observation.episode
    return observation is not asked and not is_first


class _RewardSum:
    """Reward of all decisions that were not sent to a script yet, in total and by term."""

    def __init__(self) -> None:
        self.total = 0.0
        self.terms: dict[str, float] = {}
        self._counted = (0, 0)

    def add(self, observation: Observation) -> None:
        """Add the reward of a decision, once; a new episode begins at 0."""
        decision = (observation.episode, observation.steps)
        if decision == self._counted:
            return
        if observation.episode != self._counted[0]:
            self.clear()
        self._counted = decision
        self.total += observation.reward
        for name, amount in observation.terms.items():
            self.terms[name] = self.terms.get(name, 0.0) + amount

    def clear(self) -> None:
        """Begin at 0 again, after a percept was sent."""
        self.total, self.terms = 0.0, {}


def _find_problem(
    message: native.Answer, asked: Observation, *, agents: int, may_seed: bool
) -> native.Problem | None:
    """Return the reason why a message can't be the answer to a percept.

    Args:
        message: the script's.
        asked: what the percept was made of.
        agents: number of agents in the world.
        may_seed: whether a reset may have a seed, which resets the whole world.
    """
    match message:
        case native.Action() if asked.done:
            text = _("the episode is over; expected a reset")
            return native.Problem("episode_over", text, asked.number)
        case native.Action(episode=episode, step=step):
            if (episode, step) == (asked.episode, asked.steps):
                return None
            text = _(
                "percept {n} is of episode {episode}, step {step}; "
                "got an action for episode {other_episode}, step {other_step}",
                n=asked.number,
                episode=asked.episode,
                step=asked.steps,
                other_episode=episode,
                other_step=step,
            )
            return native.Problem("bad_action", text, asked.number)
        case native.Reset(seed=int()) if not may_seed:
            text = _(
                "expected a reset without a seed, which begins an episode for this agent; with "
                "one it would begin for all {agents} agents, and whoever runs the world has to "
                "allow that (ai4u-edu play --seeded-resets)",
                agents=agents,
            )
            return native.Problem("seed_refused", text, asked.number)
    return None


def is_request_for_time(message: native.Answer) -> bool:
    """Return True for a message by which a script asks for more time."""
    return isinstance(message, native.Order) and message.word == "wait"


def _to_brain_answer(message: native.Answer) -> Answer | ResetRequest:
    """Convert a message to what a brain gets from its link."""
    match message:
        case native.Action(values=values):
            return values
        case native.Reset(seed=seed):
            return ResetRequest(seed)
        case native.Order(word=word):
            return Command(word)


class Turn(Enum):
    """States of an exchange."""

    IDLE = auto()
    """No percept waits for an answer."""
    ASKED = auto()
    """The script owes an answer to the latest percept."""
    ANSWERED = auto()
    """The script's answer to the latest percept waits for the brain."""
    RESETTING = auto()
    """The script has answered with a reset, which waits for the brain. No percept is sent: one of
    the episode that ends would make the script ask for another reset."""


_NEXT = {
    Turn.IDLE: {Turn.ASKED},
    Turn.ASKED: {Turn.ASKED, Turn.ANSWERED, Turn.RESETTING, Turn.IDLE},
    Turn.ANSWERED: {Turn.ASKED, Turn.IDLE},
    Turn.RESETTING: {Turn.IDLE},
}
"""Transitions that are allowed."""


class Exchange:
    """The latest percept of a script, and its answers that the brain has not taken yet.

    The runner's thread asks and takes answers; the server's event loop adds answers. A lock guards
    every method, and is held for a short time only.

    Attributes:
        turn: the state.
        observation: what the latest percept was made of; None while idle.
        ignored: answers that were discarded.
    """

    def __init__(self) -> None:
        self.turn = Turn.IDLE
        self.observation: Observation | None = None
        self.ignored = 0
        self._replies: deque[Reply] = deque()
        self._frame = b""
        self._lock = Lock()

    def __len__(self) -> int:
        """Return the number of answers that wait for the brain."""
        return len(self._replies)

    # -- for the brain, in the runner's thread ---------------------------------------------------

    def ask(self, observation: Observation, frame: bytes) -> bool:
        """Make this the percept that the script has to answer.

        Returns:
            False, and nothing changes, while a reset waits for the brain.
        """
        with self._lock:
            if self.turn is Turn.RESETTING:
                return False
            # in realtime a newer percept replaces one that the script never answered
            self._change_to(Turn.ASKED)
            self.observation, self._frame = observation, frame
            return True

    def ask_again(self, observation: Observation) -> bool:
        """Let the script answer once more, unless a newer percept was sent; return True if so."""
        with self._lock:
            if self.turn is not Turn.IDLE:
                return False
            self._change_to(Turn.ASKED)
            self.observation = observation
            return True

    def take(self) -> Reply | None:
        """Take the next answer; an action that came too late is skipped if there is a newer one."""
        with self._lock:
            if not self._replies:
                return None
            reply = self._replies.popleft()
            # only actions grow old: a reset or a pause is carried out however late it comes
            while self._replies and isinstance(reply.answer, Mapping):
                self.ignored += 1
                reply = self._replies.popleft()
            # else a newer percept was sent meanwhile, and still waits for its own answer
            if reply.observation is self.observation:
                self._become_idle()
            return reply

    def cancel(self) -> None:
        """Expect no answer any more."""
        with self._lock:
            if self.turn is not Turn.IDLE:
                self._become_idle()

    # -- for the connection, in the event loop ---------------------------------------------------

    def observation_for(self, seq: int) -> Observation | None:
        """Return what the percept with this number was made of, if it waits for an answer."""
        with self._lock:
            asked = self.observation if self.turn is Turn.ASKED else None
            return asked if asked is not None and asked.number == seq else None

    def answer(self, reply: Reply) -> bool:
        """Add the answer to the latest percept; return False if another one was sent meanwhile."""
        with self._lock:
            if self.turn is not Turn.ASKED or reply.observation is not self.observation:
                return False
            is_reset = isinstance(reply.answer, ResetRequest)
            self._change_to(Turn.RESETTING if is_reset else Turn.ANSWERED)
            self._replies.append(reply)
            return True

    def unanswered_frame(self) -> bytes | None:
        """Return the frame of the percept that waits for an answer, if there is one."""
        with self._lock:
            # a script that reconnects gets this frame again: the same bytes, the same number
            return self._frame if self.turn is Turn.ASKED else None

    # -- state ------------------------------------------------------------------------------------

    def _become_idle(self) -> None:
        self._change_to(Turn.IDLE)
        self.observation = None

    def _change_to(self, turn: Turn) -> None:
        if turn not in _NEXT[self.turn]:
            raise RuntimeError(f"expected {_NEXT[self.turn]} after {self.turn}, got {turn}")
        self.turn = turn
