"""Encoding of several texts as one, for our own protocol."""

import json
from collections.abc import Sequence

SEVERAL = "sstrings"
"""AI4U's type of such a reading; it is part of the welcome, so that a script can unpack it."""


def pack_texts(texts: Sequence[str], max_chars: int) -> str:
    """Return texts as a JSON array; the last ones are left out if they don't fit.

    >>> pack_texts(["to the left", "stop"], 80)
    '["to the left", "stop"]'
    >>> pack_texts(["to the left", "stop"], 20)
    '["to the left"]'
    """
    packed = json.dumps(texts, ensure_ascii=False)
    while len(packed) > max_chars:
        texts = texts[:-1]
        packed = json.dumps(texts, ensure_ascii=False)
    return packed


def unpack_texts(packed: str) -> tuple[str, ...]:
    """Return the texts of a JSON array.

    Raises:
        ValueError: it is not an array of texts.
    """
    texts = json.loads(packed)
    if not isinstance(texts, list) or not all(isinstance(each, str) for each in texts):
        raise ValueError("expected an array of texts")
    return tuple(texts)
