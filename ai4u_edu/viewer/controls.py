"""The main panel: what the time does, and what a person can ask for."""

from collections.abc import Mapping
from concurrent.futures import Future
from typing import Any, TypeVar

from viser import ClientHandle, GuiButtonGroupHandle, GuiDropdownHandle, GuiEvent, GuiInputHandle

from ai4u_edu.runner import Runner
from ai4u_edu.snapshot import Snapshot, Stage
from ai4u_edu.viewer.agent_panel import AgentPanel
from ai4u_edu.viewer.local_server import LocalServer
from ai4u_edu.viewer.rays import Rays
from ai4u_edu.viewer.status import STYLE, goal, legend, speed_name, status
from ai4u_edu.viewer.view import View

T = TypeVar("T")
SPEEDS = {speed_name(speed): speed for speed in (0.1, 0.25, 0.5, 1.0, 2.0, 4.0)}
"""What can be chosen; 1 is real time."""
RUNNING, PAUSED = ("Pause", "Step", "Reset"), ("Resume", "Step", "Reset")
WHOLE_ARENA, FOLLOW = "Whole arena", "Follow"


class Controls:
    """Shows the state of the time; hands on to the runner what people ask for.

    Args:
        server: viser's.
        runner: gets the commands.
        views: the pages' cameras, by client id.
        rays: can be shown or not.
        panel: knows which agent a page looks at.
    """

    def __init__(
        self,
        server: LocalServer,
        runner: Runner,
        views: Mapping[int, View],
        rays: Rays,
        panel: AgentPanel,
    ) -> None:
        gui = server.gui
        self._runner, self._views, self._rays, self._panel = runner, views, rays, panel
        self._scale_shown, self._seed_shown = 0.0, -1
        gui.add_html(STYLE)
        self._goal = gui.add_html("")
        self._status = gui.add_html("")
        self._time = gui.add_button_group("Time", RUNNING)
        self._speed = gui.add_dropdown("Speed", tuple(SPEEDS))
        self._form = gui.add_form(None)
        with self._form:
            hint = "Enter begins an episode with this seed"
            self._seed = gui.add_number("Seed", 0, min=0, step=1, hint=hint)
        self._camera = gui.add_button_group("Camera", (WHOLE_ARENA, FOLLOW))
        self._shown = gui.add_checkbox("Rays", initial_value=True)
        self._legend = gui.add_html("")
        self._time.on_click(self._on_time)
        self._speed.on_update(self._on_speed)
        self._form.on_submit(self._on_seed)
        self._camera.on_click(self._on_camera)
        self._shown.on_update(self._on_rays)

    def build(self, stage: Stage) -> None:
        """Tells the goal, and explains the colours of a stage."""
        self._goal.content = goal(stage)
        self._legend.content = legend(stage)

    def draw(self, snapshot: Snapshot) -> None:
        """Shows what the time does."""
        self._status.content = status(snapshot)
        self._time.options = PAUSED if snapshot.paused else RUNNING
        # only when they change: somebody may be choosing another one just now
        if snapshot.time_scale != self._scale_shown:
            self._scale_shown = snapshot.time_scale
            name = speed_name(snapshot.time_scale)
            self._speed.options = tuple(dict.fromkeys([*SPEEDS, name]))
            _show(self._speed, name)
        if snapshot.seed != self._seed_shown:
            self._seed_shown = snapshot.seed
            _show(self._seed, snapshot.seed)

    # these run in viser's event loop, one after the other: a click is never taken for the next one

    async def _on_time(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        runner = self._runner
        match event.target.value:
            case "Pause":
                self._ask(event.client, runner.pause())
            case "Resume":
                self._ask(event.client, runner.resume())
            case "Step":
                self._ask(event.client, runner.pause())
                self._ask(event.client, runner.step())
            case "Reset":
                self._ask(event.client, runner.reset())

    async def _on_speed(self, event: GuiEvent[GuiDropdownHandle[str]]) -> None:
        speed = SPEEDS.get(event.target.value)
        if event.client is not None and speed is not None:
            self._ask(event.client, self._runner.scale_time(speed))

    async def _on_seed(self, event: GuiEvent[Any]) -> None:
        self._ask(event.client, self._runner.reset(int(self._seed.value)))

    async def _on_rays(self, _event: GuiEvent[Any]) -> None:
        self._rays.shown = bool(self._shown.value)

    async def _on_camera(self, event: GuiEvent[GuiButtonGroupHandle]) -> None:
        client_id = -1 if event.client_id is None else event.client_id
        view = self._views.get(client_id)
        agent_of = self._runner.latest.stage.agent_of
        if view is None:
            return
        if event.target.value == FOLLOW and agent_of:
            chosen = self._panel.chosen(client_id)
            view.follow_next(sorted(agent_of, key=lambda body: agent_of[body] != chosen))
        else:
            view.show_all()

    def _ask(self, client: ClientHandle | None, future: Future[None]) -> None:
        """Tells whoever asked if it couldn't be done."""

        def tell(done: Future[None]) -> None:
            error = None if done.cancelled() else done.exception()
            if error is not None and client is not None:
                client.add_notification("That didn't work", str(error), auto_close_seconds=8.0)

        future.add_done_callback(tell)


def _show(handle: GuiInputHandle[T], value: T) -> None:
    handle.value = value  # type: ignore[misc]  # a method parts its getter from its setter
