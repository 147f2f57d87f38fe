"""Handles with which a person moves, rotates and resizes things, on the pages in move mode."""

import math
import threading
from collections.abc import Callable, Collection
from concurrent.futures import Future
from functools import partial
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
from viser import (
    BatchedMeshHandle,
    CommandHandle,
    LineSegmentsHandle,
    SceneNodeDragEvent,
    SceneNodePointerEvent,
)

from ai4u_edu.page.editing import ChangeResult, SceneEditor
from ai4u_edu.page.viewer.backend.reporting import report_errors
from ai4u_edu.page.viewer.scene.arena import arena_size
from ai4u_edu.page.viewer.scene.chosen_mark import INK, ChosenMark
from ai4u_edu.page.viewer.scene.drags import Drag, DragAction, Goal, Thing, outline_of
from ai4u_edu.page.viewer.scene.geometry import Array, heading_wxyz, prism, segments
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.page.viewer.scene.light import line_colours
from ai4u_edu.page.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.page.viewer.scene.subtree import Subtree
from ai4u_edu.page.viewer.scene.view import Mode
from ai4u_edu.page.viewer.viewer_client import ViewerClient, ViewerClients
from ai4u_edu.runtime.frame_budget import SENSES_PER_S, PageTurns
from ai4u_edu.snapshot import BodyState, Snapshot, StaticScene
from ai4u_edu.world import AreaDescription, BodyDescription, FloorDescription

_Region = FloorDescription | AreaDescription


def _extent(thing: Thing) -> tuple[Array, Array]:
    """Return the centre and the size of a rectangle around a thing, in its own frame."""
    outline = np.asarray(outline_of(thing.shape))
    low, high = outline.min(axis=0), outline.max(axis=0)
    return (low + high) / 2, high - low


def _centre_at(
    centre: Array, x: float, y: float, heading: float, z: float
) -> tuple[float, float, float]:
    """Return the place in the world of a point in the frame of a thing at (x, y)."""
    along, across = centre
    cos, sin = math.cos(heading), math.sin(heading)
    return x + cos * along - sin * across, y + sin * along + cos * across, z


def _surface_z(region: _Region, static_scene: StaticScene) -> float:
    """Return the height of a floor's surface, or of the surface under an area."""
    if isinstance(region, FloorDescription):
        return region.top
    ground = static_scene.floor_under(*region.position)
    return static_scene.lowest_floor if ground is None else ground


def _plate_z(region: _Region, static_scene: StaticScene) -> float:
    """Return the height of the invisible plate by which a region is clicked.

    It lies below the surface, since an invisible plate above would hide translucent areas. Areas'
    plates lie above floors', so that areas can be clicked.
    """
    layers = Layers.of(static_scene)
    depth = layers.area_plate if isinstance(region, AreaDescription) else layers.floor_plate
    return _surface_z(region, static_scene) + depth


Pose = tuple[float, float, float]
"""x, y (m) and heading (radians)."""
_HANDLE_MARGIN = 0.015
"""Margin of a handle around its body, as a share of the arena's size; it helps with thin walls."""
FREE_MODIFIER: Literal["alt"] = "alt"
"""Key that is held to move freely, without the grid."""
_BOX = prism([(0.5, 0.5), (-0.5, 0.5), (-0.5, -0.5), (0.5, -0.5)], 1.0, 0.0)


