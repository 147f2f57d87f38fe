"""Hints below the fields of forms, in plain words; names and ranges are in Details."""

import re

from ai4u_edu.locale import sentence
from ai4u_edu.page.editing.forms import ParameterField
from ai4u_edu.page.panel.block_words import BLOCK_WORDS

FIELD_LABELS = {
    "vision_max_distance": "how far it sees",
    "max_distance": "how far it sees",
    "return_code": "say what each ray hits",
    "return_distance": "say how far away it is",
    "group_code": "number for each group",
    "move_amount": "speed",
    "turn_amount": "turning speed",
    "only_one_time": "only once",
}
"""Labels of fields whose names say too little, by the parameter's name; Details shows the name."""
FIELD_HINTS = {
    "perception_key": "The sensor's name.",
    "stacked_observations": "How many of the latest readings are kept.",
    "normalized": "On: numbers from -1 to 1; off: metres, degrees and so on.",
    "resetable": "On: readings start again with each episode.",
    "is_input": "On: a learning robot gets this reading.",
    "noise": "Random error of the reading.",
    "delay": "How many decisions the reading is late.",
    "dropout": "How often a reading is lost, from 0 to 1.",
    "is_output": "On: a learning robot uses it.",
    "action_name": "The action's name.",
    "cause_episode_to_end": "On: the episode ends with it.",
    "group_code": "The number that stands for each group.",
    "number_of_rays": "How many rays; more see finer.",
    "rows": "How many rows.",
    "columns": "How many columns.",
    "width": "How wide it is.",
    "height": "How many rows.",
    "cell_size": "How large a cell is.",
    "field_of_view": "How wide it looks; 360 is all around.",
    "vision_max_distance": "How far it sees.",
    "vertical_field_of_view": "How far it looks up and down.",
    "vertical_shift": "How far down it looks.",
    "return_distance": "On: also tells how far away.",
    "return_code": "On: tells what each ray hits.",
    "normalize_distance": "On: distance from 0 to 1; off: in metres.",
    "visibility_test": "On: sees nothing behind other things.",
    "self_exclude": "On: doesn't see the robot itself.",
    "max_distance": "How far it sees. Empty: everywhere.",
    "radius": "How far it reaches. Empty: everywhere.",
    "target": "Which thing?",
    "reference": "The thing from which to look. Empty: the robot.",
    "info": "What to tell: direction, distance or both.",
    "max_speed": "The highest speed.",
    "max_turn": "The highest turning speed.",
    "source": "The reward that has the needs.",
    "move_amount": "Speed at full power.",
    "turn_amount": "Turning speed at full power.",
    "jump_power": "How strongly it jumps.",
    "jump_forward_power": "How fast it jumps forward.",
    "reward": "How much it pays; below 0 is a penalty.",
    "success_reward": "How much it pays.",
    "fail_reward": "How much it pays otherwise.",
    "only_one_time": "On: pays once an episode.",
    "cool_down": "How long it pays nothing after it has paid.",
    "threshold": "The height below which it counts as a fall.",
    "heading_tolerance_deg": "How far from straight is still good.",
    "group": "The group it is about.",
    "skip_frame": "Ticks between two decisions: 0 decides at each tick.",
    "repeat_action": "On: acts until the next decision; off: at its first tick only.",
    "name": "Its name.",
    "eye": "Where the eye is: forward, left and up, in metres.",
    "property": "What to look at: x, y, z, speed, on_ground, steps or a sensor's name.",
    "PositionSensor.target": "Which thing? Empty: the robot.",
    "event": "Which moment pays: to touch it or go in, or to leave it.",
    "ParkedRewardFunc.max_speed": "The highest speed that counts as parked.",
    **dict.fromkeys(
        (f"{name}.target" for name in ("EvalBoolValue", "EvalFloatValue", "EvalIntValue")),
        "Which thing? Empty: the robot.",
    ),
    **dict.fromkeys(
        (f"{name}.reward" for name in ("EvalBoolValue", "EvalFloatValue", "EvalIntValue")),
        "How much a block above it pays for it, if that pays for its parts.",
    ),
}
"""Hints by the parameter's name, or by class and name; others show what their class says."""
_REPLACED = (
    (r"^True:? ", "On: "),
    (r"([,;.]) False:? ", r"; off: "),
    (r"^False:? ", "Off: "),
    (r"; left out: ", ". Empty: "),
    (r"^Perception key of", "Name of the reading of"),
    (r"\bTags? of the bodies", "Group of the things"),
    (r"\bAction name\b", "Name of the action"),
    (r"\b[Bb]od(y|ies)\b", lambda found: {"y": "thing", "ies": "things"}[found[1]]),
    (r"\b[Aa]gent\b", "robot"),
)


def plain_label(field: ParameterField) -> str:
    """Return a field's label for people, with its unit.

    >>> plain_label(ParameterField("move_amount", "move amount", "number", 4, "", unit="m/s"))
    'speed (m/s)'
    """
    known = FIELD_LABELS.get(field.name)
    return field.label if known is None else f"{known} ({field.unit})" if field.unit else known


def plain_hint(field: ParameterField, block: str = "") -> str:
    """Return a field's hint without names of classes and parameters.

    Args:
        field: the field.
        block: class name of its block; empty if it is no block's.

    >>> plain_hint(ParameterField("ball", "ball", "text", "", "Perception key of a PositionSensor"))
    'Name of the reading of a "Position".'
    """
    known = FIELD_HINTS.get(f"{block}.{field.name}") or FIELD_HINTS.get(field.name)
    if known is not None and block in BLOCK_WORDS and not block.endswith("Controller"):
        return known
    text = field.hint
    for pattern, words in _REPLACED:
        text = re.sub(pattern, words, text)
    text = re.sub(r"\b[A-Z]\w+[A-Z]\w+", _title, text)
    text = re.sub(r"\b[a-z]+(_[a-z0-9]+)+\b", lambda found: found[0].replace("_", " "), text)
    return sentence(text)


def detail(field: ParameterField) -> str:
    """Return a field's name, description and range, as its class has them."""
    return ". ".join(filter(None, (field.name, field.hint, field.limits)))


def _title(found: "re.Match[str]") -> str:
    words = BLOCK_WORDS.get(found[0])
    return found[0] if words is None else f'"{words.title}"'
