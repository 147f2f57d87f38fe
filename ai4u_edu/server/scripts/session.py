"""A script that has an agent: its brain's link, and what the loop hears for it.

The runner's thread asks; the server's loop hears and speaks. What both touch is guarded by a lock,
and is never held for long.
"""

import time
from collections import deque
from collections.abc import Callable, Mapping
from threading import Lock
from typing import Any

from ai4u_edu.base.loop_queue import Post
from ai4u_edu.blocks import Answer, Command
from ai4u_edu.blocks.brains.links.link import Answered, LinkState, Offer, Reset, Situation
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.server.scripts.outbox import Line
from ai4u_edu.server.scripts.welcome import Excerpt
from ai4u_edu.wire import native


class Session:
    """One script at one agent, over however many connections.

    Args:
        runner: the room's.
        on_close: called in the loop when the agent's brain is closed.
        may_seed: whether a reset may have a seed, which resets the whole world.
        post: the way into the loop that all sessions of a room share; left out, one of its own.
    """

    def __init__(
        self,
        runner: Runner,
        on_close: Callable[[str], None],
        *,
        may_seed: bool = True,
        post: Post | None = None,
    ) -> None:
        self.state = LinkState.CONNECTED
        self.reason = ""
        self.ignored = 0
        self.heard = 0.0
        self.excerpt: Excerpt
        """The readings that the script wants; set in the runner's thread, before it is told any."""
        self._runner = runner
        self._post = post or Post()
        self._on_close = on_close
        self._may_seed = may_seed
        self._lock = Lock()
        self._line: Line | None = None
        self._answers: deque[Answered] = deque()
        self._told: Situation | None = None
        self._is_answered = False
        self._is_resetting = False
        """True while an answer that asks for a reset waits for the brain."""
        self._frame = b""
        self._counted = (0, 0)
        self._reward = 0.0
        self._terms: dict[str, float] = {}

    # -- for the brain, in the runner's thread ---------------------------------------------------

    @property
    def expecting(self) -> bool:
        """Whether the script owes an answer."""
        return self._told is not None

    @property
    def will_call(self) -> bool:
        """Whether it owes one that it has not given."""
        return self._told is not None and not self._is_answered

    def open(self, offer: Offer) -> None:
        """Nothing: the script is here already, and knows."""

    def tell(self, situation: Situation) -> None:
        """The agent's now, unless the script still thinks about what it was told before."""
        if self._line is not None and (self._told is None or self._is_answered):
            self._count(situation)
            self._tell(situation)

    def ask(self, situation: Situation, timeout: float) -> Answered | None:
        """The script's answer, if it is there; if not, the runner is called when it is."""
        self._count(situation)
        if not self._answers:
            if self._told is None or (self._line is None and _replaces(situation, self._told)):
                self._tell(situation)
            if timeout:  # the world waits for it
                self._runner.expect_answer()
            return None
        answered = self._newest()
        is_reset = isinstance(answered.answer, Reset)
        with self._lock:
            self._is_resetting = self._is_resetting and not is_reset
            if self._told is answered.situation:
                self._told = None
        if answered.situation is not situation and self._told is None and not is_reset:
            self._tell(situation)  # it was late; what it says counts now, what it sees is new
        return answered

    def refuse(self, answered: Answered, reason: str) -> bool:
        """Tells the script that its action can't be carried out."""
        situation = answered.situation
        if situation is None:
            return False
        with self._lock:
            again = self._told is None
            if again:
                self._told, self._is_answered = situation, False
        self._give(self._say, native.encode(native.Problem("bad_action", reason, situation.number)))
        return again

    def idle(self) -> None:
        """Nothing: the connection looks after itself."""

    def close(self, reason: str) -> None:
        """The agent has another brain, or the world has ended."""
        self.state, self.reason = LinkState.WAITING, reason
        self._told = None
        self._give(self._on_close, reason)

    # -- for the connections, in the loop --------------------------------------------------------

    @property
    def line(self) -> Line | None:
        """The connection; None while it is lost."""
        return self._line

    def attach(self, line: Line) -> None:
        """A connection is there; a percept that waits for its answer is said (again)."""
        self._line = line
        with self._lock:
            if self._told is not None and not self._is_answered:
                line.say(self._frame)
        self.state, self.reason = LinkState.CONNECTED, ""

    def detach(self) -> None:
        """The connection is lost."""
        self._line = None

    def hear(self, message: native.Answer) -> native.Problem | None:
        """An answer. What answers nothing is not counted, and the last percept is said again.

        Returns:
            What is wrong with it, if it is an answer and can't be one.
        """
        with self._lock:
            told = self._told
            waits = isinstance(message, native.Order) and message.word == "wait"
            if told is None or self._is_answered or message.seq != told.number:
                if waits:
                    return None
                self.ignored += 1
                if told is not None and not self._is_answered and self._line is not None:
                    self._line.say(self._frame)
                return None
            if waits:
                self.heard = time.monotonic()
                return None
            problem = self._problem(message, told)
            if problem is not None:
                return problem
            answered = Answered(_answer_in(message), told)
            self._is_answered = True
            self._is_resetting = isinstance(answered.answer, Reset)
            self._answers.append(answered)
        self._runner.notify_answer()
        return None

    # -- what they are made of -------------------------------------------------------------------

    def _problem(self, message: native.Answer, told: Situation) -> native.Problem | None:
        """Why a message can't be the answer to what was told."""
        match message:
            case native.Action() if told.done:
                text = "the episode is over; expected a reset"
                return native.Problem("episode_over", text, told.number)
            case native.Action(episode=episode, step=step):
                if (episode, step) == (told.episode, told.steps):
                    return None
                text = (
                    f"percept {told.number} is of episode {told.episode}, step {told.steps}; "
                    f"got an action for episode {episode}, step {step}"
                )
                return native.Problem("bad_action", text, told.number)
            case native.Reset(seed=int()) if not self._may_seed:
                text = (
                    "expected a reset without a seed, which begins an episode for this agent; with "
                    f"one it would begin for all {len(self._runner.sim.agents)} agents, and whoever"
                    " runs the world has to allow that (ai4u-edu play --seeded-resets)"
                )
                return native.Problem("seed_refused", text, told.number)
        return None

    def _newest(self) -> Answered:
        """The answer that counts: an action that came too late gives way to one that did not."""
        answered = self._answers.popleft()
        while self._answers and isinstance(answered.answer, Mapping):
            self.ignored += 1
            answered = self._answers.popleft()
        return answered

    def _count(self, situation: Situation) -> None:
        """Adds up what was paid since the last percept that the script was told."""
        place = (situation.episode, situation.steps)
        if place == self._counted:
            return
        if situation.episode != self._counted[0]:
            self._reward, self._terms = 0.0, {}
        self._counted = place
        self._reward += situation.reward
        for name, amount in situation.terms.items():
            self._terms[name] = self._terms.get(name, 0.0) + amount

    def _tell(self, situation: Situation) -> None:
        data, texts = self.excerpt.of(situation.percept)
        frame = native.encode(
            native.Percept(
                episode=situation.episode,
                step=situation.steps,
                seq=situation.number,
                tick=situation.tick,
                reward=self._reward,
                terms=self._terms,
                terminated=situation.done and not situation.truncated,
                truncated=situation.truncated,
                paused=situation.paused,
                stopped=situation.stopped,
                data=data,
                texts=texts,
            )
        )
        self._reward, self._terms = 0.0, {}
        with self._lock:
            if self._is_resetting:  # told of the episode that ends, it would ask for one more
                return
            self._told, self._frame, self._is_answered = situation, frame, False
        if self._line is not None:  # else it is said when there is one again
            self._give(self._say, frame)

    def _say(self, frame: bytes) -> None:
        if self._line is not None:
            self._line.say(frame)

    def _give(self, function: Callable[[Any], None], argument: object) -> None:
        try:
            self._post.give(function, argument)
        except RuntimeError:  # the server has ended before the world
            self.state, self.reason = LinkState.LOST, "the server has ended"


def _replaces(situation: Situation, told: Situation) -> bool:
    """Return True if a script that is away is to see this in place of what it was told.

    The first percept of an episode stays, since a reset gives it back.
    """
    is_first = told.steps == 0 and told.episode == situation.episode
    return situation is not told and not is_first


def _answer_in(message: native.Answer) -> Answer | Reset:
    match message:
        case native.Action(values=values):
            return values
        case native.Reset(seed=seed):
            return Reset(seed)
        case native.Order(word=word):
            return Command(word)
