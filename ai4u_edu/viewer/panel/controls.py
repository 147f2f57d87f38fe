"""The main panel: state of the simulation, time control and seed; the same on all pages."""

import asyncio
from typing import Any

from viser import GuiButtonGroupHandle, GuiCheckboxHandle, GuiDropdownHandle, GuiEvent

from ai4u_edu.base.limits import MAX_EXACT_INT
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import Snapshot, StaticScene
from ai4u_edu.viewer.backend.local_server import LocalServer
from ai4u_edu.viewer.panel.notify import notify_failure
from ai4u_edu.viewer.panel.status import goal, speed_name, status
from ai4u_edu.viewer.panel.style import STYLE
from ai4u_edu.viewer.panel.widgets import set_value
from ai4u_edu.viewer.viewer_client import ViewerClients

SPEEDS = {speed_name(speed): speed for speed in (0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 10.0, float("inf"))}
"""Time scales by their label; 1 is real time."""
RUNNING_BUTTONS = ("Pause", "Tick", "Decision", "Reset")
PAUSED_BUTTONS = ("Resume", *RUNNING_BUTTONS[1:])
NUMBER_DELAY_S = 0.15
"""Time (s) by which a typed number may arrive after the Enter key: viser throttles number boxes."""


class Controls:
    """The widgets of the main panel, which show the runner's state and send it commands.

    Args:
        server: viser's server.
        runner: receives the commands.
        viewer_clients: the pages; they know which agent each one shows.
    """

    def __init__(self, server: LocalServer, runner: Runner, viewer_clients: ViewerClients) -> None:
        gui = server.gui
        self._runner, self._viewer_clients = runner, viewer_clients
        self._scale_shown, self._seed_shown, self._lock_shown = 0.0, -1, False
        gui.add_html(STYLE)
        self._goal = gui.add_html("")
        self._status = gui.add_html("")
        self.time_buttons = gui.add_button_group("Time", RUNNING_BUTTONS)
        self.speed = gui.add_dropdown("Speed", tuple(SPEEDS))
        self.seed_form = gui.add_form(None)
        with self.seed_form:
            hint = "Enter begins an episode with this seed"
            # JavaScript rounds larger integers, so the page would show another number
            limit = MAX_EXACT_INT
            self.seed = gui.add_number("Seed", 0, min=0, max=limit, step=1, hint=hint)
        self.lock = gui.add_checkbox("Keep seed", False, hint="Each reset repeats the same start")
        self.time_buttons.on_click(self._on_time)
        self.speed.on_update(self._on_speed)
        self.seed_form.on_submit(self._on_seed)
        self.lock.on_update(self._on_lock)

    def build(self, static_scene: StaticScene) -> None:
        """Show the scene's goal."""
        self._goal.content = goal(static_scene)

    def draw(self, snapshot: Snapshot) -> None:
        """Show the state of the simulation."""
        self._status.content = status(snapshot, self._runner.stall)
        self.time_buttons.options = PAUSED_BUTTONS if snapshot.paused else RUNNING_BUTTONS
        # only after a change: a person may be choosing another value just now
        if snapshot.time_scale != self._scale_shown:
            self._scale_shown = snapshot.time_scale
            name = speed_name(snapshot.time_scale)
            self.speed.options = tuple(dict.fromkeys([*SPEEDS, name]))
            set_value(self.speed, name)
        if snapshot.is_seed_locked != self._lock_shown:
            self._lock_shown = snapshot.is_seed_locked
            set_value(self.lock, snapshot.is_seed_locked)
        if snapshot.seed != self._seed_shown:
            self._seed_shown = snapshot.seed
            is_exact = snapshot.seed <= MAX_EXACT_INT
            self.seed.label = "Seed" if is_exact else f"Seed (now {snapshot.seed})"
            if is_exact:
                set_value(self.seed, snapshot.seed)

    # coroutines, because viser runs them in its event loop one after the other, so clicks keep
    # their order

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

    async def _on_lock(self, event: GuiEvent[GuiCheckboxHandle]) -> None:
        if event.client is not None:
            notify_failure(event.client, self._runner, self._runner.lock_seed(event.target.value))

    async def _on_seed(self, event: GuiEvent[Any]) -> None:
        await asyncio.sleep(NUMBER_DELAY_S)
        notify_failure(event.client, self._runner, self._runner.reset(int(self.seed.value)))
