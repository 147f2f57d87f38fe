from dataclasses import replace

import numpy as np
import pytest

from ai4u_edu.blocks import RayPicture
from ai4u_edu.look import NOTHING, WALL, group_colours
from ai4u_edu.palette import rgb
from ai4u_edu.viewer import Viewer
from ai4u_edu.viewer.light import strokes, surfaces
from ai4u_edu.viewer.rays import Rays, ray_dots, ray_lines
from tests.viewer.worlds import busy_sim, picture

PICTURE = RayPicture(
    origin=(0.0, 0.0, 0.5),
    ends=np.array([[4.0, 0.0, 0.5], [0.0, 3.0, 0.5], [0.0, 0.0, 0.5]]),
    groups=("target", "", "?"),
)


def everybody() -> set[str]:
    return {"0"}


def test_a_line_runs_from_the_eye_to_the_end_of_each_ray() -> None:
    lines = ray_lines(PICTURE)
    assert lines.shape == (3, 2, 3)
    assert (lines[:, 0] == (0.0, 0.0, 0.5)).all()
    assert (lines[:, 1] == PICTURE.ends).all()


def test_a_dot_touches_what_was_met_from_outside() -> None:
    dots = ray_dots(ray_lines(PICTURE).astype(np.float32), 0.1)
    assert dots[0] == pytest.approx([3.9, 0.0, 0.5])
    assert np.isfinite(dots).all()  # a ray of no length has its dot at the eye


def test_rays_have_the_colours_of_what_they_met(viewer: Viewer) -> None:
    sim = busy_sim()
    sim.reset(seed=1)
    snapshot = picture(sim)
    groups = snapshot.agents[0].rays["fan"].groups
    assert set(groups) == {"target", "wall", ""}
    rays = Rays(viewer.server, everybody)
    rays.build(snapshot.stage)
    rays.draw(snapshot)
    colours = {"": NOTHING, "target": rgb("orange"), "wall": WALL}
    expected = [colours[group] for group in groups]
    assert (rays._lines.colors[:, 0] == strokes(expected)).all()
    assert (rays._dots.batched_colors == surfaces(expected)).all()
    assert rays._dots.batched_scales is not None
    assert rays._dots.batched_scales.tolist() == [float(group != "") for group in groups]


def test_more_and_fewer_rays(viewer: Viewer) -> None:
    sim = busy_sim()
    sim.reset(seed=1)
    snapshot = picture(sim)
    rays = Rays(viewer.server, everybody)
    rays.build(snapshot.stage)
    for count in (1, 3, 0, 2):
        few = RayPicture(PICTURE.origin, PICTURE.ends[:count], PICTURE.groups[:count])
        agent = replace(snapshot.agents[0], rays={"eye": few})
        rays.draw(replace(snapshot, agents=(agent,)))
        if count:
            assert rays._lines.points.shape == (count, 2, 3)
    rays.shown = False
    rays.draw(snapshot)
    assert rays._lines._impl.removed


def test_who_fell_out_of_the_world_sees_nothing(viewer: Viewer) -> None:
    sim = busy_sim()
    sim.reset(seed=1)
    snapshot = picture(sim)
    first, *others = snapshot.bodies
    rays = Rays(viewer.server, everybody)
    rays.build(snapshot.stage)
    rays.draw(snapshot)
    rays.draw(replace(snapshot, bodies=(replace(first, fallen=True), *others)))
    assert rays._lines._impl.removed


def test_rays_of_an_agent_that_nobody_looks_at_are_not_drawn(viewer: Viewer) -> None:
    sim = busy_sim()
    sim.reset(seed=1)
    rays = Rays(viewer.server, lambda: {"another"})
    snapshot = picture(sim)
    rays.build(snapshot.stage)
    rays.draw(snapshot)
    assert rays._count == 0


def test_every_group_of_the_stage_has_a_colour(viewer: Viewer) -> None:
    stage = viewer.runner.latest.stage
    assert {"agent", "target", "wall", "floor"} <= group_colours(stage).keys()
