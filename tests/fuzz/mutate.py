"""Inputs that are nearly right: bytes, texts and plain data with something wrong in them."""

import random
from collections.abc import Sequence
from typing import Any

import msgpack

ODD: tuple[Any, ...] = (
    None,
    True,
    False,
    0,
    -1,
    1,
    255,
    2**31,
    2**53,
    2**63,
    2**64 - 1,
    -(2**63),
    0.0,
    -0.0,
    1e-320,
    1e308,
    float("inf"),
    float("-inf"),
    float("nan"),
    "",
    "x",
    "\x00",
    "\u202e\U0001f916",
    "1e999",
    "../../etc/passwd",
    "<script>",
    "9" * 5000,
    b"",
    b"\x00" * 9,
    b"\xff" * 40,
    [],
    {},
    [[]],
    [0] * 1025,
    {"": None},
    {"type": "x"},
)
"""What stands where something else is expected."""


def mangled(data: bytes, chance: random.Random, tokens: Sequence[bytes] = ()) -> bytes:
    """Bytes after one to six small accidents."""
    out = bytearray(data)
    for _ in range(chance.choice((1, 1, 1, 2, 3, 6))):
        at = chance.randrange(len(out) + 1)
        span = chance.choice((1, 1, 2, 4, 8, 32))
        match chance.randrange(9):
            case 0:
                out[at:at] = chance.randbytes(span)
            case 1:
                del out[at : at + span]
            case 2 if out:
                out[at % len(out)] ^= 1 << chance.randrange(8)
            case 3:
                out[at : at + span] = chance.randbytes(span)
            case 4:
                begin = chance.randrange(len(out) + 1)
                out[at:at] = out[begin : begin + span]
            case 5:
                out[at:at] = out[at : at + span] * chance.choice((2, 3, 200))
            case 6 if tokens:
                out[at:at] = chance.choice(tokens)
            case 7 if tokens:
                token = chance.choice(tokens)
                out[at : at + len(token)] = token
            case 8:
                del out[at:]
            case _ if out:
                out[at % len(out)] = chance.choice(b"\x00\x01\x7f\x80\xff09 -")
    return bytes(out)


def bent_and_packed(tree: Any, chance: random.Random) -> bytes:
    """Plain data with something wrong in it, as msgpack."""
    while True:
        odd = bent(tree, chance)
        if chance.random() < 0.3:
            odd = bent(odd, chance)
        try:
            packed: bytes = msgpack.packb(odd, unicode_errors="replace")
        except (OverflowError, ValueError):  # msgpack has no words for it
            continue
        return packed


def bent(tree: Any, chance: random.Random, odd: Sequence[Any] = ODD) -> Any:
    """Plain data in which one thing is another one; what is not touched is shared."""
    if isinstance(tree, dict) and tree and chance.random() < 0.9:
        return _bent_mapping(tree, chance, odd)
    if isinstance(tree, list | tuple) and tree and chance.random() < 0.9:
        return _bent_list(list(tree), chance, odd)
    return _other(tree, chance, odd)


def _bent_mapping(tree: dict[Any, Any], chance: random.Random, odd: Sequence[Any]) -> Any:
    out = dict(tree)
    key = chance.choice(list(out))
    match chance.randrange(12):
        case 0:
            del out[key]
        case 1:
            out[_name(chance.choice(odd))] = chance.choice(odd)
        case 2:
            out[_name(chance.choice(odd))] = out.pop(key)
        case 3:
            out[key] = out[chance.choice(list(out))]
        case _:
            out[key] = bent(out[key], chance, odd)
    return out


def _bent_list(out: list[Any], chance: random.Random, odd: Sequence[Any]) -> Any:
    at = chance.randrange(len(out))
    match chance.randrange(12):
        case 0:
            del out[at]
        case 1:
            out.insert(at, chance.choice(odd))
        case 2:
            out.insert(at, out[chance.randrange(len(out))])
        case 3:
            other = chance.randrange(len(out))
            out[at], out[other] = out[other], out[at]
        case _:
            out[at] = bent(out[at], chance, odd)
    return out


def _other(leaf: Any, chance: random.Random, odd: Sequence[Any]) -> Any:
    if chance.random() < 0.6:
        return chance.choice(odd)
    match leaf:
        case bool():
            return not leaf
        case int():
            return leaf + chance.choice((-1, 1, 2, 2**16, -(2**33)))
        case float():
            return leaf * chance.choice((-1.0, 0.0, 1e9, 1e-9, float("nan")))
        case str():
            return leaf[: chance.randrange(len(leaf) + 1)] + chance.choice(("", "x", "\n", "é"))
        case bytes():
            return mangled(leaf, chance)
    nested: Any = leaf
    for _ in range(chance.choice((1, 3, 30, 600))):
        nested = [nested]
    return nested


def _name(value: Any) -> str:
    return value if isinstance(value, str) else repr(value)[:30]
