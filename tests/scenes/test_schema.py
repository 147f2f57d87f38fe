"""The JSON Schema of scene files says what the loader says."""

from functools import cache
from typing import TYPE_CHECKING, Any

import pytest

from ai4u_edu import Block
from ai4u_edu.blocks.block import is_built_in
from ai4u_edu.scenes.schema import scene_schema
from ai4u_edu.scenes.serialization import is_serializable
from tests.json_schema import validator_of
from tests.scenes.few import SCENES

if TYPE_CHECKING:
    from jsonschema import Draft202012Validator


@cache
def schema() -> dict[str, Any]:
    return scene_schema()


@cache
def validator() -> "Draft202012Validator":
    return validator_of(schema())


def errors_in(scene: dict[str, Any]) -> list[str]:
    return [error.json_path for error in validator().iter_errors(scene)]


@pytest.mark.parametrize("name", SCENES)
def test_every_scene_of_the_library_fits(name: str) -> None:
    from ai4u_edu.scenes.scene import LIBRARY
    from ai4u_edu.scenes.yaml.file import YamlFile

    file = LIBRARY / f"{name}.yaml"
    assert errors_in(YamlFile(file.read_text(), file.name).data) == []


@pytest.mark.parametrize(
    "change",
    [
        {"nme": 1},
        {"bodies": [{"name": "a", "shape": {"type": "sphere"}}]},
        {"agents": [{"body": "a", "sensors": [{"type": "NoSensor"}]}]},
        {"agents": [{"body": "a", "sensors": [{"type": "VelocitySensor", "max_speed": -1}]}]},
        {"agents": [{"body": "a", "sensors": [{"type": "RBMoveActuator"}]}]},
        {"bodies": [{"name": "a", "random": {"x": [1]}}]},
        {"bodies": [{"name": "a", "random": {"scale": [0, 1]}}]},
        {"areas": [{"name": "a", "shape": {"type": "circle"}, "random": {"at": [0, 1]}}]},
    ],
)
def test_what_is_wrong_does_not_fit(change: dict[str, Any]) -> None:
    assert errors_in({"name": "x", "agents": [{"body": "a"}]}) == []
    assert errors_in({"name": "x", "agents": [{"body": "a"}]} | change)


def test_what_is_random_fits_and_is_explained() -> None:
    vary = {"places": [[1, 2], [3, 4]], "heading_deg": [-90, 90], "scale": [0.5, 2], "clearance": 1}
    thing = {"name": "a", "shape": {"type": "circle"}, "random": vary}
    scene = {"name": "x", "agents": [{"body": "a"}]}
    assert errors_in(scene | {"bodies": [thing], "areas": [thing], "floors": [thing]}) == []
    for about in schema()["$defs"]["Variation"]["properties"].values():
        assert about["description"]


def test_every_block_has_a_definition_with_a_description() -> None:
    blocks = [
        name for name, cls in Block.types.items() if is_built_in(cls) and is_serializable(cls)
    ]
    assert len(blocks) > 15
    for name in blocks:
        definition = schema()["$defs"][name]
        assert definition["description"]
        assert ">>>" not in definition["description"]
        assert definition["properties"]["type"] == {"const": name}
