"""Suggested parameters for a new block."""

from typing import Any

from ai4u_edu.base.parameters import default_of
from ai4u_edu.blocks import Actuator, Block, Brain, RewardFunc, Sensor
from ai4u_edu.blocks.brains.zoo import names as in_the_zoo
from ai4u_edu.page.editing.plain import Plain
from ai4u_edu.page.editing.scene_names import SceneNames, name_of
from ai4u_edu.page.editing.state import EditState

NAMED = {
    Sensor: ("sensors", "perception_key"),
    Actuator: ("actuators", "action_name"),
    RewardFunc: ("rewards", "name"),
}


def suggest_block(state: EditState, agent_id: str, type_name: str) -> Plain:
    """Return a new block as plain data, with parameters filled in that need a value to be useful.

    Args:
        state: has the scene.
        agent_id: the agent that gets the block.
        type_name: the block's type.
    """
    cls, names = Block.types[type_name], SceneNames(state, agent_id)
    block: dict[str, Any] = {"type": type_name}
    for name, field in cls.parameters().items():
        known, default = names.fitting(name), default_of(field)
        is_unknown_name = known is not None and default not in ("", None, *known)
        if not (field.is_required() or is_unknown_name or name == "group_code"):
            continue
        value = _value(name, state, names)
        if value is not None:
            block[name] = value
    for base, (kind, parameter) in NAMED.items():
        if issubclass(cls, base):
            _make_name_unique(block, parameter, names.of_blocks(kind, parameter))
    if issubclass(cls, Brain):
        brains = names.agent.get("brains", ())
        on: Plain = next((each for each in brains if each.get("enabled", True)), {})
        block |= {name: on[name] for name in ("skip_frame", "repeat_action") if name in on}
    return block


def copy_of_block(state: EditState, agent_id: str, block: Plain) -> Plain:
    """Return a copy of an agent's block with a name that no other block of its kind has."""
    cls, names, copy = Block.types[str(block["type"])], SceneNames(state, agent_id), dict(block)
    for base, (kind, parameter) in NAMED.items():
        if issubclass(cls, base):
            _make_name_unique(copy, parameter, names.of_blocks(kind, parameter))
    return copy


def _value(name: str, state: EditState, names: SceneNames) -> Any:
    body = next(each for each in state.description.bodies if each.name == names.agent.get("body"))
    target = next(iter(names.things), None)
    match name:
        case "group_code":
            seen = [tag for tag in names.tags if tag not in body.tags]
            return {tag: index for index, tag in enumerate(seen, 1)} or None
        case "targets":
            return list(names.things[:1]) or None
        case "poses":
            return [[*body.position, body.heading_deg]]
        case "children":
            return [{"type": "TouchRewardFunc", "target": target, "reward": 1.0}]
        case "sensors":
            return [{"type": "HeadingSensor"}]
        case "variables":
            return [{"type": "HomeostaticVariable", "name": "energy"}]
        case "controller":
            return {"type": "WASDRBMoveController"}
        case "model_path":
            scene = state.description.name
            return f"zoo:{scene}" if scene in in_the_zoo() else "policy.onnx"
        case "actions":
            return [{each: [0.0, 0.0, 0.0, 0.0]} for each in _actuators(names)[:1]]
        case "property":
            return "speed"
        case "min_value":
            return 0.0
        case "max_value":
            return 1.0
    return next(iter(names.fitting(name) or ()), None)


def _actuators(names: SceneNames) -> tuple[str, ...]:
    return names.of_blocks("actuators", "action_name")


def _make_name_unique(block: dict[str, Any], parameter: str, taken: tuple[str, ...]) -> None:
    name, number = name_of(block, parameter), 2
    if name not in taken:
        return
    while f"{name}_{number}" in taken:
        number += 1
    block[parameter] = f"{name}_{number}"
