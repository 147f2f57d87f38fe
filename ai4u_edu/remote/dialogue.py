"""A script's side of the dialogue with a world; opens no connection and waits for nothing itself.

Its methods are generators of :mod:`~ai4u_edu.remote.steps`. Whoever waits in vain says again what
it said last, and a lost connection is taken up again within the grace time.
"""

import time
from collections.abc import Iterable, Sequence
from contextlib import suppress
from secrets import token_urlsafe
from typing import Any, Literal, NoReturn, SupportsIndex, cast

from msgspec.structs import replace

from ai4u_edu.base.errors import ActionError
from ai4u_edu.base.seeding import checked_seed
from ai4u_edu.remote.errors import LostError, RefusedError, RemoteError
from ai4u_edu.remote.outputs import numbers_of
from ai4u_edu.remote.percept import RemotePercept
from ai4u_edu.remote.steps import Close, ConnectionLostError, Flow, Open, Pause, Receive, Send
from ai4u_edu.wire import native
from ai4u_edu.wire.validation import WireError

FIRST_WAIT = 0.2
"""Seconds after which something is said again for the first time; then twice as many each time."""
LONGEST_WAIT = 1.0
"""Seconds."""
ATTEMPT = 3.0
"""Seconds that opening a connection and saying hello may take; then another one is opened."""


def _checked(hello: native.Hello) -> native.Hello:
    """Return a hello that a world can read."""
    try:
        said = native.decode(native.encode(hello))
    except WireError as error:
        raise RemoteError(f"connect: {error}") from None
    except (TypeError, ValueError, OverflowError) as error:  # nothing that msgpack knows
        raise RemoteError(f"connect: expected text and names of keys, got {error}") from None
    return cast(native.Hello, said)


_CODES = {number: name for name, number in native.PROBLEMS.items()}


