"""The percept of a remote agent."""

from collections.abc import Iterator, Mapping
from copy import copy
from typing import Any, Self

import numpy as np

from ai4u_edu.base.errors import NameNotFoundError, suggest
from ai4u_edu.locale import gettext as _
from ai4u_edu.remote.errors import RemoteError
from ai4u_edu.wire import native
from ai4u_edu.wire.texts import SEVERAL, unpack_texts


class RemotePercept(Mapping[str, Any]):
    """The readings of one decision by perception key, and the result of the decision before it.

    Arrays are read-only. A reading of shape () is a plain number or bool, text is a str, several
    texts are a tuple of str.

    Attributes:
        episode: counted by the agent, from 1.
        step: decisions in this episode so far.
        tick: ticks of the world since its reset.
        reward: sum over the decisions since the percept before; in lockstep there is one.
        reward_terms: the same reward by named term.
        terminated: whether the episode ended by what happened in it.
        truncated: whether the episode was cut off by the step limit.
        paused: whether the script asked for a pause, and actions move nothing until it ends.
        stopped: whether the script asked for no more decisions until the next reset.
    """

    __slots__ = (
        "_data",
        "_readings",
        "_texts",
        "episode",
        "paused",
        "reward",
        "reward_terms",
        "seq",
        "step",
        "stopped",
        "terminated",
        "tick",
        "truncated",
    )

    def __init__(self, readings: Mapping[str, native.Reading], said: native.Percept) -> None:
        self._readings = readings
        self._data = said.data
        self._texts = said.texts
        self.seq = said.seq
        self.episode = said.episode
        self.step = said.step
        self.tick = said.tick
        self.reward = said.reward
        self.reward_terms = dict(said.terms)
        self.terminated = said.terminated
        self.truncated = said.truncated
        self.paused = said.paused
        self.stopped = said.stopped

    @property
    def done(self) -> bool:
        """True if the episode is over."""
        return self.terminated or self.truncated

    def cut_off(self, seq: int) -> Self:
        """Return the same readings as the end of their episode, in a percept of another number."""
        end = copy(self)
        end.seq, end.reward, end.reward_terms = seq, 0.0, {}
        end.truncated = not self.terminated
        return end

    def __getitem__(self, key: str) -> Any:
        reading = self._readings.get(key)
        if reading is None:
            raise NameNotFoundError(
                _(
                    "no reading is called {key!r}; {hint}",
                    key=key,
                    hint=suggest(key, self._readings),
                )
            )
        try:
            if reading.kind == "text":
                text = self._texts[reading.offset]
                return unpack_texts(text) if reading.sensor_type == SEVERAL else text
            count = int(np.prod(reading.shape, dtype=np.int64))
            flat = np.frombuffer(self._data, reading.dtype, count, reading.offset)
            return flat.reshape(reading.shape) if reading.shape else flat[0].item()
        except (ValueError, IndexError, TypeError, OverflowError):
            raise RemoteError(
                _(
                    "reading {key!r}: expected it in the percept as the welcome says, found it "
                    "not; connect again",
                    key=key,
                )
            ) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._readings)

    def __len__(self) -> int:
        return len(self._readings)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, RemotePercept):
            return NotImplemented
        return self.seq == other.seq and self._data == other._data and self._texts == other._texts

    __hash__ = None  # type: ignore[assignment]  # compared by content

    def __repr__(self) -> str:
        return (
            f"RemotePercept(episode={self.episode}, step={self.step}, reward={self.reward:g}, "
            f"{dict(self)})"
        )
