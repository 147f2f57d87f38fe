"""Comments of a scene file are still there when it is written again."""

from typing import Any

import pytest

from ai4u_edu import Scene
from ai4u_edu.scenes.yaml.file import write_yaml
from tests.page.editing.harness import EditorHarness

TEXT = """\
# A header of mine,
# of two lines.
name: small  # the name
title: "Mine"   # in quotes

# all that lies about
bodies:
  # the robot
  - name: robot     # it drives
    shape: {type: circle, radius: 0.5}
    # where it begins
    position: [0, 0]   # the middle
  # the box
  - {name: box, shape: {type: box, size: [1, 1]}, position: [3, 1]}  # on one line
    # further to the right

  # a wall
  - name: wall
    kind: static
    shape: {type: box, size: [0.4, 4]}
    position: [-4, 0]
# who acts
agents:
  - body: robot
    sensors:
      # it sees
      - {type: BearingSensor, target: wall}  # the wall
    actuators: [{type: RBMoveActuator, move_amount: 2}]
    brains:
      - type: LocalBrain
        skip_frame: 4    # as by default
        controller: {type: WASDRBMoveController}
# the end
"""
COMMENTS = [line[line.index("#") :] for line in TEXT.split("\n") if "#" in line]


def changed(**values: Any) -> str:
    """The text of the scene with other values, which is the same scene."""
    scene = Scene.loads(TEXT)
    scene.description = scene.description.model_copy(update=values)
    text = scene.dumps()
    assert Scene.loads(text) == scene
    return text


def comments_in(text: str) -> list[str]:
    return [line[line.index("#") :] for line in text.split("\n") if "#" in line]


BODIES = Scene.loads(TEXT).description.bodies
(AGENT,) = Scene.loads(TEXT).description.agents


def test_what_did_not_change_is_written_as_it_was(tmp_path: Any) -> None:
    scene = Scene.loads(TEXT)
    assert scene.dumps() == TEXT
    scene.save(tmp_path / "x.yaml")
    assert (tmp_path / "x.yaml").read_text() == TEXT
    for name in Scene.names():
        library = Scene.load(name)
        assert library.dumps() == library.source


def test_of_a_changed_value_all_comments_stay() -> None:
    robot = BODIES[0].model_copy(update={"position": (2.0, 2.5)})
    expected = TEXT.replace("position: [0, 0]", "position: [2.0, 2.5]")
    assert changed(bodies=(robot, *BODIES[1:])) == expected
    assert changed(title="Yours") == TEXT.replace('"Mine"', "Yours")
    assert changed(name="other") == TEXT.replace("name: small", "name: other")


def test_what_is_added_comes_behind_its_like() -> None:
    wall = BODIES[2].model_copy(update={"name": "wall 2", "position": (4.0, 0.0)})
    text = changed(bodies=(*BODIES, wall), goal="Go there.")
    assert comments_in(text) == COMMENTS
    assert text.index("name: wall\n") < text.index("name: wall 2") < text.index("# who acts")


@pytest.mark.parametrize(
    ("left", "lost"),
    [
        ((0, 2), ["# the box", "# on one line", "# further to the right"]),
        ((0, 1), ["# a wall"]),
        ((1, 2), ["# the robot", "# it drives", "# where it begins", "# the middle"]),
        ((0,), ["# the box", "# on one line", "# further to the right", "# a wall"]),
    ],
)
def test_what_is_removed_takes_its_own_comments_along(
    left: tuple[int, ...], lost: list[str]
) -> None:
    agents = ({**AGENT, "body": BODIES[left[0]].name, "sensors": []},)
    text = changed(bodies=tuple(BODIES[index] for index in left), agents=agents)
    gone = [*lost, "# it sees", "# the wall"]
    assert comments_in(text) == [each for each in COMMENTS if each not in gone]


def test_a_changed_line_of_an_entry_leaves_its_neighbours() -> None:
    agents = ({**AGENT, "sensors": [{"type": "HeadingSensor"}], "max_steps_per_episode": 5},)
    assert comments_in(changed(agents=agents)) == [
        each for each in COMMENTS if each not in ("# it sees", "# the wall")
    ]
    robot = BODIES[0].model_copy(update={"position": (0.0, 0.0), "mass": 3.0})
    assert comments_in(changed(bodies=(robot, *BODIES[1:]))) == COMMENTS


def test_a_text_that_is_written_in_an_odd_way_loses_no_data() -> None:
    import json

    plain = Scene.loads(TEXT).plain()
    for text in (
        json.dumps(plain),
        "---\n" + TEXT,
        TEXT.replace("bodies:\n", "bodies:\n\n\n"),
        TEXT.replace("  - name: robot     # it drives\n", "  -\n    # inside\n    name: robot\n"),
        TEXT.replace('"Mine"   # in quotes', ">\n  a long\n  title\n\n"),
        TEXT.replace("title:", "? title\n:"),
    ):
        scene = Scene.loads(text)
        for values in ({"goal": "Go."}, {"bodies": BODIES[:1]}, {"title": "x"}, {"title": ""}):
            other = Scene(scene.description.model_copy(update=values), None, scene.source)
            if "bodies" in values:
                agents = ({**AGENT, "sensors": []},)
                other.description = other.description.model_copy(update={"agents": agents})
            assert Scene.loads(other.dumps()) == other


def test_comments_survive_the_page() -> None:
    harness = EditorHarness(Scene.loads(TEXT))
    assert harness.editor.text() == TEXT
    harness.done(harness.editor.add_body({"name": "ball", "position": [0, 3]}))
    harness.done(harness.editor.move_body("box", 4, 2))
    harness.done(harness.editor.change_block("0", ("actuators", 0), {"move_amount": 3}))
    text = harness.editor.text()
    assert comments_in(text) == COMMENTS
    assert Scene.loads(text) == harness.editor.scene
    harness.done(harness.editor.remove_body("ball"))
    harness.done(harness.editor.load(text.replace("small", "other")))
    assert comments_in(harness.editor.text()) == COMMENTS
    for _ in range(5):
        harness.done(harness.editor.undo())
    assert harness.editor.text() == TEXT


def test_a_scene_that_was_made_in_python_is_written_plainly() -> None:
    scene = Scene(Scene.loads(TEXT).description)
    assert scene.dumps() == write_yaml(scene.plain())
