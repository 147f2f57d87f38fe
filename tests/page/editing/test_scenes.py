"""Whole scenes that are opened, written and read."""

import pytest

from ai4u_edu import Scene
from ai4u_edu.base.errors import SceneError
from ai4u_edu.page.editing import ChangeError
from ai4u_edu.recording import Recorder, Replay
from ai4u_edu.scenes.yaml.file import MAX_SCENE_CHARS
from tests.page.editing.harness import TEXT, EditorHarness, trace


def test_another_scene_runs_in_place_of_this_one() -> None:
    harness = EditorHarness(record=True)
    harness.tick(4)
    before = harness.runner.sim
    sumo = Scene.load("sumo")
    outcome = harness.done(harness.editor.open(sumo))
    assert (outcome.when, outcome.label) == ("now", "open sumo")
    assert harness.runner.sim is not before
    assert harness.editor.scene == sumo
    assert harness.editor.is_as_opened
    assert {agent.id for agent in harness.runner.latest.agents} == {"blue", "orange"}
    harness.tick(12)
    recorder = harness.runner.recorder
    assert recorder is not None
    recorder.finish()
    assert [each.scene.name for each in recorder.episodes] == ["small", "sumo"]
    harness.done(harness.editor.undo())
    assert harness.editor.scene == harness.scene
    harness.tick(3)


def test_a_pause_does_not_travel_to_the_next_scene() -> None:
    harness = EditorHarness()
    harness.done(harness.runner.pause())
    harness.done(harness.editor.add_body({"name": "ball", "position": [0, 3]}))
    assert harness.runner.paused
    harness.done(harness.editor.open(Scene.load("donut")))
    harness.done(harness.runner.submit(lambda: None))
    assert not harness.runner.paused


def test_blocks_of_the_new_scene_can_be_changed() -> None:
    harness = EditorHarness()
    harness.done(harness.editor.open(Scene.load("sumo")))
    harness.tick(2)
    outcome = harness.done(harness.editor.add_block("orange", "sensors", {"type": "StepSensor"}))
    assert outcome.when == "next decision"
    assert "steps" in harness.runner.sim.agent("orange").percept
    harness.done(harness.editor.undo())
    harness.done(harness.editor.undo())
    assert harness.editor.scene == harness.scene


def test_text_and_back() -> None:
    harness = EditorHarness()
    text = harness.editor.text()
    assert Scene.loads(text) == harness.scene
    harness.done(harness.editor.add_body({"name": "ball", "position": [0, 3]}))
    changed = harness.editor.text()
    harness.done(harness.editor.load(text))
    assert list(harness.world.bodies) == ["robot", "box", "wall"]
    harness.done(harness.editor.load(changed))
    assert trace(harness.runner.sim, 5) == trace(Scene.loads(changed).build(), 5)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("name: [", "scene.yaml, line 1, column 7: this [ is never closed"),
        (TEXT.replace("radius: 0.5", "radius: big"), "scene.yaml, line 8: bodies[0].shape.radius"),
        (TEXT + "x: !!python/object:os.system 1", "anchors (&), aliases (*) and tags (!) are not"),
        ("#" * (MAX_SCENE_CHARS + 1), f"expected at most {MAX_SCENE_CHARS} characters"),
        (TEXT.replace("target: box, reward", "target: bxo, reward"), "did you mean 'box'?"),
    ],
)
def test_bad_texts(text: str, told: str) -> None:
    harness = EditorHarness()
    harness.tick(2)
    sim = harness.runner.sim
    with pytest.raises(SceneError) as error:
        harness.done(harness.editor.load(text))
    assert told in str(error.value)
    assert harness.runner.sim is sim


