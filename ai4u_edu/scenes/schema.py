"""JSON Schema of scene files, for completion and checks in editors."""

from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.blocks import Block
from ai4u_edu.blocks.block import is_built_in
from ai4u_edu.scenes.description import SceneDescription
from ai4u_edu.scenes.serialization import KINDS, is_serializable


def scene_schema() -> dict[str, Any]:
    """Return the schema of a whole scene file (JSON Schema 2020-12)."""
    schema = SceneDescription.model_json_schema()
    agent = BasicAgent.json_schema()
    definitions: dict[str, Any] = {**schema.pop("$defs", {}), **agent.pop("$defs", {})}
    blocks = {
        name: cls for name, cls in Block.types.items() if is_built_in(cls) and is_serializable(cls)
    }
    for name, cls in blocks.items():
        definitions[name] = _block_schema(cls)
    for kind in KINDS:
        fitting = [name for name, cls in blocks.items() if issubclass(cls, kind)]
        definitions[kind.__name__] = {"anyOf": [{"$ref": f"#/$defs/{name}"} for name in fitting]}
    definitions["BasicAgent"] = agent
    schema["properties"]["agents"]["items"] = {"$ref": "#/$defs/BasicAgent"}
    for definition in definitions.values():
        if "description" in definition:
            definition["description"] = definition["description"].split("\n\n>>>")[0]
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **schema,
        "$defs": definitions,
    }


def _block_schema(cls: type[Block]) -> dict[str, Any]:
    schema = cls.json_schema()
    schema.pop("$defs", None)  # kinds of blocks, defined once for the whole file
    schema["properties"] = {"type": {"const": cls.__name__}, **schema.get("properties", {})}
    schema["required"] = ["type", *schema.get("required", [])]
    return schema
