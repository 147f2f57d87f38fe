"""A robot in a world elsewhere, driven by asyncio code."""

import asyncio
from collections.abc import AsyncIterator, Sequence
from typing import Any, Self, SupportsIndex, TypeVar

from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, WebSocketException

from ai4u_edu.locale import gettext as _
from ai4u_edu.remote.address import Address, address_of
from ai4u_edu.remote.connection_options import (
    OPTIONS,
    authorization,
    connection_lost_from,
    log_note,
)
from ai4u_edu.remote.dialogue import Dialogue
from ai4u_edu.remote.own_frames import OWN_FRAMES_HIDDEN
from ai4u_edu.remote.percept import RemotePercept
from ai4u_edu.remote.robot_base import RobotBase
from ai4u_edu.remote.steps import (
    Close,
    ConnectionLostError,
    Delay,
    Flow,
    Note,
    Open,
    Receive,
    Send,
    Step,
)
from ai4u_edu.wire.native import Mode, OnMissing

T = TypeVar("T")


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


class AsyncConnection:
    """A WebSocket to a world; reconnects when a dialogue asks for it."""

    def __init__(self, address: Address) -> None:
        self._address = address
        self._socket: ClientConnection | None = None

    async def run(self, flow: Flow[T]) -> T:
        """Carry out a dialogue's steps one after another, and return its result."""
        result: Any = None
        error: ConnectionLostError | None = None
        while True:
            try:
                step = flow.throw(error) if error is not None else flow.send(result)
            except StopIteration as end:
                return end.value  # type: ignore[no-any-return]
            result = error = None
            try:
                result = await self._carry_out(step)
            except ConnectionLostError as lost:
                error = lost

    async def _carry_out(self, step: Step) -> Any:
        match step:
            case Receive(timeout):
                return await self._receive(timeout)
            case Send(frame):
                await self._send(frame)
            case Open(timeout):
                await self._close()
                await self._open(timeout)
            case Close():
                await self._close()
            case Delay(seconds):
                await asyncio.sleep(seconds)
            case Note(text):
                log_note(text)
        return None

    async def _open(self, timeout: float) -> None:
        try:
            self._socket = await connect(
                self._address.url,
                open_timeout=timeout,
                additional_headers=authorization(self._address.token),
                proxy=None if self._address.is_loopback else True,
                **OPTIONS,
            )
        except (OSError, WebSocketException) as error:
            raise connection_lost_from(error) from None

    async def _send(self, frame: bytes) -> None:
        try:
            await self._connected.send(frame)
        except ConnectionClosed as closed:
            raise connection_lost_from(closed) from None

    async def _receive(self, timeout: float) -> bytes | None:
        try:
            async with asyncio.timeout(timeout):
                return await self._connected.recv(decode=False)
        except TimeoutError:
            return None
        except ConnectionClosed as closed:
            raise connection_lost_from(closed) from None

    async def _close(self) -> None:
        if self._socket is not None:
            await self._socket.close()
            self._socket = None

    @property
    def _connected(self) -> ClientConnection:
        if self._socket is None:
            raise ConnectionLostError(_("there is no connection"))
        return self._socket
