"""Settings of a room."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.limits import DEFAULT_KEPT_EPISODES
from ai4u_edu.member import ClassLinkSettings
from ai4u_edu.page.server import Rules
from ai4u_edu.page.server.host_origin import LOOPBACK
from ai4u_edu.page.server.start_page import MissionsView
from ai4u_edu.page.server.viser_lockdown import PROXY_SECRET
from ai4u_edu.runtime.frame_budget import MAX_FRAMES_PER_S, MIN_FRAMES_PER_S
from ai4u_edu.scenes import Scene


def build_scene(scene: Scene) -> tuple[ControlRequestor, Scene]:
    """Return a scene's world with the agents' own brains, and the scene as it is."""
    return scene.build(), scene


@dataclass(frozen=True, kw_only=True)
class RoomSettings:
    """Settings of a room; most are options of ``ai4u-edu play`` of the same name."""

    scene: str
    """Name in the library, path of a file, or link."""
    is_scene_named: bool = True
    """False if the scene is only the default."""
    seed: int | None = None
    time_scale: float | None = None
    wait_for_key: bool = True
    frames_per_s: float = MAX_FRAMES_PER_S
    """Most pictures a second of each page."""
    min_frames_per_s: float = MIN_FRAMES_PER_S
    """Pictures a second of each page if ticks are late."""
    allowed_hosts: tuple[str, ...] = LOOPBACK
    proxy_hosts: tuple[str, ...] = ()
    rules: Rules = field(default_factory=Rules)
    viser_secret: str = PROXY_SECRET
    """Secret of the room's viser; only a proxy may know it."""
    build: Callable[[Scene], tuple[ControlRequestor, Scene]] = build_scene
    """Builds the scene's world, and returns the scene as its agents are used to observe it."""
    missions: Callable[[], MissionsView] = MissionsView
    """Returns the missions that the start page shows."""
    missions_folder: Path | None = None
    """Folder with a teacher's missions; None for none."""
    record: Path | None = None
    keep: int = DEFAULT_KEPT_EPISODES
    ghost: Path | None = None
    offers: tuple[str, ...] = ()
    saved_scenes: Path | None = None
    restore: bool = False
    unsaved: Path | None = None
    """Folder of scenes that were changed and not saved; None neither writes nor offers them."""
    autosave: bool = True
    """False only offers unsaved scenes, and writes none."""
    work: Path | None = None
    """Folder for a person's drives and networks; None keeps none."""
    class_link: ClassLinkSettings | None = None
    """Link to the class that the room belongs to; None for none."""
    class_folder: Path | None = None
    """Folder, which exists, for what the class must not lose: the last assignment, and results that
    were not delivered."""
