"""Ghosts: the bodies of recorded episodes, beside those of the running world, to race against."""

import threading
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.recording.episode import Episode
from ai4u_edu.recording.replay import Replay
from ai4u_edu.snapshot import Snapshot, StaticScene


@dataclass(frozen=True, eq=False)
class Ghost:
    """Poses of b bodies at n times."""

    names: tuple[str, ...]
    """(b,) names of the bodies at the beginning."""
    times: npt.NDArray[np.float32]
    """(n,) world time (s) since the reset, increasing."""
    poses: npt.NDArray[np.float32]
    """(n, b, 4) x, y, z (m) and heading (rad); NaN for a body that is out of the world."""

    def at(self, time: float) -> dict[str, tuple[float, float, float, float]]:
        """Return the poses at a time (s), by name, of the bodies that were in the world."""
        index = int(np.searchsorted(self.times, time, side="right")) - 1
        row = self.poses[max(index, 0)]
        return {
            name: (float(pose[0]), float(pose[1]), float(pose[2]), float(pose[3]))
            for name, pose in zip(self.names, row, strict=True)
            if np.isfinite(pose).all()
        }


def ghost_of(episode: Episode | Replay, *, every: int = 2) -> Ghost:
    """Replay an episode, as far as it is exact, and return its poses.

    Args:
        episode: the episode, or its replay.
        every: ticks between two poses.
    """
    replay = episode if isinstance(episode, Replay) else Replay(episode)
    names = [body.name for body in replay.episode.scene.bodies]
    rank = {name: index for index, name in enumerate(names)}
    times, rows = [], []
    for snapshot in replay.snapshots(every):
        row = np.full((len(names), 4), np.nan, np.float32)
        for state in snapshot.bodies:
            if not state.fallen and state.name in rank:
                row[rank[state.name]] = state.x, state.y, state.z, state.heading
        times.append(snapshot.time)
        rows.append(row)
    return Ghost(tuple(names), np.array(times, np.float32), np.stack(rows))


class GhostDrive:
    """One recorded episode to race against; a background thread computes its path.

    Args:
        episode: the recorded episode.
        name: the episode's name.
        label: text at the ghost.
        place: index among several ghosts, which differ by it; None for a single one.
        stretch: factor of its time: with 2 it drives at half its speed.
    """

    def __init__(
        self,
        episode: Episode,
        name: str,
        label: str = _("ghost"),
        place: int | None = None,
        *,
        stretch: float = 1.0,
    ) -> None:
        self.episode, self.name, self.label, self.place = episode, name, label, place
        self.stretch = stretch
        self.problem = ""
        """The reason why it can't be shown; else empty."""
        self.path: Ghost | None = None
        """The poses by time; None until they are computed."""
        threading.Thread(target=self._compute, name="ghost", daemon=True).start()

    def warning(self, snapshot: Snapshot) -> str:
        """Return what makes a race against it unfair; empty if it is fair."""
        if self.is_of_other_scene(snapshot.static_scene):
            return _("It ran in another scene.")
        if snapshot.seed != self.episode.seed:
            return _(
                "It began otherwise: with seed {seed}. Race against it again.",
                seed=self.episode.seed,
            )
        return ""

    def is_of_other_scene(self, static_scene: StaticScene) -> bool:
        """Return True if the episode has other bodies or floors; positions may be random."""
        scene = self.episode.scene
        recorded = {(body.name, body.kind, body.shape) for body in scene.bodies}
        current = {(body.name, body.kind, body.shape) for body in static_scene.bodies}
        return recorded != current or len(scene.floors) != len(static_scene.floors)

    def _compute(self) -> None:
        try:
            self.path = ghost_of(self.episode)
        except AI4UError as error:
            self.problem = text_of(error)


class Ghosts:
    """The ghosts of one or more episodes. They are not bodies: nothing senses or touches them.

    Any thread may call its methods; whoever draws the ghosts reads :attr:`drives`, which is
    replaced, never changed.
    """

    def __init__(self) -> None:
        self.drives: tuple[GhostDrive, ...] = ()
        """The ghosts that are shown, or will be as soon as their paths are computed."""

    def race(
        self,
        episode: Episode | None,
        name: str = "",
        label: str = _("ghost"),
        *,
        stretch: float = 1.0,
    ) -> None:
        """Show an episode's ghost in place of all others.

        Args:
            episode: the recorded episode; None removes all ghosts.
            name: the episode's name.
            label: text at the ghost.
            stretch: factor of its time.
        """
        if episode is None:
            self.drives = ()
        else:
            self.drives = (GhostDrive(episode, name, label, stretch=stretch),)

    def race_all(self, drives: Sequence[tuple[Episode, str]]) -> None:
        """Show the ghosts of several episodes in place of all others, each under its name.

        Args:
            drives: recorded episodes with the names of who drove.
        """
        self.drives = tuple(
            GhostDrive(episode, name, name, place) for place, (episode, name) in enumerate(drives)
        )

    @property
    def name(self) -> str:
        """Names of the episodes; empty if there is no ghost."""
        return join([drive.name for drive in self.drives if not drive.problem], ", ")

    def text(self, snapshot: Snapshot) -> str:
        """Return the ghosts' names and any problem; empty if there is no ghost."""
        if not self.drives:
            return ""
        shown = [drive for drive in self.drives if not drive.problem]
        if not shown:
            return _("No ghost: {problem}", problem=self.drives[0].problem)
        is_one = len(shown) == 1
        text = (
            _("Ghost: {name}", name=self.name) if is_one else _("Ghosts: {names}", names=self.name)
        )
        warning = shown[0].warning(snapshot)
        return join([text, warning], ". ") if warning else text
