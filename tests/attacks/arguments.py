"""Likely and odd messages to the panel's socket, for whatever its parts have named so far."""

import json
import math
import random
from typing import Any

import msgspec
from msgspec import inspect

from ai4u_edu.explain.page import messages as explain_messages
from ai4u_edu.page.messages import PageCommand
from ai4u_edu.page.panel.commands import blocks, past, run, scenes, view, world
from ai4u_edu.page.server import run_commands
from tests.attacks.test_odd_input_messages import ODD

Message = dict[str, Any]

OWN_COMMANDS, EXPLAIN_COMMANDS = (
    [
        kind
        for module in modules
        for kind in vars(module).values()
        if isinstance(kind, type) and issubclass(kind, PageCommand) and kind is not PageCommand
    ]
    for modules in ((run_commands, blocks, past, run, scenes, view, world), (explain_messages,))
)
"""Types of the panel's own commands, and of those about explanations."""
NAMES = {str(kind.__struct_config__.tag): kind for kind in (*OWN_COMMANDS, *EXPLAIN_COMMANDS)}
"""Types of commands by name."""

TEXTS = ("", "a", "wall", "box", "Lesson 1", "0", "-1.5", "ünï", "<b>x</b>", "../../etc", "x" * 300)
TABS = ("agent", "blocks", "world", "past")
KINDS = ("sensors", "actuators", "rewards", "brains")
WORLD_OPENERS = ("open_scene", "load_text", "restore")
"""Commands that replace the world; they are sent rarely, so that others have an effect first."""
ODD_SHARE = 0.1
REPLACE_SHARE = 0.1
"""Probability that a command that replaces the world is sent once it was drawn."""
NAME_POOLS = {
    "driver": "driver",
    "open_scene": "scene",
    "save_scene": "",
    "lay_picture": "",
    "load_text": "",
    "open_recording": "",
}
"""Kinds of names that a field ``name`` takes, by command; others take a body."""
FORMS = {
    "change_block": "block",
    "change_agent": "agent settings",
    "change_body": "thing",
    "change_settings": "scene settings",
    "change_field": "field",
}
"""Forms whose values the commands send."""
LISTS = {"drivers": "driver", "scenes": "scene", "gallery": "class", "palette": "template"}
"""Kinds of the names that a command lists."""


class Known:
    """Names that the server has told a page, by kind; the reader replaces whole lists only."""

    def __init__(self) -> None:
        self.names: dict[str, list[Any]] = {"number": [0]}
        self.forms: dict[str, list[Message]] = {}
        self.form_of: dict[str, Any] = {}
        """Path or name of the block and the thing whose form is shown."""
        self.listed = "sensors"
        """Kind of the blocks in the gallery."""
        self.scene_file = ""

    def note_part(self, part: Message) -> None:
        """Keep the names in a part."""
        match part["name"]:
            case "scene":
                self.names["agent"] = [agent["id"] for agent in part["agents"]]
            case "agent":
                self.names["key"] = [sensor["key"] for sensor in part["sensors"]]
            case "blocks":
                blocks = [each for kind in KINDS for each in _all(part["kinds"].get(kind, []))]
                self.names["path"] = [each["path"] for each in blocks]
                self.forms["agent settings"] = part["settings"]
                self._note_form("block", part["form"], "path")
            case "world":
                self.names["body"] = [body["name"] for body in part["bodies"]]
                self.forms["scene settings"] = part["settings"]
                self.forms["field"] = part["field"]
                self._note_form("thing", part["form"], "name")
            case "past":
                self.names["number"] = [0, *(each["number"] for each in part["episodes"])]

    def note_answer(self, asked: Message, answer: Message) -> None:
        """Keep the names in the answer to a command."""
        command = asked["command"]
        if command == "download":
            self.scene_file = answer["content"]
        elif command in LISTS:
            kind = LISTS[command]
            key = "class" if kind == "class" else "name"
            self.listed = asked.get("kind", self.listed)
            self.names[kind] = [each[key] for each in answer["items"]]

    def draw(self, kind: str, rng: random.Random) -> Any:
        """Return a known name of a kind, or a text."""
        return rng.choice(self.names.get(kind) or TEXTS)

    def _note_form(self, kind: str, form: Message | None, key: str) -> None:
        if form is not None:
            self.forms[kind], self.form_of[kind] = form["fields"], form[key]


