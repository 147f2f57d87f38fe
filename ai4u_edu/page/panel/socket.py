"""The panel's sockets: each page gets the parts that it looks at, and sends commands."""

import asyncio
from collections.abc import Collection, Coroutine, Mapping, Sequence
from concurrent.futures import Future
from contextlib import suppress
from contextvars import copy_context
from typing import Protocol

from starlette.types import Receive, Scope, Send
from starlette.websockets import WebSocket, WebSocketDisconnect, WebSocketState

from ai4u_edu.base.errors import AI4UError, NameNotFoundError, shorten, text_of
from ai4u_edu.base.log_limit import ErrorLog
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing import ChangeResult
from ai4u_edu.page.messages import MessageReader, PageCommand, id_in, to_json
from ai4u_edu.page.panel.answers import MAX_ERROR_CHARS, Answer, change_answer, failure
from ai4u_edu.page.panel.commands import blocks, past, run, scenes, view, world
from ai4u_edu.page.panel.commands.handler import Handler
from ai4u_edu.page.panel.context import PanelContext
from ai4u_edu.page.panel.labels import past_tense
from ai4u_edu.page.panel.page import Level, Page
from ai4u_edu.page.panel.page_view import PageView, Show
from ai4u_edu.page.panel.parts.due import Parts, due_parts
from ai4u_edu.page.panel.upload import MAX_PART_BYTES, Upload
from ai4u_edu.page.server.bindings import choose_agent
from ai4u_edu.page.server.limits.keepalive import keepalives
from ai4u_edu.page.server.limits.socket_close import close_reason
from ai4u_edu.page.server.page_receiver import ReceiveLimits, receive_messages
from ai4u_edu.page.server.proxy import PAGE_ID_PARAM, page_id
from ai4u_edu.runtime.runner import Runner

LIMITS = ReceiveLimits(100, 2**16, MAX_PART_BYTES)
"""Limits of one page; dragging a slider sends some thirty messages a second."""
MAX_PENDING_COMMANDS = 16
"""Commands of one page that may be under way."""
MIN_SEND_S = 0.03
"""Shortest time (s) between two looks for changed parts, after commands."""

HANDLERS: Mapping[type[PageCommand], Handler] = {
    **run.HANDLERS,
    **view.HANDLERS,
    **blocks.HANDLERS,
    **world.HANDLERS,
    **scenes.HANDLERS,
    **past.HANDLERS,
}
"""Handlers of the panel's own commands by the type of their message."""

_error_log = ErrorLog()


class PanelOption(Protocol):
    """Parts and commands that an option adds to all panels; the server's event loop calls it."""

    @property
    def commands(self) -> Mapping[type[PageCommand], Handler]:
        """Handlers of its commands by the type of their message."""

    @property
    def agent_parts(self) -> Collection[str]:
        """Names of its parts that a page clears when it shows another agent."""

    def panel_parts(self, context: PanelContext, view: PageView) -> Parts:
        """Yield the name and the JSON of each of its parts that a page looks at."""


class PanelSockets:
    """The sockets of all pages' panels; an ASGI app.

    Args:
        context: the running world.
        options: what options add.
    """

    def __init__(self, context: PanelContext, options: Sequence[PanelOption] = ()) -> None:
        self.context, self.options = context, options
        self.handlers = dict(HANDLERS)
        """Handlers of all commands."""
        for option in options:
            self.handlers |= option.commands
        self.reader = MessageReader([Show], self.handlers)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one page's socket until it is closed."""
        socket = WebSocket(scope, receive, send)
        await socket.accept()
        with suppress(WebSocketDisconnect):
            if PAGE_ID_PARAM in socket.query_params and not page_id(scope):
                await socket.close(
                    1008, close_reason(_("expected a page id of 8 to 64 letters, digits and -"))
                )
                return
            await _PanelConnection(socket, self, page_id(scope)).serve()


