"""Hints below the fields of forms, in plain words; names and ranges are in Details."""

import re

from ai4u_edu.locale import Text, join, sentence
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing.forms import ParameterField, with_unit
from ai4u_edu.page.panel.block_words import BLOCK_WORDS

FIELD_LABELS = {
    "vision_max_distance": _("how far it sees"),
    "max_distance": _("how far it sees"),
    "return_code": _("say what each ray hits"),
    "return_distance": _("say how far away it is"),
    "group_code": _("number for each group"),
    "move_amount": _("speed"),
    "turn_amount": _("turning speed"),
    "only_one_time": _("only once"),
}
"""Labels of fields whose names say too little, by the parameter's name; Details shows the name."""
FIELD_HINTS = {
    "perception_key": _("The sensor's name."),
    "stacked_observations": _("How many of the latest readings are kept."),
    "normalized": _("On: numbers from -1 to 1; off: metres, degrees and so on."),
    "resetable": _("On: readings start again with each episode."),
    "is_input": _("On: a learning robot gets this reading."),
    "noise": _("Random error of the reading."),
    "delay": _("How many decisions the reading is late."),
    "dropout": _("How often a reading is lost, from 0 to 1."),
    "is_output": _("On: a learning robot uses it."),
    "action_name": _("The action's name."),
    "cause_episode_to_end": _("On: the episode ends with it."),
    "group_code": _("The number that stands for each group."),
    "number_of_rays": _("How many rays; more see finer."),
    "rows": _("How many rows."),
    "columns": _("How many columns."),
    "width": _("How wide it is."),
    "height": _("How many rows."),
    "cell_size": _("How large a cell is."),
    "field_of_view": _("How wide it looks; 360 is all around."),
    "vision_max_distance": _("How far it sees."),
    "vertical_field_of_view": _("How far it looks up and down."),
    "vertical_shift": _("How far down it looks."),
    "return_distance": _("On: also tells how far away."),
    "return_code": _("On: tells what each ray hits."),
    "normalize_distance": _("On: distance from 0 to 1; off: in metres."),
    "visibility_test": _("On: sees nothing behind other things."),
    "self_exclude": _("On: doesn't see the robot itself."),
    "max_distance": _("How far it sees. Empty: everywhere."),
    "radius": _("How far it reaches. Empty: everywhere."),
    "target": _("Which thing?"),
    "reference": _("The thing from which to look. Empty: the robot."),
    "info": _("What to tell: direction, distance or both."),
    "max_speed": _("The highest speed."),
    "max_turn": _("The highest turning speed."),
    "source": _("The reward that has the needs."),
    "move_amount": _("Speed at full power."),
    "turn_amount": _("Turning speed at full power."),
    "jump_power": _("How strongly it jumps."),
    "jump_forward_power": _("How fast it jumps forward."),
    "reward": _("How much it pays; below 0 is a penalty."),
    "success_reward": _("How much it pays."),
    "fail_reward": _("How much it pays otherwise."),
    "only_one_time": _("On: pays once an episode."),
    "cool_down": _("How long it pays nothing after it has paid."),
    "threshold": _("The height below which it counts as a fall."),
    "heading_tolerance_deg": _("How far from straight is still good."),
    "group": _("The group it is about."),
    "skip_frame": _("Ticks between two decisions: 0 decides at each tick."),
    "repeat_action": _("On: acts until the next decision; off: at its first tick only."),
    "name": _("Its name."),
    "eye": _("Where the eye is: forward, left and up, in metres."),
    "property": _("What to look at: x, y, z, speed, on_ground, steps or a sensor's name."),
    "PositionSensor.target": _("Which thing? Empty: the robot."),
    "event": _("Which moment pays: to touch it or go in, or to leave it."),
    "ParkedRewardFunc.max_speed": _("The highest speed that counts as parked."),
    **dict.fromkeys(
        (f"{name}.target" for name in ("EvalBoolValue", "EvalFloatValue", "EvalIntValue")),
        _("Which thing? Empty: the robot."),
    ),
    **dict.fromkeys(
        (f"{name}.reward" for name in ("EvalBoolValue", "EvalFloatValue", "EvalIntValue")),
        _("How much a block above it pays for it, if that pays for its parts."),
    ),
}
"""Hints by the parameter's name, or by class and name; others show what their class says."""
_REPLACED = (
    (r"``", ""),
    (r"^True:? ", "On: "),
    (r"([,;.]) False:? ", r"; off: "),
    (r"^False:? ", "Off: "),
    (r"; left out: ", ". Empty: "),
    (r"^Perception key of", "Name of the reading of"),
    (r"\bTags? of the bodies", "Group of the things"),
    (r"\bAction name\b", "Name of the action"),
    (r"\b[Bb]od(y|ies)\b", lambda found: {"y": "thing", "ies": "things"}[found[1]]),
    (r"\b[Aa]n agent\b", "a robot"),
    (r"\b[Aa]gent\b", "robot"),
)


def plain_label(field: ParameterField) -> str:
    """Return a field's label for people, with its unit.

    >>> plain_label(ParameterField("move_amount", "move amount", "number", 4, "", unit="m/s"))
    'speed (m/s)'
    """
    known = FIELD_LABELS.get(field.name)
    if known is None or not field.unit:
        return known or field.label
    return with_unit(known, field.unit)


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
    return join([text for text in (_plain(field.hint), field.note) if text])


def detail(field: ParameterField) -> str:
    """Return a field's name, description and range, as its class has them."""
    texts = (f"{field.name}.", sentence(field.hint), field.limits, field.note)
    return join([text for text in texts if text])


def _plain(hint: str) -> str:
    """Return a hint in plain words.

    Where the plain words are others, they are another text to translate: ``tests/form_texts.py``
    collects them.
    """
    text = str(hint)
    for pattern, words in _REPLACED:
        text = re.sub(pattern, words, text)
    text = re.sub(r"\b[A-Z]\w+[A-Z]\w+", _title, text)
    text = re.sub(r"\b[a-z]+(_[a-z0-9]+)+\b", lambda found: found[0].replace("_", " "), text)
    return sentence(hint) if text == hint else Text(sentence(text))


def _title(found: "re.Match[str]") -> str:
    words = BLOCK_WORDS.get(found[0])
    return found[0] if words is None else f'"{words.title}"'
