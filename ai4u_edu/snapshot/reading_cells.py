"""Readings that are pictures, as arrays of cells."""

from typing import Any

import numpy as np
import numpy.typing as npt

from ai4u_edu.blocks import ChannelLegend, Legend
from ai4u_edu.snapshot.theme import Rgb

SHADES = 8
"""Number of greys for distances."""
GREYS: list[Rgb] = [(shade, shade, shade) for shade in range(40, 241, 200 // (SHADES - 1))]
"""Greys from dark (near) to light (far)."""

Cells = npt.NDArray[np.intp]


def split_stack(reading: npt.NDArray[Any], legend: Legend, stack: int) -> list[npt.NDArray[Any]]:
    """Split a stack into its readings, oldest first."""
    # pictures with channels are stacked along the channels, all others along the first axis
    axis = reading.ndim - 1 if isinstance(legend, ChannelLegend) else 0
    flat = reading if isinstance(legend, ChannelLegend) else reading.reshape(stack, -1)
    return np.split(flat, stack, axis=axis)


def shaded(distances: npt.NDArray[Any]) -> Cells:
    """Return the index of each cell's grey, from 1; 0 where there is no distance."""
    share = distances / max(float(distances.max()), 1e-9)
    shades: Cells = 1 + np.minimum(share * SHADES, SHADES - 1).astype(np.intp)
    return np.where(distances > 0, shades, 0)