class _PanelConnection:
    """One page's connection.

    The server's event loop calls everything but :meth:`on_selected`, :meth:`on_dropped` and
    :meth:`send`.
    """

    def __init__(self, socket: WebSocket, panel: PanelSockets, page_id: str) -> None:
        self._socket, self._panel = socket, panel
        self._context = context = panel.context
        agent = _first_agent(context.runner, socket.query_params.get("agent"))
        agent_parts = {name for option in panel.options for name in option.agent_parts}
        self._view = PageView(context.pictures, page_id, agent, self, agent_parts)
        upload = Upload(context.timeouts.upload)
        self._page = Page(context, self._view, self._note, upload)
        self._loop = asyncio.get_running_loop()
        self._changed = asyncio.Event()
        self._sent: dict[str, bytes] = {}
        self._tasks: set[asyncio.Task[None]] = set()
        self._language = copy_context()  # has the page's; viser's callbacks come from another one

    async def serve(self) -> None:
        """Send parts and carry out commands until the page leaves."""
        sending = asyncio.create_task(self._send_parts())
        try:
            async with keepalives(self._send_text):
                await self._receive()
        finally:
            self._view.close()
            self._page.upload.drop()
            for task in (sending, *self._tasks):
                task.cancel()
            with suppress(asyncio.CancelledError, WebSocketDisconnect):
                await sending

    # -- from the picture, in viser's event loop -------------------------------------------------

    def on_selected(self, body: str) -> None:
        """Note that somebody clicked on a body in the page's picture."""
        with suppress(RuntimeError):  # the server's loop has ended
            self._loop.call_soon_threadsafe(self._select, body)

    def on_dropped(self, change: "Future[ChangeResult]") -> None:
        """Report the result of a move with the mouse."""
        with suppress(RuntimeError):
            self._loop.call_soon_threadsafe(lambda: self._spawn(self._report_drop(change)))

    def send(self, message: Mapping[str, object]) -> None:
        """Send the page a message."""
        with suppress(RuntimeError):
            self._loop.call_soon_threadsafe(lambda: self._spawn_send(message))

    async def _report_drop(self, change: "Future[ChangeResult]") -> None:
        try:
            result = await self._page.result(change)
        except Exception as error:
            self._note("error", failure(error)["text"])
            return
        self._note("info", change_answer(past_tense(result.label), result).text)
        self._changed.set()

    def _select(self, body: str) -> None:
        self._view.select(body)
        agent = self._context.runner.latest.static_scene.agent_of.get(body, self._view.agent)
        if agent != self._view.agent:
            self._view.choose_agent(agent)
        self._spawn_send({"type": "selected", "body": body, "agent": agent})
        self._changed.set()

    # -- messages from the page ------------------------------------------------------------------

    async def _receive(self) -> None:
        async for message in receive_messages(
            self._socket, LIMITS, self._read, self._refuse_message
        ):
            if isinstance(message, bytes):
                self._add_part(message)
            elif isinstance(message, Show):
                self._look_at(message)
            elif len(self._tasks) >= MAX_PENDING_COMMANDS:
                text = _("expected fewer commands at a time; wait a moment")
                await self._refuse(message.id, text)
            else:
                self._spawn(self._carry_out(message))

    def _read(self, data: str | bytes) -> bytes | Show | PageCommand:
        """Return the message in a text, or a part of a file, which is binary."""
        return data if isinstance(data, bytes) else self._panel.reader.read(data)

    def _add_part(self, part: bytes) -> None:
        """Keep a part of a file."""
        try:
            self._page.upload.add(part)
        except AI4UError as error:
            self._note("error", text_of(error))

    def _look_at(self, show: Show) -> None:
        if show.agent not in self._context.runner.latest.static_scene.agent_of.values():
            show.agent = self._view.agent
        self._view.look_at(show)
        self._changed.set()

    async def _carry_out(self, command: PageCommand) -> None:
        try:
            answer: Answer = await self._panel.handlers[type(command)](self._page, command)
        except asyncio.CancelledError:
            # either the page has left, and this task was cancelled, or the world has ended, and the
            # future that the handler awaits was
            task = asyncio.current_task()
            if task is not None and task.cancelling():
                raise
            text = _("the world has ended")
            await self._send({"type": "failed", "id": command.id, "text": text, "problems": []})
        except Exception as error:  # a student's block may raise anything in a reset
            if not isinstance(error, AI4UError):
                _error_log.write(error)
            await self._send({"type": "failed", "id": command.id, **failure(error)})
        else:
            done = {"type": "done", "id": command.id, "text": answer.text}
            await self._send(done | dict(answer.more))
        self._changed.set()

    async def _refuse_message(self, data: str | bytes, text: str) -> None:
        await self._refuse(id_in(data), text)

    async def _refuse(self, number: int | None, text: str) -> None:
        text = shorten(text, MAX_ERROR_CHARS)
        if number is None:
            await self._send({"type": "note", "level": "error", "text": text})
        else:
            await self._send({"type": "failed", "id": number, "text": text, "problems": []})

    # -- messages to the page --------------------------------------------------------------------

    async def _send_parts(self) -> None:
        period = 1 / self._context.runner.frame_budget.texts_per_s
        while True:
            async with self._context.page_turn():
                parts = self._changed_parts()
            with _error_log.caught():
                # after the turn, so that a page that reads slowly keeps no other one waiting
                for name, text in parts:
                    self._sent[name] = text
                    await self._send_text(text.decode())
            # changes that come together are sent together
            await asyncio.sleep(MIN_SEND_S)
            with suppress(TimeoutError):
                async with asyncio.timeout(self._context.until_next_look(period)):
                    await self._changed.wait()

    def _changed_parts(self) -> list[tuple[str, bytes]]:
        """Return the parts that differ from what the page was sent last."""
        # cleared before the parts are read, so that a change meanwhile makes another round
        self._changed.clear()
        self._view.refresh()
        self._settle()
        for name in self._view.take_asked_again():
            self._sent.pop(name, None)
        parts = []
        with _error_log.caught():
            for name, text in self._due_parts():
                if self._sent.get(name) != text:
                    parts.append((name, text))
        return parts

    def _due_parts(self) -> Parts:
        yield from due_parts(self._context, self._view)
        for option in self._panel.options:
            yield from option.panel_parts(self._context, self._view)

    def _settle(self) -> None:
        """Show another agent if another world has no agent of that id."""
        agents = self._context.runner.latest.agents
        if not any(agent.id == self._view.agent for agent in agents):
            self._view.choose_agent(agents[0].id)

    def _note(self, level: Level, text: str) -> None:
        self._spawn_send({"type": "note", "level": level, "text": shorten(text, MAX_ERROR_CHARS)})

    def _spawn_send(self, message: Mapping[str, object]) -> None:
        self._spawn(self._send(message))

    def _spawn(self, work: Coroutine[None, None, None]) -> None:
        task = asyncio.create_task(work, context=self._language.copy())
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _send(self, message: Mapping[str, object]) -> None:
        await self._send_text(to_json(message).decode())

    async def _send_text(self, text: str) -> None:
        if self._socket.application_state is WebSocketState.CONNECTED:
            with suppress(WebSocketDisconnect):
                await self._socket.send_text(text)


def _first_agent(runner: Runner, wanted: str | None) -> str:
    """Return the id of the agent that a page asks for; else of the first that a person drives."""
    try:
        return choose_agent(runner.sim, wanted).id
    except NameNotFoundError:
        return choose_agent(runner.sim, None).id
