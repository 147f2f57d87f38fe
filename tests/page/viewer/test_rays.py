import numpy as np
import pytest

from ai4u_edu.base.colors import rgb
from ai4u_edu.blocks import RayPicture
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.page.viewer.scene.light import line_colours, surface_colours
from ai4u_edu.page.viewer.scene.sense_overlay import (
    Rays,
    RayStyle,
    ray_dots,
    ray_lines,
    weight_colours,
)
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot.theme import RAY_MISS, WALL, group_colours

PICTURE = RayPicture(
    origin=(0.0, 0.0, 0.5),
    ends=np.array([[4.0, 0.0, 0.5], [0.0, 3.0, 0.5], [0.0, 0.0, 0.5]]),
    groups=("target", "", "?"),
)


def test_a_line_runs_from_the_eye_to_the_end_of_each_ray() -> None:
    lines = ray_lines(PICTURE)
    assert lines.shape == (3, 2, 3)
    assert (lines[:, 0] == (0.0, 0.0, 0.5)).all()
    assert (lines[:, 1] == PICTURE.ends).all()


def test_ray_dot_touches_the_hit_surface_from_outside() -> None:
    dots = ray_dots(ray_lines(PICTURE).astype(np.float32), 0.1)
    assert dots[0] == pytest.approx([3.9, 0.0, 0.5])
    assert np.isfinite(dots).all()  # a ray of no length has its dot at the eye


@pytest.fixture
def rays(viewer: Viewer) -> Rays:
    return Rays(viewer.server.scene, RayStyle(viewer.runner.latest.static_scene))


def test_rays_have_the_colours_of_what_they_met(rays: Rays, runner: Runner) -> None:
    fan = runner.latest.agents[0].rays["fan"]
    assert set(fan.groups) == {"target", "wall", ""}
    rays.draw([fan])
    colours = {"": RAY_MISS, "target": rgb("orange"), "wall": WALL}
    expected = [colours[group] for group in fan.groups]
    assert (rays.lines.colors[:, 0] == line_colours(expected)).all()
    assert (rays.dots.batched_colors == surface_colours(expected)).all()
    assert rays.dots.batched_scales is not None
    assert rays.dots.batched_scales.tolist() == [float(group != "") for group in fan.groups]


def test_rays_are_drawn_around_the_eye(viewer: Viewer, rays: Rays) -> None:
    ends = np.array([[4.0, 1.0, 0.5], [1.0, 5.0, 0.5]])
    rays.draw([RayPicture((1.0, 1.0, 0.5), ends, ("target", ""))], heading=np.pi / 2)
    node = viewer.server.scene.get_handle_by_name("/rays1")
    assert node is not None
    assert node.position[:2] == pytest.approx([1.0, 1.0])
    assert rays.lines.points[:, 0] == pytest.approx(np.zeros((2, 3)))
    assert rays.lines.points[:, 1] == pytest.approx(np.array([[0, -3, 0], [4, 0, 0]]), abs=1e-6)
    assert node.wxyz == pytest.approx([np.cos(np.pi / 4), 0.0, 0.0, np.sin(np.pi / 4)])


def test_more_and_fewer_rays(rays: Rays, runner: Runner) -> None:
    for count in (1, 3, 0, 2):
        few = RayPicture(PICTURE.origin, PICTURE.ends[:count], PICTURE.groups[:count])
        rays.draw([few])
        if count:
            assert rays.lines.points.shape == (count, 2, 3)
    lines = rays.lines
    rays.build(RayStyle(runner.latest.static_scene))
    rays.draw([few])
    assert lines._impl.removed
    assert not rays.lines._impl.removed
    rays.draw(())
    assert rays.lines._impl.removed


def test_every_group_of_the_stage_has_a_colour(viewer: Viewer) -> None:
    static_scene = viewer.runner.latest.static_scene
    assert {"agent", "target", "wall", "floor"} <= group_colours(static_scene).keys()


def test_rays_are_coloured_by_how_much_they_matter(rays: Rays) -> None:
    ends = np.array([[3.0, 1.0, 0.5], [1.0, 4.0, 0.5]])
    pair = RayPicture((1.0, 1.0, 0.5), ends, ("target", ""))
    rays.draw([pair, pair])
    by_group = rays.lines.colors.copy()
    rays.draw([pair, pair], weights=[None, np.array([0.0, 1.0])])
    assert np.array_equal(rays.lines.colors[:2], by_group[:2])
    expected = line_colours(weight_colours(np.array([0.0, 1.0])))
    assert np.array_equal(rays.lines.colors[2:, 0], expected)
    rays.draw([pair, pair])
    assert np.array_equal(rays.lines.colors, by_group)