class Handles:
    """Invisible boxes over the things, to choose and drag them, and knobs on the chosen one.

    Bodies are dragged directly, and drawn from snapshots after the editor has moved them. At most
    one move is pending, so a slow world is not flooded. A floor or an area lies under everything,
    so it has to be chosen by a click before it can be dragged; it moves when it is dropped, and so
    does another size. Escape cancels the drag. If the page disconnects or the handle is removed,
    viser ends the drag, and the thing is dropped at its last place.

    viser's event loop calls the event handlers, the viewer's thread calls :meth:`draw`; a lock
    guards the drag.

    Args:
        viewer_client: the page.
        editor: changes the things.
        on_choose: called with the name of a thing that was clicked, or whose drag starts.
        on_drop: called with the future of a dropped thing's change.
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
        self.snap_m = 0.0
        """Distance (m) of the grid to which things snap; 0 for free places."""
        self._subtree = Subtree(viewer_client.client.scene, "handles")
        self._mark = ChosenMark(viewer_client)
        self._others = Subtree(viewer_client.client.scene, "others")
        self._other_lines: LineSegmentsHandle | None = None
        self._other_things: tuple[Thing, ...] = ()
        self._lock = threading.Lock()
        self.drag: Drag | None = None
        """The drag in progress."""
        self._goal: Goal | None = None
        self._pending: list[Future[None]] = []
        self._along: dict[str, tuple[float, float]] = {}
        """Offsets (m) of the things that a dragged one takes along, by name."""
        self._bodies: tuple[BodyDescription, ...] = ()
        self._regions: tuple[_Region, ...] = ()
        self.states: dict[str, BodyState] = {}
        self._boxes: BatchedMeshHandle | None = None
        self._plates: BatchedMeshHandle | None = None
        self.escape: CommandHandle | None = None
        """The command for the Escape key, while there are handles."""

    @property
    def node(self) -> str:
        """Name of the scene node of the bodies' boxes; empty if there are none."""
        return self._boxes.name if self._boxes is not None else ""

    @property
    def region_node(self) -> str:
        """Name of the scene node of the plates over floors and areas; empty if there are none."""
        return self._plates.name if self._plates is not None else ""

    @property
    def knobs(self) -> dict[DragAction, BatchedMeshHandle]:
        """The knobs of the chosen thing, by what they change."""
        return self._mark.knobs

    @property
    def chosen_plate(self) -> BatchedMeshHandle | None:
        """The plate by which the chosen floor or area is moved."""
        return self._mark.plate

    def draw(
        self, snapshot: Snapshot, chosen: str, others: Collection[str] = (), *, on: bool
    ) -> None:
        """Move the handles to the things.

        Args:
            snapshot: the shown state of the world.
            chosen: name of the chosen thing, or "".
            others: names of the things that are chosen with it.
            on: False removes all handles.
        """
        static_scene = snapshot.static_scene
        self.states = {state.name: state for state in snapshot.bodies}
        is_on = on and not snapshot.past and self._viewer_client.view.mode is not Mode.EYES
        bodies = static_scene.bodies if is_on else ()
        all_regions: tuple[_Region, ...] = (*static_scene.floors, *static_scene.areas)
        regions = all_regions if is_on else ()
        things: tuple[Thing, ...] = (*bodies, *regions)
        thing = next((each for each in things if each.name == chosen), None)
        is_rebuilt = (bodies, regions) != (self._bodies, self._regions)
        drag = self.drag
        is_by_mark = drag is not None and not (drag.is_live and drag.action is DragAction.MOVE)
        if is_rebuilt or (is_by_mark and thing != self._mark.thing):
            self._end_drag_before_rebuild((*static_scene.bodies, *all_regions))
        with self._viewer_client.client.atomic():
            if is_rebuilt:
                self._bodies, self._regions = bodies, regions
                self._build(static_scene)
                self._listen(is_on)
            if _looks(thing) != _looks(self._mark.thing):
                self._build_mark(thing, static_scene)
            self._mark.thing = thing
            self._mark.scale(self._knob_radius)
            self._draw_others(tuple(each for each in things if each.name in others), static_scene)
            self._move_handles(static_scene)
        self._send_drag()

    # -- drawing; on the viewer's thread ---------------------------------------------------------

    def _build(self, static_scene: StaticScene) -> None:
        self._boxes = self._plates = None
        self._lift = Layers.of(static_scene).body
        with self._subtree.rebuild() as parent:
            drawer = MeshDrawer(self._viewer_client.client.scene, parent)
            if self._bodies:
                boxes = drawer.batch("boxes", _BOX, [INK] * len(self._bodies), opacity=0.0)
                boxes.on_click(report_errors(self._on_click))
                _listen_to_drags(boxes, self._on_drag)
                self._boxes = boxes
            if self._regions:
                plates = drawer.batch("plates", _BOX, [INK] * len(self._regions), opacity=0.0)
                plates.on_click(report_errors(self._on_region_click))
                self._plates = plates
                self._place_plates(plates, static_scene)
        extents = [_extent(body) for body in self._bodies]
        margin = _HANDLE_MARGIN * arena_size(static_scene)
        self._centres = np.array([each[0] for each in extents]).reshape(-1, 2)
        self._sizes = np.array([(*each[1], 0.0) for each in extents]).reshape(-1, 3) + margin

    def _place_plates(self, plates: BatchedMeshHandle, static_scene: StaticScene) -> None:
        thickness = 0.1 * Layers.of(static_scene).unit
        headings = [math.radians(region.heading_deg) for region in self._regions]
        plates.batched_wxyzs = np.array([heading_wxyz(heading) for heading in headings])
        plates.batched_scales = np.array(
            [(*_extent(region)[1], thickness) for region in self._regions]
        )
        plates.batched_positions = np.array(
            [
                _centre_at(
                    _extent(region)[0], *region.position, heading, _plate_z(region, static_scene)
                )
                for region, heading in zip(self._regions, headings, strict=True)
            ]
        )

    def _build_mark(self, thing: Thing | None, static_scene: StaticScene) -> None:
        depth = 0.0
        if thing is not None and not isinstance(thing, BodyDescription):
            above_others = 0.3 * Layers.of(static_scene).unit
            depth = _plate_z(thing, static_scene) + above_others - self._mark_z(thing, static_scene)
        self._mark.build(thing, static_scene, depth, self._knob_radius)
        plates = {} if self._mark.plate is None else {DragAction.MOVE: self._mark.plate}
        for action, handle in (self._mark.knobs | plates).items():
            _listen_to_drags(handle, self._mark_dragged(action))
            handle.on_click(report_errors(self._on_mark_click))

    @property
    def _knob_radius(self) -> float:
        """Radius of a knob (m), which has the same size on the screen from near and far."""
        camera = self._viewer_client.client.camera
        distance = float(np.linalg.norm(camera.position - camera.look_at))
        height = 2 * distance * math.tan(camera.fov / 2)
        return max(self._viewer_client.knob_share * height, 1e-3)

    def _draw_others(self, things: tuple[Thing, ...], static_scene: StaticScene) -> None:
        """Draw outlines around the things that are chosen with the first one."""
        if things != self._other_things:
            self._other_things, self._other_lines = things, None
            with self._others.rebuild() as parent:
                if things:
                    self._other_lines = self._viewer_client.client.scene.add_line_segments(
                        f"{parent}/edges",
                        self._outlines(static_scene),
                        line_colours(INK),
                        thickness=3.0,
                        thickness_units="screen",
                    )
        elif self._other_lines is not None:
            points = self._outlines(static_scene)
            if not np.array_equal(points, self._other_lines.points):
                self._other_lines.points = points

    def _outlines(self, static_scene: StaticScene) -> npt.NDArray[np.float32]:
        """Return the outlines of the other chosen things in the world: (n, 2, 3)."""
        edges = []
        for thing in self._other_things:
            x, y, heading = self._pose(thing) or (*thing.position, math.radians(thing.heading_deg))
            outline = np.array(
                [
                    _centre_at(np.asarray(point), x, y, heading, 0.0)
                    for point in outline_of(thing.shape)
                ]
            )
            edge = segments(outline[:, :2])
            edge[..., 2] = (
                self.states[thing.name].z + thing.height + self._lift
                if isinstance(thing, BodyDescription)
                else self._mark_z(thing, static_scene)
            )
            edges.append(edge)
        return np.concatenate(edges).astype(np.float32)

    def _pose(self, thing: Thing) -> Pose | None:
        """Return where a thing is now; None for a body that is not there."""
        state = self.states.get(thing.name)
        if state is not None:
            return state.x, state.y, state.heading
        if isinstance(thing, BodyDescription):
            return None
        return (*thing.position, math.radians(thing.heading_deg))

    def _move_handles(self, static_scene: StaticScene) -> None:
        if self._boxes is not None:
            states = [self.states[body.name] for body in self._bodies]
            wxyzs = np.array([heading_wxyz(state.heading) for state in states])
            lift = self._lift
            positions = np.array(
                [
                    _centre_at(
                        centre, state.x, state.y, state.heading, state.z + body.height + lift
                    )
                    for body, centre, state in zip(self._bodies, self._centres, states, strict=True)
                ]
            )
            gone = np.array([state.fallen for state in states])
            self._boxes.batched_positions = positions
            self._boxes.batched_wxyzs = wxyzs
            self._boxes.batched_scales = np.where(gone[:, None], 0.0, self._sizes)
        thing, drag = self._mark.thing, self.drag
        if thing is None or (drag is not None and not drag.is_live and drag.name == thing.name):
            return  # during such a drag the mark is the preview
        if isinstance(thing, BodyDescription):
            state = self.states[thing.name]
            margin = 2 * _HANDLE_MARGIN * arena_size(static_scene)
            top = state.z + thing.height + self._lift + margin
            self._mark.place(state.x, state.y, top, state.heading, is_visible=not state.fallen)
        else:
            top = self._mark_z(thing, static_scene)
            self._mark.place(*thing.position, top, math.radians(thing.heading_deg))

    def _mark_z(self, region: _Region, static_scene: StaticScene) -> float:
        """Return the height of the mark around a floor or an area."""
        return _surface_z(region, static_scene) + self._lift

    # -- events; in viser's event loop, one at a time -------------------------------------------

    async def _on_click(self, event: SceneNodePointerEvent[BatchedMeshHandle]) -> None:
        name = _name(self._bodies, event.instance_index)
        if name:
            self._on_choose(name)

    async def _on_region_click(self, event: SceneNodePointerEvent[BatchedMeshHandle]) -> None:
        name = _name(self._regions, event.instance_index)
        if name:
            self._on_choose(name)

    async def _on_mark_click(self, _event: SceneNodePointerEvent[BatchedMeshHandle]) -> None:
        """Keep a click on a knob from reaching the page."""

    async def _on_drag(self, event: SceneNodeDragEvent[BatchedMeshHandle]) -> None:
        if event.phase == "start":
            name = _name(self._bodies, event.instance_index)
            body = next((each for each in self._bodies if each.name == name), None)
            state = self.states.get(name)
            if state is not None and body is not None:
                x, y, _ = event.start_position
                pose = state.x, state.y, state.heading
                self._start_drag(Drag.start(body, DragAction.MOVE, pose, x, y))
                if not self._along:
                    self._on_choose(name)
        self._update_drag(event)

    def _mark_dragged(self, action: DragAction) -> Callable[[SceneNodeDragEvent[Any]], Any]:
        async def on_drag(event: SceneNodeDragEvent[Any]) -> None:
            if event.phase == "start" and self._mark.thing is not None:
                self._start_mark_drag(self._mark.thing, action, event)
            self._update_drag(event)

        return on_drag

    def _start_mark_drag(
        self, thing: Thing, action: DragAction, event: SceneNodeDragEvent[Any]
    ) -> None:
        pose = self._pose(thing)
        if pose is not None:
            x, y, _ = event.start_position
            self._start_drag(Drag.start(thing, action, pose, x, y))

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
        self.cancel_drag()

    def cancel_drag(self) -> bool:
        """Put back what is dragged; return False if nothing is."""
        with self._lock:
            drag, goal, self.drag = self.drag, self._goal, None
            if drag is not None and goal is not None and drag.is_live:
                for name in (drag.name, *self._along_bodies):
                    self._editor.cancel_drag(name)
        self._mark.show_value(None)
        if drag is not None and not drag.is_live:
            self._mark.show_shape(drag.thing.shape)
        return drag is not None

    def _end_drag_before_rebuild(self, new_things: tuple[Thing, ...]) -> None:
        """Drop the dragged thing if it still exists unchanged, else cancel the drag."""
        drag = self.drag
        if drag is not None and drag.thing in new_things:
            self._drop()
        else:
            self.cancel_drag()

    def _start_drag(self, drag: Drag) -> None:
        chosen = (self._mark.thing, *self._other_things)
        things = [thing for thing in chosen if thing is not None]
        pose, along = self._pose(drag.thing), {}
        if drag.action is DragAction.MOVE and drag.thing in things and pose is not None:
            for thing in things:
                other = self._pose(thing)
                if other is not None and thing != drag.thing:
                    along[thing.name] = other[0] - pose[0], other[1] - pose[1]
        with self._lock:
            self.drag, self._goal, self._along = drag, None, along

    @property
    def _along_bodies(self) -> list[str]:
        """Names of the bodies that the dragged thing takes along, which move with it at once."""
        return [name for name in self._along if name in self.states]

    def _update_drag(self, event: SceneNodeDragEvent[Any]) -> None:
        with self._lock:
            drag = self.drag
            if drag is None:
                return
            is_free = event.modifier == FREE_MODIFIER
            x, y, _ = event.end_position
            # untrusted input: for an unusable place the thing stays at its last one
            self._goal = goal = drag.goal(x, y, self.snap_m, is_free=is_free) or self._goal
        if event.phase == "end":
            self._drop()
            return
        self._mark.show_value(goal)
        if drag.is_live:
            self._send_drag()
        elif goal is not None:
            self._show_preview(drag, goal)

    def _show_preview(self, drag: Drag, goal: Goal) -> None:
        """Show with the mark where a floor or an area will be, or how large a thing."""
        frame = self._mark.frame
        if goal.shape is not None:
            self._mark.show_shape(goal.shape)
        if frame is not None:
            turned = drag.heading if goal.heading_deg is None else math.radians(goal.heading_deg)
            self._mark.place(goal.x, goal.y, float(frame.position[2]), turned)

    def _send_drag(self) -> None:
        """Move the dragged body to its goal, unless a move is pending.

        Called at each drawing too, because the world may move the body meanwhile.
        """
        with self._lock:
            drag, goal = self.drag, self._goal
            is_idle = all(future.done() for future in self._pending)
            if drag is not None and drag.is_live and goal is not None and is_idle:
                self._pending = [self._editor.drag(drag.name, *goal[:3])]
                for name in self._along_bodies:
                    dx, dy = self._along[name]
                    self._pending.append(self._editor.drag(name, goal.x + dx, goal.y + dy))

    def _drop(self) -> None:
        with self._lock:
            drag, goal, self.drag = self.drag, self._goal, None
            if drag is None or goal is None:
                return
            if goal.shape is not None:
                shape = goal.shape.model_dump(mode="json")
                is_moved = goal[:2] != (drag.x, drag.y)
                future = self._editor.resize(drag.name, shape, goal[:2] if is_moved else None)
            elif goal.height is not None:
                future = self._editor.change_body(drag.name, {"height": goal.height})
            else:
                others = {
                    name: (goal.x + dx, goal.y + dy, None) for name, (dx, dy) in self._along.items()
                }
                future = self._editor.move_things({drag.name: goal[:3], **others})
        self._mark.show_value(None)
        self._on_drop(future)


