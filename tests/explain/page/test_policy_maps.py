"""Maps over the floor and stand-ins, as a page gets them."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pytest

from ai4u_edu.explain import map_maker
from ai4u_edu.explain.elsewhere import Pose
from ai4u_edu.explain.live_maps import MapChoice
from ai4u_edu.explain.map_colours import value_colours
from ai4u_edu.explain.map_maker import LiveMap, MapRequest
from ai4u_edu.explain.page import ExplainOption, page_option
from ai4u_edu.explain.page.choice import OPTION, ExplainChoice
from ai4u_edu.explain.page.field_arrows import LEFT, RIGHT, STRAIGHT, arrow_colours, arrow_shapes
from ai4u_edu.explain.page.policy_maps import PageMaps, PolicyMaps
from ai4u_edu.explain.page.stand_in import StandIn, StandIns
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.runtime.replay_player import ReplayPlayer
from ai4u_edu.runtime.runner import Runner
from tests.explain.worlds import robot_and_box
from tests.page.viewer.pages import Page, page, part_of, publish, seen
from tests.waiting import until


def turns_to_box(percept: Any) -> Any:
    return {"move": [0.5, -percept["bearing"][0], 0, 0]}


@pytest.fixture
def runner() -> Runner:
    runner = Runner(robot_and_box(turns_to_box), seed=1)
    runner.paused = True
    publish(runner)
    return runner


@pytest.fixture
def option(runner: Runner) -> Iterator[ExplainOption]:
    option = page_option(runner, ReplayPlayer(runner))
    yield option
    option.stop()


@pytest.fixture
def viewer(runner: Runner, option: ExplainOption) -> Iterator[Viewer]:
    viewer = Viewer(runner, options=[option])
    yield viewer
    viewer.stop()


@pytest.fixture
def here(viewer: Viewer) -> Iterator[Page]:
    with page(viewer) as here:
        seen(viewer, lambda: viewer.viewer_clients)
        yield here


def test_arrows_point_where_it_goes_and_tell_the_side() -> None:
    moves = np.array([[0.2, 0, 0.1], [0, -0.1, -0.1], [0, 0, 0.5], [0.1, 0, 0], [np.nan] * 3])
    poses = np.zeros((5, 3))
    poses[2, 2] = 1.0
    told = LiveMap(MapRequest("0", "field"), poses=poses, moves=moves, cell=(1.0, 2.0))
    lengths, angles = arrow_shapes(told)
    assert angles[:4] == pytest.approx([0, -np.pi / 2, 1.5, 0])
    assert lengths[0] == pytest.approx(0.85)
    assert lengths[0] > lengths[1] == pytest.approx(lengths[3])
    assert lengths[2] > 0 == lengths[4]
    assert arrow_colours(told).tolist() == [
        list(LEFT),
        list(RIGHT),
        list(LEFT),
        *[list(STRAIGHT)] * 2,
    ]


def test_the_maps_that_a_page_has_chosen(
    viewer: Viewer, here: Page, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(map_maker, "CELLS", 36)
    monkeypatch.setattr(map_maker, "ROLLOUT_CELLS", 4)
    (client,) = viewer.viewer_clients.values()
    pages = part_of(viewer, PolicyMaps).pages
    assert not pages
    shown = MapChoice(has_field=True, has_values=True, facing="box")
    client.choices[OPTION] = ExplainChoice(maps=shown)

    def maps() -> PageMaps | None:
        return next(iter(pages.values()), None)

    def is_drawn() -> bool:
        found = maps()
        if found is None or found.arrows is None or found.cells is None:
            return False
        return bool(np.any(found.arrows.batched_scales) and np.all(found.cells.batched_scales))

    seen(viewer, is_drawn)
    found = maps()
    assert found is not None
    assert found.arrows is not None
    assert found.cells is not None
    assert found.arrows.batched_positions.shape == (36, 3)
    assert found.cells.batched_positions.shape == (4, 3)
    assert found.cells.batched_positions[:, 2].max() < found.arrows.batched_positions[:, 2].min()
    client.choices[OPTION] = ExplainChoice(maps=MapChoice(has_values=True))
    seen(viewer, lambda: found.arrows is None)
    client.choices[OPTION] = ExplainChoice()
    seen(viewer, lambda: found.cells is None)


def test_the_stand_in_is_dragged_and_turned(
    viewer: Viewer, here: Page, option: ExplainOption
) -> None:
    (client,) = viewer.viewer_clients.values()
    pages = part_of(viewer, StandIns).pages
    told: list[Pose] = []

    class Panel:
        def on_selected(self, body: str) -> None: ...
        def on_dropped(self, change: object) -> None: ...
        def send(self, message: Mapping[str, Any]) -> None:
            heading = math.radians(message["heading_deg"])
            told.append(Pose(message["x"], message["y"], heading))

    client.panel = Panel()
    tried = option.pose_trial.at("0", Pose(1.0, -1.0, 0.0))
    client.choices[OPTION] = ExplainChoice(elsewhere=tried)

    def stand_in() -> StandIn | None:
        return next(iter(pages.values()), None)

    seen(viewer, lambda: (found := stand_in()) is not None and found.pose == (1.0, -1.0, 0.0))
    found = stand_in()
    assert found is not None
    owner = client.client.scene._owner_id

    def drag(node: Any, *path: tuple[float, float]) -> None:
        phases = ["start", *["update"] * (len(path) - 1), "end"]
        for phase, place in zip(phases, (*path, path[-1]), strict=True):
            here.say(
                "SceneNodeDragMessage",
                phase=phase,
                name=node.name,
                instance_index=0,
                start_position=(*path[0], 0.5),
                start_screen_pos=(0.5, 0.5),
                end_position=(*place, 0.5),
                end_screen_pos=(0.5, 0.5),
                button="left",
                modifier=None,
                owner=owner,
            )

    drag(found.body, (1.1, -1.0), (2.0, 0.0), (3.1, 2.0))
    until(lambda: told and told[-1] == (3.0, 2.0, 0.0))
    seen(viewer, lambda: found.pose == (3.0, 2.0, 0.0))
    drag(found.knob, (3.6, 2.0), (3.0, 4.0))
    until(lambda: math.isclose(told[-1].heading, math.pi / 2, abs_tol=1e-3))
    assert told[-1][:2] == (3.0, 2.0)
    # the robot stays, and in a world that runs there is no stand-in
    assert viewer.runner.latest.bodies[0][1:3] == (0.0, 0.0)
    viewer.runner.paused = False
    publish(viewer.runner)
    seen(viewer, lambda: found.pose is None)


@pytest.mark.nightly
def test_colours_of_values_are_cividis() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    shares = np.linspace(0, 1, 101)
    wanted = 255 * matplotlib.colormaps["cividis"](shares)[:, :3]
    assert np.abs(value_colours(7 - 3 * shares[::-1]) - wanted).max() < 8
    assert value_colours(np.array([np.nan, 2.0, 2.0])).shape == (3, 3)
