"""A step at one go is the same as one tick after another, and gives way where somebody listens."""

import struct

import pytest

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.agent.cycle import ControlRequestor
from tests.scenes.test_solvers import chance

ALONE = [name for name in Scene.names() if len(Scene.load(name).description.agents) == 1]


def drive(name: str, stepwise: bool, repeat: bool) -> bytes:
    sim = Scene.load(name).build()
    agent = sim.agents[0]
    wander, skip = chance(agent, 7), agent.brain.skip_frame
    agent.use_brain(LocalBrain(controller=wander, skip_frame=skip, repeat_action=repeat))
    sim.reset(seed=3)
    seen = b""
    for _ in range(40):
        if stepwise:
            sim.step()
        else:
            sim.tick()
            while not sim.between_decisions():
                sim.tick()
        seen += agent.percept.data + struct.pack("<2d", agent.reward, sim.world.time)
        if agent.done:
            sim.reset()
    return seen


@pytest.mark.parametrize(("name", "repeat"), [*((name, True) for name in ALONE), ("jumper", False)])
def test_both_ways_lead_to_the_same(name: str, repeat: bool) -> None:
    assert drive(name, True, repeat) == drive(name, False, repeat)


@pytest.mark.parametrize("moment", ["begin_of_apply_action", "end_of_apply_action"])
def test_who_listens_to_each_tick_hears_of_each(moment: str) -> None:
    sim: ControlRequestor = Scene.load("yardstick").build()
    agent = sim.agents[0]
    heard: list[int] = []
    getattr(agent, moment).connect(lambda _: heard.append(sim.world.ticks))
    agent.use_brain(LocalBrain(controller=lambda percept: {"move": [1, 0]}, skip_frame=3))
    sim.reset(seed=1)
    sim.step()
    assert heard == [0, 1, 2, 3]
