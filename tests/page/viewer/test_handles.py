"""Handles to move, rotate and resize things, on a page without a browser."""

import math
from collections.abc import Iterator
from concurrent.futures import Future
from typing import Any

import pytest

from ai4u_edu.page.editing import ChangeResult
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.page.viewer.scene.drags import Drag, DragAction, Goal
from ai4u_edu.page.viewer.scene.handles import Handles
from ai4u_edu.world import AreaDescription, BodyDescription, BoxShape, CapsuleShape
from tests.page.editing.harness import EditorHarness
from tests.page.viewer.pages import Page, page, publish, shown
from tests.waiting import LIMIT_S, until

AREA = {"name": "home", "shape": {"type": "box", "size": [2, 2]}, "position": [0, 4]}
LAMP = {
    "name": "lamp",
    "shape": {"type": "circle", "radius": 0.3},
    "position": [4, 4],
    "tags": ["lamp"],
    "kind": "static",
}


class HandledPage:
    """A page whose handles are switched on, with a thing chosen."""

    def __init__(self, viewer: Viewer, here: Page, harness: EditorHarness) -> None:
        self._viewer, self._here, self._harness = viewer, here, harness
        shown(viewer)
        (client,) = viewer.viewer_clients.values()
        self.chosen = ""
        self.others: tuple[str, ...] = ()
        self.results: list[Future[ChangeResult]] = []
        self.handles = Handles(client, harness.editor, self._choose, self.results.append)
        self._owner = client.client.scene._owner_id
        self.draw()

    def _choose(self, name: str) -> None:
        self.chosen = name

    def draw(self) -> None:
        publish(self._harness.runner)
        self.handles.draw(self._harness.runner.latest, self.chosen, self.others, on=True)

    def choose(self, name: str) -> None:
        self.chosen = name
        self.draw()

    def click(self, node: str, instance: int) -> None:
        self._here.click(node, instance, owner=self._owner)

    def drag(
        self, node: Any, *path: tuple[float, float], key: str | None = None, instance: int = 0
    ) -> None:
        """Drag a node along a path, and wait until the change is made."""
        count = len(self.results)
        phases = ["start", *["update"] * (len(path) - 1), "end"]
        for phase, place in zip(phases, (*path, path[-1]), strict=True):
            self._here.say(
                "SceneNodeDragMessage",
                phase=phase,
                name=node if isinstance(node, str) else node.name,
                instance_index=instance,
                start_position=(*path[0], 1.0),
                start_screen_pos=(0.5, 0.5),
                end_position=(*place, 1.0),
                end_screen_pos=(0.5, 0.5),
                button="left",
                modifier=key,
                owner=self._owner,
            )
        until(lambda: len(self.results) > count)
        self.results[-1].result(LIMIT_S)
        self.draw()


@pytest.fixture
def handled(harness: EditorHarness) -> Iterator[HandledPage]:
    harness.editor.add_region(AREA, "areas").result(LIMIT_S)
    harness.editor.add_body(LAMP).result(LIMIT_S)
    viewer = Viewer(harness.runner, editor=harness.editor)
    with page(viewer) as here:
        yield HandledPage(viewer, here, harness)
    viewer.stop()


def thing(harness: EditorHarness, name: str) -> Any:
    return next(each for each in harness.editor.state.description.things if each.name == name)


@pytest.mark.parametrize(
    ("key", "snap", "place"),
    [(None, 0.5, (3.0, -3.0)), ("alt", 0.5, (3.1, -2.9)), (None, 0.0, (3.1, -2.9))],
)
def test_bodies_snap_to_the_grid_unless_alt_is_held(
    handled: HandledPage,
    harness: EditorHarness,
    key: str | None,
    snap: float,
    place: tuple[float, float],
) -> None:
    handled.handles.snap_m = snap
    handled.drag(handled.handles.node, (4, 0), (3.6, -1), (3.1, -2.9), key=key, instance=1)
    assert harness.world["box"].position == pytest.approx(place)
    assert handled.chosen == "box"


def test_lamps_and_agents_are_moved_and_resized_too(
    handled: HandledPage, harness: EditorHarness
) -> None:
    handled.drag(handled.handles.node, (4, 4), (2, 4), instance=3)
    assert harness.world["lamp"].position == (2, 4)
    handled.drag(handled.handles.node, (0, 0), (0, -3), instance=0)
    assert harness.world["robot"].position == (0, -3)
    handled.choose("robot")
    handled.drag(handled.handles.knobs[DragAction.RESIZE], (0.3536, -2.6464), (0, -3.8))
    assert thing(harness, "robot").shape.radius == 0.8
    assert harness.editor.undo_label == "resize robot"


def test_an_area_is_chosen_by_a_click_and_moved_turned_and_resized(
    handled: HandledPage, harness: EditorHarness
) -> None:
    handles = handled.handles
    handled.click(handles.region_node, 1)  # the floor comes first
    until(lambda: handled.chosen == "home")
    handled.draw()

    handles.snap_m = 0.5
    handled.drag(handles.chosen_plate, (0.2, 4.2), (1, 3), (2.3, 2.2))
    assert thing(harness, "home").position == (2, 2)
    assert harness.world.areas["home"].contains(2.9, 2.9)

    handled.drag(handles.knobs[DragAction.TURN], (3.5, 2), (2, 5))
    assert thing(harness, "home").heading_deg == 90

    handled.drag(handles.knobs[DragAction.RESIZE], (1, 3), (0.4, 2.9))  # turned: across is along x
    assert thing(harness, "home").shape.size == (2, 2.5)
    assert thing(harness, "home").position == (1.75, 2)
    for label in ("resize home", "move home", "move home"):
        assert harness.editor.undo_label == label
        harness.editor.undo().result(LIMIT_S)
    assert thing(harness, "home").position == (0, 4)


