"""Valid messages of the native protocol, generated from the annotations of their classes."""

import random
from collections.abc import Mapping
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin, get_type_hints

from ai4u_edu.wire import native

KINDS: tuple[type[native.Message], ...] = get_args(native.Message)
NAMES = ("red", "move", "eyes", "", "s" * 20, "röbot", "speed")


def example(kind: Any, rng: random.Random) -> Any:
    """Return a random value that an annotation allows."""
    origin, parts = get_origin(kind), get_args(kind)
    if origin is Annotated:
        inner, limit = parts
        found = example(inner, rng)
        if limit.le is not None:
            return min(max(found, limit.ge), limit.le)
        return found
    if origin in (UnionType, Union):
        return example(rng.choice(parts), rng)
    if origin is Literal:
        return rng.choice(parts)
    if origin is tuple:
        return tuple(example(parts[0], rng) for _ in range(rng.randrange(4)))
    if origin is Mapping:
        return {name: example(parts[1], rng) for name in rng.sample(NAMES, 2)}
    if hasattr(kind, "__struct_fields__"):
        hints = get_type_hints(kind, include_extras=True)
        return kind(**{name: example(hints[name], rng) for name in kind.__struct_fields__})
    leaves: dict[Any, Any] = {
        int: rng.choice((0, 1, 2, 7, 2**31)),
        float: rng.choice((0.0, 1.0, -0.5, 60.0)),
        bool: rng.random() < 0.5,
        str: rng.choice(NAMES),
        bytes: rng.randbytes(rng.choice((0, 1, 4, 24))),
        NoneType: None,
    }
    return leaves[kind]
