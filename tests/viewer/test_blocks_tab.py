"""The "Blocks" tab, on pages without a browser."""

import gc
from collections.abc import Iterator
from functools import partial
from typing import Any

import pytest

from ai4u_edu.editing.autosave import Unsaved
from ai4u_edu.viewer import Viewer
from ai4u_edu.viewer.panel.block_form import BlockForm
from ai4u_edu.viewer.panel.blocks_tab import BlocksTab
from ai4u_edu.viewer.panel.field_form import FieldForm
from tests.editing.harness import TEXT, EditorHarness
from tests.viewer.pages import Page, page, seen, shown, tabs_of, until


@pytest.fixture
def viewer(harness: EditorHarness) -> Iterator[Viewer]:
    viewer = Viewer(harness.runner, editor=harness.editor)
    yield viewer
    viewer.stop()


def tab_of(viewer: Viewer, number: int = 0) -> BlocksTab:
    shown(viewer)
    return tabs_of(viewer, BlocksTab)[number]


def chosen(viewer: Viewer, here: Page, tab: BlocksTab, line: str) -> BlockForm:
    here.change(tab.block, line)
    seen(viewer, lambda: tab.form is not None and tab.block.value == line)
    assert tab.form is not None
    return tab.form


def applied(viewer: Viewer, here: Page, tab: BlocksTab, **values: Any) -> None:
    assert tab.form is not None
    for name, value in values.items():
        box: Any = tab.form.boxes[name]
        here.change(box, value)
        until(partial(_holds, box, value))
    here.change(tab.form.apply, True)


def _holds(box: Any, value: Any) -> bool:
    return bool(box.value == value)


def test_lists_of_blocks_and_of_who_may_drive(viewer: Viewer) -> None:
    with page(viewer):
        tab = tab_of(viewer)
        assert tab.block.options == ("choose a block", "1 BearingSensor")
        assert tab.driver.value == "Program: ReplayController"
        assert "Keyboard: WASDRBMoveController" in tab.driver.options
        assert "Program: TrainController" not in tab.driver.options  # by itself it does nothing
        assert any(line.startswith("RayCastingSensor: Codes and") for line in tab.new.options)
        assert tab.form is None  # made when it is asked for
        assert not tab.block_actions.visible