def test_sides_and_height_have_knobs_of_their_own(
    handled: HandledPage, harness: EditorHarness
) -> None:
    handled.choose("box")
    knob = handled.handles.knobs[DragAction.LENGTH]
    (x, y), (length, width) = harness.world["box"].position, thing(harness, "box").shape.size
    handled.drag(knob, (x + length, y), (x + length + 0.5, y + 3))
    assert thing(harness, "box").shape.size == (length + 0.5, width)
    x += 0.25  # the left side stays where it is
    assert harness.world["box"].position == pytest.approx((x, y))
    assert thing(harness, "box").position == pytest.approx((x, y))
    assert harness.editor.undo_label == "resize box"
    handled.draw()
    handled.drag(handled.handles.knobs[DragAction.HEIGHT], (x - 1, y), (x - 1, y + 0.72))
    assert thing(harness, "box").height == pytest.approx(1.7)
    assert harness.editor.undo_label == "change box"
    handled.choose("lamp")  # a circle has no sides, an area no height
    assert handled.handles.knobs.keys() == {DragAction.TURN, DragAction.RESIZE, DragAction.HEIGHT}
    handled.choose("home")
    assert DragAction.HEIGHT not in handled.handles.knobs


def test_a_dragged_thing_takes_along_what_is_chosen_with_it(
    handled: HandledPage, harness: EditorHarness
) -> None:
    handled.chosen, handled.others = "lamp", ("box", "home")
    handled.draw()
    handled.drag(handled.handles.node, (4, 0), (3, -1), (2, -2), instance=1)
    assert (handled.chosen, handled.others) == ("lamp", ("box", "home"))
    assert harness.world["box"].position == (2, -2)
    assert harness.world["lamp"].position == (2, 2)
    assert thing(harness, "home").position == (-2, 2)
    assert harness.editor.undo_label == "move 3 things"
    harness.editor.undo().result(LIMIT_S)
    assert harness.world["lamp"].position == (4, 4)
    assert thing(harness, "home").position == (0, 4)


def test_a_floor_is_resized(handled: HandledPage, harness: EditorHarness) -> None:
    handled.choose("plate")
    handled.drag(handled.handles.knobs[DragAction.RESIZE], (6, 6), (8, 7))
    assert thing(harness, "plate").shape.size == (14, 13)
    assert thing(harness, "plate").position == (1, 0.5)
    assert harness.world.ground(7.5, 6.5) == 0
    assert harness.world.ground(-5.9, -5.9) == 0


def test_a_place_where_it_can_not_stand_is_refused(
    handled: HandledPage, harness: EditorHarness
) -> None:
    handled.choose("lamp")
    with pytest.raises(Exception, match="overlap"):
        handled.drag(handled.handles.knobs[DragAction.RESIZE], (4.2, 4.2), (4, 0))
    assert thing(harness, "lamp").shape.radius == 0.3


def test_goals() -> None:
    body = BodyDescription(name="wall", shape=BoxShape(size=(2, 1)), heading_deg=90)
    area = AreaDescription(name="area", shape=CapsuleShape(length=2, radius=0.5))
    move = Drag(body, DragAction.MOVE, 0.5, 0.0)
    assert move.is_live
    assert move.goal(1.26, 2.1, 0.5) == Goal(2.0, 2.0, None)
    assert move.goal(1.2609, 2.1, 0.5, is_free=True) == Goal(1.761, 2.1, None)
    assert move.goal(math.nan, 0) is None
    assert move.goal(1e7, 0) is None
    turn = Drag(area, DragAction.TURN, 1.0, 1.0)
    assert not turn.is_live
    assert turn.goal(1.0, 5.0) == Goal(1.0, 1.0, 90.0)
    assert turn.goal(2.0, 1.07, is_free=True) == Goal(1.0, 1.0, 4.0)
    size = Drag(body, DragAction.RESIZE, 0.0, 0.0, math.pi / 2)
    resized = size.goal(-0.2, 3.0)
    assert resized is not None
    assert resized.shape == BoxShape(size=(4, 0.7))
    assert resized.words == "4 x 0.7 m"
    assert (resized.x, resized.y) == (0.15, 1.0)  # turned to the left; its other corner stays
    pulled = Drag.start(body, DragAction.WIDTH, (0.0, 0.0, 0.0), 0.3, 0.6).goal(2.0, 0.9)
    assert pulled is not None
    assert pulled.shape == BoxShape(size=(2, 1.3))
    assert (pulled.x, pulled.y) == (0.0, 0.15)
    higher = Drag.start(body, DragAction.HEIGHT, (0.0, 0.0, 0.0), -1.5, 0.2).goal(-1.5, -9.0)
    assert higher is not None
    assert (higher.height, higher.words) == (0.1, "0.1 m high")
    stick = Drag(area, DragAction.RESIZE, 0.0, 0.0).goal(3.0, 1.0)
    assert stick is not None
    assert stick.shape == CapsuleShape(length=3, radius=0.75)
    assert (stick.x, stick.y) == (0.75, 0.25)
