"""``film``: an episode as an animation in the notebook, without a server."""

from collections import deque
from contextlib import suppress
from typing import Any

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.lessons.exercise import Exercise, NotYet
from ai4u_edu.lessons.notebook_output import image, put, tell
from ai4u_edu.lessons.pictures import FRAMES_PER_S, MAX_ANIMATION_S, animation, moving
from ai4u_edu.lessons.rollouts import DEFAULT_MAX_DECISIONS, Drive, drives, observed
from ai4u_edu.lessons.student_errors import mistake_in
from ai4u_edu.lessons.time_limit import TimeLimit, TimeLimitError
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate
from ai4u_edu.recording import Episode
from ai4u_edu.scenes import Scene
from ai4u_edu.snapshot import Snapshot, capture_snapshot


def film(
    world: "ControlRequestor | Scene | Episode | str",
    brain: Any = None,
    *,
    seed: int = 0,
    limit: int = DEFAULT_MAX_DECISIONS,
) -> None:
    """Run one episode at full speed, and show its end as an animation.

    Args:
        world: a scene or its name, a world with its agents; or an episode that was recorded.
        brain: the first agent's driver; default: its own.
        seed: seed of the episode.
        limit: decisions after which it is truncated.
    """
    if isinstance(world, Episode):
        words = _("An episode of {seconds:.1f} s.", seconds=world.seconds)
        put(image(animation(world), _("the episode")), translate(words))
        return
    frames = _Frames()
    source = (lambda: world) if isinstance(world, ControlRequestor) else world
    with TimeLimit() as time_limit:
        try:
            (drive,) = drives(source, brain, [seed], limit=limit, watch=frames.add)
        except (TimeLimitError, SystemExit) as error:
            mistake = mistake_in(error)
            text = mistake.text if mistake and not time_limit.text else time_limit.text
            tell("vermillion", _("Stopped."), [text])
            return
    _put_film(drive, frames)


class _FilmedError(BaseException):
    """Raised to end a check whose first episode was filmed."""


def film_check(exercise: Exercise, *things: Any) -> bool:
    """Show the first episode of an exercise's check as an animation; nothing is saved.

    Args:
        exercise: the exercise.
        things: what a student made.

    Returns:
        False if the check runs no episode.

    Raises:
        TimeLimitError: the student's code took too long.
    """
    frames = _Frames()

    def watch(drive: Drive) -> None:
        if frames.drive is not None and frames.drive is not drive:
            raise _FilmedError
        frames.add(drive)

    with observed(watch), suppress(NotYet, _FilmedError):
        exercise.judge(*things)
    if frames.drive is None:
        return False
    _put_film(frames.drive, frames)
    return True


class _Frames:
    """Pictures of an episode, at the rate of an animation."""

    def __init__(self) -> None:
        self.shown: deque[Snapshot] = deque(maxlen=FRAMES_PER_S * MAX_ANIMATION_S)
        self.drive: Drive | None = None
        self.end = ""
        """End of the episode; kept at once, since the next one resets the agent."""
        self._due = 0.0

    def add(self, drive: Drive) -> None:
        """Take a picture if one is due."""
        self.drive = drive
        if drive.sim.world.time >= self._due or drive.agent.done:
            self.shown.append(capture_snapshot(drive.sim))
            self._due = drive.sim.world.time + 0.99 / FRAMES_PER_S
        if drive.agent.done:
            self.end = _end_of(drive)


def _end_of(drive: Drive) -> str:
    ends = (
        (drive.won, _("the robot reached its goal")),
        (drive.fell, _("the robot fell")),
        (drive.agent.done, _("the episode was over")),
        (True, _("the film stops")),
    )
    return next(words for happened, words in ends if happened)


def _put_film(drive: Drive, frames: _Frames) -> None:
    how = frames.end or _end_of(drive)
    text = _(
        "Seed {seed}: after {steps} decisions {how}.", seed=drive.seed, steps=drive.steps, how=how
    )
    words = translate(text)
    put(f"<p>{words}</p>{image(moving(frames.shown), _('the episode'))}", words)
