"""WebSockets of the teacher's page and of the projector page: the class, drawings and poses."""

import asyncio
from contextlib import suppress
from dataclasses import dataclass, field

from starlette.types import Receive, Scope, Send
from starlette.websockets import WebSocket, WebSocketDisconnect

from ai4u_edu.classroom.class_event import ClassEvents
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.page.server.limits.keepalive import keepalives

POLL_S = 0.25
"""Interval at which changes are sent; poses are sent as often."""
MIN_CLASS_INTERVAL_S = 0.5


@dataclass
class _Sent:
    """Versions of what a page has got."""

    version: int = -1
    class_at: float = -MIN_CLASS_INTERVAL_S
    drawings: dict[str, str] = field(default_factory=dict)
    poses: dict[str, int] = field(default_factory=dict)


class WallSocket:
    """ASGI app that sends a page the present state at each change until it leaves.

    A slow page gets fewer and later states, and no queue.

    Args:
        live: the class.
        events: of the class.
        is_projected: True for the page that everybody sees.
    """

    def __init__(self, live: LiveClass, events: ClassEvents, *, is_projected: bool = False) -> None:
        self._live, self._events, self._is_projected = live, events, is_projected

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one page."""
        socket = WebSocket(scope, receive, send)
        await socket.accept(next(iter(scope["subprotocols"]), None))
        self._live.ensure_ticking()
        sender = asyncio.create_task(self._send(socket))
        try:
            async with keepalives(socket.send_text):
                while (await socket.receive())["type"] == "websocket.receive":
                    pass  # commands are requests of their own
        finally:
            sender.cancel()
            with suppress(asyncio.CancelledError, WebSocketDisconnect, RuntimeError):
                await sender

    async def _send(self, socket: WebSocket) -> None:
        sent, loop = _Sent(), asyncio.get_running_loop()
        url = str(socket.url.replace(path="/", query="")).replace("ws", "http", 1)
        with suppress(WebSocketDisconnect):
            while True:
                is_due = loop.time() - sent.class_at >= MIN_CLASS_INTERVAL_S
                if is_due and sent.version != self._live.version:
                    sent.version, sent.class_at = self._live.version, loop.time()
                    text = self._events.text(url, is_projected=self._is_projected)
                    await socket.send_text(text)
                await self._send_drawings(socket, sent)
                await asyncio.sleep(POLL_S)

    async def _send_drawings(self, socket: WebSocket, sent: _Sent) -> None:
        members = self._live.members()
        rooms = [
            each for each in self._live.rooms.values() if each.drawing_json and each.id in members
        ]
        for room in rooms:
            if room.drawing_json is not sent.drawings.get(room.id):
                sent.drawings[room.id] = room.drawing_json
                sent.poses.pop(room.id, None)
                await socket.send_text(room.drawing_json)
        moved = [each for each in rooms if sent.poses.get(each.id, 0) != each.poses_version]
        if moved:
            sent.poses |= {each.id: each.poses_version for each in moved}
            # the parts are JSON already; ids are hexadecimal, or seat-N
            poses = ",".join(f'"{each.id}":{each.poses_json}' for each in moved)
            await socket.send_text(f'{{"type":"poses","rooms":{{{poses}}}}}')
