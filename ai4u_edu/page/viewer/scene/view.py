"""One page's camera: over the whole arena, before it and tilted, over an agent, or in its eye."""

import math
import time
from collections import deque
from collections.abc import Callable
from enum import StrEnum

import numpy as np
from viser import CameraHandle, ClientHandle, InitialCameraConfig, SceneApi

from ai4u_edu.page.viewer.scene.arena import arena_size, camera_bounds
from ai4u_edu.page.viewer.scene.framing import (
    FIELD_OF_VIEW_RAD,
    TILTED_FIELD_OF_VIEW_RAD,
    Bounds,
    Frame,
    frame_arena,
    frame_point,
    frame_tilted,
    visible_height,
)
from ai4u_edu.page.viewer.scene.geometry import Array
from ai4u_edu.page.viewer.scene.ground import add_void
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.snapshot import AgentState, BodyState, Snapshot, StaticScene
from ai4u_edu.snapshot.theme import Rgb

_EYE_FIELD_OF_VIEW_RAD = math.radians(65)
"""Vertical field of view."""
_EYE_NEAR_M = 0.05
"""Near clipping distance."""
_EYE_FAR_IN_ARENAS = 12.0
"""Far clipping distance, as a multiple of the arena's size."""
_DOWNWARD_SLOPE = 0.12
"""Slope at which the eye looks down: metres down for each metre ahead."""

_SKY = np.linspace((132, 170, 206), (226, 235, 242), 64).astype(np.uint8)[:, None]
"""Background image, 64 x 1 pixels, bluest on top."""
_SIDE_LIGHTS = (((1.0, 0.55, 0.0), 2.6), ((-1.0, -0.55, 0.0), 1.6), ((-0.55, 1.0, 0.0), 2.0))
"""Horizontal lights as (direction, intensity): they light walls, which the light from above does
not, and add nothing to surfaces that face up."""

_HAZE: Rgb = (150, 170, 190)
"""Colour of the sky behind a tilted arena, into which the void fades far away."""
_HAZE_NEAR, _HAZE_FAR = 1.4, 4.0
"""Distances at which the void begins to fade and has faded, in distances of the target."""

_Position = tuple[float, float, float]


class _Daylight:
    """A sky and side lights, on one page, while its camera is in an agent's eye.

    Args:
        scene: viser's scene of the page.
        static_scene: the world.
    """

    def __init__(self, scene: SceneApi, static_scene: StaticScene) -> None:
        self._scene = scene
        scene.set_background_image(_SKY, format="png")
        self._lights = [
            scene.add_light_directional(
                f"/daylight/{number}", intensity=intensity, position=position
            )
            for number, (position, intensity) in enumerate(_SIDE_LIGHTS)
        ]
        self._void = add_void(scene, static_scene)

    def remove(self) -> None:
        """Remove the sky, the lights and the ground."""
        if self._void is not None:
            self._void.remove()
        self._scene.set_background_image(None)
        for light in self._lights:
            light.remove()


class _Haze:
    """A sky on one page into which what is far away fades, while its camera is tilted.

    Args:
        scene: viser's scene of the page.
        static_scene: the world.
        distance: of the camera from its target (m).
    """

    def __init__(self, scene: SceneApi, static_scene: StaticScene, distance: float) -> None:
        self._scene = scene
        scene.set_background_image(np.array([[_HAZE]], np.uint8), format="png")
        scene.configure_fog(_HAZE_NEAR * distance, _HAZE_FAR * distance, color=_HAZE)
        self._void = add_void(scene, static_scene)

    def remove(self) -> None:
        """Remove the sky, the fading and the ground."""
        if self._void is not None:
            self._void.remove()
        self._scene.set_background_image(None)
        self._scene.configure_fog(1.0, 2.0, enabled=False)


def _limit_orbit(camera: CameraHandle, least: float, most: float) -> None:
    """Limit the distance (m) to which a user may move the camera from what it looks at."""
    if least > camera.max_orbit_distance:  # viser takes no range that is empty, not even for now
        camera.max_orbit_distance = most
    camera.min_orbit_distance = least
    camera.max_orbit_distance = most


