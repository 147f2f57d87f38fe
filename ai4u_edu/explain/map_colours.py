"""Colours of values on a map: cividis (Nuñez and others, 2018), which all eyes order alike."""

import numpy as np
import numpy.typing as npt

from ai4u_edu.explain.policy import Floats

CIVIDIS = (
    "#00224e",
    "#003170",
    "#2a3f6d",
    "#434e6c",
    "#575d6d",
    "#6a6c71",
    "#7d7c78",
    "#918b78",
    "#a59c74",
    "#bcae6c",
    "#d2c060",
    "#e9d34e",
    "#fee838",
)
"""Colours from the lowest value to the highest one, evenly spaced."""
_STOPS = np.array([[int(each[i : i + 2], 16) for i in (1, 3, 5)] for each in CIVIDIS], np.float64)


def value_range(values: Floats) -> tuple[float, float] | None:
    """Return the lowest and the highest value that is known; None if none is."""
    known = values[np.isfinite(values)]
    return (float(known.min()), float(known.max())) if len(known) else None


def value_colours(values: Floats) -> npt.NDArray[np.int64]:
    """Return the sRGB colours (n, 3) of values, from the lowest to the highest of them.

    >>> value_colours(np.array([0.0, 10.0])).tolist()
    [[0, 34, 78], [254, 232, 56]]
    """
    low, high = value_range(values) or (0.0, 0.0)
    shares = (np.nan_to_num(values, nan=low) - low) / max(high - low, 1e-12)
    places = np.linspace(0, 1, len(_STOPS))
    mixed = [np.interp(shares, places, channel) for channel in _STOPS.T]
    return np.asarray(np.rint(np.column_stack(mixed)), np.int64)
