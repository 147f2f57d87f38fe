"""Lesson pages and tables that are generated from the blocks' declarations."""

import inspect
import json
import re
from typing import Any, NamedTuple

from ai4u_edu.base.errors import NameNotFoundError, suggest
from ai4u_edu.base.parameters import is_open
from ai4u_edu.blocks.actuators.actuator import Actuator
from ai4u_edu.blocks.block import Block, is_built_in
from ai4u_edu.blocks.brains.brain import Brain
from ai4u_edu.blocks.brains.controllers.controller import Controller
from ai4u_edu.blocks.rewards.reward_func import RewardFunc
from ai4u_edu.blocks.sensors.sensor import Sensor
from ai4u_edu.locale import Text, join, translate
from ai4u_edu.locale import gettext as _

KINDS: dict[str, type[Block]] = {
    "sensors": Sensor,
    "actuators": Actuator,
    "rewards": RewardFunc,
    "brains": Brain,
    "controllers": Controller,
}

PARTS = "parts"
"""Blocks inside other blocks, such as the internal variables of a HomeostaticReward."""
KIND_TITLES = {
    "sensors": _("sensors"),
    "actuators": _("actuators"),
    "rewards": _("rewards"),
    "brains": _("brains"),
    "controllers": _("controllers"),
    PARTS: _("parts"),
}


class ParameterRow(NamedTuple):
    """A parameter of a block, in words."""

    name: str
    default: str
    """The default value as JSON; "(needed)" without one, "(own)" if each block makes its own."""
    values: str
    """Type and bounds, or the choices."""
    unit: str
    text: str


def built_in_blocks() -> dict[str, list[type[Block]]]:
    """Return all blocks of this package by kind, sorted by name."""
    blocks = [Block.types[name] for name in sorted(Block.types)]
    own = [cls for cls in blocks if is_built_in(cls) and not cls.__dict__.get("abstract")]
    found = {
        name: [cls for cls in own if issubclass(cls, kind) and cls is not kind]
        for name, kind in KINDS.items()
    }
    kinds = tuple(KINDS.values())
    return found | {PARTS: [cls for cls in own if not issubclass(cls, kinds)]}


def summary(cls: type[Block]) -> str:
    """Return the first line of a block's description."""
    return (inspect.getdoc(cls) or "").split("\n", 1)[0]


def short_summary(cls: type[Block]) -> Text:
    """Return a block's summary without its source, which is translated for built-in blocks."""
    return Text(summary(cls).split(" Source:")[0].replace("``", ""))


def differences(cls: type[Block]) -> str:
    """Return the "Differs from AI4U" paragraph of a block's description; empty if there is none."""
    found = re.search(r"Differs from AI4U: (.*?)(?:\n\n|$)", inspect.getdoc(cls) or "", re.DOTALL)
    text = " ".join(found[1].split()) if found else ""
    return text[:1].upper() + text[1:]


def _ai4u_sources() -> dict[str, type[Block]]:
    """Return the blocks that come from AI4U, by their names there."""
    found = {}
    for cls in (cls for members in built_in_blocks().values() for cls in members):
        source = re.search(r"Source:\s+AI4U(?:'s\s+(\w+))?", inspect.getdoc(cls) or "")
        if source:
            found[source[1] or cls.__name__] = cls
    return found


def coming_from_ai4u() -> str:
    """Return a Markdown table of AI4U's classes and their counterparts here."""
    rows = [
        (theirs, cls.__name__, summary(cls).split(" Source:")[0], differences(cls))
        for theirs, cls in _ai4u_sources().items()
    ]
    rows += [(*each, "") for each in _AI4U_CLASSES]
    lines = ["| AI4U | here | what it is | what differs |", "|---|---|---|---|"]
    for theirs, here, what, differs in sorted(rows, key=lambda row: row[0].lower()):
        lines.append(f"| `{theirs}` | {f'`{here}`' if here else '-'} | {what} | {differs} |")
    return "\n".join(lines)


def lesson_page(name: str) -> str:
    """Return the description and the parameters of a block, in the reader's language.

    The description stays in English.

    Raises:
        NameNotFoundError: there is no such block; the message suggests the nearest name.

    >>> print(lesson_page("BearingSensor").splitlines()[0])
    BearingSensor: [sine, cosine] of the angle to the target, counter-clockwise from the heading.
    """
    known = {cls.__name__: cls for kind in built_in_blocks().values() for cls in kind}
    if name not in known:
        hint = _hint_from_ai4u(name) or suggest(name, known)
        raise NameNotFoundError(_("no block is called {name!r}; {hint}", name=name, hint=hint))
    cls = known[name]
    described = (inspect.getdoc(cls) or "").split("\n\n>>>")[0]
    rows = [(translate(_("parameter")), translate(_("default")), translate(_("range")), "")]
    for field, default, values, unit, text in parameter_rows(cls):
        limits = " ".join(filter(None, (translate(values), unit)))
        rows.append((field, translate(default), limits, translate(text)))
    widths = [max(len(row[column]) for row in rows) for column in range(3)]
    lines = ["  ".join((*map(str.ljust, row[:3], widths), row[3])).rstrip() for row in rows]
    return "\n".join([f"{name}: {described}", "", *lines])


def parameter_rows(cls: type[Block]) -> list[ParameterRow]:
    """Return a block's parameters in words, those of its bases first.

    >>> parameter_rows(Block.types["VelocitySensor"])[-1].unit
    'rad/s'
    """
    return schema_rows(cls.json_schema())


def schema_rows(schema: dict[str, Any]) -> list[ParameterRow]:
    """Return the parameters of an object in words.

    Args:
        schema: the object's JSON Schema.
    """
    rows = []
    for field, about in schema.get("properties", {}).items():
        missing = _("(needed)") if field in schema.get("required", ()) else _("(own)")
        default = json.dumps(about["default"]) if "default" in about else missing
        rows.append(
            ParameterRow(field, default, *_range(about), Text(about.get("description", "")))
        )
    return rows


