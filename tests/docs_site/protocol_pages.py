"""The reference of the wire protocol: its messages, made of their declarations."""

import typing
from typing import Any

import msgspec

from ai4u_edu.blocks.parameterized import field_docs
from ai4u_edu.wire import native
from tests.docs_site import rst
from tests.docs_site.staging import Staging

RECORDS: tuple[type[msgspec.Struct], ...] = (native.Reading, native.Output)
"""Structures inside of messages."""
MAX_SHOWN = 10**12
"""Larger bounds are those of the number's type."""


def messages() -> list[type[msgspec.Struct]]:
    """Return all messages, in the order of the dialogue."""
    return list(typing.get_args(native.Message))


def add_protocol(site: Staging) -> None:
    """Write a page with all messages under the page of the protocol."""
    parts = [rst.title("Messages"), ".. automodule:: ai4u_edu.wire.native\n   :no-index:\n"]
    for cls in [*messages(), *RECORDS]:
        parts += [rst.title(cls.__name__, "-"), (cls.__doc__ or "").strip() + "\n", _fields(cls)]
    codes = [(rst.literal(name), str(code)) for name, code in native.PROBLEMS.items()]
    parts += [
        rst.title("Errors that close the connection", "-"),
        rst.table(
            ("code in the message ``Problem``", "close code of the WebSocket"), codes, (1, 1)
        ),
    ]
    site.write("protocol/messages.rst", "\n".join(parts))
    toctree = "```{toctree}\n:hidden:\n\nprotocol/messages\n```\n"
    site.append("protocol.md", f"All of them: [messages](protocol/messages.rst).\n\n{toctree}")


def _fields(cls: type[msgspec.Struct]) -> str:
    docs = field_docs(cls)
    rows = []
    for field in msgspec.structs.fields(cls):
        default = "" if field.default is msgspec.NODEFAULT else rst.literal(repr(field.default))
        rows.append(
            (rst.literal(field.name), type_words(field.type), default, docs.get(field.name, ""))
        )
    return rst.table(("field", "type", "default", "what it is"), rows, (2, 3, 1, 5))


def type_words(kind: Any) -> str:
    """Return a field's type in words, with its bounds.

    >>> type_words(int), type_words(native.Mode)
    ('int', '``lockstep``, ``realtime``')
    """
    return _words(msgspec.inspect.type_info(kind))


def _words(info: Any) -> str:
    inspect = msgspec.inspect
    match info:
        case inspect.LiteralType(values=values):
            return ", ".join(rst.literal(str(each)) or "empty" for each in values)
        case inspect.IntType(ge=low, le=high) | inspect.FloatType(ge=low, le=high):
            name = "int" if isinstance(info, inspect.IntType) else "float"
            least = "" if low is None or abs(low) > MAX_SHOWN else f"from {low}"
            most = "" if high is None or abs(high) > MAX_SHOWN else f"to {high}"
            return " ".join(filter(None, (name, least, most)))
        case inspect.StrType(max_length=most) | inspect.BytesType(max_length=most):
            name = "text" if isinstance(info, inspect.StrType) else "bytes"
            return f"{name}, at most {most}" if most else name
        case inspect.VarTupleType(item_type=item):
            return f"list of {_words(item)}"
        case inspect.DictType(key_type=key, value_type=value):
            return f"map from {_words(key)} to {_words(value)}"
        case inspect.StructType(cls=cls):
            return str(cls.__name__)
        case inspect.UnionType(types=types):
            return " or ".join(map(_words, types))
        case inspect.BoolType():
            return "bool"
        case inspect.NoneType():
            return "none"
    return type(info).__name__.removesuffix("Type").lower()
