"""Handles with which a person drags and rotates bodies, on one page."""

import math
import threading
from collections.abc import Callable
from concurrent.futures import Future
from typing import Any, NamedTuple

import numpy as np
from viser import (
    BatchedMeshHandle,
    CommandHandle,
    FrameHandle,
    SceneNodeDragEvent,
    SceneNodePointerEvent,
)

from ai4u_edu.base.colors import rgb
from ai4u_edu.editing import ChangeResult, SceneEditor
from ai4u_edu.snapshot import BodyState, Snapshot, StaticScene
from ai4u_edu.snapshot.theme import Rgb
from ai4u_edu.viewer.backend.reporting import report_errors
from ai4u_edu.viewer.scene.arena import arena_size
from ai4u_edu.viewer.scene.geometry import Array, circle, grow, heading_wxyz, prism, segments
from ai4u_edu.viewer.scene.layers import Layers
from ai4u_edu.viewer.scene.light import line_colours
from ai4u_edu.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.viewer.scene.subtree import Subtree
from ai4u_edu.viewer.scene.view import Mode
from ai4u_edu.viewer.viewer_client import ViewerClient
from ai4u_edu.world import BodyDescription

HANDLE_MARGIN = 0.015
"""Margin of a handle around its body, as a share of the arena's size; it helps with thin walls."""
KNOB_RADIUS, KNOB_DISTANCE = 0.02, 0.05
"""Radius of the rotation knob and its distance from the body, as shares of the arena's size."""
ROTATION_STEP_DEG = 5.0
"""Bodies rotate in steps of this size, because most walls are meant to be straight."""
MAX_DRAG_M = 1e6
"""Largest distance (m) from the origin to which a body can be dragged."""
INK: Rgb = rgb("vermillion")
BOX = prism([(0.5, 0.5), (-0.5, 0.5), (-0.5, -0.5), (0.5, -0.5)], 1.0, 0.0)


class Drag(NamedTuple):
    """A body that is being dragged or rotated."""

    name: str
    x: float
    y: float
    """Offset from the pointer to the body's centre; for a rotation, the centre in the world."""
    is_rotation: bool