def _eye_pose(
    static_scene: StaticScene, agent: AgentState, body: BodyState
) -> tuple[_Position, _Position]:
    """Return the eye's position and a point about 1 m ahead of it; world frame, metres.

    The eye is that of the agent's first ray sensor, else a point near the top of its body.
    """
    eyes = [sensor.eye for sensor in agent.sensor_infos if sensor.eye is not None]
    forward, left, up = eyes[0] if eyes else _default_eye(static_scene, body)
    cos, sin = math.cos(body.heading), math.sin(body.heading)
    x, y = body.x + cos * forward - sin * left, body.y + sin * forward + cos * left
    z = body.z + Layers.of(static_scene).body + up  # bodies are drawn that much higher
    return (x, y, z), (x + cos, y + sin, z - _DOWNWARD_SLOPE)


def _default_eye(static_scene: StaticScene, body: BodyState) -> _Position:
    (height,) = (each.height for each in static_scene.bodies if each.name == body.name)
    return 0.0, 0.0, 0.8 * height


FOLLOW_HEIGHT_IN_RADII = 22.0
"""Height of the window that follows an agent, as a multiple of the agent's radius."""
CAMERA_LAG_S = 0.18
"""Time constant with which the camera follows an agent."""


NORTH = (0.0, 1.0, 0.0)


class Mode(StrEnum):
    """_Position of a page's camera, by the name that a page sends."""

    ARENA = "arena"
    """Over the whole arena."""
    TILTED = "tilted"
    """Before the whole arena and above it, with perspective."""
    FOLLOW = "follow"
    """Over the agent that the page shows."""
    TURN = "turn"
    """Over the agent, and turning with it: ahead is up."""
    EYES = "eyes"
    """In the agent's eye."""


class Opening(StrEnum):
    """State of the tilt with which a page opens."""

    NONE = "none"
    """It has not been asked for."""
    RUNNING = "running"
    ENDING = "ending"
    """The user did something: the camera goes back with the next update."""
    OVER = "over"
    """The camera is back where it is else."""


ZOOM, TILTED_ZOOM = (12.0, 4.0), (8.0, 3.0)
"""Factors by which a user may go nearer and farther than the camera begins, from above and tilted;
``near`` and ``far`` of the frame have to reach as far."""
OPENING_S = 1.8
"""Duration of the tilt."""
OPENING_TILT_RAD = math.radians(42)
"""Largest angle of the tilt, in its middle."""


