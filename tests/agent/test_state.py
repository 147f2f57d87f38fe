"""The state of a world goes into a copy of it whole: a kind of state that does not fails here."""

import math
import types
from collections import deque
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pytest
from gymnasium.spaces import Discrete

from ai4u_edu import (
    BasicAgent,
    BoxShape,
    CircleShape,
    Controller,
    LocalBrain,
    PositionSensor,
    RBMoveActuator,
    Scene,
    World,
)
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import Keyboard, Percept
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.world import Body, WorldView

IGNORED = {
    "generation",
    "_built_for",
    "_groups",
    "_told_by",
    "_unconfirmed",
    "has_news",
    "_fan",
    "_grid",
    "_map",
    "_seen",
    "_shares",
    "_top_view",
    "_walls",
}
"""Attributes that belong to the one object alone, that it works out again where it needs them, or
that the next reading writes before anything reads them."""


class Wanderer(Controller):
    """A student's controller, which declares nothing of what it keeps."""

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        self.actuators = [each for each in agent.actuators if each.is_output and each.is_active]

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        self.decisions = 0
        self.latest: list[dict[str, list[float]]] = []
        self.random = view.random(f"{agent.id}/wanderer")

    def get_action(self, percept: Percept) -> dict[str, list[float]]:
        self.decisions += 1
        action = {}
        for actuator in self.actuators:
            low, high = actuator.limits()
            if isinstance(actuator.space(), Discrete):
                action[actuator.action_name] = [
                    float(self.random.integers(int(low[0]), int(high[0]) + 1))
                ]
            else:  # a little out of range, which it counts
                action[actuator.action_name] = list(self.random.uniform(low, high) * 1.1)
        self.latest = [*self.latest[-3:], action]
        return action


def differences(one: Any, other: Any, path: str, seen: set[int]) -> Iterator[str]:
    """Yield where two worlds differ, in all that their objects hold."""
    if isinstance(one, float) and isinstance(other, float):
        if one != other and not (math.isnan(one) and math.isnan(other)):
            yield f"{path}: {one} != {other}"
    elif one is None or isinstance(one, bool | int | str | bytes | frozenset):
        if one != other:
            yield f"{path}: {one!r} != {other!r}"
    elif isinstance(one, np.random.Generator):
        if one.bit_generator.state != other.bit_generator.state:
            yield f"{path}: another state of the generator"
    elif isinstance(one, np.ndarray):
        if not np.array_equal(one, other):
            yield f"{path}: {one} != {other}"
    elif id(one) in seen:
        return
    elif isinstance(one, Mapping):
        seen.add(id(one))
        keys = [key for key in one if isinstance(key, str | int | tuple)]
        theirs = [key for key in other if isinstance(key, str | int | tuple)]
        if [str(key) for key in keys] != [str(key) for key in theirs]:
            yield f"{path}: {keys} != {theirs}"
        else:
            for mine, its in zip(keys, theirs, strict=True):
                yield from differences(one[mine], other[its], f"{path}[{mine!r}]", seen)
    elif isinstance(one, list | tuple | deque):
        seen.add(id(one))
        if len(one) != len(other):
            yield f"{path}: {one} != {other}"
        else:
            for index, (mine, its) in enumerate(zip(one, other, strict=True)):
                yield from differences(mine, its, f"{path}[{index}]", seen)
    elif type(one).__module__.startswith(("ai4u_edu", "tests")) and not isinstance(
        one, types.FunctionType | types.MethodType | type | Keyboard
    ):
        seen.add(id(one))
        if isinstance(one, Body):
            motion = [(each.pose, each.velocity, each.angular_velocity) for each in (one, other)]
            if motion[0] != motion[1]:
                yield f"{path}: {motion[0]} != {motion[1]}"
        names = list(getattr(one, "__dict__", ())) or list(getattr(type(one), "__slots__", ()))
        for name in names:
            if name not in IGNORED and hasattr(one, name):
                mine, its = getattr(one, name), getattr(other, name, "absent")
                yield from differences(mine, its, f"{path}.{name}", seen)


def wander(_: BasicAgent) -> LocalBrain:
    return LocalBrain(controller=Wanderer())


def pair(name: str, *, has_own_drivers: bool) -> tuple[ControlRequestor, ControlRequestor]:
    """Return a world of a scene that has run for a while, and a copy of it."""
    scene = Scene.load(name)
    sim, copy = (scene.build(brains=None if has_own_drivers else wander) for _ in range(2))
    sim.reset(3)
    for tick in range(293):
        sim.tick()
        if tick % 100 == 60:
            sim.restart(sim.agents[0])
    copy.set_state(sim.get_state())
    return sim, copy


@pytest.mark.parametrize("name", Scene.names())
@pytest.mark.parametrize("has_own_drivers", [True, False])
def test_a_copy_equals_its_world_in_all_that_it_holds(name: str, has_own_drivers: bool) -> None:
    sim, copy = pair(name, has_own_drivers=has_own_drivers)
    assert list(differences(sim, copy, "sim", set())) == []


