"""The points that a line sensor probes are drawn, lit where they are on the line."""

import numpy as np
import pytest

from ai4u_edu import Scene
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.page.viewer.scene.light import surface_colours
from ai4u_edu.page.viewer.scene.sense_overlay import Spots
from ai4u_edu.snapshot import Snapshot, capture_snapshot
from ai4u_edu.snapshot.theme import SPOT_LIT, SPOT_UNLIT


@pytest.fixture
def picture() -> Snapshot:
    sim = Scene.load("line_follow").build()
    sim.reset(1)
    sim.agents[0].body.move_to(-1.0, -3.85, heading=np.pi / 2)
    sim.agents[0].sense()
    return capture_snapshot(sim)


def test_the_spots_are_where_the_eyes_look(picture: Snapshot) -> None:
    spots = picture.agents[0].spots["line"]
    assert spots.places[:, 0] == pytest.approx([-1.3, -1.15, -1.0, -0.85, -0.7])
    assert spots.places[:, 1] == pytest.approx(-3.5)
    assert spots.lit == (True,) * 5


def test_spots_light_up_and_go(viewer: Viewer, picture: Snapshot) -> None:
    (agent,) = picture.agents
    some = agent.spots["line"]._replace(lit=(True, False, False, True, False))
    part = Spots(viewer.server.scene)
    part.draw([some], height=1.5)
    expected = surface_colours([SPOT_LIT, SPOT_UNLIT, SPOT_UNLIT, SPOT_LIT, SPOT_UNLIT])
    dots = part.dots
    assert (dots.batched_colors == expected).all()
    places = dots.batched_positions + dots.position
    assert places[:, 0] == pytest.approx([-1.3, -1.15, -1.0, -0.85, -0.7])
    assert places[:, 1] == pytest.approx(-3.5)
    assert places[:, 2].min() > 1.0
    part.draw([], height=1.5)
    assert dots._impl.removed
