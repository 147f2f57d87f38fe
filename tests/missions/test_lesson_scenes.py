"""Scenes of lessons are what the lessons build."""

import pytest

from ai4u_edu.page.editing.scene_pictures import EMPTY_SCENE, TEMPLATES, load_by_name
from tests.lesson_scenes import WORLDS, lesson_scene


@pytest.mark.parametrize("name", WORLDS)
def test_a_lessons_scene_is_its_world(name: str) -> None:
    text = (TEMPLATES / f"{name}.yaml").read_text(encoding="utf-8")
    assert lesson_scene(name).dumps() == text, "run: python -m tests.lesson_scenes --write"
    scene = load_by_name(name)
    assert scene is not None
    sim = scene.build()
    sim.reset(1)
    sim.step()


def test_no_other_template_is_there() -> None:
    found = {path.stem for path in TEMPLATES.glob("*.yaml")}
    assert found == {EMPTY_SCENE, *WORLDS}
    assert load_by_name("../library/maze") is None
