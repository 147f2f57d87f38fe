"""What of a sensor can be seen: in the world, and in the panel."""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

Groups = npt.NDArray[np.intp]
"""(rows, columns): for each cell the number of a group, counted from 1; 0 is nothing."""


class SpotPicture(NamedTuple):
    """The places at which a sensor looked last, to be drawn as dots."""

    places: npt.NDArray[np.float64]
    """(n, 3) world frame, metres."""
    lit: tuple[bool, ...]
    """Whether there was something at each."""


@dataclass(frozen=True)
class CodeLegend:
    """How a reading made of codes is seen as a picture: which group each code stands for.

    >>> legend = CodeLegend((1, 3), (0.5, 1.0), ("wall", "dirty"))
    >>> legend.groups_in(np.array([[0.5, 0.0, 1.0]])).tolist()
    [[1, 0, 2]]
    """

    shape: tuple[int, int]
    """(rows, columns) of one picture."""
    codes: tuple[float, ...]
    """As they stand in the percept."""
    groups: tuple[str, ...]
    """What each code stands for."""
    planes: int = 1
    """So many pictures make up one reading; the codes are the first."""
    nothing: float = 0.0
    """The code of nothing, or of nothing known."""

    def groups_in(self, reading: npt.ArrayLike) -> Groups:
        """What is where; of stacked readings, in the latest one."""
        planes = np.asarray(reading).reshape(-1, *self.shape)
        known = np.array((self.nothing, *self.codes))
        # noise may have moved a code: the nearest one is meant
        nearest: Groups = np.abs(planes[-self.planes][..., None] - known).argmin(axis=-1)
        return nearest


@dataclass(frozen=True)
class ChannelLegend:
    """How a reading with a channel for each group is seen as one picture; the last group on top.

    >>> legend = ChannelLegend(("floor", "wall"))
    >>> legend.groups_in(np.array([[[255, 0], [255, 255], [0, 0]]])).tolist()
    [[1, 2, 0]]
    """

    groups: tuple[str, ...]

    def groups_in(self, reading: npt.ArrayLike) -> Groups:
        """What is where; of stacked readings, in the latest one."""
        count = len(self.groups)
        there: Any = np.asarray(reading)[..., -count:] > 0
        on_top: Groups = (there * np.arange(1, count + 1)).max(axis=-1)
        return on_top


Legend = CodeLegend | ChannelLegend