def show_message(known: Known, rng: random.Random) -> Message:
    """Return a message that looks at something."""
    return {
        "type": "show",
        "agent": known.draw("agent", rng),
        "tabs": rng.sample(TABS, rng.randint(1, len(TABS))),
        "block": rng.choice(known.names.get("path") or [None]),
        "body": known.draw("body", rng),
        "episode": known.draw("number", rng),
    }


def draw_command(rng: random.Random) -> str:
    """Return the name of a random command."""
    while True:
        name = rng.choice(sorted(NAMES))
        if name not in WORLD_OPENERS or rng.random() < REPLACE_SHARE:
            return name


def arguments(name: str, known: Known, rng: random.Random) -> Message:
    """Return likely arguments of a command."""
    fields = inspect.type_info(NAMES[name])
    assert isinstance(fields, inspect.StructType)
    shared = {each.name for each in msgspec.structs.fields(PageCommand)}
    found = {
        field.encode_name: _value(name, field, known, rng)
        for field in fields.fields
        if field.name not in shared and (field.required or rng.random() < 0.5)
    }
    form = FORMS.get(name, "")
    if form in known.form_of:
        found["path" if form == "block" else "name"] = known.form_of[form]
    return found


def spoilt(message: Message, rng: random.Random) -> str:
    """Return a message as JSON, with an odd value in one place."""
    place = rng.choice([*message, "more"])
    return json.dumps(message | {place: "%odd%"}).replace('"%odd%"', rng.choice(ODD))


def _value(command: str, field: inspect.Field, known: Known, rng: random.Random) -> Any:
    match field.encode_name:
        case "name":
            return known.draw(NAME_POOLS.get(command, "body"), rng)
        case "names":
            return [known.draw("body", rng) for _ in range(rng.randint(1, 3))]
        case "corners":
            return [[rng.uniform(-9, 9), rng.uniform(-9, 9)] for _ in range(rng.randint(1, 4))]
        case "parent":
            return [known.listed]
        case "path":
            return known.draw("path", rng) if known.names.get("path") else ["sensors", 0]
        case "seed":
            return str(rng.randrange(10**6))
        case "values" if command in FORMS:
            return _entered(known.forms.get(FORMS[command]) or [], rng)
        case "changes":
            change = {"key": known.draw("key", rng), "index": rng.randrange(4), "value": 0.5}
            return [change]
        case "facing":
            return rng.choice(("", known.draw("body", rng)))
        case "first" | "second":
            return rng.choice(("", known.draw("driver", rng)))
        case "agent" | "body" | "class" | "key" | "template" | "number" as kind:
            return known.draw(kind, rng)
    return _of_type(field.type, rng)


def _of_type(kind: inspect.Type, rng: random.Random) -> Any:
    match kind:
        case inspect.UnionType():
            return _of_type(rng.choice(kind.types), rng)
        case inspect.LiteralType():
            return rng.choice(kind.values)
        case inspect.BoolType():
            return rng.random() < 0.5
        case inspect.IntType():
            return rng.randint(max(kind.ge or 0, -10), min(kind.le or 10, 10))
        case inspect.FloatType():
            low = 0.1 if kind.gt is not None else max(kind.ge or 0.0, -10.0)
            return rng.uniform(low, min(kind.le or 10.0, 10.0))
    return None


def _entered(fields: list[Message], rng: random.Random) -> Message:
    """Return what a form's user has entered in some of its fields."""
    found: Message = {}
    for field in rng.sample(fields, min(len(fields), rng.randint(1, 3))):
        match field["kind"]:
            case "switch":
                found[field["name"]] = rng.random() < 0.5
            case "choice" if field["choices"]:
                found[field["name"]] = rng.choice(field["choices"])
            case "number" | "whole" as kind:
                low = -5.0 if field["low"] is None else field["low"]
                high = low + 10.0 if field["high"] is None else min(field["high"], low + 1000.0)
                value = rng.uniform(low, high)
                found[field["name"]] = str(math.floor(value) if kind == "whole" else value)
            case _:
                found[field["name"]] = rng.choice((field["shown"], *TEXTS))
    return found


def _all(blocks: list[Message]) -> list[Message]:
    return [found for each in blocks for found in (each, *_all(each["children"]))]
