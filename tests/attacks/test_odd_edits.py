"""Edits with odd values: each is refused in a sentence, or carried out; nothing breaks by either.

Of every form that a page has and every public method of the editor. After an edit that was
refused the scene, the steps that can be undone and the autosave are what they were; after one that
was carried out, the world goes on, and undo brings the scene back.
"""

import math
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from typing import Any

import pytest

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks import Actuator, Block, Brain, Controller, RewardFunc, Sensor
from ai4u_edu.blocks.block import is_built_in
from ai4u_edu.page.editing import ChangeResult
from ai4u_edu.page.editing.forms import block_form
from ai4u_edu.page.editing.scene_names import SceneNames
from ai4u_edu.page.editing.settings import agent_form, field_form, scene_form
from ai4u_edu.page.editing.suggestion import suggest_block
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.serialization import is_serializable
from ai4u_edu.world import BodyDescription
from tests.page.editing.harness import TEXT, EditorHarness

NESTED: list[Any] = []
NESTED.append(NESTED)
ODD: list[Any] = [
    1e308,
    -1e20,
    -0.0,
    math.nan,
    -math.inf,
    10**400,
    -(2**63),
    True,
    "5",
    "\ud800",
    "x" * 100_000,
    [],
    [1e308, None],
    {"type": "circle", "radius": "1"},
    NESTED,
    object(),
    b"\xff",
    None,
]
NOT_NUMBERS = [True, "5", "", [], [1], {}, object(), b"1", math.nan, math.inf, -math.inf, 10**400]
MAX_SENTENCE_CHARS = 2000


class Attacked(EditorHarness):
    """A editor, and what it keeps."""

    def __init__(self) -> None:
        super().__init__(TEXT)
        self.kept: list[Any] = []
        self.accepted = 0
        self.editor.listeners.append(self.kept.append)

    def all(self) -> tuple[Any, ...]:
        editor = self.editor
        step = editor.undo_label, editor.redo_label, editor.version
        return id(editor.state), step, len(self.kept)

    def attempt(self, edit: Callable[[], "Future[Any]"], what: str) -> bool:
        """Returns whether it was carried out."""
        before, state = self.all(), self.editor.state
        try:
            outcome = self.done(edit())
        except AI4UError as error:
            told = str(error)
            assert 5 < len(told) < MAX_SENTENCE_CHARS, what
            assert self.all() == before, what
            return False
        self.accepted += 1
        if isinstance(outcome, ChangeResult) and self.editor.version != before[1][2]:
            self.go_on(what)
            self.done(self.editor.undo())
            assert self.editor.state == state, what
        return True

    def go_on(self, what: str) -> None:
        self.runner._tick()
        assert self.runner.error == "", what
        assert all(math.isfinite(sum(body.pose)) for body in self.world.bodies.values()), what


@pytest.fixture
def harness() -> Iterator[Attacked]:
    harness = Attacked()
    harness.tick(5)
    text = harness.editor.text()
    yield harness
    harness.go_on("at the end")
    assert harness.editor.text() == text


KINDS: dict[str, type[Block]] = {
    "sensors": Sensor,
    "actuators": Actuator,
    "rewards": RewardFunc,
    "brains": Brain,
}
BLOCKS = [
    pytest.param(kind, name, id=name)
    for kind, base in KINDS.items()
    for name, cls in sorted(Block.types.items())
    if issubclass(cls, base) and is_serializable(cls) and is_built_in(cls)
]


@pytest.mark.parametrize(("kind", "name"), BLOCKS)
def test_every_field_of_every_block(harness: Attacked, kind: str, name: str) -> None:
    block = dict(suggest_block(harness.editor.state, "0", name)) | {"enabled": False}
    if kind != "brains":
        del block["enabled"]
    fields = block_form(block, SceneNames(harness.editor.state, "0"))
    as_suggested = harness.attempt(lambda: harness.editor.add_block("0", kind, block), name)
    is_first = name in {"BearingSensor", "ForceMoveActuator", "TouchRewardFunc"}
    for index, field in enumerate(fields):
        if field.is_common and not is_first and kind != "brains":
            continue
        for value in ODD if is_first else ODD[index % 2 :: 2]:
            given = {**block, field.name: value}
            harness.attempt(
                lambda given=given: harness.editor.add_block("0", kind, given),  # type: ignore[misc]
                f"{name}.{field.name} = {str(value)[:40]}",
            )
    assert as_suggested or name in UNFIT, "all was refused for another reason"


UNFIT = {
    "BodyInAreaRewardFunc",
    "FigureReward",
    "HomeostaticSensor",
    "LineSensor",
    "ParkedRewardFunc",
}
"""Blocks that need more than this scene has."""
CONTROLLERS = [
    name
    for name, cls in sorted(Block.types.items())
    if issubclass(cls, Controller) and is_serializable(cls) and is_built_in(cls)
]


@pytest.mark.parametrize("name", CONTROLLERS)
def test_every_field_of_every_controller(harness: Attacked, name: str) -> None:
    block = suggest_block(harness.editor.state, "0", name)
    for index, field in enumerate(block_form(block, SceneNames(harness.editor.state, "0"))):
        for value in ODD[index % 2 :: 2]:
            controller = {**block, field.name: value}
            brain = {"type": "LocalBrain", "enabled": False, "controller": controller}
            harness.attempt(
                lambda brain=brain: harness.editor.add_block("0", "brains", brain),  # type: ignore[misc]
                f"{name}.{field.name} = {str(value)[:40]}",
            )


