"""Classes of controllers that listen to keys."""

import re

from ai4u_edu.base.parameters import default_of
from ai4u_edu.blocks.parameterized import Parameterized

_CODE = re.compile("Key[A-Z]$|Arrow|Space|Digit")
"""Names of keys, by their position on the keyboard (``KeyboardEvent.code``)."""


def listens_to_keys(cls: type[Parameterized]) -> bool:
    """Return True if a parameter of a controller has codes of keys as its default."""
    defaults = map(default_of, cls.parameters().values())
    firsts = [each[0] for each in defaults if isinstance(each, list) and each]
    return any(isinstance(each, str) and _CODE.match(each) for each in firsts)
