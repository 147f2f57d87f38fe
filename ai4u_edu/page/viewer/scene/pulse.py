"""A pulse of the body that an agent has reached, for about a second after its success."""

import math
import time
from collections.abc import Callable

import numpy as np

from ai4u_edu.page.viewer.scene.geometry import Array
from ai4u_edu.snapshot import AgentState, Snapshot

PULSE_S = 1.0
"""Duration of a pulse, wall time (s)."""
PULSE_COUNT = 2
"""Times that a body grows and shrinks during a pulse."""
PULSE_GROWTH = 0.22
"""Share by which a body grows."""
MAX_GAP_M = 0.15
"""Largest gap (m) between an agent and the body that it has reached."""


def reached_target(snapshot: Snapshot, agent: AgentState) -> str:
    """Return the name of the target that an agent has reached; empty if it has reached none.

    It is the nearest body with the tag ``target`` within reach of an agent whose episode has ended
    with success.
    """
    if not (agent.succeeded and (agent.terminated or agent.truncated)):
        return ""
    shapes = {body.name: body for body in snapshot.static_scene.bodies}
    states = {body.name: body for body in snapshot.bodies}
    own, reach = states[agent.body], shapes[agent.body].shape.reach
    gaps = {
        name: math.hypot(states[name].x - own.x, states[name].y - own.y) - body.shape.reach - reach
        for name, body in shapes.items()
        if "target" in body.tags and name != agent.body and not states[name].fallen
    }
    nearest = min(gaps, key=gaps.__getitem__, default="")
    return nearest if nearest and gaps[nearest] <= MAX_GAP_M else ""


class Pulse:
    """Scales of bodies: above 1 while one pulses.

    Args:
        clock: wall clock (s); replaced in tests.
        is_motion_reduced: returns True while nothing may pulse.
    """

    def __init__(
        self,
        clock: Callable[[], float] = time.monotonic,
        is_motion_reduced: Callable[[], bool] = lambda: False,
    ) -> None:
        self._clock, self._is_motion_reduced = clock, is_motion_reduced
        self._began: dict[tuple[str, int, int], tuple[str, float]] = {}

    def scales(self, snapshot: Snapshot) -> Array:
        """Return the scale of each body of a snapshot, shape (n,)."""
        now, began = self._clock(), {}
        for agent in snapshot.agents:
            name = reached_target(snapshot, agent)
            if name:
                episode = agent.id, snapshot.episode, agent.episode
                began[episode] = self._began.get(episode, (name, now))
        self._began = began
        pulses = () if self._is_motion_reduced() else began.values()
        sizes = {name: pulse_scale(now - start) for name, start in pulses}
        return np.array([sizes.get(body.name, 1.0) for body in snapshot.bodies])


def pulse_scale(seconds: float) -> float:
    """Return a body's scale a time after it was reached.

    >>> [round(pulse_scale(seconds), 2) for seconds in (0.0, 0.25, 0.5, 0.75, 1.0, 9.0)]
    [1.0, 1.22, 1.0, 1.22, 1.0, 1.0]
    """
    if not 0.0 <= seconds < PULSE_S:
        return 1.0
    return 1.0 + PULSE_GROWTH * math.sin(math.pi * PULSE_COUNT * seconds / PULSE_S) ** 2
