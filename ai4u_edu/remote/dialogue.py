"""A script's side of the dialogue with a world, without input and output.

Its methods are generators of :mod:`~ai4u_edu.remote.steps`, which a connection carries out. If no
answer arrives in time, the dialogue repeats its last frame; if the connection is lost, it
reconnects. It resumes its session, or begins another one if the world has none of it any more,
since it was restarted or the script was away for too long. Then the episode ends, truncated.
"""

import math
import time
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from secrets import token_urlsafe
from typing import Any, Literal, NoReturn, SupportsIndex, cast

from msgspec.structs import replace

from ai4u_edu.base.errors import ActionError, shown, suggest, text_of
from ai4u_edu.base.seeding import checked_seed
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import ngettext
from ai4u_edu.remote.errors import LostError, RefusedError, RemoteError
from ai4u_edu.remote.percept import RemotePercept
from ai4u_edu.remote.steps import (
    Close,
    ConnectionLostError,
    Delay,
    Flow,
    Note,
    Open,
    Receive,
    Send,
)
from ai4u_edu.wire import native
from ai4u_edu.wire.validation import WireError

FIRST_TIMEOUT_S = 0.2
"""Time after which a frame is repeated for the first time; it doubles with each repetition."""
MAX_TIMEOUT_S = 1.0
"""Longest time between two repetitions."""
ATTEMPT_TIMEOUT_S = 3.0
"""Timeout of one attempt to connect, hello and welcome included."""
FIRST_BACKOFF_S = 0.02
"""Pause after the first failed attempt to connect; it doubles with each failure."""
MAX_BACKOFF_S = 0.5
"""Longest pause between two attempts."""
MIN_OPEN_TIMEOUT_S = 0.1
"""Time that opening a connection gets even if the deadline is nearer."""


class _WaitError(ConnectionLostError):
    """The world refuses the script for now: another one has the agent.

    Attributes:
        problem: the world's.
    """

    def __init__(self, problem: native.Problem) -> None:
        super().__init__(problem.text)
        self.problem = problem


def _checked(hello: native.Hello) -> native.Hello:
    """Return the hello as a world will decode it.

    Raises:
        RemoteError: it can't be encoded, or breaks a limit.
    """
    try:
        said = native.decode(native.encode(hello))
    except WireError as error:
        raise RemoteError(_("connect: {problem}", problem=text_of(error))) from None
    except (TypeError, ValueError, OverflowError) as error:  # nothing that msgpack knows
        raise RemoteError(
            _("connect: expected text and names of keys, got {problem}", problem=str(error))
        ) from None
    return cast(native.Hello, said)


_PROBLEM_NAMES = {number: name for name, number in native.PROBLEMS.items()}
"""Names of problems by the code of the WebSocket's close."""


