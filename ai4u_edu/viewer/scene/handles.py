"""What a hand takes the bodies of a world by, on one page."""

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
from ai4u_edu.viewer.backend.reporting import reporting
from ai4u_edu.viewer.scene.geometry import Array, circle, grow, prism, segments
from ai4u_edu.viewer.scene.layers import Layers
from ai4u_edu.viewer.scene.light import strokes
from ai4u_edu.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.viewer.scene.placing import size
from ai4u_edu.viewer.scene.subtree import Subtree
from ai4u_edu.viewer.scene.view import Mode
from ai4u_edu.viewer.viewer_client import ViewerClient
from ai4u_edu.world import BodyDescription

ROOM = 0.015
"""How far a handle reaches beyond its body, as a share of the arena: a thin wall can be hit too."""
KNOB, STEM = 0.02, 0.05
"""The radius of what turns a body, and how far it is from it, as shares of the arena."""
STEP = 5.0
"""Degrees: a hand turns in such steps, for walls are mostly to be straight."""
MAX_DRAG_M = 1e6
"""Largest distance (m) from the origin to which a body can be dragged."""
INK: Rgb = rgb("vermillion")
BOX = prism([(0.5, 0.5), (-0.5, 0.5), (-0.5, -0.5), (0.5, -0.5)], 1.0, 0.0)


class Grip(NamedTuple):
    """How a hand holds a body."""

    name: str
    x: float
    y: float
    """Where the body's centre is, seen from the hand; or in the world, for one that is turned."""
    turns: bool


