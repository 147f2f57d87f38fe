"""Errors of random ranges, and the cost of a world without any."""

from typing import Any

import pytest

from ai4u_edu.base.errors import ParameterError
from ai4u_edu.world import (
    BoxShape,
    CircleShape,
    FloorDescription,
    Variation,
    World,
)


@pytest.mark.parametrize(
    ("vary", "told"),
    [
        ({"x": (4, -4)}, "x: expected the smaller number first, got [4.0, -4.0]"),
        ({"x": (0, 1), "places": [(0, 0)]},
         "expected either ranges (x, y) or places, got both; leave one out"),
        ({"clearance": 1}, "nothing is drawn; expected at least one of x, y, places, heading_deg, "
         "scale"),
        ({"places": []}, "places: expected at least 1 entries, got []"),
        ({"scale": (0, 1)}, "scale[0]: expected more than 0, got 0"),
        ({"heading": (0, 1)}, "heading: unknown parameter; did you mean 'heading_deg'?"),
        ({"x": (0, 1), "clearance": -1}, "clearance: expected at least 0, got -1"),
    ],
)  # fmt: skip
def test_what_is_wrong_in_a_variation_is_told(vary: dict[str, Any], told: str) -> None:
    with pytest.raises(ParameterError) as caught:
        Variation(**vary)
    assert str(caught.value) == f"Variation: {told}"


def test_a_floor_has_no_clearance() -> None:
    with pytest.raises(ParameterError, match=r"random: a floor has bodies on it; expected no cl"):
        FloorDescription(name="f", shape=BoxShape(), random=Variation(x=(0, 1), clearance=1))


def test_no_random_placement_in_a_fixed_world(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_args: Any) -> None:
        raise AssertionError("somebody looked for a place")

    world = World()
    monkeypatch.setattr("ai4u_edu.world.world.randomize", refuse)
    monkeypatch.setattr("ai4u_edu.world.world.Places", refuse)
    world.add_floor("plate", BoxShape(size=(9, 9)))
    ball = world.add_body("ball", CircleShape())
    world.reset()
    assert ball.sampled is ball.description


def test_no_random_placement_after_the_last_random_body_is_removed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    world = World()
    world.add_body("ball", CircleShape(), random={"x": (0, 1)})
    world.remove("ball")
    monkeypatch.setattr("ai4u_edu.world.world.randomize", lambda *_args: 1 / 0)
    world.reset()
