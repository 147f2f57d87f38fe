"""Classes of controllers that listen to keys."""

import re

from ai4u_edu.blocks.parameterized import Parameterized

_CODE = re.compile("Key[A-Z]$|Arrow|Space|Digit")
"""Names of keys, by their position on the keyboard (``KeyboardEvent.code``)."""


def listens_to_keys(cls: type[Parameterized]) -> bool:
    """Return True if a parameter of a controller has codes of keys as its default."""
    defaults = [f.get_default(call_default_factory=True) for f in cls.parameters().values()]
    lists = [each for each in defaults if isinstance(each, list) and each]
    return any(isinstance(each[0], str) and _CODE.match(each[0]) for each in lists)
