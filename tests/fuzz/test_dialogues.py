"""The state machines of both protocols, checked against their diagrams in the code."""

import asyncio
import math
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule

from ai4u_edu.blocks.brains.links.link import Observation, Reply
from ai4u_edu.blocks.brains.links.link import ResetRequest as ResetAnswer
from ai4u_edu.page.server.scripts.outbox import Outbox
from ai4u_edu.page.server.scripts.session import Session
from ai4u_edu.wire import native
from ai4u_edu.wire.ai4u import decode_request
from ai4u_edu.wire.ai4u_dialogue import (
    VALID_KINDS,
    AI4UDialogue,
    ReplyKind,
    SentState,
    SessionPhase,
)
from ai4u_edu.wire.validation import WireError

SAYABLE = {
    ReplyKind.CONFIGURED: b"max_steps;1;0@id;1;0",
    ReplyKind.ACTION: b"move;2;1.0;0.5",
} | {
    word: f"{word.value};1;0".encode()
    for word in ReplyKind
    if word not in (ReplyKind.CONFIGURED, ReplyKind.ACTION, ReplyKind.HALT)
}
SAYABLE[ReplyKind.HALT] = b"halt"
NEXT = {
    (SessionPhase.HANDSHAKE, ReplyKind.CONFIGURED): SessionPhase.POLLING,
    **{(phase, ReplyKind.HALT): SessionPhase.OVER
       for phase in SessionPhase if phase is not SessionPhase.CONNECTING},
    **{(phase, word): SessionPhase.PLAYING
       for phase in (SessionPhase.POLLING, SessionPhase.STARTED, SessionPhase.PLAYING)
       for word in (ReplyKind.RESET, ReplyKind.RESTART)},
    (SessionPhase.POLLING, ReplyKind.START): SessionPhase.STARTED,
    (SessionPhase.STARTED, ReplyKind.CONTROL): SessionPhase.POLLING,
    (SessionPhase.PLAYING, ReplyKind.CONTROL): SessionPhase.POLLING,
}  # fmt: skip
MEANT = {
    ReplyKind.START: SessionPhase.STARTED,
    ReplyKind.RESET: SessionPhase.PLAYING,
    ReplyKind.RESTART: SessionPhase.PLAYING,
}
"""Phase that a reply to the first contact leads to after the handshake."""


class AI4USession(RuleBasedStateMachine):
    """After any input the phase is the state diagram's, and each message sent can be decoded."""

    def __init__(self) -> None:
        super().__init__()
        self.dialogue = AI4UDialogue("0", metadata="{}")
        self.phase = SessionPhase.CONNECTING
        self.meant: SessionPhase | None = None

    @rule(done=st.booleans(), reward=st.floats(allow_nan=False, allow_infinity=False))
    def ask(self, done: bool, reward: float) -> None:
        state = SentState(sensors=[], reward=reward, steps=3, done=done, truncated=False)
        names = [field.name for field in decode_request(self.dialogue.request(state))]
        assert "id" in names
        assert ("reward" in names) == (self.phase in (SessionPhase.STARTED, SessionPhase.PLAYING))
        assert self.dialogue.in_flight

    @rule(word=st.sampled_from(ReplyKind))
    def hear(self, word: ReplyKind) -> None:
        if word not in VALID_KINDS[self.phase]:
            with pytest.raises(WireError, match="nothing that can be said while"):
                self.dialogue.parse_reply(SAYABLE[word])
            return
        self.dialogue.parse_reply(SAYABLE[word])
        if self.phase is SessionPhase.CONNECTING:
            self.phase, self.meant = SessionPhase.HANDSHAKE, MEANT.get(word)
        elif word is ReplyKind.CONFIGURED and self.meant is not None:
            self.phase = self.meant
        else:
            self.phase = NEXT.get((self.phase, word), self.phase)
        assert not self.dialogue.in_flight

    @rule(reply=st.binary(max_size=40))
    def garbage(self, reply: bytes) -> None:
        before = self.dialogue.in_flight
        try:
            self.dialogue.parse_reply(b"\xff" + reply)
        except WireError:
            assert self.dialogue.in_flight == before

    @rule()
    def begin(self) -> None:
        self.dialogue.begin()
        self.phase = SessionPhase.CONNECTING

    @invariant()
    def phase_is_the_pictures(self) -> None:
        assert self.dialogue.phase is self.phase


