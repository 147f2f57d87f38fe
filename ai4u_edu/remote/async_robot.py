"""A robot in a world elsewhere, driven by asyncio code."""

from collections.abc import AsyncIterator, Sequence
from typing import Any, Self, SupportsIndex

from ai4u_edu.remote.address import address_of
from ai4u_edu.remote.async_connection import AsyncConnection
from ai4u_edu.remote.dialogue import Dialogue
from ai4u_edu.remote.own_frames import OWN_FRAMES_HIDDEN
from ai4u_edu.remote.percept import RemotePercept
from ai4u_edu.remote.robot_base import RobotBase
from ai4u_edu.wire.native import Mode, OnMissing


class AsyncRobot(RobotBase):
    """The asynchronous form of :class:`~ai4u_edu.remote.Robot`: its methods are awaited.

    ::

        async with AsyncRobot("http://teacher:8080", agent="red") as robot:
            async for percept in robot:
                await robot.act(move=[1, 0, 0, 0])

    Arguments and errors are those of :func:`~ai4u_edu.remote.connect`.
    """

    def __init__(
        self,
        url: str,
        agent: str = "",
        *,
        token: str = "",
        mode: Mode = "realtime",
        keys: Sequence[str] = (),
        session: str = "",
        patience: float = 10.0,
        on_missing: OnMissing = "",
    ) -> None:
        with OWN_FRAMES_HIDDEN:
            address = address_of(url, token)
            self._connection = AsyncConnection(address)
            super().__init__(
                Dialogue(
                    agent,
                    token=address.token,
                    mode=mode,
                    keys=keys,
                    session=session,
                    patience=patience,
                    on_missing=on_missing,
                )
            )

    async def open(self) -> Self:
        """Connect, and get the agent."""
        with OWN_FRAMES_HIDDEN:
            await self._connection.run(self._dialogue.begin())
        return self

    async def sense(self) -> RemotePercept:
        """Return the current percept; after an action, wait until its decision is over."""
        with OWN_FRAMES_HIDDEN:
            return await self._connection.run(self._dialogue.sense())

    async def act(self, action: Any = None, /, **numbers: Any) -> None:
        """Answer the latest percept with an action."""
        with OWN_FRAMES_HIDDEN:
            await self._connection.run(self._dialogue.act(numbers if action is None else action))

    async def tell(self, **fields: Any) -> None:
        """Tell the agent something besides actions; see :meth:`Robot.tell`."""
        with OWN_FRAMES_HIDDEN:
            await self._connection.run(self._dialogue.tell(fields))

    async def reset(self, seed: SupportsIndex | None = None) -> RemotePercept:
        """Begin an episode, and return its first percept."""
        with OWN_FRAMES_HIDDEN:
            return await self._connection.run(self._dialogue.reset(seed))

    async def close(self) -> None:
        """Give the agent back to the brain that it had before."""
        with OWN_FRAMES_HIDDEN:
            await self._connection.run(self._dialogue.end())

    async def __aiter__(self) -> AsyncIterator[RemotePercept]:
        """Yield every percept that needs an action, until the episode is over."""
        with OWN_FRAMES_HIDDEN:
            while not (percept := await self.sense()).done:
                yield percept
                self._dialogue.expect_answer_to(percept)

    async def __aenter__(self) -> Self:
        with OWN_FRAMES_HIDDEN:
            return await self.open()

    async def __aexit__(self, *_: object) -> None:
        await self.close()
