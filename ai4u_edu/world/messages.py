"""Messages that agents say to each other."""

from collections.abc import Iterator, Mapping
from typing import NamedTuple, Protocol

from ai4u_edu.world.body import BodyView


class Message(NamedTuple):
    """The last message of one speaker."""

    tick: int
    """Ticks of the world before it was said."""
    reach: float
    """Distance (m) up to which it is heard."""
    numbers: tuple[float, ...]


class _WorldOfSpeakers(Protocol):
    """Protocol of a world in which bodies speak (World is one)."""

    @property
    def ticks(self) -> int: ...

    @property
    def bodies(self) -> Mapping[str, BodyView]: ...


class Messages:
    """The last message of each body that has spoken since the world's reset.

    A listener hears what was said since it listened last. Everybody speaks before a tick and
    listens after it, so the agents' order makes no difference.
    """

    def __init__(self, world: _WorldOfSpeakers) -> None:
        self._world = world
        self._last: dict[str, Message] = {}

    def say(self, speaker: BodyView, numbers: tuple[float, ...], reach: float) -> None:
        """Say something; it replaces what the speaker said before."""
        self._last[speaker.name] = Message(self._world.ticks, reach, numbers)

    def heard(self, listener: BodyView, since: int) -> Iterator[tuple[BodyView, Message]]:
        """Yield the messages that a body hears, the nearest speaker first.

        Args:
            listener: hears all others, where they are now, but not itself.
            since: ticks of the world when it listened last.
        """
        if not self._last:
            return
        bodies = self._world.bodies
        candidates = [
            (listener.distance(bodies[name]), name, message)
            for name, message in self._last.items()
            if message.tick >= since and name != listener.name and name in bodies
        ]
        for distance, name, message in sorted(candidates):
            if distance <= message.reach and not bodies[name].fallen:
                yield bodies[name], message

    def clear(self) -> None:
        """Forget all messages."""
        self._last.clear()

    def get_state(self) -> dict[str, Message]:
        """Return the last message of each speaker, by its body's name."""
        return dict(self._last)

    def set_state(self, state: Mapping[str, Message]) -> None:
        """Take over the messages of another moment or world."""
        self._last = dict(state)
