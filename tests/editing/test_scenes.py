"""Whole scenes that are opened, written and read."""

import pytest

from ai4u_edu import Scene
from ai4u_edu.base.errors import SceneError
from ai4u_edu.editing import ChangeError
from ai4u_edu.scenes.yaml.file import MAX_SCENE_CHARS
from tests.editing.shops import TEXT, Shop, trace


def test_another_scene_runs_in_place_of_this_one() -> None:
    shop = Shop(record=True)
    shop.tick(4)
    before = shop.runner.sim
    sumo = Scene.load("sumo")
    outcome = shop.done(shop.editor.open(sumo))
    assert (outcome.when, outcome.label) == ("now", "open sumo")
    assert shop.runner.sim is not before
    assert shop.editor.scene == sumo
    assert shop.editor.is_as_opened
    assert {agent.id for agent in shop.runner.latest.agents} == {"blue", "orange"}
    shop.tick(12)
    recorder = shop.runner.recorder
    assert recorder is not None
    recorder.finish()
    assert [each.scene.name for each in recorder.episodes] == ["small", "sumo"]
    shop.done(shop.editor.undo())
    assert shop.editor.scene == shop.scene
    shop.tick(3)


def test_blocks_of_the_new_scene_can_be_changed() -> None:
    shop = Shop()
    shop.done(shop.editor.open(Scene.load("sumo")))
    shop.tick(2)
    outcome = shop.done(shop.editor.add_block("orange", "sensors", {"type": "StepSensor"}))
    assert outcome.when == "next decision"
    assert "steps" in shop.runner.sim.agent("orange").percept
    shop.done(shop.editor.undo())
    shop.done(shop.editor.undo())
    assert shop.editor.scene == shop.scene


def test_text_and_back() -> None:
    shop = Shop()
    text = shop.editor.text()
    assert Scene.loads(text) == shop.scene
    shop.done(shop.editor.add_body({"name": "ball", "position": [0, 3]}))
    changed = shop.editor.text()
    shop.done(shop.editor.load(text))
    assert list(shop.world.bodies) == ["robot", "box", "wall"]
    shop.done(shop.editor.load(changed))
    assert trace(shop.runner.sim, 5) == trace(Scene.loads(changed).build(), 5)


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
    shop = Shop()
    shop.tick(2)
    sim = shop.runner.sim
    with pytest.raises(SceneError) as error:
        shop.done(shop.editor.load(text))
    assert told in str(error.value)
    assert shop.runner.sim is sim


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
    shop = Shop()
    text = TEXT.split("    brains:")[0] + f"    brains:\n      - {brain}\n"
    with pytest.raises(ChangeError) as error:
        shop.done(shop.editor.load(text))
    assert told in str(error.value)
    with pytest.raises(ChangeError) as error:
        shop.done(shop.editor.add_block("0", "brains", {"type": "RemoteBrain", "host": "x.org"}))
    assert "can't have this machine connect to 'x.org'" in str(error.value)


def test_what_waits_for_the_reset_comes_with_it() -> None:
    shop = Shop(record=True)
    shop.tick(4)
    sim = shop.runner.sim
    outcome = shop.done(shop.editor.change_scene({"world": {"ticks_per_second": 30}}))
    assert str(outcome) == "it applies at the next reset"
    assert (shop.editor.waits_for_reset, shop.runner.sim) == (True, sim)
    outcome = shop.done(shop.editor.change_block("0", ("rewards", 0), {"reward": 4}))
    assert outcome.when == "next reset"
    assert sim.agents[0].rewards[0].values()["reward"] == 4  # that much is possible now
    shop.done(shop.runner.reset(seed=11))
    shop.done(shop.runner.submit(lambda: None))
    assert shop.editor.waits_for_reset is False
    assert shop.world.settings.ticks_per_second == 30
    assert (shop.world.seeds.seed, shop.world.ticks) == (11, 0)
    assert trace(shop.runner.sim, 5) == trace(shop.editor.scene.build(), 5)


def test_what_waits_can_be_taken_back() -> None:
    shop = Shop()
    shop.done(shop.editor.change_scene({"world": {"damping": 0.5}}))
    shop.done(shop.editor.undo())
    sim = shop.runner.sim
    assert not shop.editor.waits_for_reset
    shop.done(shop.runner.reset())
    assert shop.runner.sim is sim


def test_somebody_elses_world_is_taken_over() -> None:
    shop = Shop()
    shop.done(shop.editor.add_body({"name": "ball", "position": [0, 3]}))
    shop.done(shop.runner.replace_sim(shop.scene.build()))
    shop.done(shop.editor.add_block("0", "sensors", {"type": "HeadingSensor"}))
    assert "ball" not in shop.editor.text()
    assert "heading" in shop.agent.percept
    shop.done(shop.editor.undo())
    shop.done(shop.editor.undo())
    assert "ball" in shop.world.bodies
