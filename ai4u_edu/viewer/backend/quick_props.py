"""viser's properties and poses are set with less ado.

For every property that is set, viser compares its type with ``NDArray[float16]`` and others, and
has Python make those anew each time: a quarter of the time that drawing for sixty pages takes. Here
they are made once. And whether three numbers are others than before, Python finds out faster
without numpy: a hundred labels that move need that for every picture.
"""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy.typing as npt
import viser
from viser import _assignable_props_api as props
from viser import _scene_handles as handles
from viser._scene_api import cast_vector

from ai4u_edu.viewer.backend.broadcast import KNOWN


class _Arrays:
    """Stands for ``NDArray``."""

    @cache  # noqa: B019 - there is one of it, for ever
    def __getitem__(self, kind: Any) -> Any:
        return npt.NDArray[kind]


class _Types:
    """Stands for ``numpy.typing``, of which viser uses nothing else there."""

    NDArray = _Arrays()


def set_pose(
    current: npt.NDArray[Any],
    value: tuple[float, ...] | npt.NDArray[Any],
    length: int,
    queue: Callable[[Any], None],
    make_message: Callable[[Any], Any],
) -> None:
    """In place of viser's ``_set_pose_vector``: tells of a pose that is another one than before."""
    wanted: tuple[float, ...] = cast_vector(value, length)
    for new, old in zip(wanted, current.tolist(), strict=True):
        if not abs(new - old) <= 1e-8 + 1e-5 * abs(old):  # as numpy.allclose has it
            current[:] = wanted
            queue(make_message(wanted))
            return


def quick_props() -> bool:
    """Has properties set quickly; whether it can be done with this viser."""
    if viser.__version__ != KNOWN:
        return False
    props.npt = _Types  # type: ignore[assignment, attr-defined]
    handles._set_pose_vector = set_pose
    return True
