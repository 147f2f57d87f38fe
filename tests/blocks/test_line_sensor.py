"""LineSensor: a line of areas on the ground."""

import math
from typing import Any

import pytest

from ai4u_edu import BoxShape, CircleShape, LineSensor, PolygonShape, World
from ai4u_edu.base.errors import BlockError
from tests.builders import small_sim


def painted() -> World:
    """A line 0.2 m wide along the y axis, in two areas, and another area."""
    world = World()
    world.add_body("robot", CircleShape(radius=0.4))
    corners = ((-0.1, -3), (0.1, -3), (0.1, 0), (-0.1, 0))
    world.add_area("south", PolygonShape(vertices=corners), tags=("line",))
    world.add_area("north", BoxShape(size=(3, 0.2)), position=(0, 1.5), heading_deg=90,
                   tags=("line", "far"))  # fmt: skip
    world.add_area("puddle", CircleShape(radius=3), position=(5, 0), tags=("wet",))
    return world


def reading(x: float, y: float, degrees: float, **fields: Any) -> list[float]:
    sim = small_sim([LineSensor(**fields)], world=painted())
    agent = sim.agents[0]
    agent.body.move_to(x, y, heading=math.radians(degrees))
    numbers: list[float] = agent.sense()["line"].tolist()
    return numbers


@pytest.mark.parametrize(
    ("x", "y", "degrees", "expected"),
    [
        (0, -2, 90, [0, 0, 1, 0, 0]),
        (0, 1, 90, [0, 0, 1, 0, 0]),
        (0.25, -2, 90, [0, 1, 0, 0, 0]),  # the line is to the left
        (-0.25, -2, 90, [0, 0, 0, 1, 0]),
        (0.5, -2, 90, [1, 0, 0, 0, 0]),
        (-0.5, -2, 90, [0, 0, 0, 0, 1]),
        (-0.5, -2, -90, [1, 0, 0, 0, 0]),
        (0.7, -2, 90, [0, 0, 0, 0, 0]),
        (-0.5, -2, 0, [1, 1, 1, 1, 1]),  # the bar lies along it, half a metre ahead
        (0, -2, 0, [0, 0, 0, 0, 0]),
        (0, 2.4, 90, [0, 0, 1, 0, 0]),
        (0, 2.6, 90, [0, 0, 0, 0, 0]),  # the end is half a metre ahead
        (0, 3.4, -90, [0, 0, 1, 0, 0]),
        (5, 0, 90, [0, 0, 0, 0, 0]),
    ],
)
def test_one_over_the_line_from_left_to_right(
    x: float, y: float, degrees: float, expected: list[float]
) -> None:
    assert reading(x, y, degrees, ahead=0.5, width=1.0) == expected


def test_the_tag_says_what_the_line_is() -> None:
    assert reading(0, -2, 90, group="far", points=1) == [0]
    assert reading(0, 1, 90, group="far", points=1) == [1]
    assert reading(5, 0, 0, group="wet", points=3, ahead=0) == [1, 1, 1]


def test_a_line_that_grows_is_seen() -> None:
    sim = small_sim([LineSensor(points=1)], world=painted())
    agent = sim.agents[0]
    agent.body.move_to(-5, 0)
    assert agent.sense()["line"].tolist() == [0]
    sim.world.add_area("more", CircleShape(radius=1), position=(-5, 0), tags=("line",))
    assert agent.sense()["line"].tolist() == [1]


def test_there_has_to_be_a_line() -> None:
    with pytest.raises(BlockError) as caught:
        small_sim([LineSensor(group="lime")], world=painted())
    assert "no area carries the tag 'lime'; did you mean 'line'?" in str(caught.value)
