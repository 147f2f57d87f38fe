"""The immutable readings of one decision; shared by brain, viewer, recorder and network."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from ai4u_edu.base.errors import NameNotFoundError, suggest
from ai4u_edu.locale import gettext as _

DTYPES: dict[str, npt.DTypeLike] = {
    "sfloat": np.float32,
    "sbool": np.bool_,
    "sint": np.int32,
    "sbytearray": np.uint8,
    "sfloatarray": np.float32,
    "sintarray": np.int32,
    "simage": np.uint8,
}
"""AI4U's types of numeric readings; texts are stored separately."""

TEXTS = ("sstring", "sstrings")
"""AI4U's types of readings that are text: one, or several."""

Texts = str | tuple[str, ...]
"""A reading that is text, or texts."""


class Slot(NamedTuple):
    """The position of one sensor's reading in the percept's bytes."""

    key: str
    dtype: np.dtype[Any]
    shape: tuple[int, ...]
    offset: int
    size: int


class Layout:
    """The memory layout of an agent's readings in one buffer.

    Args:
        numbers: (key, key of :data:`DTYPES`, shape) of each numeric reading.
        texts: keys of the readings that are text.
    """

    def __init__(
        self, numbers: Sequence[tuple[str, str, tuple[int, ...]]], texts: Sequence[str]
    ) -> None:
        self.slots: dict[str, Slot] = {}
        self.texts = tuple(texts)
        offset = 0
        for key, kind, shape in numbers:
            dtype = np.dtype(DTYPES[kind])
            offset = -(-offset // dtype.itemsize) * dtype.itemsize
            count = int(np.prod(shape, dtype=np.int64))
            self.slots[key] = Slot(key, dtype, shape, offset, count)
            offset += count * dtype.itemsize
        self.size = offset

    def view(self, memory: Any, key: str) -> npt.NDArray[Any]:
        """Return one reading in a buffer, without a copy."""
        slot = self.slots[key]
        return np.ndarray(slot.shape, slot.dtype, memory, slot.offset)


class Percept(Mapping[str, Any]):
    """The readings of one decision by perception key.

    Arrays are read-only. A reading of shape () is a plain number or bool, text is a str, several
    texts are a tuple of str.

    Args:
        layout: position of each reading.
        data: the numeric readings, ``layout.size`` bytes.
        texts: the readings that are text, in the layout's order.

    >>> layout = Layout([("eyes", "sfloatarray", (2,)), ("done", "sbool", ())], ["id"])
    >>> percept = Percept(layout, np.array([0.5, 1.0], np.float32).tobytes() + bytes([1]), ("7",))
    >>> percept["eyes"].tolist(), percept["done"], percept["id"]
    ([0.5, 1.0], True, '7')
    """

    __slots__ = ("data", "layout", "texts")

    def __init__(self, layout: Layout, data: bytes, texts: tuple[Texts, ...]) -> None:
        self.layout = layout
        self.data = data
        self.texts = texts

    def __getitem__(self, key: str) -> Any:
        slot = self.layout.slots.get(key)
        if slot is not None:
            reading: npt.NDArray[Any] = np.ndarray(slot.shape, slot.dtype, self.data, slot.offset)
            return reading if slot.shape else reading.item()
        if key in self.layout.texts:
            return self.texts[self.layout.texts.index(key)]
        raise NameNotFoundError(
            _("no reading is called {key!r}; {hint}", key=key, hint=suggest(key, self))
        )

    def __iter__(self) -> Iterator[str]:
        yield from self.layout.slots
        yield from self.layout.texts

    def __len__(self) -> int:
        return len(self.layout.slots) + len(self.layout.texts)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Percept):
            return NotImplemented
        return self.data == other.data and self.texts == other.texts

    __hash__ = None  # type: ignore[assignment]  # compared by content

    def __repr__(self) -> str:
        return f"Percept({dict(self)})"