@pytest.mark.parametrize(
    ("brain", "told"),
    [
        (
            "{type: RemoteBrain, host: example.org}",
            "agents[0].brains[0].host: a page can't have this machine connect to 'example.org'",
        ),
        (
            "{type: LocalBrain, controller: {type: NeuralNetController, model_path: /etc/a.onnx}}",
            "expected zoo:SCENE, or a file that lies beside the scene, got '/etc/a.onnx'",
        ),
        (
            "{type: LocalBrain, controller: {type: NeuralNetController, model_path: ../a.onnx}}",
            "expected zoo:SCENE, or a file that lies beside the scene, got '../a.onnx'",
        ),
    ],
)
def test_a_page_names_no_other_machine_and_no_file_elsewhere(brain: str, told: str) -> None:
    harness = EditorHarness()
    text = TEXT.split("    brains:")[0] + f"    brains:\n      - {brain}\n"
    with pytest.raises(ChangeError) as error:
        harness.done(harness.editor.load(text))
    assert told in str(error.value)
    with pytest.raises(ChangeError) as error:
        harness.done(
            harness.editor.add_block("0", "brains", {"type": "RemoteBrain", "host": "x.org"})
        )
    assert "can't have this machine connect to 'x.org'" in str(error.value)


def test_pending_scene_changes_apply_at_reset() -> None:
    harness = EditorHarness(record=True)
    harness.tick(4)
    sim = harness.runner.sim
    outcome = harness.done(harness.editor.change_scene({"world": {"ticks_per_second": 30}}))
    assert str(outcome) == "works from the next reset on"
    assert (harness.editor.waits_for_reset, harness.runner.sim) == (True, sim)
    outcome = harness.done(harness.editor.change_block("0", ("rewards", 0), {"reward": 4}))
    assert outcome.when == "next reset"
    assert sim.agents[0].rewards[0].values()["reward"] == 4  # that much is possible now
    harness.done(harness.runner.reset(seed=11))
    harness.done(harness.runner.submit(lambda: None))
    assert harness.editor.waits_for_reset is False
    assert harness.world.settings.ticks_per_second == 30
    assert (harness.world.seeds.seed, harness.world.ticks) == (11, 0)
    assert trace(harness.runner.sim, 5) == trace(harness.editor.scene.build(), 5)


def test_pending_scene_changes_can_be_undone() -> None:
    harness = EditorHarness()
    harness.done(harness.editor.change_scene({"world": {"damping": 0.5}}))
    harness.done(harness.editor.undo())
    sim = harness.runner.sim
    assert not harness.editor.waits_for_reset
    harness.done(harness.runner.reset())
    assert harness.runner.sim is sim


def test_editor_adopts_a_replaced_world() -> None:
    harness = EditorHarness()
    harness.done(harness.editor.add_body({"name": "ball", "position": [0, 3]}))
    harness.done(harness.runner.replace_sim(harness.scene.build()))
    harness.done(harness.editor.add_block("0", "sensors", {"type": "HeadingSensor"}))
    assert "ball" not in harness.editor.text()
    assert "heading" in harness.agent.percept
    harness.done(harness.editor.undo())
    harness.done(harness.editor.undo())
    assert "ball" in harness.world.bodies


@pytest.mark.parametrize("record", [True, False])
def test_a_scene_that_goes_on_in_a_recording_of_another_one_can_be_opened(record: bool) -> None:
    sumo = Scene.load("sumo")
    sim = sumo.build()
    recorder = Recorder(sim, scene=sumo.description)
    sim.reset(1)
    for _ in range(9):
        sim.step()
    recorder.finish()
    harness = EditorHarness(Scene.load("box_chase"), record=record)
    harness.done(harness.runner.continue_from(Replay(recorder.episodes[-1]), 2))
    harness.done(harness.editor.add_body({"name": "ball", "position": [0, 3]}))
    scene = Scene.loads(harness.editor.text())
    assert scene.description.success == "win"
    assert scene.description.goal == sumo.description.goal
    assert scene.description.name == ("sumo" if record else "box_chase")
    harness.done(harness.editor.undo())
    harness.done(harness.editor.undo())
    assert harness.editor.scene.description.success == "touch"
