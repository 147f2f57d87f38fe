"""The main panel: what the time does, and what a person can ask of it; the same on all pages."""

import asyncio
from typing import Any, TypeVar

from viser import GuiButtonGroupHandle, GuiDropdownHandle, GuiEvent, GuiInputHandle

from ai4u_edu.base.limits import MAX_EXACT_INT
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import Snapshot, StaticScene
from ai4u_edu.viewer.backend.local_server import LocalServer
from ai4u_edu.viewer.panel.notify import notify_failure
from ai4u_edu.viewer.panel.status import goal, speed_name, status
from ai4u_edu.viewer.panel.style import STYLE
from ai4u_edu.viewer.viewer_client import ViewerClients

T = TypeVar("T")
SPEEDS = {speed_name(speed): speed for speed in (0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 10.0, float("inf"))}
"""What can be chosen; 1 is real time."""
RUNNING = ("Pause", "Tick", "Decision", "Reset")
PAUSED = ("Resume", *RUNNING[1:])
LATE = 0.15
"""Seconds by which the last digit may come after the Enter: pages send numbers not so often."""


class Controls:
    """Shows the state of the time; hands on to the runner what people ask for.

    Args:
        server: viser's.
        runner: gets the commands.
        viewer_clients: know which agent a page looks at.
    """

    def __init__(self, server: LocalServer, runner: Runner, viewer_clients: ViewerClients) -> None:
        gui = server.gui
        self._runner, self._viewer_clients = runner, viewer_clients
        self._scale_shown, self._seed_shown = 0.0, -1
        gui.add_html(STYLE)
        self._goal = gui.add_html("")
        self._status = gui.add_html("")
        self._time = gui.add_button_group("Time", RUNNING)
        self._speed = gui.add_dropdown("Speed", tuple(SPEEDS))
        self._form = gui.add_form(None)
        with self._form:
            hint = "Enter begins an episode with this seed"
            # as far as browsers count exactly: beyond, the page would show another number
            limit = MAX_EXACT_INT
            self._seed = gui.add_number("Seed", 0, min=0, max=limit, step=1, hint=hint)
        self._time.on_click(self._on_time)
        self._speed.on_update(self._on_speed)
        self._form.on_submit(self._on_seed)

    def build(self, static_scene: StaticScene) -> None:
        """Tells the goal of a static_scene."""
        self._goal.content = goal(static_scene)

    def draw(self, snapshot: Snapshot) -> None:
        """Shows what the time does."""
        self._status.content = status(snapshot, self._runner.stall)
        self._time.options = PAUSED if snapshot.paused else RUNNING
        # only when they change: somebody may be choosing another one just now
        if snapshot.time_scale != self._scale_shown:
            self._scale_shown = snapshot.time_scale
            name = speed_name(snapshot.time_scale)
            self._speed.options = tuple(dict.fromkeys([*SPEEDS, name]))
            _show(self._speed, name)
        if snapshot.seed != self._seed_shown:
            self._seed_shown = snapshot.seed
            is_exact = snapshot.seed <= MAX_EXACT_INT
            self._seed.label = "Seed" if is_exact else f"Seed (now {snapshot.seed})"
            if is_exact:
                _show(self._seed, snapshot.seed)

    # these run in viser's event loop, one after the other: a click is never taken for the next one

    async def _on_time(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        runner, client = self._runner, event.client
        match event.target.value:
            case "Pause":
                notify_failure(client, runner, runner.pause())
            case "Resume":
                notify_failure(client, runner, runner.resume())
            case "Tick":
                notify_failure(client, runner, runner.pause())
                notify_failure(client, runner, runner.step())
            case "Decision":
                viewer_client = self._viewer_clients.get(-1 if client is None else client.client_id)
                notify_failure(client, runner, runner.pause())
                notify_failure(
                    client,
                    runner,
                    runner.step_decision(viewer_client.agent if viewer_client else None),
                )
            case "Reset":
                notify_failure(client, runner, runner.reset())

    async def _on_speed(self, event: GuiEvent[GuiDropdownHandle[str]]) -> None:
        speed = SPEEDS.get(event.target.value)
        if event.client is not None and speed is not None:
            notify_failure(event.client, self._runner, self._runner.scale_time(speed))

    async def _on_seed(self, event: GuiEvent[Any]) -> None:
        await asyncio.sleep(LATE)
        notify_failure(event.client, self._runner, self._runner.reset(int(self._seed.value)))


def _show(handle: GuiInputHandle[T], value: T) -> None:
    handle.value = value  # type: ignore[misc]  # a method parts its getter from its setter