class Dialogue:
    """The state of a session: the latest percept, and the last frame that was sent.

    Args:
        agent: the id of the agent; empty for the only agent of a world.
        token: the world's, if it has one.
        mode: lockstep: the world waits for each action; realtime: it never waits.
        keys: keys of the readings to get; empty for all.
        session: :attr:`session` of another dialogue, to resume it.
        patience: seconds to wait for a world that is not there, at first or again, and for an agent
            that another script has. One attempt is always made.
        on_missing: substitute for an action that is missing.

    Raises:
        RemoteError: one of the arguments can't be sent to a world.
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
        name, _colon, secret = session.partition(":") if type(session) is str else (session, "", "")
        wanted: Any = (keys,) if isinstance(keys, str) else keys
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
            raise RemoteError(
                _(
                    "patience: expected a number of seconds from 0 on, got {patience}",
                    patience=patience,
                )
            )
        self._patience = patience
        self._welcome: native.Welcome | None = None
        self._last_frame = b""
        """The frame that is repeated if no answer arrives."""
        self._last_hello = b""
        self._is_answered = True
        """The latest percept has an answer."""
        self._refusable_seq = -1
        """Number of the percept whose answer the world may still refuse."""
        self._copies = 0
        """Times that the answer to the latest percept was sent."""
        self._refusal: native.Problem | None = None
        """The latest problem that was raised."""
        self._stale_refusals = 0
        """Times that this problem may still arrive, for the other copies of that answer."""
        self._latest_seq = 0
        """Number of the latest percept in this session; 0 before the first."""
        self._interrupted: RemotePercept | None = None
        """The latest percept of a session that the world has not any more; the next one is the
        truncated end of its episode."""
        self._ended: RemoteError | None = None
        """The error that ended the session; every method raises it from then on."""
        self._told: dict[str, tuple[str, ...]] = {}
        """Fields that go with each answer, by name."""
        self._unread = ""
        """The latest sentence about fields that no sensor reads."""
        self.percept: RemotePercept | None = None
        """The latest percept; None before the first."""
        self.readings: dict[str, native.Reading] = {}
        self.outputs: dict[str, native.Output] = {}

    @property
    def welcome(self) -> native.Welcome:
        """The world's description of the agent."""
        if self._welcome is None:
            raise self._ended or RemoteError(_("there is no connection yet; expected connect(...)"))
        return self._welcome

    @property
    def session(self) -> str:
        """The argument by which another dialogue can resume this session; a secret."""
        return f"{self.welcome.session}:{self._hello.secret}"

    def expect_answer_to(self, percept: RemotePercept) -> None:
        """Raise a RemoteError if this is the latest percept, and it has no answer yet."""
        if self.percept is percept and not self._is_answered:
            example = ", ".join(
                f"{name}={[0] * len(output.low)}"
                for name, output in self.outputs.items()
                if output.is_output
            )
            raise RemoteError(
                _(
                    "expected robot.act(...) in the loop, such as robot.act({example}); "
                    "robot.act() lets one decision pass",
                    example=example,
                )
            )

    # -- what a script can do --------------------------------------------------------------------

    def begin(self) -> Flow[None]:
        """Connect, and get the agent."""
        lost = yield from self._connect(self._patience)
        if lost is not None:
            yield Close()
            raise LostError(
                _(
                    "expected a world, got {lost}; is it running, and is the address right?",
                    lost=str(lost),
                )
            )

    def sense(self) -> Flow[RemotePercept]:
        """Return the percept that has no answer yet, as soon as it is there."""
        timeout = FIRST_TIMEOUT_S
        while (percept := self.percept) is None or self._is_answered:
            self._check_open()
            try:
                frame = yield Receive(timeout)
                if frame is None:
                    timeout = min(2 * timeout, MAX_TIMEOUT_S)
                    yield self._repeat()
                else:
                    self._handle(frame)
            except ConnectionLostError as lost:
                yield from self._reconnect(lost)
                timeout = FIRST_TIMEOUT_S
        return percept

    def tell(self, fields: Mapping[str, Any]) -> Flow[None]:
        """Let fields go with each answer from the next one on; None takes one back.

        Raises:
            RemoteError: a field is neither numbers nor text, or they are too many or too long.
        """
        told = dict(self._told)
        for name, value in fields.items():
            told.pop(name, None)
            if value is not None:
                told[name] = _texts_of(name, value)
        try:
            native.decode(native.encode(native.Reset(0, None, told)))
        except WireError as error:
            raise RemoteError(_("tell: {problem}", problem=text_of(error))) from None
        self._told = told
        unread = native.without_reader(told, self.welcome.fields)
        if unread and unread != self._unread:
            yield Note(unread)
        self._unread = unread

    def act(self, action: Any) -> Flow[None]:
        """Answer the latest percept with an action; if it has an answer, wait for the next one."""
        percept = yield from self.sense()
        if percept.done:
            how = "terminated" if percept.terminated else "truncated"
            raise ActionError(_("the episode is over ({how}); reset() begins another", how=how))
        values = _numbers_of(self.outputs, action)
        action = native.Action(
            percept.episode, percept.step, percept.seq, values, self._told or None
        )
        yield from self._answer(action)

    def reset(self, seed: SupportsIndex | None = None) -> Flow[RemotePercept]:
        """Begin an episode, and return its first percept."""
        number = None if seed is None else checked_seed(seed)
        before = yield from self.sense()
        yield from self._answer(native.Reset(before.seq, number, self._told or None))
        percept = yield from self.sense()
        while percept.episode == before.episode:
            # the world could not reset, since an error had stopped it
            yield from self._answer(native.Reset(percept.seq, number, self._told or None))
            percept = yield from self.sense()
        return percept

    def order(self, word: Literal["pause", "resume", "stop"]) -> Flow[None]:
        """Answer the latest percept with a command other than an action."""
        percept = yield from self.sense()
        yield from self._answer(native.Order(percept.seq, word))

    def wait(self) -> Flow[None]:
        """Ask for more time, if the latest percept has no answer yet."""
        if self.percept is None or self._is_answered:
            return
        try:
            yield Send(native.encode(native.Order(self.percept.seq, "wait")))
        except ConnectionLostError as lost:
            yield from self._reconnect(lost)

    def end(self, reason: str = _("the script has ended")) -> Flow[None]:
        """Say goodbye, which gives the agent back, and close the connection."""
        if self._ended is None:
            self._ended = LostError(_("the robot was closed; expected connect(...) again"))
            yield from self._leave(reason)

    def _leave(self, reason: str) -> Flow[None]:
        with suppress(ConnectionLostError):
            yield Send(native.encode(native.Bye(reason)))
        yield Close()

    # -- connecting ------------------------------------------------------------------------------

    def _connect(self, patience: float) -> Flow[ConnectionLostError | None]:
        """Connect, with a growing pause between two attempts; say so if that takes several.

        Args:
            patience: seconds after which no other attempt is begun.

        Returns:
            None on success, else the last error.
        """
        is_first = self._welcome is None
        deadline = time.monotonic() + patience
        backoff, noted = FIRST_BACKOFF_S, ""
        attempt_until = time.monotonic() + ATTEMPT_TIMEOUT_S
        while True:
            try:
                yield from self._attempt(attempt_until)
                if self._ended is not None:
                    yield from self._leave(_("it was written for another robot"))
                    raise self._ended
                if self._is_answered and not is_first:
                    yield self._repeat()
            except ConnectionLostError as failed:
                lost = self._waitable(failed)
            else:
                if noted:
                    yield Note(
                        _("connected: this script drives agent {agent!r}", agent=self.welcome.agent)
                    )
                return None
            left = deadline - time.monotonic()
            if left <= 0 or (is_first and lost.is_permanent):
                if isinstance(lost, _WaitError):
                    self._end_by_problem(lost.problem)
                return lost
            if text_of(lost) != noted:
                why = noted = text_of(lost)
                if not isinstance(lost, _WaitError):
                    why = _("the connection is lost ({why})", why=noted)
                    if is_first:
                        why = _("no world answers yet ({why})", why=noted)
                yield Note(_("{why}; trying again for up to {left:.0f} s", why=why, left=left))
            yield Delay(min(backoff, left))
            backoff = min(2 * backoff, MAX_BACKOFF_S)
            attempt_until = min(deadline, time.monotonic() + ATTEMPT_TIMEOUT_S)

    def _attempt(self, deadline: float) -> Flow[None]:
        """Open a connection, and send the hello until there is a welcome."""
        yield Open(max(deadline - time.monotonic(), MIN_OPEN_TIMEOUT_S))
        hello = native.encode(self._hello)
        timeout = FIRST_TIMEOUT_S
        while True:
            yield Send(hello)
            if self._last_frame == self._last_hello:  # there was no percept to answer yet
                self._last_frame = hello
            self._last_hello = hello
            repeat_at = time.monotonic() + timeout
            timeout = min(2 * timeout, MAX_TIMEOUT_S)
            while (left := repeat_at - time.monotonic()) > 0:
                frame = yield Receive(left)
                if frame is not None and self._handle_welcome(frame):
                    return
            if time.monotonic() >= deadline:
                raise ConnectionLostError(_("no answer"))

    def _reconnect(self, lost: ConnectionLostError) -> Flow[None]:
        """Resume the session over a new connection, or begin another one.

        Raises:
            LostError: that failed; the session is over.
        """
        self._check_open()
        self._waitable(lost)
        # the grace time if it is longer, since the world keeps the agent for it
        patience = max(self.welcome.grace, self._patience)
        final = yield from self._connect(patience)
        if final is not None:
            self._ended = LostError(
                _(
                    "the connection is lost ({final}), and could not be taken up again within "
                    "{patience:g} s; expected connect(...) again",
                    final=str(final),
                    patience=patience,
                )
            )
            yield Close()
            raise self._ended from None

    def _waitable(self, lost: ConnectionLostError) -> ConnectionLostError:
        """Return an error after which another attempt may succeed.

        Raises:
            RemoteError: the world closed on purpose. The frame that said why may have been lost.
        """
        name = _PROBLEM_NAMES.get(lost.code)
        if name is None:
            return lost
        try:
            self._refuse(native.Problem(name, str(lost), 0))
        except ConnectionLostError as reason:
            return reason

    # -- messages --------------------------------------------------------------------------------

    def _answer(self, message: native.Answer) -> Flow[None]:
        """Send the answer to the latest percept."""
        self._last_frame, self._is_answered = native.encode(message), True
        self._refusable_seq, self._copies = message.seq, 1
        try:
            yield Send(self._last_frame)
        except ConnectionLostError as lost:
            yield from self._reconnect(lost)

    def _repeat(self) -> Send:
        """Return the step that sends the last frame once more."""
        self._copies += 1
        return Send(self._last_frame)

    def _handle_welcome(self, frame: bytes) -> bool:
        """Handle a frame that may be the welcome; return True if it is."""
        message = native.decode(frame, native.MAX_WORLD_FRAME_BYTES)
        if isinstance(message, native.Problem):
            if message.code == "bad_message" and self._hello.on_missing:
                text = _(
                    "{text}; if the world is an older one, leave out on_missing", text=message.text
                )
                message = native.Problem(message.code, text, message.seq)
            self._refuse(message)
        if not isinstance(message, native.Welcome):
            return False
        before, self._welcome = self._welcome, message
        self._hello = replace(self._hello, session=message.session)
        if before is not None and before.session != message.session:
            self._begin_session_after(before, message)
        self.readings = {reading.key: reading for reading in message.readings}
        self.outputs = {output.name: output for output in message.outputs}
        return True

    def _begin_session_after(self, before: native.Welcome, now: native.Welcome) -> None:
        """Begin a session in place of one that the world has not any more."""
        if (before.readings, before.outputs) != (now.readings, now.outputs):
            self._ended = LostError(
                _("the robot has other sensors or actuators by now; expected connect(...) again")
            )
        self._interrupted = self.percept or self._interrupted
        self._latest_seq = 0
        self._last_frame, self._is_answered = self._last_hello, True
        self._refusable_seq, self._copies = -1, 0
        self._refusal, self._stale_refusals = None, 0

    def _handle(self, frame: bytes) -> None:
        """Handle a frame of the session; old percepts and repeated problems are ignored."""
        message = native.decode(frame, native.MAX_WORLD_FRAME_BYTES)
        latest = self._latest_seq
        match message:
            case native.Percept(seq=seq) if seq > latest:
                self.percept = RemotePercept(self.readings, message)
                if self._interrupted is not None:
                    self.percept, self._interrupted = self._interrupted.cut_off(seq), None
                self._latest_seq, self._is_answered = seq, False
            case native.Problem(code=code) if code in native.PROBLEMS:
                self._end_by_problem(message)
            case native.Problem(seq=0):
                self._is_answered = self.percept is None  # the last frame was no answer
                raise RemoteError(message.text, message.code)
            case native.Problem() if message == self._refusal and self._stale_refusals:
                # the world refuses each copy of an answer; this one is not about the present answer
                self._stale_refusals -= 1
            case native.Problem(code=code, seq=seq) if seq == self._refusable_seq:
                self._refusal, self._stale_refusals = message, self._copies - 1
                self._refusable_seq = -1
                self._is_answered = self._is_answered and seq != latest
                if code == "seed_refused":
                    raise RefusedError(message.text, code)
                raise ActionError(message.text)
            case native.Bye(reason):
                self._end(LostError(_("the world has ended the session: {reason}", reason=reason)))

    # -- the end ---------------------------------------------------------------------------------

    def _check_open(self) -> None:
        if self._ended is not None:
            raise self._ended

    def _refuse(self, problem: native.Problem) -> NoReturn:
        """Raise the error of a refusal.

        Raises:
            ConnectionLostError: another attempt may succeed.
            RemoteError: none will.
        """
        if problem.code == "agent_taken":
            raise _WaitError(problem)
        if problem.code == "session_over" and self._welcome is not None:
            self._hello = replace(self._hello, session="")
            raise ConnectionLostError(_("the world was restarted, or has given the agent back"))
        self._end_by_problem(problem)

    def _end_by_problem(self, problem: native.Problem) -> NoReturn:
        kind = LostError if self._welcome else RefusedError
        self._end(kind(problem.text, problem.code))

    def _end(self, error: RemoteError) -> NoReturn:
        self._ended = error
        raise error from None


