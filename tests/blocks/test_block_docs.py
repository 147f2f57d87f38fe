"""Lesson pages of all blocks."""

import pytest

from ai4u_edu import Block, Sensor
from ai4u_edu.base.errors import NameNotFoundError, text_of
from ai4u_edu.blocks.docs import built_in_blocks, lesson_page, summary
from ai4u_edu.locale import Catalogue, reader
from ai4u_edu.scenes.serialization import KINDS

BLOCKS = [cls for kind in built_in_blocks().values() for cls in kind]


@pytest.mark.parametrize("cls", BLOCKS, ids=lambda cls: cls.__name__)
def test_a_page_has_a_summary_and_all_parameters(cls: type[Block]) -> None:
    page = lesson_page(cls.__name__)
    assert len(summary(cls)) > 15
    described = {
        name: about.get("description", "")
        for name, about in cls.json_schema().get("properties", {}).items()
    }
    assert described.keys() == cls.parameters().keys()
    for name, text in described.items():
        assert f"\n{name} " in page
        assert len(text.split()) > 2, f"say under {cls.__name__}.{name} what it is, unit and range"
        assert text in page
    if issubclass(cls, Sensor):
        assert "Reading: " in page, "say the reading's shape, unit and range"


@pytest.mark.parametrize("cls", KINDS, ids=lambda cls: cls.__name__)
def test_what_all_blocks_of_a_kind_have_is_described_once_at_the_base(cls: type[Block]) -> None:
    described = cls.json_schema().get("properties", {})
    assert all(described[name].get("description") for name in cls.parameters())


def test_a_block_without_descriptions_would_fail() -> None:
    class Bare(Sensor):
        """Reads nothing."""

        depth: float = 1.0

    assert "description" not in Bare.json_schema()["properties"]["depth"]


def test_units_and_ranges_of_the_status_sensors_are_told() -> None:
    for name in ("Done", "Truncated", "ID", "Step", "Reward", "Action"):
        page = lesson_page(f"{name}Sensor")
        assert len(page.split("Reading: ")[0].split("\n\n")) > 2, f"{name}Sensor has a paragraph"


def test_orientation_and_position_say_in_which_unit_they_read() -> None:
    for name, first in (
        ("OrientationSensor", "a share of max_distance, or m"),
        ("PositionSensor", "as shares of the world's size, or in metres"),
    ):
        page = " ".join(lesson_page(name).split())
        assert first in page.split(". ")[0]
        assert "With ``normalized=False``" in page


def test_exactly() -> None:
    lines = [" ".join(line.split()) for line in lesson_page("VelocitySensor").splitlines()]
    assert "max_speed 20.0 0..10000 m/s Largest speed that is read, forward and sideways." in lines
    assert lines.count("max_turn 20.0 0..10000 rad/s Largest turning speed that is read.") == 1
    needed = lesson_page("BearingSensor")
    assert "target                (needed)  text" in needed


def test_the_frame_of_a_page_is_in_the_readers_language() -> None:
    with reader("pt_BR"):
        page = " ".join(lesson_page("BearingSensor").split())
    assert "parâmetro padrão intervalo" in page
    assert "target (obrigatório) texto" in page
    with pytest.raises(NameNotFoundError) as raised:
        lesson_page("Camera")
    said = Catalogue("pt_BR").translate(text_of(raised.value))
    assert "Camera do AI4U se chama LocalGridSensor aqui. Não há câmera" in said


def test_an_unknown_block() -> None:
    with pytest.raises(NameNotFoundError, match="did you mean 'BearingSensor'"):
        lesson_page("BearingSenser")
