"""The page's types of its messages, derived from the structs that the server sends and reads.

``python -m tests.web_messages`` says so if ``web/generated/messages.d.ts`` is out of date;
``--write`` writes it. The texts under the fields of a struct become the comments of its interface.
"""

import json
import sys
from collections.abc import Iterable, Mapping
from importlib import import_module
from pathlib import Path

import msgspec
from msgspec import inspect

from ai4u_edu.base.options import PAGE_OPTIONS
from ai4u_edu.blocks.parameterized import field_docs
from ai4u_edu.page.messages import Message, PageCommand
from ai4u_edu.page.panel.parts.part import PanelPart
from ai4u_edu.page.server.input_messages import InputEvent
from ai4u_edu.wire.class_link import Switches

FILE = Path(__file__).parents[1] / "web" / "generated" / "messages.d.ts"
HEAD = """\
/** The messages between a page and its world. Made by python -m tests.web_messages --write */
"""
COMMAND_FIELDS = {field.name for field in msgspec.structs.fields(PageCommand)}
"""Fields of all commands, which the socket adds."""
TYPES: Mapping[type[inspect.Type], str] = {
    inspect.AnyType: "unknown",
    inspect.BoolType: "boolean",
    inspect.FloatType: "number",
    inspect.IntType: "number",
    inspect.NoneType: "null",
    inspect.StrType: "string",
}


class Declarations:
    """Interfaces in TypeScript, one for each struct; those that a struct holds come before it."""

    def __init__(self) -> None:
        self._texts: dict[str, str] = {}
        self._classes: dict[str, type] = {}

    def __str__(self) -> str:
        return "\n".join([HEAD, *self._texts.values()])

    def received(self, kind: type) -> str:
        """Declare a struct that a page gets, and return its name."""
        return self._declared(inspect.type_info(kind), is_sent=False)

    def sent(self, kind: type) -> str:
        """Declare a struct that a page sends, and return its name."""
        return self._declared(inspect.type_info(kind), is_sent=True)

    def map(self, name: str, doc: str, names: Iterable[tuple[str, str]]) -> None:
        """Declare the types of messages by the names that they have on the wire."""
        rows = (f"  {key}: {kind};\n" for key, kind in sorted(names))
        self._texts[name] = f"{comment(doc)}export interface {name} {{\n{''.join(rows)}}}\n"

    def _declared(self, info: inspect.Type, *, is_sent: bool) -> str:
        match info:
            case inspect.StructType() | inspect.DataclassType():
                name = info.cls.__name__
                if self._classes.setdefault(name, info.cls) is not info.cls:
                    raise ValueError(f"expected one struct called {name}, got two; rename one")
                if name not in self._texts:
                    self._texts[name] = ""  # it may hold others of its kind
                    text = self._interface(info, is_sent=is_sent)
                    del self._texts[name]
                    self._texts[name] = text
                return name
            case inspect.UnionType(types):
                return " | ".join(self._declared(kind, is_sent=is_sent) for kind in types)
            case inspect.LiteralType(values):
                return " | ".join(json.dumps(value) for value in values)
            case inspect.ListType(item_type=item) | inspect.VarTupleType(item_type=item):
                text = self._declared(item, is_sent=is_sent)
                is_union = isinstance(item, inspect.UnionType | inspect.LiteralType)
                return f"({text})[]" if is_union else f"{text}[]"
            case inspect.TupleType(item_types=items):
                return f"[{', '.join(self._declared(item, is_sent=is_sent) for item in items)}]"
            case inspect.DictType(value_type=value):
                return f"Record<string, {self._declared(value, is_sent=is_sent)}>"
        return TYPES[type(info)]

    def _interface(self, info: inspect.StructType | inspect.DataclassType, *, is_sent: bool) -> str:
        docs = field_docs(info.cls)
        lines = []
        is_command = issubclass(info.cls, PageCommand)
        if isinstance(info, inspect.StructType) and info.tag_field is not None and not is_command:
            lines.append(f"  {info.tag_field}: {json.dumps(info.tag)};\n")
        for field in info.fields:
            if is_command and field.name in COMMAND_FIELDS:
                continue
            can_miss = not field.required and (is_sent or _can_be_unset(field))
            text = self._declared(field.type, is_sent=is_sent)
            lines += [
                comment(docs.get(field.name, ""), "  "),
                f"  {field.encode_name}{'?' if can_miss else ''}: {text};\n",
            ]
        doc = comment(info.cls.__doc__ or "")
        return f"{doc}export interface {info.cls.__name__} {{\n{''.join(lines)}}}\n"


def _can_be_unset(field: inspect.Field) -> bool:
    """Return True if a field is left out unless it is set; msgspec hides the type UnsetType."""
    return not field.required and field.default is field.default_factory is msgspec.NODEFAULT


def comment(text: str, indent: str = "") -> str:
    """Return a docstring as a comment; empty if there is none."""
    text = " ".join(text.replace("``", "`").split())
    return f"{indent}/** {text} */\n" if text else ""


def source() -> str:
    """Return the declarations of all messages."""
    for module in PAGE_OPTIONS:
        import_module(module)
    file = Declarations()
    parts = [(kind.__struct_defaults__[0], file.received(kind)) for kind in subclasses(PanelPart)]
    file.map("PanelParts", "The parts of the panel by name.", parts)
    for kind in subclasses(InputEvent):
        file.received(kind)
    file.received(Switches)
    for kind in subclasses(Message):
        file.sent(kind)
    commands = [
        (str(kind.__struct_config__.tag), file.sent(kind)) for kind in subclasses(PageCommand)
    ]
    file.map("Commands", "The commands by name: what is sent with each of them.", commands)
    return str(file)


def subclasses(base: type[msgspec.Struct]) -> list[type[msgspec.Struct]]:
    """Return the subclasses of a struct in the order of their names."""
    return sorted(base.__subclasses__(), key=lambda kind: kind.__name__)


def main() -> None:
    """Say whether the file is out of date; with ``--write``, write it."""
    text = source()
    is_stale = not FILE.is_file() or FILE.read_text(encoding="utf-8") != text
    if "--write" in sys.argv:
        FILE.write_text(text, encoding="utf-8")
    elif is_stale:
        sys.exit(f"{FILE} is out of date; run: python -m tests.web_messages --write")


if __name__ == "__main__":
    main()
