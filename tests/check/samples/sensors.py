"""Samples of sensors whose defaults do not suit the checks' world."""

import math

from ai4u_edu import (
    AgentArraySensor,
    AreaOrientationSensor,
    BasicAgent,
    BearingSensor,
    Body,
    CellSensor,
    EventSensor,
    FloatArrayCompositeSensor,
    GridSensor,
    GroupTouchSensor,
    HeadingSensor,
    HearSensor,
    IDSensor,
    LightSensor,
    LinearRayCastingSensor,
    LineSensor,
    LocalGridSensor,
    OrientationSensor,
    PresenceSensor,
    RayCastingSensor,
    TouchSensor,
    VelocitySensor,
)
from tests.check.samples.sample import Sample

CODES = {"floor": 1, "target": 2, "wall": 4, "agent": 8}


def set_array(agent: BasicAgent, decision: int) -> None:
    """Set the values of the agent's AgentArraySensor, as a script does."""
    for sensor in agent.sensors:
        if isinstance(sensor, AgentArraySensor):
            sensor.set_value(0, abs(math.sin(decision)))


def remove_ball(agent: BasicAgent, decision: int) -> None:
    """Remove the ball after a while, so that its presence changes."""
    if decision == 90:
        ball = agent.view["ball"]
        assert isinstance(ball, Body)
        ball.leave()


def let_box_speak(agent: BasicAgent, decision: int) -> None:
    """Let the box say something now and then, as another agent would."""
    box = agent.view["box"]
    assert isinstance(box, Body)
    if decision % 3 == 0:
        box.say((math.sin(decision),), 50.0)


SAMPLES = (
    Sample(AgentArraySensor(size=2), script=set_array),
    AreaOrientationSensor(target_group="target", group_code={"target": 2, "wall": 4}, radius=3),
    BearingSensor(target="box"),
    CellSensor(rows=14, columns=14, cell_size=0.5),
    EventSensor(target="box"),
    FloatArrayCompositeSensor(sensors=[BearingSensor(target="box"), HeadingSensor()]),
    GridSensor(rows=14, columns=14, cell_size=0.5, group_code=CODES, self_exclude=False),
    GroupTouchSensor(group="target"),
    Sample(HearSensor(), script=let_box_speak),
    Sample(IDSensor(), always_same="an agent keeps its id"),
    LineSensor(group="goal"),
    LightSensor(group="target", angle_deg=40),
    LinearRayCastingSensor(group_code=CODES, return_distance=True),
    LinearRayCastingSensor(group_code=CODES, vertical_shift=20, return_distance=True),
    LocalGridSensor(width=16, height=16, cell_size=0.5, stacked_observations=2),
    OrientationSensor(target="box", visibility_test=True),
    Sample(PresenceSensor(group="target"), script=remove_ball),
    RayCastingSensor(rows=3, columns=5, group_code=CODES, return_distance=True),
    RayCastingSensor(rows=3, columns=5, return_code=False, return_distance=True),
    TouchSensor(target="box"),
    VelocitySensor(noise=0.1, delay=1, stacked_observations=2, dropout=0.1),
)
