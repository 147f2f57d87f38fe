"""Where everything was in a recorded run, by time: a ghost to play against."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ai4u_edu.recording.episode import Episode
from ai4u_edu.recording.replay import Replay


@dataclass(frozen=True, eq=False)
class Ghost:
    """The poses of a run, n times of b bodies."""

    names: tuple[str, ...]
    """(b,) the bodies that were there at the beginning."""
    times: npt.NDArray[np.float32]
    """(n,) seconds since the reset, growing."""
    poses: npt.NDArray[np.float32]
    """(n, b, 4) x, y, z in metres and the heading in radians; nan for who is out of the world."""

    def at(self, time: float) -> dict[str, tuple[float, float, float, float]]:
        """The pose of each body that was in the world at a time; afterwards, as at the end."""
        index = int(np.searchsorted(self.times, time, side="right")) - 1
        row = self.poses[max(index, 0)]
        return {
            name: (float(pose[0]), float(pose[1]), float(pose[2]), float(pose[3]))
            for name, pose in zip(self.names, row, strict=True)
            if np.isfinite(pose).all()
        }


def ghost_of(episode: Episode | Replay, *, every: int = 2) -> Ghost:
    """The poses of an episode, as far as it can be played again exactly.

    Args:
        episode: which.
        every: ticks between two of them.
    """
    replay = episode if isinstance(episode, Replay) else Replay(episode)
    names = [body.name for body in replay.episode.scene.bodies]
    rank = {name: index for index, name in enumerate(names)}
    times, rows = [], []
    for picture in replay.snapshots(every):
        row = np.full((len(names), 4), np.nan, np.float32)
        for state in picture.bodies:
            if not state.fallen and state.name in rank:
                row[rank[state.name]] = state.x, state.y, state.z, state.heading
        times.append(picture.time)
        rows.append(row)
    return Ghost(tuple(names), np.array(times, np.float32), np.stack(rows))
