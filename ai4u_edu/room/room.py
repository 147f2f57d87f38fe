"""Construction of a room from its settings, its start and its end."""

from collections.abc import Callable
from contextlib import ExitStack
from typing import Self

from ai4u_edu.member import ClassMember
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.editing.autosave import Autosave, unsaved_scenes
from ai4u_edu.page.editing.scene_store import SceneStore
from ai4u_edu.page.editing.sharing import SharedScene, read_shared
from ai4u_edu.page.editing.unsaved import Unsaved, choose_unsaved
from ai4u_edu.page.server.scripts import ScriptReport
from ai4u_edu.recording import Episode, Ghosts, Recorder
from ai4u_edu.room.served_world import ServedWorld, serve_world
from ai4u_edu.room.settings import RoomSettings
from ai4u_edu.runtime.frame_budget import FrameBudget
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.scene_link import is_link


class Room:
    """A world, the threads that run and draw it, and the app that serves its page and API.

    ``with Room(settings) as room: serve(room.page.app, ...)``

    Args:
        settings: of the room.
        warn: called with a sentence when something goes wrong later, in any thread.
        tell: called with a line when something happens with a script, in a thread; default:
            nothing is reported.

    Raises:
        AI4UError: the scene or a file can't be used; the message says why.
    """

    def __init__(
        self,
        settings: RoomSettings,
        warn: Callable[[str], object] = lambda _: None,
        tell: Callable[[str], object] | None = None,
    ) -> None:
        self.unsaved = unsaved_scenes(settings.unsaved) if settings.unsaved else []
        restored = _restored(settings, self.unsaved)
        scene, linked_seed = _scene_of(settings, restored)
        self.title = scene.description.title or scene.description.name
        sim, scene = settings.build(scene)
        recorder = Recorder.into(settings.record, sim, scene, settings.keep)
        ghost = Episode.load(settings.ghost) if settings.ghost else None
        self.runner = Runner(
            sim,
            seed=_first_seed(settings, ghost, linked_seed),
            time_scale=settings.time_scale,
            recorder=recorder,
            wait_for_key=settings.wait_for_key,
            frame_budget=FrameBudget(settings.frames_per_s, settings.min_frames_per_s),
        )
        self._autosave = None
        if settings.unsaved is not None and settings.autosave:
            self._autosave = Autosave(settings.unsaved, scene.description.name, warn)
        self.editor = SceneEditor(self.runner, scene, offers=[*settings.offers])
        self.editor.recovery.autosave = self._autosave
        self.editor.work_folder = settings.work
        self.editor.missions_folder = settings.missions_folder
        if settings.saved_scenes is not None:
            self.editor.scene_store = SceneStore(settings.saved_scenes)
        if restored is not None:
            self.editor.recovery.mark_restored(restored)
        elif self.unsaved:
            self.editor.recovery.unsaved = self.unsaved[0]
        self._settings = settings
        self._ghosts = Ghosts()
        if ghost is not None and settings.ghost is not None:
            self._ghosts.race(ghost, settings.ghost.name)
        self.class_member = None
        if settings.class_link is not None:
            self.class_member = ClassMember(
                self.runner,
                self.editor,
                settings.class_link,
                settings.class_folder,
                show_ghosts=self._ghosts.race_all,
            )
            if settings.learns_in_class:
                self.editor.class_trainings = self.class_member.trainings
        self._script_report = None if tell is None else ScriptReport(self.runner, tell)
        self._page: ServedWorld | None = None
        self._ending = ExitStack()

    @property
    def page(self) -> ServedWorld:
        """The page, which is there while the room has been entered."""
        if self._page is None:
            raise RuntimeError("expected a room that has been entered; use it in a with statement")
        return self._page

    def __enter__(self) -> Self:
        if self._script_report is not None:
            self._ending.enter_context(self._script_report)
        settings = self._settings
        self._page = page = serve_world(
            self.runner,
            title=self.title,
            editor=self.editor,
            port=None,
            rules=settings.rules,
            ghosts=self._ghosts,
            allowed_hosts=settings.allowed_hosts,
            proxy_hosts=settings.proxy_hosts,
            viser_secret=settings.viser_secret,
            missions=settings.missions,
            class_feed=None if self.class_member is None else self.class_member.view,
            script_report=self._script_report,
        )
        # the last one first: the runner may yet change what is saved
        self._ending.callback(page.stop)
        if self._autosave is not None:
            self._ending.callback(self._autosave.stop)
        self.runner.start()
        self._ending.callback(self.runner.stop)
        if self.class_member is not None:
            self.class_member.start()
            self._ending.callback(self.class_member.stop)
        return self

    def __exit__(self, *_: object) -> None:
        self._ending.close()


def _restored(settings: RoomSettings, unsaved: list[Unsaved]) -> Unsaved | None:
    if not settings.restore:
        return None
    return choose_unsaved(unsaved, settings.scene if settings.is_scene_named else "")


def _scene_of(settings: RoomSettings, restored: Unsaved | None) -> SharedScene:
    """Return the scene to serve, and the seed that comes with it in a link."""
    if restored is not None:
        return SharedScene(restored.scene(), None)
    if is_link(settings.scene):
        return read_shared(settings.scene)
    return SharedScene(Scene.load(settings.scene), None)


def _first_seed(settings: RoomSettings, ghost: Episode | None, linked: int | None) -> int | None:
    if settings.seed is not None:
        return settings.seed
    return linked if ghost is None else ghost.seed