def _listen_to_drags(
    handle: BatchedMeshHandle, on_drag: Callable[[SceneNodeDragEvent[Any]], Any]
) -> None:
    """Listen to drags without a key, and to those with the key for free places."""
    handle.on_drag(report_errors(on_drag))
    handle.on_drag("left", modifier=FREE_MODIFIER)(report_errors(on_drag))


def _looks(thing: Thing | None) -> Thing | None:
    """Return a body at the origin: its mark is moved, and built again for another shape only."""
    if not isinstance(thing, BodyDescription):
        return thing
    return thing.model_copy(update={"position": (0.0, 0.0), "heading_deg": 0.0})


def _name(things: tuple[Thing, ...], index: int | None) -> str:
    return things[index].name if index is not None and 0 <= index < len(things) else ""


class PageHandles:
    """The handles of each page in move mode.

    Args:
        viewer_clients: the pages.
        editor: changes the things.
    """

    def __init__(self, viewer_clients: ViewerClients, editor: SceneEditor) -> None:
        self._viewer_clients, self._editor = viewer_clients, editor
        self.pages: dict[int, Handles] = {}

    def build(self, static_scene: StaticScene) -> None:  # noqa: ARG002 - handles find it in snapshots
        """Draw all pages' handles again, at once."""
        self._turns = PageTurns(SENSES_PER_S)

    def draw(self, snapshot: Snapshot) -> None:
        """Move the handles to the things, and remove those of pages that left the move mode."""
        for gone in self.pages.keys() - self._viewer_clients.keys():
            del self.pages[gone]
        for number in self._turns.due(self._viewer_clients.keys()):
            client = self._viewer_clients[number]
            if number not in self.pages and not (client.page_id and client.is_move_mode):
                continue
            if number not in self.pages:
                self.pages[number] = Handles(
                    client, self._editor, partial(_select_for, client), partial(_report, client)
                )
            handles = self.pages[number]
            handles.snap_m = client.snap_m
            handles.draw(snapshot, client.selected, client.others, on=client.is_move_mode)


def _select_for(client: ViewerClient, name: str) -> None:
    client.selected, client.others = name, ()
    if client.panel is not None:
        client.panel.on_selected(name)


def _report(client: ViewerClient, change: "Future[ChangeResult]") -> None:
    if client.panel is not None:
        client.panel.on_dropped(change)
