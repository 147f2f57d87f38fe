"""Poses of a recorded episode by time, to show a ghost to race against."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ai4u_edu.recording.episode import Episode
from ai4u_edu.recording.replay import Replay


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
