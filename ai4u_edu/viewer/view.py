"""One page's view of the arena: the whole of it, or an agent that is followed."""

import math
import time

import numpy as np
from viser import CameraHandle, ClientHandle

from ai4u_edu.snapshot import BodyState, Snapshot
from ai4u_edu.viewer.framing import FIELD_OF_VIEW, Bounds, Frame, centred, frame, visible_height
from ai4u_edu.viewer.geometry import Array
from ai4u_edu.viewer.placing import seen_bounds

FOLLOWED = 22.0
"""A window in which an agent is followed is so many times as high as the agent's radius."""
LAG = 0.18
"""How long (s) the camera takes to catch up with most of an agent's lead."""


class View:
    """The camera of one page. Once a person has moved it, it is theirs.

    Args:
        client: the page.
    """

    def __init__(self, client: ClientHandle) -> None:
        self._client = client
        self._bounds: Bounds | None = None
        self._aspect = 0.0
        self._frame = Frame(0.0, 0.0, 1.0)
        self._has_arrived = False
        self._is_theirs = False
        self._followed = ""
        self._begins = False
        self._moved_at = 0.0
        client.camera.on_update(self._on_report)

    def show_all(self) -> None:
        """Shows the whole arena, from the next update on."""
        self._followed, self._bounds = "", None

    def follow_next(self, names: list[str]) -> None:
        """Follows the body that comes after the one that is followed, from the next update on."""
        place = names.index(self._followed) + 1 if self._followed in names else 0
        self._followed, self._begins = names[place % len(names)], True

    def update(self, snapshot: Snapshot) -> None:
        """Moves the camera, if there is a reason to."""
        camera, bounds = self._client.camera, seen_bounds(snapshot.stage)
        aspect = camera.image_width / max(camera.image_height, 1)
        followed = [body for body in snapshot.bodies if body.name == self._followed]
        if followed and self._begins:
            self._begins = False
            (reach,) = (b.shape.reach for b in snapshot.stage.bodies if b.name == self._followed)
            height = min(frame(bounds, aspect).height, FOLLOWED * reach)
            self._put(centred(followed[0].x, followed[0].y, height, aspect))
        elif followed:
            self._follow(followed[0], aspect)
        else:
            reshaped = abs(aspect - self._aspect) > 0.02 * self._aspect and not self._is_theirs
            if bounds != self._bounds or reshaped:
                self._bounds, self._aspect = bounds, aspect
                self._put(frame(bounds, aspect))

    async def _on_report(self, camera: CameraHandle) -> None:
        """Finds out from what the page reports whether a person has moved the camera.

        Until a pose that we sent has come back, the page may still speak of an older one.
        """
        ours = np.array([self._frame.x, self._frame.y, self._frame.distance])
        if np.allclose(camera.position, ours, rtol=1e-3, atol=1e-2):
            self._has_arrived = True
        elif self._has_arrived:
            self._is_theirs = True

    def _put(self, wanted: Frame) -> None:
        camera, distance = self._client.camera, wanted.distance
        self._frame, self._has_arrived, self._is_theirs = wanted, False, False
        self._moved_at = time.monotonic()
        with self._client.atomic():
            camera.up_direction = (0.0, 1.0, 0.0)
            camera.position = (wanted.x, wanted.y, distance)
            camera.look_at = (wanted.x, wanted.y, 0.0)
            camera.fov = FIELD_OF_VIEW
            camera.near, camera.far = wanted.near, wanted.far
            camera.min_orbit_distance, camera.max_orbit_distance = distance / 12, distance * 4

    def _follow(self, body: BodyState, aspect: float) -> None:
        camera, now = self._client.camera, time.monotonic()
        # from how far and from which side is the person's choice
        offset: Array = camera.position - camera.look_at
        goal = centred(body.x, body.y, visible_height(float(np.linalg.norm(offset))), aspect)
        share = 1.0 - math.exp((self._moved_at - now) / LAG)
        dx, dy = share * (goal.x - self._frame.x), share * (goal.y - self._frame.y)
        self._moved_at = now
        if math.hypot(dx, dy) < 1e-4 * goal.height:
            return
        self._frame = Frame(self._frame.x + dx, self._frame.y + dy, goal.height)
        centre = np.array([self._frame.x, self._frame.y, 0.0])
        with self._client.atomic():
            camera.position = centre + offset
            camera.look_at = centre