def test_every_field_of_a_block_that_is_there(harness: Attacked) -> None:
    agent = harness.editor.state.agent("0")
    paths = [("sensors", 0), ("actuators", 0), ("rewards", 0), ("brains", 0, "controller")]
    for path in paths:
        block: Any = agent
        for part in path:
            block = block[part]
        for field in block_form(block, SceneNames(harness.editor.state, "0")):
            if field.name == "action_name":
                continue  # under another name the brain that drives does not find it
            for value in ODD:
                harness.attempt(
                    lambda p=path, f=field.name, v=value: harness.editor.change_block(  # type: ignore[misc]
                        "0", p, {f: v}
                    ),
                    f"{path} {field.name} = {str(value)[:40]}",
                )


def test_every_setting_of_agent_and_scene(harness: Attacked) -> None:
    editor = harness.editor
    for field in agent_form(editor.state.agent("0")):
        for value in ODD:
            given = {field.name: value}
            what = f"{field.name} = {str(value)[:40]}"
            harness.attempt(lambda given=given: editor.change_agent("0", given), what)  # type: ignore[misc]
    for field in scene_form(editor.state.description):
        for value in ODD:
            given = {field.name: value}
            what = f"{field.name} = {str(value)[:40]}"
            harness.attempt(lambda given=given: editor.change_settings(given), what)  # type: ignore[misc]
    for value in ODD:
        given = {"type": value}
        harness.attempt(lambda given=given: editor.change_field(given), f"type = {str(value)[:40]}")  # type: ignore[misc]
    for field in field_form(Scene.load("endless_rescue").description):
        for value in ODD:
            given = {"type": "rescue"} | {field.name: value}
            what = f"{field.name} = {str(value)[:40]}"
            harness.attempt(lambda given=given: editor.change_field(given), what)  # type: ignore[misc]
    assert harness.attempt(lambda: editor.change_agent("0", {"reward_scale": 2}), "2")
    assert harness.attempt(lambda: editor.change_settings({"gravity": 2}), "2")


@pytest.mark.parametrize("field", BodyDescription.model_fields)
def test_every_field_of_a_body(harness: Attacked, field: str) -> None:
    editor = harness.editor
    for value in ODD:
        what = f"{field} = {str(value)[:40]}"
        for name in ("box", "robot"):
            harness.attempt(lambda n=name, v=value: editor.change_body(n, {field: v}), what)  # type: ignore[misc]
        body = {"name": "new", "position": [0, 4], field: value}
        harness.attempt(lambda body=body: editor.add_body(body), what)  # type: ignore[misc]
    assert harness.attempt(lambda: editor.change_body("box", {"mass": 2.0, "z": None}), "mass")
    assert harness.attempt(lambda: editor.add_body({"name": "new", "position": [0, 4]}), "new")


def test_every_method_with_what_is_no_number(harness: Attacked) -> None:
    editor = harness.editor
    for odd in NOT_NUMBERS:
        what = str(odd)[:40]
        calls: list[Callable[[Any], Future[Any]]] = [
            lambda v: editor.drag("box", v, 0),
            lambda v: editor.drag("box", 0, v),
            lambda v: editor.drag("box", 0, 0, v),
            lambda v: editor.move_body("box", v, 0),
            lambda v: editor.move_body("box", 0, v),
            lambda v: editor.move_body("box", 3, 3, v),
            lambda v: editor.move_block("0", ("sensors", 0), v),
            lambda v: editor.add_block("0", "sensors", {"type": "HeadingSensor"}, v),
        ]
        for call in calls:
            assert not harness.attempt(lambda call=call, v=odd: call(v), what)  # type: ignore[misc]


def test_every_method_with_anything(harness: Attacked) -> None:
    editor = harness.editor
    for odd in [*ODD, *NOT_NUMBERS, ("sensors", 9), ("sensors",), ("x", 0), -1, 5, "box"]:
        what = str(odd)[:40]
        calls: list[Callable[[Any], Future[Any]]] = [
            lambda v: editor.drag(v, 1e20, 0),
            lambda v: editor.move_body(v, 0, 3),
            lambda v: editor.change_block("0", v, {"is_active": False}),
            lambda v: editor.change_block(v, ("sensors", 0), {"is_active": False}),
            lambda v: editor.change_block("0", ("sensors", 0), v),
            lambda v: editor.add_block("0", v, {"type": "HeadingSensor"}),
            lambda v: editor.add_block("0", "sensors", v),
            lambda v: editor.add_block(v, "sensors", {"type": "HeadingSensor"}),
            lambda v: editor.remove_block("0", v),
            lambda v: editor.move_block("0", v, 1),
            lambda v: editor.switch_block("0", v, False),
            lambda v: editor.switch_block("0", ("sensors", 0), v),
            lambda v: editor.change_agent("0", v),
            lambda v: editor.change_agent(v, {"reward_scale": 2.0}),
            lambda v: editor.set_driver("0", v),
            lambda v: editor.set_driver(v, "brain:0"),
            lambda v: editor.add_body(v),
            lambda v: editor.remove_body(v),
            lambda v: editor.change_body("box", v),
            lambda v: editor.change_body(v, {"mass": 2.0}),
            lambda v: editor.change_scene(v),
            lambda v: editor.change_scene({"time_scale": v}),
            lambda v: editor.change_scene({"world": v}),
            lambda v: editor.change_settings(v),
            lambda v: editor.load(v),
        ]
        for number, call in enumerate(calls):
            harness.attempt(lambda call=call, v=odd: call(v), f"{number}: {what}")  # type: ignore[misc]
