"""Order of the wall: who needs help first, and a reason in words."""

from dataclasses import dataclass

from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import ngettext
from ai4u_edu.wire.class_link import Status

MANY_FALLS = 3
MANY_EPISODES = 8
MANY_WRONG = 3
LONG_IDLE_MINUTES = 1.0
MISTAKE_HELP = 92
"""Need for help of a seat whose program was stopped by a mistake."""


@dataclass(frozen=True)
class Signals:
    """Everything that the score of a room depends on."""

    status: Status | None = None
    """None if the room has no link."""
    error: str = ""
    is_solved: bool = False
    falls: int = 0
    """Falls in this scene."""
    episodes: int = 0
    """Episodes of this scene."""
    idle_minutes: float = 0.0
    """Time since anybody drove or edited."""
    wrong: int = 0
    """Checks in a row with the same mistake."""
    exercise: str = ""
    """Exercise of these checks."""
    lost: bool = False
    """True if its link was lost while somebody has the seat."""


def help_score(signals: Signals) -> tuple[int, str]:
    """Return how much a room needs help (0 to 100), and the reason in a sentence; empty for 0.

    The highest of these counts, as the reasons rarely add up:

    ======================================  =======================================
    the world has an error                  95
    a mistake stopped its program           92, of the class and not of the room
    the same wrong answer n >= 3 times      40 + 10 (n - 3), at most 90
    n >= 3 falls, goal not reached          30 + 8 (n - 3), at most 80
    n >= 8 episodes, goal not reached       25 + 3 (n - 8), at most 70
    idle for m >= 1 minutes, not reached    20 + 4 m, at most 60
    connection lost                         15
    ======================================  =======================================

    >>> help_score(Signals(falls=6))
    (54, 'fell 6 times')
    >>> help_score(Signals(falls=6, is_solved=True))
    (0, '')
    """
    found: list[tuple[float, str]] = [(0, "")]
    if signals.error:
        found.append((95, _("its world has an error")))
    if signals.wrong >= MANY_WRONG:
        score = min(90, 40 + 10 * (signals.wrong - MANY_WRONG))
        reason: str = ngettext(
            "the same wrong answer {n} time in {exercise}",
            "the same wrong answer {n} times in {exercise}",
            signals.wrong,
            exercise=signals.exercise,
        )
        found.append((score, reason))
    if signals.lost:
        found.append((15, _("not connected")))
    if not signals.is_solved:
        if signals.falls >= MANY_FALLS:
            score = min(80, 30 + 8 * (signals.falls - MANY_FALLS))
            found.append((score, ngettext("fell {n} time", "fell {n} times", signals.falls)))
        if signals.episodes >= MANY_EPISODES:
            score = min(70, 25 + 3 * (signals.episodes - MANY_EPISODES))
            reason = ngettext("began {n} time", "began {n} times", signals.episodes)
            found.append((score, reason))
        if signals.status == "idle" and signals.idle_minutes >= LONG_IDLE_MINUTES:
            minutes = int(signals.idle_minutes)
            reason = ngettext(
                "nobody has driven for {n} minute", "nobody has driven for {n} minutes", minutes
            )
            found.append((min(60, 20 + 4 * minutes), reason))
    highest, why = max(found, key=lambda each: each[0])
    return int(highest), why
