"""Nearly valid inputs: bytes, texts and plain data with random faults."""

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
"""Values of wrong types, sizes and contents, put in place of the expected ones."""


def mangled(data: bytes, rng: random.Random, tokens: Sequence[bytes] = ()) -> bytes:
    """Return the bytes with one to six random faults."""
    out = bytearray(data)
    for _ in range(rng.choice((1, 1, 1, 2, 3, 6))):
        at = rng.randrange(len(out) + 1)
        span = rng.choice((1, 1, 2, 4, 8, 32))
        match rng.randrange(9):
            case 0:
                out[at:at] = rng.randbytes(span)
            case 1:
                del out[at : at + span]
            case 2 if out:
                out[at % len(out)] ^= 1 << rng.randrange(8)
            case 3:
                out[at : at + span] = rng.randbytes(span)
            case 4:
                begin = rng.randrange(len(out) + 1)
                out[at:at] = out[begin : begin + span]
            case 5:
                out[at:at] = out[at : at + span] * rng.choice((2, 3, 200))
            case 6 if tokens:
                out[at:at] = rng.choice(tokens)
            case 7 if tokens:
                token = rng.choice(tokens)
                out[at : at + len(token)] = token
            case 8:
                del out[at:]
            case _ if out:
                out[at % len(out)] = rng.choice(b"\x00\x01\x7f\x80\xff09 -")
    return bytes(out)


def bent_and_packed(tree: Any, rng: random.Random) -> bytes:
    """Return plain data with a fault in it, as msgpack."""
    while True:
        odd = bent(tree, rng)
        if rng.random() < 0.3:
            odd = bent(odd, rng)
        try:
            packed: bytes = msgpack.packb(odd, unicode_errors="replace")
        except (OverflowError, ValueError):  # msgpack has no words for it
            continue
        return packed


def bent(tree: Any, rng: random.Random, odd: Sequence[Any] = ODD) -> Any:
    """Return plain data with one value replaced; the rest is shared with the original."""
    if isinstance(tree, dict) and tree and rng.random() < 0.9:
        return _bent_mapping(tree, rng, odd)
    if isinstance(tree, list | tuple) and tree and rng.random() < 0.9:
        return _bent_list(list(tree), rng, odd)
    return _other(tree, rng, odd)


def _bent_mapping(tree: dict[Any, Any], rng: random.Random, odd: Sequence[Any]) -> Any:
    out = dict(tree)
    key = rng.choice(list(out))
    match rng.randrange(12):
        case 0:
            del out[key]
        case 1:
            out[_name(rng.choice(odd))] = rng.choice(odd)
        case 2:
            out[_name(rng.choice(odd))] = out.pop(key)
        case 3:
            out[key] = out[rng.choice(list(out))]
        case _:
            out[key] = bent(out[key], rng, odd)
    return out


def _bent_list(out: list[Any], rng: random.Random, odd: Sequence[Any]) -> Any:
    at = rng.randrange(len(out))
    match rng.randrange(12):
        case 0:
            del out[at]
        case 1:
            out.insert(at, rng.choice(odd))
        case 2:
            out.insert(at, out[rng.randrange(len(out))])
        case 3:
            other = rng.randrange(len(out))
            out[at], out[other] = out[other], out[at]
        case _:
            out[at] = bent(out[at], rng, odd)
    return out


def _other(leaf: Any, rng: random.Random, odd: Sequence[Any]) -> Any:
    if rng.random() < 0.6:
        return rng.choice(odd)
    match leaf:
        case bool():
            return not leaf
        case int():
            return leaf + rng.choice((-1, 1, 2, 2**16, -(2**33)))
        case float():
            return leaf * rng.choice((-1.0, 0.0, 1e9, 1e-9, float("nan")))
        case str():
            return leaf[: rng.randrange(len(leaf) + 1)] + rng.choice(("", "x", "\n", "é"))
        case bytes():
            return mangled(leaf, rng)
    nested: Any = leaf
    for _ in range(rng.choice((1, 3, 30, 600))):
        nested = [nested]
    return nested


def _name(value: Any) -> str:
    return value if isinstance(value, str) else repr(value)[:30]
