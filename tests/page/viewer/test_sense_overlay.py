"""Sensor overlays are drawn on the pages that show the sensor's agent."""

from dataclasses import replace

import numpy as np
import pytest

from ai4u_edu import (
    BasicAgent,
    BearingSensor,
    BoxShape,
    CircleShape,
    ControlRequestor,
    GroupTouchSensor,
    LinearRayCastingSensor,
    LocalBrain,
    LocalGridSensor,
    PositionSensor,
    VelocitySensor,
    World,
)
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.page.viewer.scene.sense_overlay import RING_RADIUS, pointer
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot.block_info import SensorInfo
from tests.page.viewer.pages import Page, page, publish, shown
from tests.waiting import until


def two() -> ControlRequestor:
    world = World(seed=1)
    world.add_area("home", BoxShape(size=(2, 2)), position=(-4, 0))
    world.add_body("robot", CircleShape(radius=0.4), tags=("toy",))  # no toy of its own
    world.add_body("other", CircleShape(radius=0.4), position=(0, 3))
    world.add_body("box", CircleShape(radius=0.5), position=(3, 0), tags=("toy",))
    world.add_body("ball", CircleShape(radius=0.2), position=(0, -3), tags=("toy",))
    sensors = [
        LinearRayCastingSensor(perception_key="fan", number_of_rays=3),
        BearingSensor(target="box"),
        GroupTouchSensor(group="toy"),
        PositionSensor(target="home"),
        LocalGridSensor(perception_key="map", width=8, height=4, cell_size=0.5, channels=["toy"]),
        VelocitySensor(),
    ]
    still = LocalBrain(controller=lambda _percept: {})
    first = BasicAgent(body="robot", id="0", sensors=sensors, brains=[still])
    second = BasicAgent(body="other", id="1", brains=[LocalBrain(controller=lambda _percept: {})])
    return ControlRequestor(world, [first, second])


@pytest.fixture
def runner() -> Runner:
    return Runner(two(), seed=1)


def senses(runner: Runner) -> dict[str, SensorInfo]:
    return {sense.key: sense for sense in runner.latest.agents[0].sensor_infos}


def test_only_sensors_with_something_to_show_have_a_button(runner: Runner) -> None:
    agent = runner.latest.agents[0]
    seen = {key for key, sense in senses(runner).items() if agent.is_drawable(sense)}
    assert seen == {"fan", "bearing", "group_touch", "position", "map"}


def test_a_target_has_a_ring_and_a_line_that_ends_at_it(runner: Runner) -> None:
    body = runner.latest.bodies[0]
    ring, line = pointer(runner.latest, body, senses(runner)["bearing"])
    distances = np.hypot(ring[..., 0] - 3, ring[..., 1])
    assert distances == pytest.approx(np.full(distances.shape, 0.5 * RING_RADIUS))
    assert line[0, 0, :2] == pytest.approx([0, 0])
    assert line[0, 1, :2] == pytest.approx([3 - 0.5 * RING_RADIUS, 0])


def test_all_of_a_group_are_pointed_at(runner: Runner) -> None:
    marks = pointer(runner.latest, runner.latest.bodies[0], senses(runner)["group_touch"])
    assert len(marks) == 4  # a ring and a line for the box and the ball


def test_paint_is_outlined_only_if_a_sensor_names_it(runner: Runner) -> None:
    sim = two()
    for number in (0, 1):
        sim.world.add_area(
            f"line {number}",
            BoxShape(size=(1, 0.2)),
            position=(number, -4),
            tags=("toy",),
            paint=True,
        )
    painted, body = Runner(sim, seed=1).latest, runner.latest.bodies[0]
    of_group = senses(runner)["group_touch"]
    assert len(pointer(painted, body, of_group)) == len(pointer(runner.latest, body, of_group))
    named = replace(senses(runner)["position"], targets=("line 0",))
    assert len(pointer(painted, body, named)) == 2


def test_an_area_is_outlined(runner: Runner) -> None:
    outline, line = pointer(runner.latest, runner.latest.bodies[0], senses(runner)["position"])
    assert sorted({(round(x), round(y)) for x, y in outline[:, 0, :2]}) == [
        (-5, -1),
        (-5, 1),
        (-3, -1),
        (-3, 1),
    ]
    assert line[0, 1, :2] == pytest.approx([-4, 0])


def test_what_a_picture_from_above_shows_is_framed_and_turns(runner: Runner) -> None:
    runner.sim.agents[0].body.move_to(1.0, 0.0, heading=np.pi / 2)
    publish(runner)
    (frame,) = pointer(runner.latest, runner.latest.bodies[0], senses(runner)["map"])
    corners = sorted({(round(x), round(y)) for x, y in frame[:, 0, :2]})
    assert corners == [(-1, -1), (-1, 1), (3, -1), (3, 1)]


def own_nodes(viewer: Viewer, here: int = 0) -> set[str]:
    """Return the names of the scene nodes that exist on one page only."""
    client = sorted(viewer.server.get_clients().items())[here][1]
    names = client.scene._handle_from_node_name
    return {name.rstrip("/") for name, each in names.items() if getattr(each, "visible", True)}


def test_each_page_shows_the_agent_that_it_looks_at(viewer: Viewer) -> None:
    with page(viewer), page(viewer, "1"):
        until(lambda: len(viewer.server.get_clients()) == 2)
        shown(viewer)
        assert "/rays1/lines" in own_nodes(viewer, 0)
        assert not {each for each in own_nodes(viewer, 1) if "trails" not in each}


def test_a_sensor_lights_up_at_a_click_and_goes_out_again(viewer: Viewer) -> None:
    with page(viewer):
        shown(viewer)
        (viewer_client,) = viewer.viewer_clients.values()
        assert "/pointers" not in own_nodes(viewer)
        viewer_client.show_sensor("bearing", True)
        shown(viewer)
        assert "/pointers" in own_nodes(viewer)
        viewer_client.show_sensor("bearing", False)
        viewer_client.show_sensor("fan", False)
        shown(viewer)
        assert "/pointers" not in own_nodes(viewer)
        assert "/rays1/lines" not in own_nodes(viewer)
        viewer_client.agent = "1"
        viewer_client.agent = "0"
        shown(viewer)
        assert not viewer_client.shows_sensor("fan", is_default=True)  # it stays as it was chosen


def test_fallen_agent_has_no_rays(viewer: Viewer, runner: Runner) -> None:
    with page(viewer):
        shown(viewer)
        assert "/rays1/lines" in own_nodes(viewer)
        runner.sim.world["robot"].fallen = True
        publish(runner)
        shown(viewer)
        assert "/rays1/lines" not in own_nodes(viewer)


def test_another_stage_is_drawn_anew(viewer: Viewer, runner: Runner) -> None:
    with page(viewer):
        shown(viewer)
        runner.sim.world.add_body("late", CircleShape(radius=3), position=(20, 0), tags=("new",))
        publish(runner)
        shown(viewer)
        assert {"/rays0/lines", "/rays0/dots"} <= own_nodes(viewer)
        assert "/rays1/lines" not in own_nodes(viewer)


def test_a_page_that_is_gone_is_forgotten(viewer: Viewer) -> None:
    with page(viewer) as here:
        assert isinstance(here, Page)
        shown(viewer)
    until(lambda: not viewer.server.get_clients())
    shown(viewer)
    assert not viewer.viewer_clients
