"""Right messages of our own protocol, made by what their classes declare."""

import random
from collections.abc import Mapping
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin, get_type_hints

from ai4u_edu.wire import native

KINDS: tuple[type[native.Message], ...] = get_args(native.Message)
NAMES = ("red", "move", "eyes", "", "s" * 20, "röbot", "speed")


def example(kind: Any, chance: random.Random) -> Any:
    """Something that an annotation lets through."""
    origin, parts = get_origin(kind), get_args(kind)
    if origin is Annotated:
        inner, limit = parts
        found = example(inner, chance)
        if limit.le is not None:
            return min(max(found, limit.ge), limit.le)
        return found
    if origin in (UnionType, Union):
        return example(chance.choice(parts), chance)
    if origin is Literal:
        return chance.choice(parts)
    if origin is tuple:
        return tuple(example(parts[0], chance) for _ in range(chance.randrange(4)))
    if origin is Mapping:
        return {name: example(parts[1], chance) for name in chance.sample(NAMES, 2)}
    if hasattr(kind, "__struct_fields__"):
        hints = get_type_hints(kind, include_extras=True)
        return kind(**{name: example(hints[name], chance) for name in kind.__struct_fields__})
    leaves: dict[Any, Any] = {
        int: chance.choice((0, 1, 2, 7, 2**31)),
        float: chance.choice((0.0, 1.0, -0.5, 60.0)),
        bool: chance.random() < 0.5,
        str: chance.choice(NAMES),
        bytes: chance.randbytes(chance.choice((0, 1, 4, 24))),
        NoneType: None,
    }
    return leaves[kind]
