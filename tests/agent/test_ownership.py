"""A block belongs to one agent at a time; another one may claim it later."""

import gc
import weakref
from collections.abc import Callable
from typing import Any

import pytest

from ai4u_edu import (
    AndRewardFunc,
    BasicAgent,
    CircleShape,
    ControlRequestor,
    FallReward,
    FloatArrayCompositeSensor,
    HomeostaticReward,
    HomeostaticVariable,
    LocalBrain,
    MinDistReward,
    RBMoveActuator,
    VelocitySensor,
    WASDRBMoveController,
    World,
)
from ai4u_edu.base.errors import SetupError
from tests.builders import small_sim, small_world, still


def two(world: World | None = None, **shared: Any) -> ControlRequestor:
    """Two agents, a and b, with the same blocks."""
    agents = []
    for agent_id, body in (("a", "robot"), ("b", "box")):
        fields = {"brains": [LocalBrain(controller=still)]} | shared
        agents.append(BasicAgent(id=agent_id, body=body, **fields))
    return ControlRequestor(world or small_world(), agents)


@pytest.mark.parametrize(
    ("shared", "named"),
    [
        ({"sensors": [VelocitySensor()]}, "VelocitySensor 'velocity'"),
        ({"actuators": [RBMoveActuator()]}, "RBMoveActuator 'move'"),
        ({"rewards": [MinDistReward(target="box")]}, "MinDistReward 'min_dist'"),
        ({"brains": [LocalBrain(controller=still)]}, r"LocalBrain\(ScriptController\)"),
    ],
)
def test_two_agents_cannot_share_a_block(shared: dict[str, Any], named: str) -> None:
    with pytest.raises(SetupError, match=f"^agents 'a' and 'b' share the same {named}; make one"):
        two(**shared)


def test_nor_what_is_inside_a_block() -> None:
    child, fall, velocity = HomeostaticVariable(name="energy"), FallReward(), VelocitySensor()
    controller = WASDRBMoveController()
    kinds: list[tuple[str, str, Callable[[], Any]]] = [
        ("rewards", "HomeostaticVariable 'energy'", lambda: HomeostaticReward(variables=[child])),
        ("rewards", "FallReward 'fall'", lambda: AndRewardFunc(children=[fall])),
        (
            "sensors",
            "VelocitySensor 'velocity'",
            lambda: FloatArrayCompositeSensor(sensors=[velocity]),
        ),
        ("brains", "WASDRBMoveController", lambda: LocalBrain(controller=controller)),
    ]
    for field, name, make in kinds:
        agents = []
        for agent_id, body in (("a", "robot"), ("b", "box")):
            fields: dict[str, Any] = {"brains": [LocalBrain(controller=still)], field: [make()]}
            agents.append(
                BasicAgent(id=agent_id, body=body, actuators=[RBMoveActuator()], **fields)
            )
        with pytest.raises(SetupError, match=f"^agents 'a' and 'b' share the same {name}"):
            ControlRequestor(small_world(), agents)


def test_one_agent_cannot_have_a_block_twice() -> None:
    velocity, fall = VelocitySensor(), FallReward()
    doubles: list[dict[str, Any]] = [
        {"sensors": [velocity, velocity]},
        {"sensors": [velocity, FloatArrayCompositeSensor(sensors=[velocity])]},
        {"sensors": [FloatArrayCompositeSensor(sensors=[velocity, velocity])]},
        {"rewards": [AndRewardFunc(children=[fall, fall])]},
    ]
    for fields in doubles:
        with pytest.raises(SetupError, match=r"^agent '0': the same .* stands in it twice"):
            small_sim(**fields)


def test_two_agents_cannot_have_one_body() -> None:
    agents = [
        BasicAgent(id=each, body="robot", brains=[LocalBrain(controller=still)]) for each in "ab"
    ]
    with pytest.raises(SetupError, match=r"^agents 'a' and 'b' have the same body 'robot'"):
        ControlRequestor(small_world(), agents)


def test_a_block_that_is_off_is_nobodys() -> None:
    two(sensors=[VelocitySensor(is_active=False)], rewards=[FallReward(is_active=False)])