class Handles:
    """An unseen box over each body to take it by, and a knob by which the chosen one is turned.

    The picture follows from what the editor does with the world. One call at a time is under way
    while a body is carried, so a slow world gets no more of them than it can take. Escape puts back
    what is held. A hand that is gone lets go where it was last: viser ends what a page drags when
    that page goes, or when what it drags by is taken away.

    Args:
        viewer_client: the page.
        editor: moves the bodies.
        on_choose: called with the name of a body that was clicked on, or taken up.
        on_drop: called with what becomes of a body that was let go of.
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
        self.grip: Grip | None = None
        """The body that is held just now."""
        self._goal: tuple[float, float, float | None] | None = None
        self._asked: Future[None] | None = None
        self._bodies: tuple[BodyDescription, ...] = ()
        self._states: dict[str, BodyState] = {}
        self._boxes: BatchedMeshHandle | None = None
        self.knob: BatchedMeshHandle | None = None
        self._mark: FrameHandle | None = None
        self._marked: BodyDescription | None = None
        self.escape: CommandHandle | None = None
        """Listens to the key, while there is something to take up."""

    @property
    def node(self) -> str:
        """The name of the node in which the boxes are; empty if there are none."""
        return self._boxes.name if self._boxes is not None else ""

    def draw(self, snapshot: Snapshot, chosen: str, *, on: bool) -> None:
        """Puts the handles where the bodies are.

        Args:
            snapshot: what is seen.
            chosen: the name of the body that was chosen, or "".
            on: whether there are to be any.
        """
        static_scene = snapshot.static_scene
        self._states = {state.name: state for state in snapshot.bodies}
        is_on = on and not snapshot.past and self._viewer_client.view.mode is not Mode.EYES
        wanted = static_scene.bodies if is_on else ()
        body = next((each for each in wanted if each.name == chosen), None)
        if wanted != self._bodies or (body != self._marked and self.grip and self.grip.turns):
            self._lose_hold(static_scene.bodies)
        with self._viewer_client.client.atomic():
            if wanted != self._bodies:
                self._bodies = wanted
                self._build(static_scene)
                self._listen(is_on)
            if body != self._marked:
                self._marked = body
                self._build_mark(static_scene)
            self._place(static_scene)
        self._carry()

    # -- what is seen ----------------------------------------------------------------------------

    def _build(self, static_scene: StaticScene) -> None:
        self._boxes = None
        with self._subtree.rebuild() as parent:
            if self._bodies:
                drawer = MeshDrawer(self._viewer_client.client.scene, parent)
                boxes = drawer.batch("boxes", BOX, [INK] * len(self._bodies), opacity=0.0)
                boxes.on_click(reporting(self._on_click))
                boxes.on_drag(reporting(self._on_drag))
                self._boxes = boxes
        extents = [_extent(body) for body in self._bodies]
        room = ROOM * size(static_scene)
        self._centres = np.array([each[0] for each in extents]).reshape(-1, 2)
        self._sizes = np.array([(*each[1], 0.0) for each in extents]).reshape(-1, 3) + room
        self._lift = Layers.of(static_scene).body

    def _build_mark(self, static_scene: StaticScene) -> None:
        self._mark = self.knob = None
        body, unit = self._marked, size(static_scene)
        with self._frame_subtree.rebuild() as parent:
            if body is None:
                return
            scene = self._viewer_client.client.scene
            self._mark = scene.add_frame(f"{parent}/frame", show_axes=False)
            outline = np.asarray(body.shape.outline())
            near, far = float(outline[:, 0].max()), float(outline[:, 0].max()) + STEM * unit
            lines = [segments(grow(outline, 0.006 * unit)), np.array([[(near, 0, 0), (far, 0, 0)]])]
            scene.add_line_segments(
                f"{parent}/frame/edge",
                np.concatenate(lines).astype(np.float32),
                strokes(INK),
                thickness=3.0,
                thickness_units="screen",
            )
            drawer = MeshDrawer(scene, f"{parent}/frame")
            rim = circle(KNOB * unit, corners=24)
            knob = drawer.batch("knob", prism(rim, KNOB * unit, 0.0).moved(far, 0.0), [INK])
            knob.batched_scales = np.ones(1, np.float32)
            knob.on_drag(reporting(self._on_turn))
            self.knob = knob

    def _place(self, static_scene: StaticScene) -> None:
        if self._boxes is not None:
            states = [self._states[body.name] for body in self._bodies]
            turns = np.array([_quaternion(state.heading) for state in states])
            places = np.array([self._middle(i, state) for i, state in enumerate(states)])
            gone = np.array([state.fallen for state in states])
            self._boxes.batched_positions = places
            self._boxes.batched_wxyzs = turns
            self._boxes.batched_scales = np.where(gone[:, None], 0.0, self._sizes)
        if self._mark is not None and self._marked is not None:
            state = self._states[self._marked.name]
            self._mark.visible = not state.fallen
            top = state.z + self._marked.height + self._lift + 2 * ROOM * size(static_scene)
            self._mark.position = (state.x, state.y, top)
            self._mark.wxyz = _quaternion(state.heading)

    def _middle(self, index: int, state: BodyState) -> tuple[float, float, float]:
        """Where a handle stands: a flat box on top of its body, around the body's outline."""
        x, y = self._centres[index]
        cos, sin = math.cos(state.heading), math.sin(state.heading)
        top = state.z + self._bodies[index].height + self._lift
        return state.x + cos * x - sin * y, state.y + sin * x + cos * y, top

    # -- what a hand does; in viser's loop, one after the other ----------------------------------

    async def _on_click(self, event: SceneNodePointerEvent[BatchedMeshHandle]) -> None:
        name = self._name(event.instance_index)
        if name:
            self._on_choose(name)

    async def _on_drag(self, event: SceneNodeDragEvent[BatchedMeshHandle]) -> None:
        if event.phase == "start":
            name = self._name(event.instance_index)
            state = self._states.get(name)
            if state is not None:
                x, y, _ = event.start_position
                self._take(Grip(name, state.x - x, state.y - y, turns=False))
                self._on_choose(name)
        self._follow(event)

    async def _on_turn(self, event: SceneNodeDragEvent[BatchedMeshHandle]) -> None:
        if event.phase == "start" and self._marked is not None:
            state = self._states.get(self._marked.name)
            if state is not None:
                self._take(Grip(state.name, state.x, state.y, turns=True))
        self._follow(event)

    def _listen(self, is_on: bool) -> None:
        """Has Escape mean something here, or no longer."""
        if is_on and self.escape is None:
            gui = self._viewer_client.client.gui
            self.escape = gui.add_command("Put back what is held", hotkey="escape")
            self.escape.on_trigger(self._on_escape)
        elif not is_on and self.escape is not None:
            self.escape.remove()
            self.escape = None

    async def _on_escape(self, _event: Any) -> None:
        self._put_back()

    def _put_back(self) -> None:
        with self._lock:
            grip, goal, self.grip = self.grip, self._goal, None
            if grip is not None and goal is not None:
                self._editor.cancel_drag(grip.name)

    def _lose_hold(self, now: tuple[BodyDescription, ...]) -> None:
        """What a hand holds its body by is about to go; so may be the body, with its scene."""
        grip = self.grip
        held = next((body for body in self._bodies if grip and body.name == grip.name), None)
        if held in now:
            self._let_go()
        else:
            self._put_back()

    def _name(self, index: int | None) -> str:
        bodies = self._bodies
        return bodies[index].name if index is not None and 0 <= index < len(bodies) else ""

    def _take(self, grip: Grip) -> None:
        with self._lock:
            self.grip, self._goal = grip, None

    def _follow(self, event: SceneNodeDragEvent[Any]) -> None:
        with self._lock:
            grip = self.grip
            if grip is None:
                return
            x, y, _ = event.end_position
            ahead, aside = (x - grip.x, y - grip.y) if grip.turns else (x + grip.x, y + grip.y)
            if not math.hypot(ahead, aside) <= MAX_DRAG_M:  # that of NaN is not, either
                pass  # a page may say what it likes: the body stays where it was last
            elif grip.turns:
                degrees = math.degrees(math.atan2(aside, ahead))
                self._goal = grip.x, grip.y, STEP * round(degrees / STEP)
            else:
                self._goal = round(ahead, 3), round(aside, 3), None
        if event.phase == "end":
            self._let_go()
        else:
            self._carry()

    def _carry(self) -> None:
        """Has a body that is held go where the hand is; also when only the world moved it."""
        with self._lock:
            idle = self._asked is None or self._asked.done()
            if self.grip is not None and self._goal is not None and idle:
                self._asked = self._editor.drag(self.grip.name, *self._goal)

    def _let_go(self) -> None:
        with self._lock:
            grip, goal, self.grip = self.grip, self._goal, None
            if grip is None or goal is None:
                return
            future = self._editor.move_body(grip.name, *goal)
        self._on_drop(future)


def _extent(body: BodyDescription) -> tuple[Array, Array]:
    """The middle and the size of a rectangle around a body, in its own frame."""
    outline = np.asarray(body.shape.outline())
    low, high = outline.min(axis=0), outline.max(axis=0)
    return (low + high) / 2, high - low


def _quaternion(heading: float) -> tuple[float, float, float, float]:
    return math.cos(heading / 2), 0.0, 0.0, math.sin(heading / 2)