class _World:
    """Stub of the runner methods that a session calls."""

    sim = SimpleNamespace(agents=[None])

    def expect_answer(self) -> None:
        pass

    def notify_answer(self) -> None:
        pass


class _Subset:
    def extract(self, percept: Any) -> tuple[bytes, tuple[str, ...]]:
        return b"", ()


class NativeSession(RuleBasedStateMachine):
    """Frames are lost, duplicated and delayed: each answer counts once, for its percept."""

    def __init__(self) -> None:
        super().__init__()
        self.loop = asyncio.new_event_loop()
        self.loop.run_until_complete(self._make())
        self.number = 0
        self.asked: Observation | None = None
        self.heard: list[native.Message] = []
        self.sent: list[native.Action | native.Reset] = []
        self.carried_out: list[int] = []
        self.line: Outbox | None = None

    async def _make(self) -> None:
        world: Any = _World()
        subset: Any = _Subset()
        self.session = Session(world, lambda reason: None)
        self.session.subset = subset

    @initialize()
    def come(self) -> None:
        self.connect()

    @rule()
    def connect(self) -> None:
        def write(frame: bytes) -> bool:
            self.heard.append(native.decode(frame, native.MAX_WORLD_FRAME_BYTES))
            return True

        async def never(message: Any) -> None:
            raise AssertionError

        self.line = Outbox(never, write)
        self.session.attach(self.line)

    @rule()
    def lose(self) -> None:
        self.session.detach()

    @rule(new=st.booleans(), patient=st.booleans())
    def world_asks(self, new: bool, patient: bool) -> None:
        if new or self.asked is None:
            self.number += 1
            nothing: Any = None
            self.asked = Observation(
                number=self.number, episode=1 + self.number // 5, percept=nothing, reward=1.0,
                terms={},
                steps=self.number % 5, tick=self.number, done=self.number % 5 == 4,
                truncated=False, paused=False, stopped=False,
            )  # fmt: skip
        answered = self.session.ask(self.asked, 0.015 if patient else 0.0)
        if answered is not None:
            self._check(answered)
            self.asked = None  # a brain that has its answer asks about something new

    def _check(self, answered: Reply) -> None:
        told = answered.observation
        assert told is not None
        assert not self.carried_out or told.number > self.carried_out[-1], "twice, or out of order"
        self.carried_out.append(told.number)
        if not isinstance(answered.answer, ResetAnswer):
            values: Any = answered.answer
            assert values == {"log": (float(told.number),)}, "to another percept"
            assert not told.done

    def _percept(self, back: int) -> native.Percept | None:
        percepts = [each for each in self.heard if isinstance(each, native.Percept)]
        return percepts[-1 - back] if back < len(percepts) else None

    @rule(back=st.integers(0, 3), reset=st.booleans())
    def script_answers(self, back: int, reset: bool) -> None:
        percept = self._percept(back)
        if percept is None:
            return
        seq = percept.seq
        message = (
            native.Reset(seq, None)
            if reset
            else native.Action(percept.episode, percept.step, seq, {"log": (float(seq),)})
        )
        self.sent.append(message)
        self.session.hear(message)

    @rule(back=st.integers(0, 5))
    def a_frame_comes_again(self, back: int) -> None:
        if back < len(self.sent):
            self.session.hear(self.sent[-1 - back])

    @rule(seq=st.integers(0, 2**53), step=st.integers(0, 9))
    def a_frame_of_nowhere(self, seq: int, step: int) -> None:
        if seq > self.number:
            before = self.session.ignored
            self.session.hear(native.Action(1, step, seq, {"log": (math.nan,)}))
            assert self.session.ignored == before + 1

    def teardown(self) -> None:
        self.loop.close()


EXAMPLES = settings(max_examples=60, stateful_step_count=40, deadline=None, derandomize=True)


TestAI4USession = AI4USession.TestCase
TestAI4USession.settings = EXAMPLES
TestNativeSession = NativeSession.TestCase
TestNativeSession.settings = EXAMPLES