def test_a_brain_of_the_agent_beside_is_refused_and_nothing_changes() -> None:
    sim = two_of_their_own()
    a, b = sim.agents
    before = b.brain
    with pytest.raises(SetupError, match=r"^agents 'a' and 'b' share the same LocalBrain"):
        b.use_brain(a.brain)
    assert b.brain is before
    sim.reset()
    sim.step()


def two_of_their_own() -> ControlRequestor:
    agents = [
        BasicAgent(id=each, body=body, brains=[LocalBrain(controller=still)])
        for each, body in (("a", "robot"), ("b", "box"))
    ]
    return ControlRequestor(small_world(), agents)


def test_brains_of_two_agents_can_be_swapped_one_after_the_other() -> None:
    sim = two_of_their_own()
    sim.reset()
    a, b = sim.agents
    one, other = a.brain, b.brain
    a.use_brain(LocalBrain(controller=still))
    b.use_brain(one)
    a.use_brain(other)
    sim.step()
    assert (a.brain, b.brain) == (other, one)


def test_a_cell_of_a_notebook_can_run_again() -> None:
    world, velocity = small_world(), VelocitySensor()
    for _ in range(3):  # the second one is made while the first one is still there
        sim = small_sim([velocity], world=world, controller=drive)
        sim.step()
        assert sim.agents[0].percept["velocity"][0] > 1
    agent = sim.agents[0]
    for _ in range(3):
        sim = ControlRequestor(small_world(), [agent])
        sim.reset()
        sim.step()
        assert agent.percept["velocity"][0] > 1


def drive(_percept: Any) -> dict[str, Any]:
    return {"move": [1, 0, 0, 0]}


def test_who_lost_a_block_to_another_world_says_so_and_can_be_set_up_again() -> None:
    velocity = VelocitySensor()
    first = small_sim([velocity], controller=drive)
    second = small_sim([velocity], controller=drive, id="b")
    for what in (first.step, first.reset, first.tick):
        with pytest.raises(SetupError, match="agent '0' has lost its VelocitySensor 'velocity' to"):
            what()
    with pytest.raises(SetupError, match="has lost its VelocitySensor"):
        first.agents[0].use_brain(LocalBrain(controller=still))
    second.step()
    assert second.agents[0].percept["velocity"][0] > 1
    again = ControlRequestor(small_world(), [first.agents[0]])
    again.reset()
    again.step()
    assert first.agents[0].percept["velocity"][0] > 1
    with pytest.raises(SetupError, match="agent 'b' has lost its VelocitySensor 'velocity' to"):
        second.step()


def test_who_lost_its_brain_takes_another_one() -> None:
    brain = LocalBrain(controller=drive)
    first = small_sim(brains=[brain])
    second = small_sim()
    second.agents[0].use_brain(brain)
    with pytest.raises(SetupError, match=r"has lost its LocalBrain\(ScriptController\) to"):
        first.step()
    first.agents[0].use_brain(LocalBrain(controller=still))
    first.step()
    second.step()


def test_an_agent_that_moved_to_another_world_is_no_more_in_the_first_one() -> None:
    agent = BasicAgent(body="robot", brains=[LocalBrain(controller=still)])
    first = ControlRequestor(small_world(), [agent])
    first.reset()
    second = ControlRequestor(small_world(), [agent])
    second.reset()
    for what in (first.step, first.reset):
        with pytest.raises(SetupError, match="agent '0' was set up in another world since"):
            what()
    second.step()


def test_an_error_at_setup_leaves_the_blocks_free() -> None:
    velocity = VelocitySensor()
    with pytest.raises(SetupError):
        small_sim([velocity], rewards=[MinDistReward(target="bux")])
    small_sim([velocity]).step()


def test_a_block_keeps_no_agent_alive() -> None:
    velocity = VelocitySensor()
    sim: Any = small_sim([velocity])
    agent = weakref.ref(sim.agents[0])
    del sim
    gc.collect()
    assert agent() is None
    world = World()
    world.add_body("robot", CircleShape(radius=0.5))
    small_sim([velocity], world=world).step()
