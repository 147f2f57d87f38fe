"""Bodies that come, go and are moved in a running world."""

import math
from functools import partial
from typing import Any, ClassVar

import pytest
from gymnasium.spaces import Box

from ai4u_edu import Scene, Sensor
from ai4u_edu.base.errors import BlockError, WorldError
from ai4u_edu.page.editing import ChangeError
from ai4u_edu.page.editing.proposals import NewThing
from tests.page.editing.harness import EditorHarness, trace


@pytest.fixture
def harness() -> EditorHarness:
    harness = EditorHarness()
    harness.tick(5)
    return harness


def test_a_body_is_put_somewhere_now_and_for_later(harness: EditorHarness) -> None:
    robot = harness.world["robot"].pose
    outcome = harness.done(harness.editor.move_body("wall", -2, 3, 90))
    assert (outcome.when, outcome.label, outcome.note) == ("now", "move wall", "")
    x, y, z, heading = harness.world["wall"].pose
    assert (x, y, z, heading) == pytest.approx((-2, 3, 0, math.pi / 2))
    assert harness.world["robot"].pose == robot
    assert harness.world.ticks == 5
    harness.done(harness.runner.reset(seed=2))
    assert harness.world["wall"].position == (-2, 3)


def test_moved_body_is_sensed_at_once(harness: EditorHarness) -> None:
    before = (
        harness.agent.percept["bearing"][-1].tolist(),
        harness.agent.percept["bearing"][:-1].tolist(),
    )
    harness.done(harness.editor.move_body("box", -3, 4))
    after = harness.agent.percept["bearing"]
    assert after[-1].tolist() != before[0]
    assert after[:-1].tolist() == before[1]


def test_undo_puts_it_back_where_it_was_taken_up(harness: EditorHarness) -> None:
    harness.world["box"].move_to(3, 3)  # it has rolled there
    harness.done(harness.editor.drag("box", 0, 4))
    harness.done(harness.editor.drag("box", 1, 4))
    assert harness.world["box"].position == (1, 4)
    harness.done(harness.editor.move_body("box", 2, 4))
    harness.done(harness.editor.undo())
    assert harness.world["box"].position == (3, 3)
    harness.done(harness.editor.redo())
    assert harness.world["box"].position == (2, 4)


def test_overlapping_move_is_undone(harness: EditorHarness) -> None:
    x, y = -3, 4
    harness.world["robot"].move_to(x, y)
    harness.done(harness.editor.drag("box", x, y))
    with pytest.raises(WorldError, match="it would overlap body 'robot'; choose another place"):
        harness.done(harness.editor.move_body("box", x, y))
    assert harness.world["box"].position == (4, 0)
    assert harness.editor.undo_label == ""
    assert harness.editor.scene == harness.scene
    harness.tick(3)


def test_a_move_that_the_next_episode_could_not_begin_with_is_refused(
    harness: EditorHarness,
) -> None:
    harness.world["robot"].move_to(0, -4)
    with pytest.raises(ChangeError, match=r"where all begin, .* overlaps body 'robot'"):
        harness.done(harness.editor.move_body("box", 0, 0.3))
    assert harness.world["box"].position == (4, 0)


def test_one_that_was_pushed_about_stays_when_it_is_changed(harness: EditorHarness) -> None:
    harness.world["box"].move_to(3, 3)
    harness.world["box"].set_velocity(1, 0)
    harness.done(harness.editor.change_body("box", {"mass": 3, "colour": "purple"}))
    box = harness.world["box"]
    assert (box.position, box.velocity, box.description.mass) == ((3, 3), (1, 0), 3)
    static_scene = harness.runner.latest.static_scene
    assert [body.colour for body in static_scene.bodies if body.name == "box"] == ["purple"]
    harness.done(harness.runner.reset())
    assert harness.world["box"].position == (4, 0)