class View:
    """The camera of one page. Once a user has moved it, it is no longer moved for another window.

    viser's event loop alone calls :meth:`update` and moves the camera: viser leaves out what equals
    the page's latest report, so none may come in the middle. Other threads say what is wanted:
    :meth:`choose`, :meth:`open` and :meth:`end_opening` only set a value.

    Args:
        client: the page.
        initial_camera: of new pages.
        clock: seconds; to be replaced in tests.
    """

    def __init__(
        self,
        client: ClientHandle,
        initial_camera: InitialCameraConfig,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._client = client
        self._initial_camera = initial_camera
        self._clock = clock
        self.mode = Mode.ARENA
        self.opening = Opening.NONE
        """State of the opening; only an update makes it ``OVER``."""
        self._opened_at = math.nan
        self._bounds: Bounds | None = None
        self._aspect = 0.0
        self.frame = Frame(0.0, 0.0, 1.0)
        self._known: deque[Array] = deque(maxlen=4)
        self._has_arrived = False
        self._is_moved_by_user = False
        self._followed = ""
        self._sky: _Daylight | _Haze | None = None
        self._sent: Array = np.zeros(3)
        """Place where the camera was put last."""
        self._moved_at = 0.0
        client.camera.on_update(self._on_report)

    def choose(self, mode: Mode) -> None:
        """Choose the camera's position, from the next update on."""
        self.mode, self._followed, self._bounds = mode, "", None

    def open(self) -> None:
        """Tilt the camera over the arena for a moment, once, from the next update on."""
        if self.opening is Opening.NONE:
            self.opening = Opening.RUNNING

    def end_opening(self) -> None:
        """End the tilt with the next update."""
        if self.opening in (Opening.NONE, Opening.RUNNING):
            self.opening = Opening.ENDING

    @property
    def is_opening(self) -> bool:
        """True while updates move the camera, whatever the world does."""
        return self.opening in (Opening.RUNNING, Opening.ENDING)

    def update(self, snapshot: Snapshot, agent_id: str) -> None:
        """Move the camera, if the mode, the arena, the agent or the window asks for it.

        Args:
            snapshot: what is shown.
            agent_id: of the agent that the page shows.
        """
        agent = next((each for each in snapshot.agents if each.id == agent_id), None)
        if self.is_opening:
            self._go_on_opening(snapshot)
            if self.is_opening:
                return
        if self.mode in (Mode.ARENA, Mode.TILTED) or agent is None:
            self._show_all(snapshot)
            return
        (body,) = (each for each in snapshot.bodies if each.name == agent.body)
        is_new, self._followed = agent.body != self._followed, agent.body
        if self.mode is Mode.EYES:
            self._look_out(snapshot, agent, body, is_new=is_new)
        elif is_new:
            self._begin(snapshot, body)
        else:
            self._follow(body, aspect_of(self._client.camera))

    def _show_all(self, snapshot: Snapshot) -> None:
        bounds, aspect = camera_bounds(snapshot.static_scene), aspect_of(self._client.camera)
        reshaped = abs(aspect - self._aspect) > 0.02 * self._aspect and not self._is_moved_by_user
        if bounds != self._bounds or reshaped:
            self._bounds, self._aspect = bounds, aspect
            if self.mode is Mode.TILTED:
                self._tilt(snapshot.static_scene, bounds, aspect)
            else:
                self._put(frame_arena(bounds, aspect))

    def _go_on_opening(self, snapshot: Snapshot) -> None:
        """Tilt the camera over the arena with time, or end that."""
        now = self._clock()
        if math.isnan(self._opened_at):
            self._opened_at = now
        share = (now - self._opened_at) / OPENING_S
        if self.opening is Opening.ENDING or share >= 1.0 or self.mode is not Mode.ARENA:
            # the event loop may have set another mode or ENDING meanwhile: both lead here again
            self.opening, self._bounds = Opening.OVER, None
            return
        self._show_all(snapshot)
        camera, distance = self._client.camera, self.frame.distance
        tilt = OPENING_TILT_RAD * math.sin(math.pi * share) ** 2
        south, up = distance * math.sin(tilt), distance * math.cos(tilt)
        position = (self.frame.x, self.frame.y - south, up)
        self._note_sent(position)
        with self._client.atomic():
            camera.position = position
            camera.look_at = (self.frame.x, self.frame.y, 0.0)

    def _tilt(self, static_scene: StaticScene, bounds: Bounds, aspect: float) -> None:
        """Put the camera before the arena, tilted."""
        camera, frame = self._client.camera, frame_tilted(bounds, aspect)
        self._note_sent(frame.position)
        with self._client.atomic():
            self._clear_sky()
            self._sky = _Haze(self._client.scene, static_scene, frame.distance)
            camera.up_direction = (0.0, 0.0, 1.0)
            camera.position = frame.position
            camera.look_at = frame.target
            camera.fov = TILTED_FIELD_OF_VIEW_RAD
            camera.near, camera.far = frame.distance / 40, frame.distance * 16
            zoom_in, zoom_out = TILTED_ZOOM
            _limit_orbit(camera, frame.distance / zoom_in, frame.distance * zoom_out)

    def _note_sent(self, position: _Position) -> None:
        """Note that the camera is put somewhere, for it to be told from where a user puts it."""
        self._known.append(self._client.camera.position)
        self._sent = np.array(position)
        self._has_arrived = self._is_moved_by_user = False

    def _begin(self, snapshot: Snapshot, body: BodyState) -> None:
        aspect = aspect_of(self._client.camera)
        (reach,) = (b.shape.reach for b in snapshot.static_scene.bodies if b.name == body.name)
        whole = frame_arena(camera_bounds(snapshot.static_scene), aspect).height
        height = min(whole, FOLLOW_HEIGHT_IN_RADII * reach)
        self._put(frame_point(body.x, body.y, height, aspect), self._up(body))

    def _look_out(
        self, snapshot: Snapshot, agent: AgentState, body: BodyState, *, is_new: bool
    ) -> None:
        """Put the camera in the agent's eye."""
        camera = self._client.camera
        place, ahead = _eye_pose(snapshot.static_scene, agent, body)
        with self._client.atomic():
            if is_new:
                self._clear_sky()
                self._sky = _Daylight(self._client.scene, snapshot.static_scene)
                _limit_orbit(camera, 0.01, 100.0)
                camera.up_direction = (0.0, 0.0, 1.0)
                camera.fov = _EYE_FIELD_OF_VIEW_RAD
                camera.near, camera.far = (
                    _EYE_NEAR_M,
                    _EYE_FAR_IN_ARENAS * arena_size(snapshot.static_scene),
                )
            camera.position = place
            camera.look_at = ahead

    def _up(self, body: BodyState) -> tuple[float, float, float]:
        """Return the direction that is up on the screen."""
        if self.mode is not Mode.TURN:
            return NORTH
        return math.cos(body.heading), math.sin(body.heading), 0.0

    async def _on_report(self, camera: CameraHandle) -> None:
        """Find out from a page's report whether its user has moved the camera.

        A slow page may report an older position: until a pose that we sent has come back and, since
        a report may be read while we move the camera, for a while after that.
        """
        if _same(camera.position, self._sent):
            self._has_arrived = True
        elif _same(camera.position, self._initial_camera.position):
            # a slow browser puts its camera there after what we sent: it is sent again
            self._bounds = None
        elif self._has_arrived and not any(_same(camera.position, each) for each in self._known):
            self._is_moved_by_user = True

    def _clear_sky(self) -> None:
        if self._sky is not None:
            self._sky.remove()
            self._sky = None

    def _put(self, wanted: Frame, up: tuple[float, float, float] = NORTH) -> None:
        camera, distance = self._client.camera, wanted.distance
        self._note_sent((wanted.x, wanted.y, distance))
        self.frame = wanted
        self._moved_at = self._clock()
        with self._client.atomic():
            self._clear_sky()
            camera.up_direction = up
            camera.position = (wanted.x, wanted.y, distance)
            camera.look_at = (wanted.x, wanted.y, 0.0)
            camera.fov = FIELD_OF_VIEW_RAD
            camera.near, camera.far = wanted.near, wanted.far
            zoom_in, zoom_out = ZOOM
            _limit_orbit(camera, distance / zoom_in, distance * zoom_out)

    def _follow(self, body: BodyState, aspect: float) -> None:
        camera, now, up = self._client.camera, self._clock(), self._up(body)
        # distance and side are the user's choice
        offset: Array = camera.position - camera.look_at
        goal = frame_point(body.x, body.y, visible_height(float(np.linalg.norm(offset))), aspect)
        if self.mode is Mode.TURN:
            # the overlay covers the lower part of the window: there is what is behind the agent
            short = goal.y - body.y
            goal = Frame(body.x + short * up[0], body.y + short * up[1], goal.height)
        share = 1.0 - math.exp((self._moved_at - now) / CAMERA_LAG_S)
        dx, dy = share * (goal.x - self.frame.x), share * (goal.y - self.frame.y)
        self._moved_at = now
        stands = math.hypot(dx, dy) < 1e-4 * goal.height
        if stands and np.allclose(camera.up_direction, up, atol=1e-4):
            return
        self.frame = Frame(self.frame.x + dx, self.frame.y + dy, goal.height)
        centre = np.array([self.frame.x, self.frame.y, 0.0])
        self._sent = centre + offset
        with self._client.atomic():
            if self.mode is Mode.TURN:
                camera.up_direction = up
            camera.position = centre + offset
            camera.look_at = centre


def aspect_of(camera: CameraHandle) -> float:
    """Return a window's width / height; a window that is minimized reports 0 for both."""
    return max(camera.image_width, 1) / max(camera.image_height, 1)


def _same(place: Array, other: Array) -> bool:
    return bool(np.allclose(place, other, rtol=1e-3, atol=1e-2))
