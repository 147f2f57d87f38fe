"""Attributes that an object's class does not know: usually a typing mistake."""

from collections.abc import Iterable, Iterator
from functools import cache
from types import CodeType
from typing import TYPE_CHECKING, Any

from ai4u_edu.base.errors import UnknownAttributeError, suggest
from ai4u_edu.locale import gettext as _


class NoStrayAttributes:
    """Base of a class whose objects take no new public attributes once they are complete.

    Its constructor sets ``_is_complete`` at its end.

    >>> class Lamp(NoStrayAttributes):
    ...     def __init__(self) -> None:
    ...         self.brightness = 1.0
    ...         self._is_complete = True
    >>> lamp = Lamp()
    >>> lamp.brightnes = 0.5
    Traceback (most recent call last):
    ...
    ai4u_edu.base.errors.UnknownAttributeError: Lamp has no attribute 'brightnes'; did you mean \
'brightness'?
    """

    _is_complete = False

    if not TYPE_CHECKING:  # a type checker would take any name for known

        def __setattr__(self, name: str, value: Any) -> None:
            is_new = name not in self.__dict__ and not name.startswith("_")
            if is_new and self._is_complete and not hasattr(type(self), name):
                raise UnknownAttributeError(self._about(name))
            object.__setattr__(self, name, value)

    def _about(self, name: str) -> str:
        """Return a sentence on an unknown attribute; a subclass may know it better."""
        public = [each for each in (*vars(self), *dir(type(self))) if not each.startswith("_")]
        owner = type(self).__name__
        return _(
            "{owner} has no attribute {name!r}; {hint}",
            owner=owner,
            name=name,
            hint=suggest(name, public),
        )


def refuse_stray(thing: object, where: str, parameters: Iterable[str]) -> None:
    """Check that an object has no attribute that its class does not know.

    A class knows its class attributes and all names in its methods, so a block may keep what it
    likes. Names that begin with an underscore are the object's own.

    Args:
        thing: the object.
        where: beginning of the message.
        parameters: names for the suggestion.

    Raises:
        UnknownAttributeError: it has one.
    """
    cls: type = type(thing)  # mypy believes that a class that defines __hash__ has no hash
    known = attributes_of(cls)
    for name in vars(thing):
        if name not in known and not name.startswith("_"):
            raise UnknownAttributeError(
                _(
                    "{where}: has no attribute {name!r}; {hint}",
                    where=where,
                    name=name,
                    hint=suggest(name, parameters),
                )
            )


@cache
def attributes_of(cls: type) -> frozenset[str]:
    """Return all attributes of a class, and all names in its methods."""
    names = set(dir(cls))
    for base in cls.__mro__:
        names |= vars(base).get("__annotations__", {}).keys()
        for member in vars(base).values():
            for part in (member, getattr(member, "fget", None), getattr(member, "fset", None)):
                code = getattr(getattr(part, "__func__", part), "__code__", None)
                if code is not None:
                    names |= set(_names_in(code))
    return frozenset(names)


def _names_in(code: CodeType) -> Iterator[str]:
    """Yield the names in a function's code, and in that of functions inside it."""
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _names_in(constant)