def test_a_form_is_filled_in_and_handed_in(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        form = chosen(viewer, here, tab, "1 BearingSensor")
        assert form.boxes["target"].value == "box"
        applied(viewer, here, tab, noise="0,5", target="wall")
        until(lambda: harness.agent.sensors[0].target == "wall")
        assert harness.agent.sensors[0].noise == 0.5
        seen(viewer, lambda: "it applies at the next decision" in tab.status.content)
        assert tab.form is form  # the same boxes
        assert form.boxes["noise"].value == "0.5"


def test_what_is_wrong_stands_beside_its_field(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        form = chosen(viewer, here, tab, "1 BearingSensor")
        applied(viewer, here, tab, noise="-1", delay=-2)
        seen(viewer, lambda: len(form.problem_texts) == 2)
        assert "expected at least 0, got -1" in form.problem_texts["noise"].content
        assert "delay (decisions): expected at least 0, got -2" in form.message.content
        for name, complaint in form.problem_texts.items():
            place = [field.name for field in form.fields].index(name)
            assert complaint.order == place + 0.5
        assert harness.editor.undo_label == ""
        applied(viewer, here, tab, noise="0.1", delay=0)
        seen(viewer, lambda: not form.problem_texts)
        assert "it applies" in form.message.content


def test_what_can_not_be_read_is_not_handed_in(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        here.change(tab.kind, "Brains")
        seen(viewer, lambda: "1.controller ReplayController" in tab.block.options)
        form = chosen(viewer, here, tab, "1.controller ReplayController")
        assert not tab.block_actions.visible
        applied(viewer, here, tab, actions="[{move: [1, 0")
        seen(viewer, lambda: "actions" in form.problem_texts)
        assert "for a list" in form.problem_texts["actions"].content
        applied(viewer, here, tab, actions="[{move: [0, 1, 0, 0]}]")
        until(lambda: harness.agent.brain.controller.actions == [{"move": [0, 1, 0, 0]}])


def test_deeds(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        here.change(tab.kind, "Rewards")
        seen(viewer, lambda: "2 ProgressReward" in tab.block.options)
        chosen(viewer, here, tab, "2 ProgressReward")
        here.change(tab.block_actions, "Up")
        until(lambda: type(harness.agent.rewards[0]).__name__ == "ProgressReward")
        seen(viewer, lambda: tab.block.value == "1 ProgressReward")  # it is still looked at
        here.change(tab.block_actions, "Off")
        seen(viewer, lambda: tab.block.value == "1 ProgressReward (off)")
        assert tab.block_actions.options[0] == "On"
        here.change(tab.block_actions, "Remove")
        until(lambda: len(harness.agent.rewards) == 1)
        here.change(tab.changes, "Undo")
        until(lambda: len(harness.agent.rewards) == 2)
        seen(viewer, lambda: "redo: remove ProgressReward" in tab.status.content)


def test_a_controller_has_no_place_in_a_list(
    viewer: Viewer, harness: EditorHarness, caplog: pytest.LogCaptureFixture
) -> None:
    gc.collect()  # tasks of viewers that earlier tests stopped
    caplog.clear()
    with page(viewer) as here:
        tab = tab_of(viewer)
        here.change(tab.kind, "Brains")
        seen(viewer, lambda: "1.controller ReplayController" in tab.block.options)
        chosen(viewer, here, tab, "1.controller ReplayController")
        before = harness.editor.state
        for word in tab.block_actions.options:
            here.change(tab.block_actions, word)
        here.change(tab.kind, "Rewards")  # after it, those were heard
        seen(viewer, lambda: "1 TouchRewardFunc" in tab.block.options)
        assert harness.editor.state == before
        gc.collect()
        assert caplog.records == []


def test_a_new_block_is_added_and_looked_at(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        assert tab.add.disabled
        line = next(line for line in tab.new.options if line.startswith("LinearRayCasting"))
        here.change(tab.new, line)
        until(lambda: not tab.add.disabled)
        here.change(tab.add, True)
        until(lambda: "linear_ray_casting" in harness.agent.percept)
        seen(viewer, lambda: tab.block.value == "2 LinearRayCastingSensor")
        assert tab.form is not None
        assert tab.form.boxes["group_code"].value == "{target: 1, wall: 2}"


def test_a_page_can_send_what_it_likes(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        before = harness.editor.state
        for handle in (tab.block, tab.new, tab.driver, tab.kind, tab.changes, tab.block_actions):
            here.change(handle, "nonsense")
        here.change(tab.add, True)
        form = chosen(viewer, here, tab, "1 BearingSensor")
        here.change(form.boxes["target"], "<script>")  # is none of its choices
        applied(viewer, here, tab, noise="<script>")
        seen(viewer, lambda: "noise" in form.problem_texts)
        assert "&lt;script&gt;" in form.problem_texts["noise"].content
        assert form.boxes["target"].value == "box"
        assert harness.editor.state == before


def test_two_pages_have_a_form_each_and_see_each_others_changes(
    viewer: Viewer, harness: EditorHarness
) -> None:
    with page(viewer) as mine, page(viewer) as theirs:
        until(lambda: len(viewer.server.get_clients()) == 2)
        one, two = tab_of(viewer, 0), tab_of(viewer, 1)
        form = chosen(viewer, mine, one, "1 BearingSensor")
        other = chosen(viewer, theirs, two, "1 BearingSensor")
        assert form is not other
        applied(viewer, mine, one, noise="0.25")
        seen(viewer, lambda: other.boxes["noise"].value == "0.25")
        assert "undo: change BearingSensor" in two.status.content


def test_another_scene_has_other_lists(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        chosen(viewer, here, tab, "1 BearingSensor")
        other = "title: Another one\n" + TEXT.replace(
            "BearingSensor, target: box, stacked_observations: 3", "HeadingSensor"
        )
        harness.editor.load(other).result(5)
        seen(viewer, lambda: "1 HeadingSensor" in tab.block.options)
        assert viewer._title == "Another one"
        seen(viewer, lambda: tab.form is None or tab.form._block["type"] == "HeadingSensor")


def test_what_was_left_is_offered(viewer: Viewer, harness: EditorHarness, tmp_path: Any) -> None:
    text = TEXT.replace("position: [4, 0]", "position: [3, 3]")
    harness.editor.recovery.unsaved = Unsaved(tmp_path / "x", text, None, 0.0)
    with page(viewer) as here:
        tab = tab_of(viewer)
        assert tab.unsaved_text.visible
        here.change(tab.unsaved_actions, "Bring it back")
        until(lambda: harness.world["box"].position == (3, 3))
        seen(viewer, lambda: not tab.unsaved_text.visible)


def test_an_agents_own_settings_have_a_form(viewer: Viewer, harness: EditorHarness) -> None:
    with page(viewer) as here:
        tab = tab_of(viewer)
        here.press(tab.settings.button)  # the form is made when it is asked for
        seen(viewer, lambda: tab.settings.form)
        form = tab.settings.form
        assert form is not None
        assert form.boxes["skip_frame"].value == 0
        hand_in(here, form, skip_frame=3, max_steps_per_episode=50, repeat_action=False)
        until(lambda: harness.agent.brain.skip_frame == 3)
        assert harness.agent.max_steps_per_episode == 50
        assert harness.agent.brain.repeat_action is False
        seen(
            viewer, lambda: "change agent 0: it applies at the next decision" in tab.status.content
        )
        hand_in(here, form, skip_frame=-2)
        seen(viewer, lambda: "skip frame: expected at least 0, got -2" in form.message.content)
        assert harness.agent.brain.skip_frame == 3
        here.change(tab.changes, "Undo")
        seen(viewer, lambda: form.boxes["skip_frame"].value == 0)
        assert tab.settings.form is form
        assert harness.agent.brain.skip_frame == 0
        hand_in(here, form, priority=2)
        seen(viewer, lambda: "it applies at the next reset" in tab.status.content)
        here.press(tab.settings.button)
        seen(viewer, lambda: tab.settings.form is None)


def hand_in(here: Page, form: FieldForm, **values: Any) -> None:
    for name, value in values.items():
        here.change(form.boxes[name], value)
        until(partial(_holds, form.boxes[name], value))
    here.press(form.apply)
