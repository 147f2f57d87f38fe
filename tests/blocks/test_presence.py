"""PresenceSensor: bodies that are in the world."""

import pytest

from ai4u_edu import BoxShape, CircleShape, PresenceSensor, World
from ai4u_edu.base.errors import BlockError
from tests.builders import small_sim


def test_one_number_for_each_in_the_order_of_the_scene() -> None:
    world = World()
    world.add_floor("plate", BoxShape(size=(20, 20)))
    world.add_body("robot", CircleShape(radius=0.5))
    for index, name in enumerate(("b", "c", "a")):
        world.add_body(name, CircleShape(radius=0.5), position=(3, 2 * index), tags=("coin",))
    sensor = PresenceSensor(group="coin")
    sim = small_sim([sensor], world=world)
    percept = sim.agents[0].percept
    assert percept["presence"].tolist() == [1.0, 1.0, 1.0]
    assert sensor.space().shape == (3,)
    world["c"].leave()
    assert sim.step()["presence"].tolist() == [1.0, 0.0, 1.0]
    world["a"].move_to(15, 0)  # over the void
    for _ in range(60):
        percept = sim.step()
    assert percept["presence"].tolist() == [1.0, 0.0, 0.0]
    sim.reset()
    assert sim.agents[0].percept["presence"].tolist() == [1.0, 1.0, 1.0]


def test_an_unknown_group() -> None:
    with pytest.raises(BlockError, match="no body carries the tag 'targt'; did you mean 'target'"):
        small_sim([PresenceSensor(group="targt")])
