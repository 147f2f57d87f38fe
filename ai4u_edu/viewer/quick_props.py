"""viser's properties are set without making the same types again and again.

For every property that is set, viser compares its type with ``NDArray[float16]`` and others, and
has Python make those anew each time: a quarter of the time that drawing for sixty pages takes. Here
they are made once.
"""

from functools import cache
from typing import Any

import numpy.typing as npt
import viser
from viser import _assignable_props_api as props

from ai4u_edu.viewer.fan_out import KNOWN


class _Arrays:
    """Stands for ``NDArray``."""

    @cache  # noqa: B019 - there is one of it, for ever
    def __getitem__(self, kind: Any) -> Any:
        return npt.NDArray[kind]


class _Types:
    """Stands for ``numpy.typing``, of which viser uses nothing else there."""

    NDArray = _Arrays()


def quick_props() -> bool:
    """Has properties set quickly; whether it can be done with this viser."""
    if viser.__version__ != KNOWN:
        return False
    props.npt = _Types  # type: ignore[assignment, attr-defined]
    return True
