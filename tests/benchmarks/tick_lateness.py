"""Blocks file for rooms of a benchmark: writes how late ticks were, when it is asked to.

It is loaded with ``--blocks``. The folder stands in ``AI4U_LATENESS_FOLDER``. Once it has a file
:data:`REQUEST`, each process writes one of its own: to write all the time would make ticks late.
"""

import json
import os
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu import Sensor
from ai4u_edu.runtime.runner import Runner

POLL_S = 0.5
REQUEST = "write"


class NoReading(Sensor):
    """A reading that is always 0: a blocks file has at least one block."""

    def space(self) -> Box:
        return Box(0.0, 1.0, (1,))

    def read(self, body: Any, view: Any) -> Any:
        return np.zeros(1)


_ticks: list[tuple[float, float, float]] = []
"""Begin (s), lateness (s) and delay (s) of each tick.

The delay is the time since the tick before, beyond the period; waiting for a script counts.
"""
_last = {"began": 0.0}
_tick = Runner._tick


def _timed_tick(self: Runner, *, whole_decision: bool = False) -> None:
    began, due = self._clock(), self._schedule.due
    _tick(self, whole_decision=whole_decision)
    if not self.sim.waiting_for_brain:  # else the tick has not taken place
        delay = max(0.0, began - _last["began"] - self._period)
        _ticks.append((time.monotonic(), began - due, delay))
        _last["began"] = began


def _write(folder: Path) -> None:
    while not (folder / REQUEST).exists():
        time.sleep(POLL_S)
    path = folder / f"{os.getpid()}.json"
    beside = path.with_suffix(".partial")
    beside.write_text(json.dumps(list(_ticks)))
    beside.replace(path)


def _begin() -> None:
    folder = os.environ.get("AI4U_LATENESS_FOLDER")
    if folder:
        Runner._tick = _timed_tick  # type: ignore[method-assign]  # to measure
        threading.Thread(target=_write, args=[Path(folder)], daemon=True).start()


_begin()