def test_several_bodies_make_room_for_each_other(harness: EditorHarness) -> None:
    shape = {"type": "box", "size": [1, 1]}
    boxes = [
        NewThing({"name": f"row {n}", "position": [n, 3], "shape": shape}, "bodies")
        for n in range(3)
    ]
    assert harness.done(harness.editor.add_things(boxes)).when == "now"
    assert harness.editor.undo_label == "add 3 things"
    goals = {f"row {n}": (n + 1.0, 3.0, None) for n in range(3)}
    assert harness.done(harness.editor.move_things(goals)).when == "now"
    assert [harness.world[f"row {n}"].position[0] for n in range(3)] == [1, 2, 3]
    swapped = {"row 0": (2.0, 3.0, None), "row 1": (1.0, 3.0, None)}
    assert harness.done(harness.editor.move_things(swapped)).when == "next reset"
    assert harness.done(harness.editor.remove_things(["row 0", "row 2"])).when == "now"
    for _ in range(4):
        harness.done(harness.editor.undo())
    assert "row 1" not in harness.world.bodies
    taken = {"box": (0.0, 3.0, None), "wall": (0.0, 3.0, None)}
    with pytest.raises((ChangeError, WorldError), match="overlap"):
        harness.done(harness.editor.move_things(taken))
    assert harness.world["box"].position == (4, 0)


def test_add_and_remove(harness: EditorHarness) -> None:
    name = harness.editor.free_names(["box"])[0]
    assert name == "box 2"
    harness.done(harness.editor.add_body({"name": name, "position": [0, 4], "kind": "static"}))
    assert harness.world["box 2"].position == (0, 4)
    assert "box 2" in [body.name for body in harness.runner.latest.static_scene.bodies]
    assert harness.done(harness.editor.remove_body("box 2")).when == "now"
    assert "box 2" not in harness.world.bodies
    harness.done(harness.editor.undo())
    assert harness.world["box 2"].position == (0, 4)
    harness.tick(5)


@pytest.mark.parametrize(
    ("body", "told"),
    [
        ({"name": "box"}, "name: something is named 'box' already; expected another name, such "),
        ({"name": "new", "mass": -1}, "mass: expected more than 0, got -1"),
        ({"name": "new", "shape": {"type": "circle", "radius": "x"}}, "shape.radius: expected a"),
        ({"name": "new", "position": [4.2, 0]}, "overlaps body 'box'"),
        ({"name": "new", "colur": "blue"}, "colur: unknown parameter; did you mean 'colour'?"),
    ],
)
def test_bad_bodies(harness: EditorHarness, body: dict[str, object], told: str) -> None:
    with pytest.raises(ChangeError) as error:
        harness.done(harness.editor.add_body(body))
    assert told in str(error.value)
    assert list(harness.world.bodies) == ["robot", "box", "wall"]


