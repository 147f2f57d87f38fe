"""A stand-in for an agent: an outline that a person puts elsewhere, while the agent stays."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any, Literal

import numpy as np
from viser import BatchedMeshHandle, FrameHandle, SceneNodeDragEvent

from ai4u_edu.base.colors import rgb
from ai4u_edu.explain.elsewhere import Elsewhere, Pose
from ai4u_edu.explain.map_maker import LiveMap, MapRequest
from ai4u_edu.explain.page.choice import OPTION, choice_of
from ai4u_edu.explain.page.field_arrows import FieldArrows
from ai4u_edu.page.viewer.backend.reporting import report_errors
from ai4u_edu.page.viewer.scene.arena import arena_size
from ai4u_edu.page.viewer.scene.drags import Drag, DragAction
from ai4u_edu.page.viewer.scene.geometry import circle, grow, heading_wxyz, prism, segments
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.page.viewer.scene.light import line_colours
from ai4u_edu.page.viewer.scene.mesh_drawer import MeshDrawer
from ai4u_edu.page.viewer.scene.subtree import Subtree
from ai4u_edu.page.viewer.viewer_client import ViewerClient, ViewerClients
from ai4u_edu.runtime.frame_budget import SENSES_PER_S, PageTurns
from ai4u_edu.snapshot import Snapshot, StaticScene
from ai4u_edu.world import BodyDescription

INK = rgb("purple")
BODY_OPACITY = 0.45
KNOB_RADIUS, KNOB_DISTANCE = 0.02, 0.05
"""Radius of the knob that turns it, and its distance, as shares of the arena's size."""
OUTLINE_MARGIN = 0.006
"""Distance of the outline from the body, as a share of the arena's size."""
ARROW_SHARE = 1.8
"""Length of the arrow that shows the action, relative to the body's reach."""
FREE_MODIFIER: Literal["alt"] = "alt"


class StandIns:
    """The stand-ins of the pages that try other places.

    Args:
        viewer_clients: the pages.
    """

    def __init__(self, viewer_clients: ViewerClients) -> None:
        self._viewer_clients = viewer_clients
        self.pages: dict[int, StandIn] = {}
        self._turns = PageTurns(SENSES_PER_S)

    def build(self, static_scene: StaticScene) -> None:  # noqa: ARG002 - they find it in snapshots
        """Draw all pages' stand-ins again, at once."""
        self._turns = PageTurns(SENSES_PER_S)

    def draw(self, snapshot: Snapshot) -> None:
        """Draw the stand-ins where they stand; in a world that runs there are none."""
        for gone in self.pages.keys() - self._viewer_clients.keys():
            del self.pages[gone]
        for number in self._turns.due(self._viewer_clients.keys()):
            client = self._viewer_clients[number]
            told = choice_of(client).elsewhere if snapshot.paused else None
            if number not in self.pages and told is None:
                continue
            if number not in self.pages:
                self.pages[number] = StandIn(client)
            self.pages[number].draw(snapshot, told)


