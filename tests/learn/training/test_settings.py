"""Settings files, and what becomes of a scene that is learned as they say."""

import re
from pathlib import Path
from typing import Any

import pytest

from ai4u_edu import Scene
from ai4u_edu.base.errors import SetupError, text_of
from ai4u_edu.learn.envs import SceneEnv
from ai4u_edu.learn.training.prepare import prepare
from ai4u_edu.learn.training.settings import FOLDER, Settings, settings_for
from ai4u_edu.locale import Catalogue


def with_(**changes: Any) -> Settings:
    return Settings.model_validate(settings_for("box_chase").model_dump() | changes)


@pytest.mark.parametrize("file", sorted(FOLDER.glob("*.yaml")), ids=lambda file: file.stem)
def test_every_file_fits_its_scene(file: Path) -> None:
    settings = settings_for(file.stem)
    if file.stem != "defaults":
        prepare(Scene.load(file.stem), settings)


def test_a_scenes_own_file_says_only_what_is_different() -> None:
    plain, own = settings_for("no such scene"), settings_for("sample_scene")
    assert (plain.skip_frame, own.skip_frame) == (None, 14)
    assert own.sac.others["n_steps"] == 5
    assert own.sac.others["tau"] == plain.sac.others["tau"] == 0.02
    assert own.dqn == plain.dqn


def test_a_file_of_ones_own(tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"
    file.write_text("sac: {steps: 77, gamma: 0.5}\n")
    settings = settings_for("sample_scene", file)
    assert (settings.sac.steps, settings.sac.others["gamma"]) == (77, 0.5)
    assert settings.skip_frame is None  # in place of the scene's own file, not on top of it


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("skip_fame: 3", "mine.yaml: skip_fame: unknown parameter; did you mean 'skip_frame'?"),
        ("skip_frame: -1", "mine.yaml: skip_frame: expected at least 0, got -1"),
        ("sac: {steps: 0}", "mine.yaml: sac.steps: expected at least 1, got 0"),
        ("sac: 3", "mine.yaml: sac: expected a mapping, got 3"),
        ("- 3", "mine.yaml: expected lines such as algorithm: ..., sac: ..., ppo: ..., got a list"),
        ("a: [", "mine.yaml, line 1, column 4: this [ is never closed"),
    ],
)
def test_what_is_wrong_in_a_file(tmp_path: Path, text: str, message: str) -> None:
    file = tmp_path / "mine.yaml"
    file.write_text(text + "\n")
    with pytest.raises(SetupError) as caught:
        settings_for("box_chase", file)
    assert str(caught.value).startswith(message)
    translation = Catalogue("pt_BR").translate(text_of(caught.value))
    assert not re.search("expected|unknown|never closed", translation)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(SetupError, match="can't be read"):
        settings_for("box_chase", tmp_path / "none.yaml")


def test_what_the_settings_change_in_a_scene() -> None:
    scene = Scene.load("box_chase")
    settings = with_(observe=["orientation", "last_action"], skip_frame=2, max_steps=50)
    learned = SceneEnv(prepare(scene, settings), observation="flat")
    assert learned.observation_space.shape == (6,)
    assert learned.agent.brain.skip_frame == 2
    assert learned.agent.max_steps_per_episode == 50
    # an evaluation takes the scene's own limit
    assert prepare(scene, settings, learning=False).build().agents[0].max_steps_per_episode == 3000
    # and the scene itself stays as it was
    assert scene == Scene.load("box_chase")
    assert SceneEnv(scene, observation="flat").observation_space.shape == (126,)


def test_what_the_settings_can_not_change() -> None:
    scene = Scene.load("box_chase")
    with pytest.raises(SetupError, match="no sensor has the key 'visoin'; did you mean 'vision'"):
        prepare(scene, with_(observe=["visoin"]))
    with pytest.raises(SetupError, match="agent: the scene has none with the id '7'"):
        prepare(scene, with_(agent="7"))
