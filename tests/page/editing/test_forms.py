"""Forms of all blocks, from their declarations; and what is suggested for a new one."""

from typing import Any

import pytest

from ai4u_edu import Scene
from ai4u_edu.blocks.block import is_built_in
from ai4u_edu.page.editing import ChangeError
from ai4u_edu.page.editing.blocks import types_of
from ai4u_edu.page.editing.forms import NONE_LABEL, ParameterField, block_form
from ai4u_edu.page.editing.scene_names import SceneNames
from ai4u_edu.page.editing.suggestion import suggest_block
from tests.page.editing.harness import TEXT, EditorHarness

RICH = TEXT.replace(
    "bodies:",
    "areas:\n  - {name: goal, shape: {type: circle, radius: 1}, position: [0, 4], tags: [line]}\n"
    "bodies:",
    1,
).replace(
    "      - {type: ProgressReward, target: box}",
    "      - {type: ProgressReward, target: box}\n"
    "      - {type: HomeostaticReward, variables: [{type: HomeostaticVariable, name: energy}]}",
)
ALL = [
    (kind, cls.__name__)
    for kind in ("sensors", "actuators", "rewards", "brains")
    for cls in types_of(kind)
    if is_built_in(cls)
]


def fields(harness: EditorHarness, block: dict[str, Any]) -> dict[str, ParameterField]:
    return {each.name: each for each in block_form(block, SceneNames(harness.editor.state, "0"))}


@pytest.mark.parametrize(("kind", "name"), ALL)
def test_a_new_block_fits_and_its_form_says_what_it_is(kind: str, name: str) -> None:
    harness = EditorHarness(RICH)
    block = suggest_block(harness.editor.state, "0", name)
    if name in ("NeuralNetController", "FigureReward"):  # a file, and a figure, which is not here
        return
    harness.done(harness.editor.add_block("0", kind, block))
    if name != "RemoteBrain":
        harness.tick(3)
    for field in fields(harness, dict(block)).values():
        said = field.value if field.kind == "switch" else field.shown
        read = field.read(said)
        same = field.value if field.value not in ("", None) else None
        assert read == (list(same) if isinstance(same, tuple) else same), field


def test_form_field_has_label_limits_and_order() -> None:
    harness = EditorHarness(RICH)
    seen = fields(harness, {"type": "LinearRayCastingSensor", "number_of_rays": 9})
    assert seen["number_of_rays"].kind == "whole"
    assert seen["number_of_rays"].shown == "9"
    assert next(iter(seen)) == "number_of_rays"  # its own before those of all that cast rays
    assert list(seen)[-1] == "dropout"
    assert seen["vision_max_distance"].label == "vision max distance (m)"
    assert "more than 0, at most 10000 m" in seen["vision_max_distance"].limits
    assert seen["noise"].is_common
    assert not seen["number_of_rays"].is_common
    assert "is_active" not in seen
    seen = fields(harness, {"type": "BearingSensor", "target": "box"})
    assert (seen["target"].kind, seen["target"].choices) == ("choice", ("box", "wall", "goal"))
    seen = fields(harness, {"type": "OrientationSensor", "target": "box"})
    assert seen["info"].choices == ("both", "angle", "distance")
    assert "children" not in fields(harness, {"type": "AndRewardFunc", "children": []})


@pytest.mark.parametrize(
    ("kind", "said", "read"),
    [
        ("number", "2.5", 2.5),
        ("number", "2,5", 2.5),
        ("number", "-1e-3", -0.001),
        ("number", "three", "three"),
        ("number", " ", None),
        ("whole", "3", 3),
        ("whole", 3, 3),
        ("whole", "3.5", 3.5),
        ("data", "{floor: 1, target: 2}", {"floor": 1, "target": 2}),
        ("data", "[[0, 0, 90]]", [[0, 0, 90]]),
        ("data", "", None),
        ("choice", NONE_LABEL, None),
        ("choice", "x", "x"),
        ("switch", True, True),
        ("text", "eyes", "eyes"),
    ],
)
def test_form_field_parses_typed_text(kind: Any, said: Any, read: Any) -> None:
    got = ParameterField("x", "x", kind, None, "").read(said)
    assert got == read
    assert type(got) is type(read)


@pytest.mark.parametrize("said", ["{a: ", "[1, 2", "!!python/object:os.system 1", "&a [*a]"])
def test_unparsable_field_text_is_explained(said: str) -> None:
    with pytest.raises(ChangeError) as error:
        ParameterField("poses", "poses", "data", None, "").read(said)
    (problem,) = error.value.problems
    assert problem.path == ("poses",)
    assert "write [1, 2] for a list" in problem.text


def test_blocks_in_blocks() -> None:
    harness = EditorHarness(RICH)
    block = suggest_block(harness.editor.state, "0", "AndRewardFunc")
    harness.done(harness.editor.add_block("0", "rewards", block))
    agent = harness.editor.state.agent("0")
    assert [reward["type"] for reward in agent["rewards"]][3:] == ["AndRewardFunc"]
    child = ("rewards", 3, "children", 0)
    harness.done(harness.editor.change_block("0", child, {"reward": 3.0}))
    assert harness.agent.rewards[3].children[0].reward == 3
    new = {"type": "FallReward"}
    harness.done(harness.editor.add_block("0", ("rewards", 3, "children"), new))
    assert [type(each).__name__ for each in harness.agent.rewards[3].children] == [
        "TouchRewardFunc",
        "FallReward",
    ]
    with pytest.raises(ChangeError) as error:
        harness.done(harness.editor.change_block("0", child, {"reward": "much"}))
    assert [str(each) for each in error.value.problems] == ["reward: expected a number, got 'much'"]
    harness.done(harness.editor.remove_block("0", child))
    harness.done(harness.editor.undo())
    harness.tick(3)


def test_names_that_are_taken_get_a_number() -> None:
    harness = EditorHarness(Scene.load("box_chase"))
    for expected in ("ray_casting", "ray_casting_2", "ray_casting_3"):
        block = suggest_block(harness.editor.state, "0", "RayCastingSensor")
        assert block.get("perception_key", "ray_casting") == expected
        harness.done(harness.editor.add_block("0", "sensors", block))
        assert expected in harness.agent.percept
