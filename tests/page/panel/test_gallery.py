"""Blocks in words, and the reasons why some can't work in a scene."""

from typing import Any

import pytest
from gymnasium.spaces import Discrete

from ai4u_edu import Scene, Sensor
from ai4u_edu.blocks import Block
from ai4u_edu.blocks.docs import built_in_blocks
from ai4u_edu.page.editing.forms import block_form
from ai4u_edu.page.editing.scene_names import SceneNames
from ai4u_edu.page.editing.suggestion import suggest_block
from ai4u_edu.page.panel.block_words import BLOCK_WORDS
from ai4u_edu.page.panel.gallery import first_fields, gallery_items, words_of
from ai4u_edu.page.server.web_files import web_folder
from tests.page.editing.harness import EditorHarness

BUILT_IN = [cls.__name__ for classes in built_in_blocks().values() for cls in classes]


def test_each_built_in_block_has_words_and_no_other_has() -> None:
    assert sorted(BUILT_IN) == sorted(name for name in BLOCK_WORDS if name)


@pytest.mark.parametrize("name", BUILT_IN)
def test_words_are_words(name: str) -> None:
    words = words_of(name)
    assert words.title[0].isupper()
    assert len(words.title) <= 30
    assert name not in words.title
    assert words.question.endswith("?")


def test_titles_differ() -> None:
    titles = [words.title for words in BLOCK_WORDS.values()]
    assert len(set(titles)) == len(titles)


def test_each_picture_is_drawn() -> None:
    drawn = (web_folder() / "shared/icons.js").read_text()
    missing = {w.picture for w in BLOCK_WORDS.values() if f"\n  {w.picture}:" not in drawn}
    assert missing == set()


@pytest.mark.parametrize("name", [each for each in BLOCK_WORDS if words_of(each).first_fields])
def test_first_fields_are_parameters(name: str) -> None:
    assert set(words_of(name).first_fields) <= set(Block.types[name].parameters())


def test_three_fields_come_first() -> None:
    state = EditorHarness().editor.state

    def first(name: str) -> list[str]:
        block = suggest_block(state, "0", name)
        return first_fields(name, block_form(block, SceneNames(state, "0")))

    assert first("LinearRayCastingSensor") == [
        "number_of_rays",
        "field_of_view",
        "vision_max_distance",
    ]
    assert first("TouchRewardFunc") == ["target", "reward", "only_one_time"]
    assert first("GroundStatusSensor") == []


def test_a_gallery_groups_by_question_and_tells_what_can_not_work() -> None:
    items = gallery_items(EditorHarness().editor.state, "0", "sensors")
    questions = [item.question for item in items]
    assert questions[0] == "Where is ...?"
    assert len(dict.fromkeys(questions)) == sum(
        one != other for one, other in zip(questions, ["", *questions], strict=False)
    )
    reasons = {item.type_name: item.reason for item in items}
    assert reasons["BearingSensor"] == ""
    assert reasons["LineSensor"] == "It needs an area. Add one in the World tab first."
    assert reasons["HomeostaticSensor"] == 'It needs the reward "Feel better" first.'


@pytest.mark.parametrize(
    ("scene", "driver", "reason"),
    [
        ("box_chase", "brain:0", ""),
        ("box_chase", "keys:ArrowController", ""),
        ("box_chase", "network:zoo:box_chase", ""),
        (
            "box_chase",
            "keys:StrikerController",
            "It needs a sensor with the name ball.",
        ),
        (
            "grid_world",
            "keys:WASDRBMoveController",
            "Its actions don't fit this agent's actuators.",
        ),
        (
            "parking",
            "network:zoo:box_chase",
            "It was trained with other sensors or actuators.",
        ),
        ("box_chase", "ai4u://127.0.0.1:8080", ""),
    ],
)
def test_reasons_against_drivers(scene: str, driver: str, reason: str) -> None:
    harness = EditorHarness(Scene.load(scene))
    assert harness.editor.reason_against_driver("0", driver) == reason


def test_a_block_whose_code_fails_is_grey_and_says_why() -> None:
    class Unfinished(Sensor):
        """Is not finished."""

        def space(self) -> Any:
            raise NameError("name 'Box' is not defined")

    harness = EditorHarness()
    items = gallery_items(harness.editor.state, "0", "sensors")
    (item,) = [each for each in items if each.type_name == "Unfinished"]
    assert item.reason == "Its code raised NameError: name 'Box' is not defined."


def test_a_block_of_a_lesson_is_not_listed_as_a_persons_own() -> None:
    class Hidden(Sensor):
        """Belongs to an exercise of the package."""

        __module__ = "ai4u_edu.lessons.exercises.lesson_00"

        def space(self) -> Any:
            return Discrete(2)

    items = gallery_items(EditorHarness().editor.state, "0", "sensors")
    assert "Hidden" not in [each.type_name for each in items]