class Handles:
    """Invisible boxes over the bodies, to drag them, and a knob to rotate the chosen one.

    The bodies are drawn from snapshots, after the editor has moved them. At most one move is
    pending during a drag, so a slow world is not flooded. Escape cancels the drag. If the page
    disconnects or the handle is removed, viser ends the drag, and the body is dropped at its last
    position.

    viser's event loop calls the event handlers, the viewer's thread calls :meth:`draw`; a lock
    guards the drag.

    Args:
        viewer_client: the page.
        editor: moves the bodies.
        on_choose: called with the name of a body that was clicked, or whose drag starts.
        on_drop: called with the future of a dropped body's move.
    """

    def __init__(
        self,
        viewer_client: ViewerClient,
        editor: SceneEditor,
        on_choose: Callable[[str], None],
        on_drop: Callable[["Future[ChangeResult]"], None],
    ) -> None:
        self._viewer_client, self._editor = viewer_client, editor
        self._on_choose, self._on_drop = on_choose, on_drop
        scene = viewer_client.client.scene
        self._subtree, self._frame_subtree = Subtree(scene, "handles"), Subtree(scene, "chosen")
        self._lock = threading.Lock()
        self.drag: Drag | None = None
        """The drag in progress."""
        self._goal: tuple[float, float, float | None] | None = None
        self._pending: Future[None] | None = None
        self._bodies: tuple[BodyDescription, ...] = ()
        self.states: dict[str, BodyState] = {}
        self._boxes: BatchedMeshHandle | None = None
        self.knob: BatchedMeshHandle | None = None
        self._mark: FrameHandle | None = None
        self._marked: BodyDescription | None = None
        self.escape: CommandHandle | None = None
        """The command for the Escape key, while there are handles."""

    @property
    def node(self) -> str:
        """Name of the scene node of the boxes; empty if there are none."""
        return self._boxes.name if self._boxes is not None else ""

    def draw(self, snapshot: Snapshot, chosen: str, *, on: bool) -> None:
        """Move the handles to the bodies.

        Args:
            snapshot: the shown state of the world.
            chosen: name of the chosen body, or "".
            on: False removes all handles.
        """
        static_scene = snapshot.static_scene
        self.states = {state.name: state for state in snapshot.bodies}
        is_on = on and not snapshot.past and self._viewer_client.view.mode is not Mode.EYES
        wanted = static_scene.bodies if is_on else ()
        body = next((each for each in wanted if each.name == chosen), None)
        is_rotating = self.drag is not None and self.drag.is_rotation
        if wanted != self._bodies or (body != self._marked and is_rotating):
            self._end_drag_before_rebuild(static_scene.bodies)
        with self._viewer_client.client.atomic():
            if wanted != self._bodies:
                self._bodies = wanted
                self._build(static_scene)
                self._listen(is_on)
            if body != self._marked:
                self._marked = body
                self._build_mark(static_scene)
            self._move_handles(static_scene)
        self._send_drag()

    # -- drawing; on the viewer's thread ---------------------------------------------------------

    def _build(self, static_scene: StaticScene) -> None:
        self._boxes = None
        with self._subtree.rebuild() as parent:
            if self._bodies:
                drawer = MeshDrawer(self._viewer_client.client.scene, parent)
                boxes = drawer.batch("boxes", BOX, [INK] * len(self._bodies), opacity=0.0)
                boxes.on_click(report_errors(self._on_click))
                boxes.on_drag(report_errors(self._on_drag))
                self._boxes = boxes
        extents = [_extent(body) for body in self._bodies]
        margin = HANDLE_MARGIN * arena_size(static_scene)
        self._centres = np.array([each[0] for each in extents]).reshape(-1, 2)
        self._sizes = np.array([(*each[1], 0.0) for each in extents]).reshape(-1, 3) + margin
        self._lift = Layers.of(static_scene).body

    def _build_mark(self, static_scene: StaticScene) -> None:
        self._mark = self.knob = None
        body, unit = self._marked, arena_size(static_scene)
        with self._frame_subtree.rebuild() as parent:
            if body is None:
                return
            scene = self._viewer_client.client.scene
            self._mark = scene.add_frame(f"{parent}/frame", show_axes=False)
            outline = np.asarray(body.shape.outline())
            near, far = (
                float(outline[:, 0].max()),
                float(outline[:, 0].max()) + KNOB_DISTANCE * unit,
            )
            lines = [segments(grow(outline, 0.006 * unit)), np.array([[(near, 0, 0), (far, 0, 0)]])]
            scene.add_line_segments(
                f"{parent}/frame/edge",
                np.concatenate(lines).astype(np.float32),
                line_colours(INK),
                thickness=3.0,
                thickness_units="screen",
            )
            drawer = MeshDrawer(scene, f"{parent}/frame")
            rim = circle(KNOB_RADIUS * unit, corners=24)
            knob = drawer.batch("knob", prism(rim, KNOB_RADIUS * unit, 0.0).moved(far, 0.0), [INK])
            knob.batched_scales = np.ones(1, np.float32)
            knob.on_drag(report_errors(self._on_rotate))
            self.knob = knob

    def _move_handles(self, static_scene: StaticScene) -> None:
        if self._boxes is not None:
            states = [self.states[body.name] for body in self._bodies]
            wxyzs = np.array([heading_wxyz(state.heading) for state in states])
            positions = np.array([self._box_position(i, state) for i, state in enumerate(states)])
            gone = np.array([state.fallen for state in states])
            self._boxes.batched_positions = positions
            self._boxes.batched_wxyzs = wxyzs
            self._boxes.batched_scales = np.where(gone[:, None], 0.0, self._sizes)
        if self._mark is not None and self._marked is not None:
            state = self.states[self._marked.name]
            self._mark.visible = not state.fallen
            top = (
                state.z
                + self._marked.height
                + self._lift
                + 2 * HANDLE_MARGIN * arena_size(static_scene)
            )
            self._mark.position = (state.x, state.y, top)
            self._mark.wxyz = heading_wxyz(state.heading)

    def _box_position(self, index: int, state: BodyState) -> tuple[float, float, float]:
        """Return the position of a body's handle, a flat box on top of it around its outline."""
        x, y = self._centres[index]
        cos, sin = math.cos(state.heading), math.sin(state.heading)
        top = state.z + self._bodies[index].height + self._lift
        return state.x + cos * x - sin * y, state.y + sin * x + cos * y, top

    # -- events; in viser's event loop, one after the other --------------------------------------

    async def _on_click(self, event: SceneNodePointerEvent[BatchedMeshHandle]) -> None:
        name = self._name(event.instance_index)
        if name:
            self._on_choose(name)

    async def _on_drag(self, event: SceneNodeDragEvent[BatchedMeshHandle]) -> None:
        if event.phase == "start":
            name = self._name(event.instance_index)
            state = self.states.get(name)
            if state is not None:
                x, y, _ = event.start_position
                self._start_drag(Drag(name, state.x - x, state.y - y, is_rotation=False))
                self._on_choose(name)
        self._update_drag(event)

    async def _on_rotate(self, event: SceneNodeDragEvent[BatchedMeshHandle]) -> None:
        if event.phase == "start" and self._marked is not None:
            state = self.states.get(self._marked.name)
            if state is not None:
                self._start_drag(Drag(state.name, state.x, state.y, is_rotation=True))
        self._update_drag(event)

    def _listen(self, is_on: bool) -> None:
        """Add or remove the Escape key's command."""
        if is_on and self.escape is None:
            gui = self._viewer_client.client.gui
            self.escape = gui.add_command("Put back what is held", hotkey="escape")
            self.escape.on_trigger(self._on_escape)
        elif not is_on and self.escape is not None:
            self.escape.remove()
            self.escape = None

    async def _on_escape(self, _event: Any) -> None:
        self._cancel_drag()

    def _cancel_drag(self) -> None:
        with self._lock:
            drag, goal, self.drag = self.drag, self._goal, None
            if drag is not None and goal is not None:
                self._editor.cancel_drag(drag.name)

    def _end_drag_before_rebuild(self, new_bodies: tuple[BodyDescription, ...]) -> None:
        """Drop the dragged body if it still exists unchanged, else cancel the drag."""
        drag = self.drag
        dragged = next((body for body in self._bodies if drag and body.name == drag.name), None)
        if dragged in new_bodies:
            self._drop()
        else:
            self._cancel_drag()

    def _name(self, index: int | None) -> str:
        bodies = self._bodies
        return bodies[index].name if index is not None and 0 <= index < len(bodies) else ""

    def _start_drag(self, drag: Drag) -> None:
        with self._lock:
            self.drag, self._goal = drag, None

    def _update_drag(self, event: SceneNodeDragEvent[Any]) -> None:
        with self._lock:
            drag = self.drag
            if drag is None:
                return
            x, y, _ = event.end_position
            dx, dy = (x - drag.x, y - drag.y) if drag.is_rotation else (x + drag.x, y + drag.y)
            if not math.hypot(dx, dy) <= MAX_DRAG_M:  # also true for NaN
                pass  # untrusted input: the body stays at its last position
            elif drag.is_rotation:
                degrees = math.degrees(math.atan2(dy, dx))
                self._goal = drag.x, drag.y, ROTATION_STEP_DEG * round(degrees / ROTATION_STEP_DEG)
            else:
                self._goal = round(dx, 3), round(dy, 3), None
        if event.phase == "end":
            self._drop()
        else:
            self._send_drag()

    def _send_drag(self) -> None:
        """Move the dragged body to its goal, unless a move is pending.

        Called at each drawing too, because the world may move the body meanwhile.
        """
        with self._lock:
            is_idle = self._pending is None or self._pending.done()
            if self.drag is not None and self._goal is not None and is_idle:
                self._pending = self._editor.drag(self.drag.name, *self._goal)

    def _drop(self) -> None:
        with self._lock:
            drag, goal, self.drag = self.drag, self._goal, None
            if drag is None or goal is None:
                return
            future = self._editor.move_body(drag.name, *goal)
        self._on_drop(future)


def _extent(body: BodyDescription) -> tuple[Array, Array]:
    """Return the centre and the size of a rectangle around a body, in its own frame."""
    outline = np.asarray(body.shape.outline())
    low, high = outline.min(axis=0), outline.max(axis=0)
    return (low + high) / 2, high - low
