"""The world under load, in a process of its own, that notes when its ticks begin."""

import time
from multiprocessing.connection import Connection
from typing import Any, NamedTuple

import numpy as np
from gymnasium.spaces import Box

from ai4u_edu import (
    BasicAgent,
    BoxShape,
    CircleShape,
    ControlRequestor,
    LinearRayCastingSensor,
    LocalBrain,
    RBMoveActuator,
    Sensor,
    TouchRewardFunc,
    World,
)
from ai4u_edu.room import serve_world
from ai4u_edu.runtime.process_tuning import tuned_process
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.server.scripts import Rules
from tests.builders import still

RAYS = 16
SKIP = 3
"""Ticks between two decisions: 60 / (3 + 1) are 15 a second."""
CLOCK_PERIOD_S = 256.0
"""Time (s) after which a :class:`Clock` wraps around: its float32 has steps of 0.02 ms."""


class Clock(Sensor):
    """Time of sensing (s), by a clock that all processes of this machine share."""

    def space(self) -> Box:
        return Box(0.0, CLOCK_PERIOD_S, (1,))

    def read(self, body: Any, view: Any) -> Any:
        return time.monotonic() % CLOCK_PERIOD_S


class TimedRunner(Runner):
    """Runner that records how late each tick begins."""

    late: list[float]

    def _tick(self, *, whole_decision: bool = False) -> None:
        self.late.append(self._clock() - self._schedule.due)
        super()._tick(whole_decision=whole_decision)


class WorldReport(NamedTuple):
    """Measurements of the world since the last report."""

    late: list[float]
    """Lateness (s) of every tick."""
    processor: float
    """Processor time (s)."""
    missing: dict[str, int]
    """Decisions without an action from the script, by agent."""


def crowd(agents: int, *, in_turn: bool = True) -> ControlRequestor:
    """Return robots on a plate, each with 16 rays, which decide in turn or in the same tick."""
    world = World()
    side = int(np.ceil(np.sqrt(agents)))
    world.add_floor("plate", BoxShape(size=(4.0 * side + 8, 4.0 * side + 8)))
    crew = []
    for number in range(agents):
        x, y = (4.0 * (each - side / 2) for each in divmod(number, side))
        name = f"robot {number}"
        world.add_body(name, CircleShape(radius=0.4), position=(x, y), tags=("robot",))
        crew.append(
            BasicAgent(
                id=str(number),
                body=name,
                sensors=[
                    Clock(perception_key="clock"),
                    LinearRayCastingSensor(
                        number_of_rays=RAYS, field_of_view=180, group_code={"robot": 1}
                    ),
                ],
                actuators=[RBMoveActuator(move_amount=0.5)],
                rewards=[TouchRewardFunc(target=f"robot {(number + 1) % agents}")],
                brains=[LocalBrain(controller=still, skip_frame=SKIP)],
            )
        )
    return ControlRequestor(world, crew, spread_decisions=in_turn)


def serve(agents: int, ends: Connection, *, in_turn: bool = True) -> None:
    """Serve such a world; answer each message with a report, until "end" comes."""
    runner = TimedRunner.__new__(TimedRunner)
    runner.late = []
    runner.__init__(crowd(agents, in_turn=in_turn), seed=1)  # type: ignore[misc]
    runner.start()
    with tuned_process(), serve_world(runner, title="Load", rules=Rules(grace=1.0)) as world:
        ends.send(world.url)
        processor = time.process_time()
        while ends.recv() != "end":
            late, runner.late = runner.late, []
            before, processor = processor, time.process_time()
            states = {agent.id: agent.remote for agent in runner.latest.agents}
            ends.send(
                WorldReport(
                    late,
                    processor - before,
                    {name: state.missing for name, state in states.items() if state},
                )
            )
    runner.stop()
