"""A whole decision gives the same as tick by tick, and runs tick by tick where events need it."""

import struct
from collections.abc import Callable
from typing import Any

import pytest

from ai4u_edu import (
    CircleShape,
    DiscreteActuator,
    LocalBrain,
    RBMoveActuator,
    Scene,
    World,
)
from ai4u_edu.agent.cycle import ControlRequestor
from tests.builders import small_sim, small_world
from tests.scenes.test_solvers import random_driver

ALONE = [name for name in Scene.names() if len(Scene.load(name).description.agents) == 1]


def drive(name: str, stepwise: bool, repeat: bool) -> bytes:
    sim = Scene.load(name).build()
    agent = sim.agents[0]
    wander, skip = random_driver(agent, 7), agent.brain.skip_frame
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


def ahead(_percept: Any) -> dict[str, Any]:
    return {"move": [1.0, 0.5, 0.0, 0.0]}


def both(make: Callable[[], ControlRequestor], decisions: int = 3) -> World:
    """Return the world after some decisions; tick by tick it must be the same."""
    whole, single = make(), make()
    for _ in range(decisions):
        whole.step()
        single.tick()
        while not single.between_decisions():
            single.tick()
    assert state(whole) == state(single)
    return whole.world


def state(sim: ControlRequestor) -> list[Any]:
    bodies = sim.world.bodies.values()
    moving = [(*each.pose, *each.velocity, each.angular_velocity, each.vz) for each in bodies]
    return [sim.world.ticks, moving, sim.agents[0].reward_terms, sim.agents[0].percept.data]


def test_an_action_that_is_not_repeated_acts_at_the_first_tick_only() -> None:
    def make() -> ControlRequestor:
        brain = LocalBrain(controller=ahead, skip_frame=4, repeat_action=False)
        return small_sim(brains=[brain])

    world = both(make)
    assert 0.0 < world["robot"].velocity[0] < 1.9, "it slows down in between"


def test_a_fall_out_of_the_world_ends_the_decision() -> None:
    def make() -> ControlRequestor:
        world = World(fall_threshold=-1e-9)
        world.add_floor("plate", small_world(plate=4).floors[0].shape)
        world.add_body("robot", CircleShape(), position=(1.9, 0))
        return small_sim(world=world, controller=ahead, skip_frame=9)

    world = both(make, 1)
    assert world["robot"].fallen
    assert world.ticks == 4


def test_a_body_that_is_out_of_the_world_has_one_tick() -> None:
    def make() -> ControlRequestor:
        sim = small_sim(controller=ahead, skip_frame=9)
        sim.agents[0].body.leave()
        return sim

    assert both(make, 1).ticks == 1


def test_two_actuators_act_in_turn_at_each_tick() -> None:
    both(
        lambda: small_sim(
            actuators=[RBMoveActuator(), RBMoveActuator(action_name="more", move_amount=3)],
            controller=lambda percept: {"more": [1, 0, 0, 0], "move": [0, 1, 0, 0]},
            skip_frame=4,
        )
    )


def test_a_handler_is_called_at_each_tick() -> None:
    actuator, asked = DiscreteActuator(), []
    sim = small_sim(actuators=[actuator], controller=lambda percept: {"move": 3}, skip_frame=4)
    sim.step()
    actuator.handler = lambda body, index: asked.append(index)
    sim.step()
    assert asked == [3] * 5


def test_a_step_has_skip_frame_more_ticks_than_one() -> None:
    sim = small_sim(controller=ahead, skip_frame=6)
    for count in range(1, 20):
        sim.step()
        assert sim.world.ticks == 7 * count