class StandIn:
    """The stand-in on one page.

    viser's event loop calls the event handlers, the viewer's thread calls :meth:`draw`; what they
    share are single values.
    """

    def __init__(self, client: ViewerClient) -> None:
        self._client = client
        self._scene = client.client.scene
        self._subtree = Subtree(self._scene, "elsewhere")
        self._arrows = FieldArrows(self._scene, "elsewhere_arrow")
        self._built: tuple[BodyDescription, StaticScene] | None = None
        self._drawn: object = None
        self._frame: FrameHandle | None = None
        self.body: BatchedMeshHandle | None = None
        """The body, which is dragged to another place."""
        self.knob: BatchedMeshHandle | None = None
        """The knob that turns it."""
        self.pose: Pose | None = None
        """Pose at which it is drawn; None if it is not."""
        self._drag: Drag | None = None
        self._dragged: Pose | None = None

    def draw(self, snapshot: Snapshot, told: Elsewhere | None) -> None:
        """Draw the stand-in of an agent and its action, or nothing."""
        static_scene = snapshot.static_scene
        name = next((a.body for a in snapshot.agents if told and a.id == told.agent), "")
        body = next((each for each in static_scene.bodies if each.name == name), None)
        if told is None or body is None:
            self._clear()
            return
        pose = self._dragged or told.pose
        drawn = told, pose, static_scene
        if drawn == self._drawn:
            return
        self._drawn = drawn
        with self._client.client.atomic():
            if self._built != (body, static_scene):
                self._build(body, static_scene)
            self.pose = pose
            ground = static_scene.floor_under(pose.x, pose.y)
            z = static_scene.lowest_floor if ground is None else ground
            layers = Layers.of(static_scene)
            if self._frame is not None:
                self._frame.position = (pose.x, pose.y, z + layers.body)
                self._frame.wxyz = heading_wxyz(pose.heading)
            top = z + body.height + 2 * layers.body
            self._arrows.draw(_arrow_of(told, pose, body), np.array([top]), layers)

    def _clear(self) -> None:
        if self.pose is not None:
            self._subtree.remove()
            self._arrows.clear()
            self._built = self._drawn = self._frame = self.body = self.knob = self.pose = None
            self._drag = self._dragged = None

    def _build(self, body: BodyDescription, static_scene: StaticScene) -> None:
        unit = arena_size(static_scene)
        outline = np.asarray(body.shape.outline())
        reach = float(outline[:, 0].max())
        with self._subtree.rebuild() as parent:
            node = f"{parent}/frame"
            self._frame = self._scene.add_frame(node, show_axes=False)
            edge = segments(grow(outline, OUTLINE_MARGIN * unit), body.height)
            far = reach + KNOB_DISTANCE * unit
            bar = np.array([[(reach, 0.0, body.height), (far, 0.0, body.height)]])
            self._scene.add_line_segments(
                f"{node}/edge",
                np.concatenate([edge, bar]).astype(np.float32),
                line_colours(INK),
                thickness=3.0,
                thickness_units="screen",
            )
            drawer = MeshDrawer(self._scene, node)
            self.body = drawer.batch(
                "body", prism(outline, body.height, 0.0), [INK], opacity=BODY_OPACITY
            )
            radius = KNOB_RADIUS * unit
            self.knob = drawer.batch("knob", prism(circle(radius, corners=24), radius, 0.0), [INK])
            self.knob.batched_positions = np.array([(far, 0.0, body.height)], np.float32)
            for handle, action in ((self.body, DragAction.MOVE), (self.knob, DragAction.TURN)):
                handle.batched_scales = np.ones(1, np.float32)
                on_drag = report_errors(self._on_drag(action))
                handle.on_drag(on_drag)
                handle.on_drag("left", modifier=FREE_MODIFIER)(on_drag)
        self._built = body, static_scene

    def _on_drag(self, action: DragAction) -> Callable[[SceneNodeDragEvent[Any]], Any]:
        async def on_drag(event: SceneNodeDragEvent[Any]) -> None:
            pose, built = self.pose, self._built
            if event.phase == "start" and pose is not None and built is not None:
                x, y, _ = event.start_position
                moves = action is DragAction.MOVE
                dx, dy = (pose.x - x, pose.y - y) if moves else (pose.x, pose.y)
                self._drag = Drag(built[0], action, dx, dy)
            self._follow(event)

        return on_drag

    def _follow(self, event: SceneNodeDragEvent[Any]) -> None:
        drag, pose = self._drag, self._dragged or self.pose
        if drag is None or pose is None:
            return
        x, y, _ = event.end_position
        goal = drag.goal(x, y, is_free=event.modifier == FREE_MODIFIER)
        if goal is not None:
            turned = pose.heading if goal.heading_deg is None else math.radians(goal.heading_deg)
            pose = Pose(goal.x, goal.y, turned)
        is_over = event.phase == "end"
        choice = choice_of(self._client)
        if is_over and choice.elsewhere is not None:
            elsewhere = choice.elsewhere._replace(pose=pose)
            self._client.choices[OPTION] = choice._replace(elsewhere=elsewhere)
        self._dragged = None if is_over else pose
        self._drag = None if is_over else drag
        if self._client.panel is not None:
            degrees = round(math.degrees(pose.heading), 1)
            message = {"type": "stand_in", "x": pose.x, "y": pose.y, "heading_deg": degrees}
            self._client.panel.send(message)


def _arrow_of(told: Elsewhere, pose: Pose, body: BodyDescription) -> LiveMap:
    """Return the action of a stand-in as a field of one place; nothing while it is dragged away."""
    length = ARROW_SHARE * body.shape.reach
    moves = np.array([told.move if told.pose == pose else (math.nan,) * 3], np.float64)
    request = MapRequest(told.agent, "field")
    return replace(
        LiveMap(request), poses=np.array([pose]), cell=(length, length), moves=moves, done=1
    )