def _texts_of(name: str, value: Any) -> tuple[str, ...]:
    """Return a field as it is sent.

    >>> _texts_of("goal", [1, 2.5]), _texts_of("colour", "red"), _texts_of("speed", 3)
    (('1.0', '2.5'), ('red',), ('3.0',))
    """
    if isinstance(value, str):
        return (value,)
    values = value if isinstance(value, Iterable) else [value]
    try:
        return tuple(each if isinstance(each, str) else repr(float(each)) for each in values)
    except (TypeError, ValueError, OverflowError):
        raise RemoteError(
            _(
                "tell: {name}: expected numbers, text or None, got {value}",
                name=name,
                value=shown(value),
            )
        ) from None


def _numbers_of(outputs: Mapping[str, native.Output], action: Any) -> dict[str, tuple[float, ...]]:
    """Return the numbers of an action by the actuator's name.

    Args:
        outputs: the actuators by name.
        action: numbers by the actuator's name; of an agent with one actuator, its numbers alone.

    Raises:
        ActionError: it names an unknown actuator, or its numbers don't fit.

    >>> move = native.Output("move", "box", (-1.0, -1.0), (1.0, 1.0), True)
    >>> _numbers_of({"move": move}, {"move": [1, 0]})
    {'move': (1.0, 0.0)}
    >>> _numbers_of({"move": move}, {"mvoe": [1, 0]})
    Traceback (most recent call last):
    ...
    ai4u_edu.base.errors.ActionError: no actuator is called 'mvoe'; did you mean 'move'?
    """
    if not isinstance(action, Mapping):
        if len(outputs) != 1:
            raise ActionError(
                _(
                    "expected numbers by the actuator's name ({outputs}), got {action}",
                    outputs=", ".join(outputs),
                    action=shown(action),
                )
            )
        action = {next(iter(outputs)): action}
    for name in action:
        if name not in outputs:
            raise ActionError(
                _(
                    "no actuator is called {name}; {hint}",
                    name=shown(name),
                    hint=suggest(str(name), outputs),
                )
            )
    return {name: _numbers(outputs[name], values) for name, values in action.items()}


def _numbers(output: native.Output, values: Any) -> tuple[float, ...]:
    try:
        if hasattr(values, "tolist"):  # numpy's
            values = values.tolist()
        if isinstance(values, int | float):
            values = (values,)
        if isinstance(values, Sequence) and not isinstance(values, str | bytes):
            numbers = tuple(map(float, values))
            if len(numbers) == len(output.low) and all(map(math.isfinite, numbers)):
                return numbers
    except (TypeError, ValueError, OverflowError):
        pass
    count = len(output.low)
    raise ActionError(
        ngettext(
            "action {name!r}: expected {n} finite number, got {values}",
            "action {name!r}: expected {n} finite numbers, got {values}",
            count,
            name=output.name,
            values=shown(values),
        )
    )