def test_the_world_is_full() -> None:
    harness = EditorHarness()
    description = harness.scene.description
    pole = description.bodies[2]
    poles = [
        pole.model_copy(update={"name": f"pole {n}", "position": (20.0 + n // 20, 2.0 * (n % 20))})
        for n in range(497)
    ]
    full = description.model_copy(update={"bodies": (*description.bodies, *poles)})
    harness.done(harness.editor.open(Scene(full)))
    with pytest.raises(ChangeError, match="the world is full; expected at most 500 bodies"):
        harness.done(harness.editor.add_body({"name": "one too many", "position": [0, -4]}))


def test_bodies_in_use_cannot_be_removed(harness: EditorHarness) -> None:
    with pytest.raises(ChangeError, match="it is the body of agent '0'; an agent needs its body"):
        harness.done(harness.editor.remove_body("robot"))
    with pytest.raises(
        ChangeError, match="TouchRewardFunc 'touch': no body or area is named 'box'"
    ):
        harness.done(harness.editor.remove_body("box"))
    assert "box" in harness.world.bodies
    harness.tick(3)


class Moody(Sensor):
    """Fits before the first tick; later only while it is in a good mood."""

    in_a_good_mood: ClassVar[bool] = True
    kind = "sfloat"

    def on_setup(self, agent: Any, view: Any) -> None:
        if view.ticks and not Moody.in_a_good_mood:
            raise BlockError("not now")

    def space(self) -> Box:
        return Box(0.0, 1.0, ())

    def read(self, body: Any, view: Any) -> float:
        return 0.0


@pytest.mark.parametrize("verb", ["remove", "change", "add"])
def test_change_that_fails_in_the_running_world_is_rolled_back(
    verb: str, harness: EditorHarness, monkeypatch: pytest.MonkeyPatch
) -> None:
    harness.done(harness.editor.add_block("0", "sensors", {"type": "Moody"}))
    before = {name: body.pose for name, body in harness.world.bodies.items()}
    monkeypatch.setattr(Moody, "in_a_good_mood", False)
    editor = harness.editor
    asked = {
        "remove": partial(editor.remove_body, "wall"),
        "change": partial(editor.change_body, "wall", {"position": [0, 4]}),
        "add": partial(editor.add_body, {"name": "ball", "position": [0, 4]}),
    }[verb]()
    with pytest.raises(BlockError, match="not now"):
        harness.done(asked)
    monkeypatch.setattr(Moody, "in_a_good_mood", True)
    assert {name: body.pose for name, body in harness.world.bodies.items()} == before
    assert harness.editor.undo_label == "add Moody"
    harness.tick(2)


def test_moving_a_respawning_body_gives_a_note() -> None:
    harness = EditorHarness(Scene.load("box_chase"))
    harness.tick(3)
    outcome = harness.done(harness.editor.move_body("robot", 1, 1))
    assert outcome.note == "its RespawnActuator puts 'robot' elsewhere at each reset"
    assert harness.world["robot"].position == (1, 1)


def test_one_that_is_moved_before_the_first_tick_stands_there() -> None:
    harness = EditorHarness(Scene.load("box_chase"))
    harness.done(harness.editor.move_body("robot", 1, 1))
    assert harness.world["robot"].position == (1, 1)
    harness.done(harness.editor.move_body("box", 3, -3))
    assert harness.world["box"].position == (3, -3)


def test_contacts_are_forgotten(harness: EditorHarness) -> None:
    harness.done(harness.editor.move_body("box", 1.2, harness.world["robot"].position[1]))
    harness.tick(60)
    view = harness.agent.view
    assert view.contacts(harness.world["robot"]) == ("box",)
    harness.done(harness.editor.move_body("box", -3, 4))
    assert view.contacts(harness.world["robot"]) == ()
    harness.tick(2)
    assert view.contacts(harness.world["robot"]) == ()


def test_height_is_right() -> None:
    harness = EditorHarness(
        Scene.loads(
            """
name: steps
floors:
  - {name: low, shape: {type: box, size: [20, 20]}}
  - {name: high, shape: {type: box, size: [4, 4]}, position: [8, 8], top: 1}
bodies:
  - {name: robot, shape: {type: circle, radius: 0.5}}
  - {name: box, shape: {type: box, size: [1, 1]}, position: [4, 0]}
agents:
  - body: robot
    actuators: [{type: RBMoveActuator}]
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""
        )
    )
    harness.tick(3)
    harness.done(harness.editor.move_body("box", 8, 8))
    box = harness.world["box"]
    assert (box.z, box.on_ground) == (1, True)
    harness.done(harness.editor.move_body("box", 3, 3))
    assert (box.z, box.on_ground) == (0, True)
    assert trace(harness.runner.sim, 1, 5) == trace(harness.editor.scene.build(), 1, 5)


def test_hands_may_not_be_mad(harness: EditorHarness) -> None:
    with pytest.raises(WorldError, match="expected finite numbers"):
        harness.done(harness.editor.drag("box", math.nan, 0))
    with pytest.raises(ChangeError, match="expected finite numbers"):
        harness.done(harness.editor.move_body("box", math.inf, 0))
    with pytest.raises(ChangeError, match=r"position\[0\]: expected at most 10000"):
        harness.done(harness.editor.move_body("box", 1e6, 0))
    assert harness.world["box"].position == (4, 0)
