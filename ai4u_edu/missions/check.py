"""A check of a mission: the base of all kinds, and one that is being followed.

A check is data, with parameters. Its :meth:`Check.follow` is a generator: it yields how far it is,
in words, receives what happens, and returns when it is satisfied. It reads nothing else, so the
same events give the same result, whoever drives and wherever the world runs.
"""

from collections.abc import Generator, Sequence
from typing import Any, ClassVar

import numpy as np

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.locale import gettext as _
from ai4u_edu.missions.events import Decision, Event, distances_of
from ai4u_edu.world.shapes import Description

Follow = Generator[str, Any, None]
"""Yields how far a check is; receives events of the type that it listens to."""


class Check(Description):
    """The base of all kinds of checks."""

    listens: ClassVar[type[Event]] = Decision
    """The type of events that it follows."""
    begins_with_latest: ClassVar[bool] = False
    """True if it compares the first decision with the latest one before it."""
    counts_whole_episodes: ClassVar[bool] = False
    """True if it has to see the first decision of an episode, also of one that has begun before."""

    def follow(self) -> Follow:
        """Follow events until the check is satisfied."""
        raise NotImplementedError  # each check has its own

    def quantities(self) -> Sequence[str]:
        """Return the quantities that it reads, to be looked for in a scene."""
        return ()

    def fit(self, agent: BasicAgent) -> None:
        """Check that an agent has what it reads.

        Raises:
            SetupError: it has not; the text suggests what it has.
        """
        for what in self.quantities():
            _check_quantity(what, agent)


class Following:
    """A check that is being followed.

    Args:
        check: the check.
        latest: the latest decision before it; None if there was none.
        first: the first decision of the present episode, if the driver that counts has driven in it
            alone; None otherwise.

    >>> from ai4u_edu.missions.checks import Opens
    >>> from ai4u_edu.missions.events import SeenPage
    >>> following = Following(Opens(tab="code"))
    >>> following.see(SeenPage("drive")); following.is_done
    False
    >>> following.see(SeenPage("code")); following.is_done
    True
    """

    def __init__(
        self, check: Check, latest: Decision | None = None, first: Decision | None = None
    ) -> None:
        self.check = check
        self.is_done = False
        self._events = check.follow()
        self.words = next(self._events)
        """Words on how far it is; empty if there is nothing to say."""
        if latest is not None and check.begins_with_latest:
            self.see(latest)
        if first is not None and check.counts_whole_episodes:
            self.see(first)

    def see(self, event: Event) -> None:
        """Let the check see an event."""
        if self.is_done or not isinstance(event, self.check.listens):
            return
        try:
            self.words = self._events.send(event)
        except StopIteration:
            self.is_done, self.words = True, ""


def _check_quantity(what: str, agent: BasicAgent) -> None:
    """Raise a SetupError if an agent has no such quantity."""
    key, bracket, part = what.rstrip("]").partition("[")
    distances = distances_of(agent)
    known = ["speed", "turning", *(f"distance {side}" for side in distances), *agent.percept]
    if key not in known or (bracket and not part.isdigit()):
        raise SetupError(
            _("the robot senses no {what!r}; {hint}", what=what, hint=suggest(what, known))
        )
    if key not in agent.percept:
        return
    reading = agent.percept[key]
    size = np.asarray(reading).size
    if isinstance(reading, str | tuple) or int(part or 0) >= size or (size > 1 and not part):
        hint = (
            _("write {key}[0] to {key}[{last}]", key=key, last=size - 1)
            if size > 1
            else _("choose another sensor")
        )
        raise SetupError(
            _("{what!r} is not one number of what the robot senses; {hint}", what=what, hint=hint)
        )
