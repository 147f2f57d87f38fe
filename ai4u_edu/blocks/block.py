"""The base of all blocks: declared parameters, setup and reset."""

import re
import sys
import threading
from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from copy import copy, deepcopy
from functools import cache
from typing import Any, ClassVar

import numpy as np

from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.parameterized import Parameterized
from ai4u_edu.world import WorldView

_UNCHANGING = {bool, int, float, str, tuple, type(None)}
_registering = threading.Lock()


class Block(Parameterized):
    """The base of sensors, actuators, reward functions, brains and controllers."""

    types: ClassVar[dict[str, type["Block"]]] = {}
    """All classes of blocks by name, as in scene files; replaced by each new one, never changed,
    since another thread may read it."""

    abstract: ClassVar[bool] = False
    """True for a class that is only a base of others; it applies to the class that sets it."""

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        with _registering:
            Block.types = {**Block.types, cls.__name__: cls}

    carried: ClassVar[tuple[str, ...]] = ()
    """Attributes that an episode changes, besides those of the base classes; a copy of the world
    at one moment gets them."""

    def inner_blocks(self) -> "Sequence[Block]":
        """Return the blocks inside this one, which it sets up and resets; most have none."""
        return ()

    def fixed_at_setup(self) -> dict[str, object]:
        """Return attributes that count at setup only, by name; the next reset refuses others."""
        return {}

    def get_state(self) -> dict[str, Any]:
        """Return a copy of all that an episode has changed in this block, by attribute.

        These are the attributes that its class declares in :attr:`carried`. A class that is not of
        this package need not: of such a class, it is all plain data that its methods name.
        """
        own = vars(self)
        cls: type = type(self)  # mypy believes that a class of blocks has no hash
        state = {name: _copied(own[name]) for name in _carried_by(cls) if name in own}
        for name in _named_in_methods(cls):
            if name in own and name not in state and _is_plain(own[name]):
                state[name] = deepcopy(own[name])
        return state

    def set_state(self, state: Mapping[str, Any]) -> None:
        """Take over a result of :meth:`get_state` of a block of the same class and parameters."""
        for name, value in state.items():
            setattr(self, name, _copied(value))

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Prepare, when the agent is set up: check targets and compute what is costly here."""

    def on_reset(self, agent: AgentView, view: WorldView) -> None:
        """Prepare for an episode, at every reset before its first reading."""


def walk_blocks(blocks: "Iterable[Block]") -> "Iterator[Block]":
    """Yield blocks, each followed by the blocks inside it."""
    for block in blocks:
        yield block
        yield from walk_blocks(block.inner_blocks())


def _copied(value: Any) -> Any:
    """Return a shallow copy; numbers and texts are the same objects, which takes less time."""
    return value if type(value) in _UNCHANGING else copy(value)


@cache
def _carried_by(cls: type) -> tuple[str, ...]:
    """Return the attributes that a class and its bases declare."""
    declared = (vars(base).get("carried", ()) for base in cls.__mro__)
    # a block of somebody else's may have a parameter of this name
    return tuple(name for names in declared if isinstance(names, tuple) for name in names)


@cache
def _named_in_methods(cls: type) -> tuple[str, ...]:
    """Return the names that methods use in classes that are not of this package."""
    names: dict[str, None] = {}
    for base in cls.__mro__:
        if issubclass(base, Block) and not is_built_in(base):
            for method in vars(base).values():
                code = getattr(getattr(method, "__func__", method), "__code__", None)
                names |= dict.fromkeys(code.co_names if code else ())
    return tuple(names)


def _is_plain(value: object) -> bool:
    """Return True for numbers, texts, arrays, and collections of these."""
    if isinstance(value, Mapping):
        return all(map(_is_plain, value)) and all(map(_is_plain, value.values()))
    if isinstance(value, list | tuple | set | frozenset | deque):
        return all(map(_is_plain, value))
    return value is None or isinstance(value, bool | int | float | str | np.ndarray | np.generic)


def levels_up(cls: type, name: str) -> int:
    """Return the index in the MRO of the class that defines a name; the MRO's length if none."""
    order = cls.__mro__
    return next((up for up, each in enumerate(order) if name in vars(each)), len(order))


def is_built_in(cls: type[Block]) -> bool:
    """Return True for a class that a module of this package defines, except for a lesson."""
    place, module = cls.__module__, sys.modules.get(cls.__module__)
    is_ours = place.startswith("ai4u_edu.") and not place.startswith("ai4u_edu.lessons.")
    return is_ours and getattr(module, cls.__name__, None) is cls


def default_name(cls: type[Block], *endings: str) -> str:
    """Derive a name from a class: ``RayCastingSensor`` -> ``ray_casting``."""
    name = cls.__name__
    for ending in endings:
        if name != ending:
            name = name.removesuffix(ending)
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()