class Dialogue:
    """What was said last, by both sides.

    Args:
        agent: the id of the agent; empty for a world's only one.
        token: the world's, where it asks for one.
        mode: lockstep: the world waits for each action; realtime: it never waits.
        keys: the readings that are wanted; none named: all.
        session: what :attr:`session` of another dialogue was, to take its place.
        patience: seconds until the first welcome has to be there.
        on_missing: what the agent does in place of an action that is missing.

    Raises:
        RemoteError: one of them can't be said to a world.
    """

    def __init__(
        self,
        agent: str,
        *,
        token: str = "",
        mode: native.Mode = "realtime",
        keys: Sequence[str] = (),
        session: str = "",
        patience: float = 10.0,
        on_missing: native.OnMissing = "",
    ) -> None:
        name, _, secret = session.partition(":") if type(session) is str else (session, "", "")
        wanted: Any = (keys,) if isinstance(keys, str) else keys  # one key is one
        self._hello = _checked(
            native.Hello(
                native.VERSION,
                agent,
                token,
                mode,
                tuple(wanted) if isinstance(wanted, Iterable) else wanted,
                name,
                secret or token_urlsafe(16),
                on_missing,
            )
        )
        if not patience >= 0:
            raise RemoteError(f"patience: expected a number of seconds from 0 on, got {patience}")
        self._patience = patience
        self._welcome: native.Welcome | None = None
        self._said = self._greeting = b""
        self._answered = True
        self._refusable = -1
        self._ended: RemoteError | None = None
        self.percept: RemotePercept | None = None
        """The latest."""
        self.readings: dict[str, native.Reading] = {}
        self.outputs: dict[str, native.Output] = {}

    @property
    def welcome(self) -> native.Welcome:
        """What the world said of the agent."""
        if self._welcome is None:
            raise self._ended or RemoteError("there is no connection yet; expected connect(...)")
        return self._welcome

    @property
    def session(self) -> str:
        """What another dialogue needs to take this one's place; keep it secret."""
        return f"{self.welcome.session}:{self._hello.secret}"

    def expect_answer_to(self, percept: RemotePercept) -> None:
        """Raises a RemoteError if a percept is the latest and has no answer yet."""
        if self.percept is percept and not self._answered:
            example = ", ".join(
                f"{name}={[0] * len(output.low)}" for name, output in self.outputs.items()
            )
            raise RemoteError(
                f"expected robot.act(...) in the loop, such as robot.act({example}); "
                "robot.act() lets one decision pass"
            )

    # -- the verbs -------------------------------------------------------------------------------

    def begin(self) -> Flow[None]:
        """Opens a connection and gets the agent."""
        lost = yield from self._insist(time.monotonic() + self._patience, first=True)
        if lost is not None:
            yield Close()
            raise LostError(
                f"expected a world, got {lost}; is it running, and is the address right?"
            )

    def sense(self) -> Flow[RemotePercept]:
        """The percept that has no answer yet, as soon as it is there."""
        wait = FIRST_WAIT
        while (percept := self.percept) is None or self._answered:
            self._check_open()
            try:
                frame = yield Receive(wait)
                if frame is None:
                    wait = min(2 * wait, LONGEST_WAIT)
                    yield Send(self._said)
                else:
                    self._hear(frame)
            except ConnectionLostError as lost:
                yield from self._take_up_again(lost)
                wait = FIRST_WAIT
        return percept

    def act(self, action: Any) -> Flow[None]:
        """Answers the latest percept; after an answer, the next one."""
        percept = yield from self.sense()
        if percept.done:
            how = "terminated" if percept.terminated else "truncated"
            raise ActionError(f"the episode is over ({how}); reset() begins another")
        values = numbers_of(self.outputs, action)
        yield from self._answer(native.Action(percept.episode, percept.step, percept.seq, values))

    def reset(self, seed: SupportsIndex | None = None) -> Flow[RemotePercept]:
        """Begins an episode, and waits for its first percept."""
        number = None if seed is None else checked_seed(seed)
        before = yield from self.sense()
        yield from self._answer(native.Reset(before.seq, number))
        percept = yield from self.sense()
        while percept.episode == before.episode:
            # the world had to leave the wish undone: it has stood still because of an error
            yield from self._answer(native.Reset(percept.seq, number))
            percept = yield from self.sense()
        return percept

    def order(self, word: Literal["pause", "resume", "stop"]) -> Flow[None]:
        """Answers the latest percept with something other than an action."""
        percept = yield from self.sense()
        yield from self._answer(native.Order(percept.seq, word))

    def wait(self) -> Flow[None]:
        """Asks for more time, if there is a percept that has no answer yet."""
        if self.percept is None or self._answered:
            return
        try:
            yield Send(native.encode(native.Order(self.percept.seq, "wait")))
        except ConnectionLostError as lost:
            yield from self._take_up_again(lost)

    def end(self, reason: str = "the script has ended") -> Flow[None]:
        """Says goodbye: the seat is free."""
        if self._ended is None:
            self._ended = LostError("the robot was closed; expected connect(...) again")
            with suppress(ConnectionLostError):
                yield Send(native.encode(native.Bye(reason)))
            yield Close()

    # -- what they are made of -------------------------------------------------------------------

    def _answer(self, message: native.Answer) -> Flow[None]:
        self._said, self._answered, self._refusable = native.encode(message), True, message.seq
        try:
            yield Send(self._said)
        except ConnectionLostError as lost:
            yield from self._take_up_again(lost)

    def _greet(self, deadline: float) -> Flow[None]:
        """Opens a connection and says hello, until there is a welcome."""
        yield Open(max(deadline - time.monotonic(), 0.1))
        hello = native.encode(self._hello)
        wait = FIRST_WAIT
        while time.monotonic() < deadline:
            yield Send(hello)
            if self._said == self._greeting:  # nothing else was said yet
                self._said = hello
            self._greeting = hello
            until = time.monotonic() + wait
            wait = min(2 * wait, LONGEST_WAIT)
            while (left := until - time.monotonic()) > 0:
                frame = yield Receive(left)
                if frame is not None and self._hear_welcome(frame):
                    return
        raise ConnectionLostError("no answer")

    def _take_up_again(self, lost: ConnectionLostError) -> Flow[None]:
        self._check_open()
        self._refuse_by_close(lost)
        final = yield from self._insist(time.monotonic() + self.welcome.grace)
        if final is not None:
            self._ended = LostError(
                f"the connection is lost ({final}), and could not be taken up again within "
                f"{self.welcome.grace:g} s; expected connect(...) again"
            )
            yield Close()
            raise self._ended from None

    def _insist(self, deadline: float, *, first: bool = False) -> Flow[ConnectionLostError | None]:
        """Opens a connection and says what has to be said, again and again; what failed last."""
        pause, lost = 0.02, ConnectionLostError("no answer")
        while time.monotonic() < deadline:
            try:
                yield from self._greet(min(deadline, time.monotonic() + ATTEMPT))
                if self._answered and not first:
                    yield Send(self._said)
            except ConnectionLostError as failed:
                self._refuse_by_close(failed)
                lost = failed
                if first and lost.is_permanent:
                    break
            else:
                return None
            yield Pause(pause)
            pause = min(2 * pause, 0.5)
        return lost

    def _hear_welcome(self, frame: bytes) -> bool:
        message = native.decode(frame, native.MAX_WORLD_FRAME_BYTES)
        if isinstance(message, native.Problem):
            if message.code == "bad_message" and self._hello.on_missing:
                text = f"{message.text}; if the world is an older one, leave out on_missing"
                message = native.Problem(message.code, text, message.seq)
            self._refuse(message)
        if not isinstance(message, native.Welcome):
            return False
        self._welcome = message
        self._hello = replace(self._hello, session=message.session)
        self.readings = {reading.key: reading for reading in message.readings}
        self.outputs = {output.name: output for output in message.outputs}
        return True

    def _hear(self, frame: bytes) -> None:
        message = native.decode(frame, native.MAX_WORLD_FRAME_BYTES)
        latest = self.percept.seq if self.percept else 0
        match message:
            case native.Percept(seq=seq) if seq > latest:
                self.percept = RemotePercept(self.readings, message)
                self._answered = False
            case native.Problem(code=code) if code in native.PROBLEMS:
                self._refuse(message)
            case native.Problem(seq=0):
                self._answered = self.percept is None  # what was said is no answer
                raise RemoteError(message.text, message.code)
            case native.Problem(code=code, seq=seq) if seq == self._refusable:
                self._refusable = -1  # it may come twice
                self._answered = self._answered and seq != latest
                if code == "seed_refused":
                    raise RefusedError(message.text, code)
                raise ActionError(message.text)
            case native.Bye(reason):
                self._end_by(LostError(f"the world has ended the session: {reason}"))

    def _check_open(self) -> None:
        if self._ended is not None:
            raise self._ended

    def _refuse(self, problem: native.Problem) -> NoReturn:
        kind = LostError if self._welcome else RefusedError
        self._end_by(kind(problem.text, problem.code))

    def _refuse_by_close(self, lost: ConnectionLostError) -> None:
        """Raises if the world closed on purpose; the frame that said why may have got lost."""
        if lost.code in _CODES:
            self._refuse(native.Problem(_CODES[lost.code], str(lost), 0))

    def _end_by(self, error: RemoteError) -> NoReturn:
        self._ended = error
        raise error from None