def _hint_from_ai4u(name: str) -> str:
    """Return a clause on the counterpart of a class of AI4U; empty for any other name."""
    source = _ai4u_sources().get(name)
    if source is not None:
        return _("AI4U's {name} is {here} here", name=name, here=source.__name__)
    for each in _AI4U_CLASSES:
        if each.ai4u == name:
            there = _(
                "AI4U's {name} has no class of its own here. {more}", name=name, more=each.words
            )
            if each.here:
                there = _(
                    "AI4U's {name} is {here} here. {more}",
                    name=name,
                    here=each.here,
                    more=each.words,
                )
            return there
    return ""


def _range(about: dict[str, Any]) -> tuple[str, str]:
    """Return a parameter's type and bounds as a short text, and its unit."""
    if "enum" in about:
        return " | ".join(map(str, about["enum"])), ""
    options = [each for each in about.get("anyOf", ()) if each.get("type") != "null"]
    about = {**about, **options[0]} if options else about
    kind = {"number": "", "integer": _("whole"), "boolean": "true | false", "string": _("text")}
    kind |= {"array": _("list"), "object": _("mapping")}
    low = about.get("minimum", about.get("exclusiveMinimum"))
    high = about.get("maximum", about.get("exclusiveMaximum"))
    bounds = f"{_show(low)}..{_show(high)}" if _show(low) or _show(high) else ""
    name = str(about.get("type", ""))
    limits = join([part for part in (kind.get(name, name), bounds) if part])
    return limits, str(about.get("unit", ""))


def _show(bound: float | None) -> str:
    if bound is None or is_open(bound):
        return ""
    return f"{bound}" if isinstance(bound, int) else f"{bound:g}"


class _Counterpart(NamedTuple):
    """A class of AI4U that no block here names as its source, and its counterpart here."""

    ai4u: str
    here: str
    """Name that ``ai4u_edu`` exports; empty if there is none."""
    words: str


_AI4U_CLASSES = (
    _Counterpart("Actuator", "Actuator", _("The base of all actuators.")),
    _Counterpart(
        "AgentRewardFunc",
        "BasicAgent",
        _("No block: ``agent.add_reward(amount, request_done)``, from any event's handler."),
    ),
    _Counterpart(
        "ArrowPhysicsMoveController2D",
        "ArrowController",
        _("One controller for all bodies; ``components`` and the lists of keys adapt it."),
    ),
    _Counterpart(
        "BasicAgent", "BasicAgent", _("A body with sensors, actuators, rewards and a brain.")
    ),
    _Counterpart("Brain", "Brain", _("The base of all brains.")),
    _Counterpart(
        "Camera",
        "LocalGridSensor",
        _("There is no camera, but an image from above, for image policies."),
    ),
    _Counterpart(
        "Camera3DSensor", "LocalGridSensor", _("Like Camera; grayScale doesn't exist here.")
    ),
    _Counterpart(
        "CBMoveActuator2D",
        "CBMoveActuator",
        _("The world is seen from above: flipWhenTurn and lerpFactor don't exist here."),
    ),
    _Counterpart(
        "CBRespawnActuator",
        "RespawnActuator",
        _("radomizeDirection is ``randomise_heading``, and off by default."),
    ),
    _Counterpart(
        "CBRespawnActuator2D", "RespawnActuator", _("flipWhenTurn and randomize don't exist here.")
    ),
    _Counterpart("Controller", "Controller", _("The base of all controllers of a LocalBrain.")),
    _Counterpart(
        "ControlRequestor",
        "ControlRequestor",
        _("The decision cycle of a world and its agents: ``ControlRequestor(world, [agent])``."),
    ),
    _Counterpart(
        "LinearRayCastingSensor2D",
        "LinearRayCastingSensor",
        _("groupCode and groupName are one table, ``group_code``; shift is ``horizontal_shift``."),
    ),
    _Counterpart(
        "LocalBrain", "LocalBrain", _("A brain in this process, which asks its controller.")
    ),
    _Counterpart("MinDistReward2D", "MinDistReward", _("One block for both.")),
    _Counterpart(
        "RaycastMapping", "", _("No class: a ray sensor's ``group_code`` is a dictionary.")
    ),
    _Counterpart(
        "RBMoveActuator2D", "RBMoveActuator", _("One block for both; here it moves the body.")
    ),
    _Counterpart(
        "RestlessnessRewardFunc",
        "RestlessnessRewardFunc",
        _(
            "The 3D version, with increseRate and decreaseRate, punishes moving: ours is the "
            "2D one."
        ),
    ),
    _Counterpart("RewardFunc", "RewardFunc", _("The base of all reward functions.")),
    _Counterpart(
        "RLAgent",
        "BasicAgent",
        _("The later name of BasicAgent; ``done_at_negative_reward`` is off by default, there on."),
    ),
    _Counterpart(
        "ScreenSensor",
        "LocalGridSensor",
        _("Like Camera. To watch a world, open its page or render it."),
    ),
    _Counterpart(
        "Sensor",
        "Sensor",
        _("The base of all sensors; ``normalized`` is off by default, there on."),
    ),
    _Counterpart(
        "TouchRewardFunc2D",
        "TouchRewardFunc",
        _("One block for both; a target may be an area. The cool-down is 0, there 0.2 s."),
    ),
    _Counterpart(
        "Trainer",
        "Trainer",
        _("A script that gets each percept of a TrainController and directs it."),
    ),
    _Counterpart(
        "Utils",
        "",
        _("No class: percepts and actions are dictionaries with numbers in them."),
    ),
)
