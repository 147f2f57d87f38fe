"""Classes of controllers that listen to keys."""

import re

from ai4u_edu.blocks.parameterized import Parameterized

_CODE = re.compile("Key[A-Z]$|Arrow|Space|Digit")
"""Names of keys, by their position on the keyboard (``KeyboardEvent.code``)."""
_known: dict[type[Parameterized], bool] = {}
"""Answers: pages ask once a second, and to make all defaults takes 16 ms."""


def listens_to_keys(cls: type[Parameterized]) -> bool:
    """Return True if a parameter of a controller has codes of keys as its default."""
    if cls not in _known:
        defaults = [f.get_default(call_default_factory=True) for f in cls.parameters().values()]
        lists = [each for each in defaults if isinstance(each, list) and each]
        _known[cls] = any(isinstance(each[0], str) and _CODE.match(each[0]) for each in lists)
    return _known[cls]
