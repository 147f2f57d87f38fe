"""Old names of attributes and methods, kept for one release."""

import warnings
from typing import Any


class RenamedAttribute:
    """Descriptor that forwards an old attribute name to the new one with a DeprecationWarning.

    >>> class Door:
    ...     is_open = True
    ...     opened = RenamedAttribute("is_open")
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always")
    ...     Door().opened
    True
    >>> str(caught[0].message)
    'Door.opened is now Door.is_open'
    """

    def __init__(self, new: str) -> None:
        self._new = new

    def __set_name__(self, owner: type, name: str) -> None:
        self._owner, self._old = owner.__name__, name

    def __get__(self, instance: object, owner: type) -> Any:
        self._warn()
        return getattr(owner if instance is None else instance, self._new)

    def __set__(self, instance: object, value: object) -> None:
        self._warn()
        setattr(instance, self._new, value)

    def _warn(self) -> None:
        text = f"{self._owner}.{self._old} is now {self._owner}.{self._new}"
        warnings.warn(text, DeprecationWarning, stacklevel=3)