def test_a_copy_goes_on_as_its_world_does() -> None:
    sim, copy = pair("box_chase", has_own_drivers=False)
    for _ in range(200):
        sim.tick()
        copy.tick()
        assert copy.agents[0].percept.data == sim.agents[0].percept.data
        assert copy.agents[0].ledger.episode_terms == sim.agents[0].ledger.episode_terms
    assert copy.world["robot"].pose == sim.world["robot"].pose


def test_what_touches_goes_on_and_ends_in_a_copy() -> None:
    scene = Scene.load("push_block")
    sim, copy = scene.build(), scene.build()
    for each in (sim, copy):
        each.reset(1)
    block = sim.world["block"]
    robot = sim.world["robot"]
    reach = block.sampled.shape.reach + 2.0
    robot.move_to(block.position[0] - reach, block.position[1], heading=0.0)
    for _ in range(300):
        robot.set_velocity(2.0, 0.0)
        sim.world.tick()
        if sim.world.contacts.of("robot"):
            break
    assert sim.world.contacts.of("robot") == ("block",)
    copy.set_state(sim.get_state())
    assert copy.world.contacts.of("robot") == ("block",)
    assert copy.world.contacts.begun("robot") == 1
    copy.world["robot"].set_velocity(-3.0, 0.0)  # leaves within the first tick of the new space
    copy.world.tick()
    copy.world.tick()
    assert copy.world.contacts.of("robot") == ()


def pressing(*boxes: tuple[float, float]) -> ControlRequestor:
    """Return a world whose robot drives into a wall, or pushes boxes against it."""
    world = World(seed=1)
    world.add_floor("plate", BoxShape(size=(12, 12)))
    world.add_body("robot", CircleShape(radius=0.5), position=(-2, 0.1))
    world.add_body("wall", BoxShape(size=(0.5, 8)), position=(3, 0), kind="static")
    for number, place in enumerate(boxes):
        world.add_body(f"box {number}", BoxShape(size=(1, 1)), position=place)
    agent = BasicAgent(
        body="robot",
        sensors=[PositionSensor()],
        actuators=[RBMoveActuator(move_amount=2, turn_amount=2)],
        brains=[LocalBrain(controller=lambda _: {"move": [1, 0.1, 0, 0]})],
    )
    return ControlRequestor(world, [agent])


def straight() -> LocalBrain:
    """Return a brain that drives straight ahead."""
    return LocalBrain(controller=lambda _: {"move": [1, 0, 0, 0]})


def apart(sim: ControlRequestor, copy: ControlRequestor, ticks: int) -> float:
    """Return the largest distance (m, rad) of a body from itself in a copy, in so many ticks."""
    largest = 0.0
    for _ in range(ticks):
        sim.tick()
        copy.tick()
        for name, body in sim.world.bodies.items():
            pairs = zip(body.pose, copy.world[name].pose, strict=True)
            largest = max(largest, *(abs(mine - its) for mine, its in pairs))
    return largest


@pytest.mark.parametrize("ticks", [90, 130, 177, 240])
def test_what_presses_on_something_goes_on_bit_for_bit_in_a_copy(ticks: int) -> None:
    sim, copy = pressing(), pressing()
    sim.reset(1)
    for _ in range(ticks):
        sim.tick()
    copy.set_state(sim.get_state())
    assert apart(sim, copy, 600) == 0.0


@pytest.mark.parametrize("seed", range(5))
def test_many_robots_at_walls_go_on_bit_for_bit_in_a_copy(seed: int) -> None:
    sim, copy = (Scene.load("ants").build(brains=lambda _: straight()) for _ in range(2))
    sim.reset(seed)
    for _ in range(300):
        sim.tick()
    assert any(sim.world.contacts.of(agent.body_name) for agent in sim.agents)
    copy.set_state(sim.get_state())
    assert apart(sim, copy, 600) == 0.0


@pytest.mark.parametrize("boxes", [[(1, 0)], [(1, 0), (2.1, 0.1)]])
@pytest.mark.parametrize("ticks", [90, 130, 177, 240])
def test_a_chain_of_bodies_that_press_begins_within_a_centimetre_in_a_copy(
    boxes: list[tuple[float, float]], ticks: int
) -> None:
    sim, copy = pressing(*boxes), pressing(*boxes)
    sim.reset(1)
    for _ in range(ticks):
        sim.tick()
    copy.set_state(sim.get_state())
    assert apart(sim, copy, 2) < 0.01


def test_a_body_that_was_put_back_presses_on_as_before_in_a_copy() -> None:
    sim, copy = pressing(), pressing()
    sim.reset(1)
    for _ in range(30):
        sim.tick()
    sim.world.put_back("robot")
    for _ in range(177):
        sim.tick()
    assert sim.world.contacts.of("robot") == ("wall",)
    copy.set_state(sim.get_state())
    assert apart(sim, copy, 600) == 0.0
