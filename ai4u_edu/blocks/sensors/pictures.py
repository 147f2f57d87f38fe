"""Pictures of what sensors read, for the viewer's world and panel."""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

Groups = npt.NDArray[np.intp]
"""(rows, columns): a group's number for each cell, counted from 1; 0 is nothing."""


class SpotPicture(NamedTuple):
    """Points that a sensor sampled in its last reading, to be drawn as dots."""

    places: npt.NDArray[np.float64]
    """(n, 3) points, world frame, metres."""
    lit: tuple[bool, ...]
    """True for each point at which something was found."""


@dataclass(frozen=True)
class CodeLegend:
    """The legend of a reading that is made of codes: the group of each code.

    >>> legend = CodeLegend((1, 3), (0.5, 1.0), ("wall", "dirty"))
    >>> legend.groups_in(np.array([[0.5, 0.0, 1.0]])).tolist()
    [[1, 0, 2]]
    """

    shape: tuple[int, int]
    """(rows, columns) of one picture."""
    codes: tuple[float, ...]
    """The codes as they are in the percept."""
    groups: tuple[str, ...]
    """The group of each code."""
    planes: int = 1
    """Number of pictures in one reading; the codes are the first."""
    nothing: float = 0.0
    """The code of nothing, and of anything without a group."""
    has_codes: bool = True
    """False if the reading is distances alone."""

    def groups_in(self, reading: npt.ArrayLike) -> Groups:
        """Return the group in each cell; of stacked readings, the latest one's."""
        planes = np.asarray(reading).reshape(-1, *self.shape)
        known = np.array((self.nothing, *self.codes))
        # noise may have changed a code: take the nearest one
        nearest: Groups = np.abs(planes[-self.planes][..., None] - known).argmin(axis=-1)
        return nearest


@dataclass(frozen=True)
class ChannelLegend:
    """The legend of a reading with a channel for each group; the last group is drawn on top.

    >>> legend = ChannelLegend(("floor", "wall"))
    >>> legend.groups_in(np.array([[[255, 0], [255, 255], [0, 0]]])).tolist()
    [[1, 2, 0]]
    """

    groups: tuple[str, ...]

    def groups_in(self, reading: npt.ArrayLike) -> Groups:
        """Return the group in each cell; of stacked readings, the latest one's."""
        count = len(self.groups)
        there: Any = np.asarray(reading)[..., -count:] > 0
        on_top: Groups = (there * np.arange(1, count + 1)).max(axis=-1)
        return on_top


Legend = CodeLegend | ChannelLegend
