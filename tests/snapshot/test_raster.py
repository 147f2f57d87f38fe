"""Pictures without a browser."""

from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

from ai4u_edu.base.colors import rgb
from ai4u_edu.snapshot import Snapshot, Stages
from ai4u_edu.snapshot.marks import CHASSIS, DARK, LIGHT, TREAD
from ai4u_edu.snapshot.raster import MARGIN_M, draw_snapshot
from ai4u_edu.snapshot.theme import FLOOR, VOID, mix_colours
from tests.page.viewer.worlds import busy_sim, picture

Picture = npt.NDArray[np.uint8]


@pytest.fixture
def snapshot() -> Snapshot:
    sim = busy_sim()
    sim.reset(1)
    return picture(sim)


def colour_at(drawn: Picture, snapshot: Snapshot, x: float, y: float) -> tuple[int, ...]:
    """Return the colour of a place in the world."""
    (left, _), (right, high) = snapshot.static_scene.bounds
    scale = drawn.shape[1] / (right - left + 2 * MARGIN_M)
    row, column = int((high + MARGIN_M - y) * scale), int((x - left + MARGIN_M) * scale)
    return tuple(drawn[row, column].tolist())


def test_faces_and_rings_are_those_of_the_page(snapshot: Snapshot) -> None:
    drawn = draw_snapshot(snapshot, longest=2000)
    robot, box = snapshot.bodies[:2]
    assert colour_at(drawn, snapshot, robot.x + 0.4 * 0.7, robot.y) == LIGHT
    # a light nose on the rim would look like a notch
    assert colour_at(drawn, snapshot, robot.x + 0.4 * 0.945, robot.y) == CHASSIS
    assert colour_at(drawn, snapshot, robot.x + 0.4 * 0.48, robot.y + 0.4 * 0.29) == DARK
    assert colour_at(drawn, snapshot, robot.x + 0.4 * 0.22, robot.y + 0.4 * 0.29) == LIGHT
    assert colour_at(drawn, snapshot, robot.x - 0.2, robot.y) == rgb("blue")
    assert colour_at(drawn, snapshot, robot.x - 0.4 * 0.97, robot.y) == CHASSIS
    assert colour_at(drawn, snapshot, robot.x, robot.y + 0.4 * 0.8) == TREAD
    assert colour_at(drawn, snapshot, box.x + 0.5 * 0.6, box.y) == LIGHT
    assert colour_at(drawn, snapshot, box.x + 0.5 * 0.35, box.y) == rgb("orange")
    assert colour_at(drawn, snapshot, box.x, box.y) == LIGHT


def test_the_floor_has_a_grid_and_the_void_has_none(snapshot: Snapshot) -> None:
    drawn = draw_snapshot(snapshot, longest=2000)
    on_line = min(colour_at(drawn, snapshot, -4.0 + 0.004 * step, -4.5) for step in range(-3, 4))
    assert mix_colours(FLOOR, VOID, 0.12) <= on_line < mix_colours(FLOOR, VOID, 0.05)
    assert colour_at(drawn, snapshot, -4.3, -4.5) == FLOOR
    (left, low), _ = snapshot.static_scene.bounds
    assert colour_at(drawn, snapshot, left - 0.5, low - 0.5) == VOID


def test_an_area_that_was_passed_is_filled(snapshot: Snapshot) -> None:
    names = ("goal", "box")
    agent = snapshot.agents[0]._replace(stages=(Stages(1, 2, names, names[1:], names[1:]),))
    passed = replace(snapshot, agents=(agent,))
    before, after = (draw_snapshot(each, longest=2000) for each in (snapshot, passed))
    assert colour_at(before, snapshot, 3.0, 3.7) != colour_at(after, passed, 3.0, 3.7)
    assert (draw_snapshot(snapshot, longest=2000) == before).all()


def test_labels_are_half_transparent_and_small_pictures_have_none(snapshot: Snapshot) -> None:
    def without(name: str) -> Snapshot:
        static_scene = snapshot.static_scene
        areas: Any = tuple(
            area.model_copy(update={"label": " "}) if area.name == name else area
            for area in static_scene.areas
        )
        return replace(snapshot, static_scene=replace(static_scene, areas=areas))

    for longest, has_labels in ((640, True), (200, False)):
        drawn, plain = (
            draw_snapshot(each, longest=longest) for each in (snapshot, without("goal"))
        )
        differs = (drawn != plain).any(axis=2)
        assert differs.any() == has_labels
        if has_labels:
            rows, columns = np.nonzero(differs)
            assert 12 <= np.ptp(rows) <= 30
            assert 40 <= np.ptp(columns) <= 80


def test_a_label_that_would_cover_an_agent_s_is_left_out_and_none_is_cut(
    snapshot: Snapshot,
) -> None:
    static_scene, robot = snapshot.static_scene, snapshot.bodies[0]
    (left, _), _ = static_scene.bounds

    def drawn(x: float, y: float, label: str) -> Picture:
        """Draw an area with a label, in a picture with room for labels."""
        (area,) = static_scene.areas[:1]
        areas = (area.model_copy(update={"label": label, "position": (x, y)}),)
        there = replace(static_scene, areas=areas)
        return draw_snapshot(replace(snapshot, static_scene=there), longest=640)

    below = robot.y - 0.6
    assert (drawn(robot.x, below, "a field") == drawn(robot.x, below, " ")).all()
    differs = drawn(left - 0.5, 0.0, "a long label") != drawn(left - 0.5, 0.0, " ")
    columns = np.nonzero(differs.any(axis=2))[1]
    assert np.ptp(columns) > 60  # of which half would lie beyond the edge


def test_a_ground_that_is_kept_is_the_same(snapshot: Snapshot) -> None:
    first = draw_snapshot(snapshot)
    assert (draw_snapshot(snapshot) == first).all()
    other = busy_sim()
    other.world.add_area("late", other.world.areas["goal"].description.shape, position=(-3, -3))
    other.reset(1)
    assert (draw_snapshot(picture(other)) != first).any()
    assert (draw_snapshot(snapshot) == first).all()
