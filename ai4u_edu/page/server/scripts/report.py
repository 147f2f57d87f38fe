"""Lines on the scripts of a world, for whoever runs it."""

import time
from collections.abc import Callable
from contextlib import suppress
from queue import Empty, Full, Queue
from threading import Event, Lock, Thread
from typing import Protocol, Self

from ai4u_edu.base.errors import shorten
from ai4u_edu.base.log_limit import LogLimiter
from ai4u_edu.blocks.brains.remote import RemoteBrain
from ai4u_edu.blocks.brains.remote_status import RemoteStatus
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join, translate
from ai4u_edu.page.server.limits.rate_limit import RateLimit
from ai4u_edu.runtime.runner import Runner

EVENTS_PER_S = 5.0
"""Rate limit of the lines on scripts that join, are lost, come back or leave."""
POLL_S = 0.25
"""Interval at which the state of AI4U's scripts is looked at."""
MAX_LINE_CHARS = 300
MAX_WAITING_LINES = 100
"""Lines that wait for a blocked terminal; further ones are left out."""
STOP_TIMEOUT_S = 1.0
"""Time that the last lines may take to be written."""


class ScriptLog(Protocol):
    """A log of what happens with scripts; thread-safe, and never blocks."""

    def note_event(self, text: str) -> None:
        """Report that a script joined, was lost, came back or left."""

    def note_mistake(self, kind: str, text: str) -> None:
        """Report what a script did in vain.

        Args:
            kind: of the mistake; lines of one kind are limited.
            text: the line.
        """


class NoReport:
    """Reports nothing."""

    def note_event(self, text: str) -> None:
        """Do nothing."""

    def note_mistake(self, kind: str, text: str) -> None:
        """Do nothing."""


class ScriptReport:
    """Writes a line when a script joins, is lost, comes back, leaves, is refused or fails to act.

    A thread of its own writes, since a terminal may block whoever writes to it, and looks at AI4U's
    scripts, which the world itself looks for: their brain knows how it stands with them. So nobody
    can fill a terminal, events are limited by number, and mistakes by their kind.

    Args:
        runner: of the world.
        tell: called with each line, in the thread.
        clock: seconds; to be replaced in tests.
    """

    def __init__(
        self,
        runner: Runner,
        tell: Callable[[str], object],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._runner, self._tell = runner, tell
        self._lines: Queue[str] = Queue(MAX_WAITING_LINES)
        self._is_over = Event()
        self._events = RateLimit(EVENTS_PER_S, clock=clock)
        self._lock = Lock()
        """Guards the limit of events: the server's event loop and the thread report some."""
        self._mistakes = LogLimiter(clock=clock)
        self._seen: dict[str, RemoteStatus] = {}
        """Status of AI4U's scripts at the last look, by the agent's id."""
        self._thread = Thread(target=self._run, name="script-report", daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._is_over.set()
        self._thread.join(STOP_TIMEOUT_S)

    def note_event(self, text: str) -> None:
        """Write a line, unless there are too many."""
        with self._lock:
            has_token = self._events.take_within() is not None
        if has_token:
            self._put(_plain(translate(text)))

    def note_mistake(self, kind: str, text: str) -> None:
        """Write a line, and only a count of further ones of its kind for some time."""
        left_out = self._mistakes.admit(kind)
        if left_out is not None:
            more = (
                _("({left_out} more since the last such line)", left_out=left_out)
                if left_out
                else ""
            )
            self._put(_plain(translate(join([text, more]) if more else text)))

    def _put(self, line: str) -> None:
        # lose a line rather than block the caller, which may be the server's event loop
        with suppress(Full):
            self._lines.put_nowait(line)

    def _run(self) -> None:
        look_at = 0.0
        # after the end, lines that wait are still written
        while not (self._is_over.is_set() and self._lines.empty()):
            # lines go first: a flood of them delays the look at AI4U's scripts
            try:
                line = self._lines.get(timeout=max(0.0, look_at - time.monotonic()))
            except Empty:
                self._look()
                look_at = time.monotonic() + POLL_S
            else:
                self._tell(line)

    def _look(self) -> None:
        """Report what has changed with AI4U's scripts."""
        now: dict[str, RemoteStatus] = {}
        for agent in self._runner.sim.agents:
            brain = agent.brain
            if isinstance(brain, RemoteBrain) and not brain.has_own_link:
                now[agent.id] = brain.status()
                self._compare(agent.id, self._seen.get(agent.id), now[agent.id])
        self._seen = now

    def _compare(self, agent_id: str, before: RemoteStatus | None, now: RemoteStatus) -> None:
        was, is_now = before.state if before else "waiting", now.state
        is_here = is_now in ("connected", "late")
        script = _("the AI4U script of agent {agent_id!r}", agent_id=agent_id)
        if is_here and was == "waiting":
            self.note_event(_("an AI4U script drives agent {agent_id!r}", agent_id=agent_id))
        elif is_here and was == "lost":
            self.note_event(_("{script} is back", script=script))
        elif is_now == "lost" != was:
            self.note_event(_("{script} is lost: {reason}", script=script, reason=now.reason))
        elif is_now == "waiting" != was and now.reason:  # without one the world itself has ended
            self.note_event(_("{script} has left: {reason}", script=script, reason=now.reason))
        if now.warnings > (before.warnings if before else 0):
            self.note_mistake(
                agent_id,
                _(
                    "{script} sent what has no effect: {warning}",
                    script=script,
                    warning=now.warning,
                ),
            )


def _plain(text: str) -> str:
    """Return a text of a script without characters that command a terminal."""
    return shorten("".join(each if each.isprintable() else "?" for each in text), MAX_LINE_CHARS)
