"""Scenes that a class gives to a world, and what becomes of the student's own one."""

import hashlib
import json
import re
from collections.abc import Callable
from concurrent.futures import Future
from pathlib import Path
from typing import Any

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import AI4UError, SceneError, SetupError, shorten, text_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.editing.scene_pictures import load_by_name
from ai4u_edu.page.editing.scene_store import SceneExistsError, SceneStore
from ai4u_edu.recording.scene_export import export_scene, without_brains
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import Scene, SceneDescription
from ai4u_edu.wire.class_link import Applied, Assignment, race_assignment
from ai4u_edu.wire.validation import MAX_TEXT_CHARS

MEMORY = "class.json"
"""File with ids of the last assignment and race, and a hash of the scene that the class gave."""
OPEN_TIMEOUT_S = 30.0
"""Usual time that the world has to open a scene; a block that does not return may keep it from
that."""
REMEMBER_DELAY_S = 1.5
"""Time after which an assignment is remembered: the scene is on disk by then. A process that is
killed before opens it again."""
MAX_SCENES_OF_A_NAME = 100
MAX_TITLE_CHARS = 48


class AssignedScenes:
    """Opens scenes of the class, each assignment once. One thread calls it.

    A scene that the student changed is saved first, under a name that is free.

    Args:
        runner: runs the world.
        editor: of the world; None if it can't open scenes.
        folder: of the room, which exists; without it nothing is remembered beyond this process.
        clock: seconds.
        open_timeout: time (s) that the world has to open a scene.
    """

    def __init__(
        self,
        runner: Runner,
        editor: SceneEditor | None,
        folder: Path | None,
        clock: Callable[[], float],
        open_timeout: float = OPEN_TIMEOUT_S,
    ) -> None:
        self._runner, self._editor, self._folder = runner, editor, folder
        self._clock, self._open_timeout = clock, open_timeout
        memory = _read(folder / MEMORY) if folder is not None else {}
        self._last = str(memory.get("assignment", ""))
        self._given = str(memory.get("given", ""))
        self._race = str(memory.get("race", ""))
        self._remember_at: float | None = None
        if not self._given and editor is not None:
            self._given = _fingerprint(editor.state.description)
            self._remember()

    def apply(self, assignment: Assignment) -> Applied:
        """Open an assignment's scene unless that was done before; return the answer."""
        if assignment.id in (self._last, race_assignment(self._race)):
            return Applied(assignment.id)
        try:
            if assignment.scene:
                self.open(assignment.scene, assignment.seed)
        except AI4UError as error:
            return Applied(assignment.id, shorten(text_of(error), MAX_TEXT_CHARS))
        self._last = assignment.id
        return Applied(assignment.id)

    def open(self, source: str, seed: int | None) -> None:
        """Save the student's own scene, and run another one.

        Args:
            source: name in the library, or YAML, which contains a line break.
            seed: of the first episode; None for a new one.

        Raises:
            AI4UError: it can't be opened, or the present one can't be saved; then that one goes on.
        """
        editor = self._editor
        if editor is None:
            raise SetupError(_("this world can't open another scene; it was shown without one"))
        scene = self._read(source)
        self._save_own(editor)
        self._result(editor.open(scene))
        if seed is not None:
            self._result(self._runner.reset(seed))
        self._given = _fingerprint(scene.description)
        self._remember_at = self._clock() + REMEMBER_DELAY_S

    def open_race(self, race: str, source: str, seed: int) -> list[Any]:
        """Open a race's scene, unless this room or its process before has done so for this race.

        Args:
            race: id of the race.
            source: as for :meth:`open`.
            seed: of the race.

        Returns:
            The scene's parts that determine an episode.

        Raises:
            AI4UError: as :meth:`open`.
        """
        if self._race != race:
            self.open(source, seed)
            self._race = race
        return without_brains(export_scene(self._read(source).build()))

    def _read(self, source: str) -> Scene:
        if self._editor is not None and "\n" in source:
            return self._editor.read(source, "scene")
        return _named(source)

    def poll(self) -> None:
        """Write the state to remember, when it is time."""
        if self._remember_at is not None and self._clock() >= self._remember_at:
            self._remember()

    def stop(self) -> None:
        """Write the state to remember."""
        if self._remember_at is not None:
            self._remember()

    def _result(self, future: "Future[Any]") -> None:
        try:
            future.result(self._open_timeout)
        except TimeoutError:
            future.cancel()
            raise SetupError(
                _("the world does not answer: some block does not return; restart the world")
            ) from None
        except AI4UError:
            raise
        except Exception as error:  # a block's own
            raise SetupError(f"{type(error).__name__}: {error}") from error

    def _save_own(self, editor: SceneEditor) -> None:
        """Save the present scene if it is neither the class's nor the library's.

        Raises:
            SetupError: it can't be saved.
        """
        scene = editor.scene
        if _fingerprint(scene.description) == self._given or _is_in_library(scene.description):
            return
        store = editor.scene_store
        if store is None and self._folder is not None:
            store = SceneStore(self._folder / "scenes")
        if store is None:
            return  # undo brings it back
        words = " ".join(re.sub(r"[^\w -]+", " ", editor.title).replace("_", " ").split())
        base = f"My {words[:MAX_TITLE_CHARS]}".strip(" -")
        for number in range(1, MAX_SCENES_OF_A_NAME):
            name = base if number == 1 else f"{base} {number}"
            try:
                store.save(name, scene)
            except SceneExistsError:
                if _has(store, name, scene):
                    return
            except SetupError as error:
                raise SetupError(
                    _("the present scene can't be saved: {problem}", problem=text_of(error))
                ) from None
            else:
                return
        raise SetupError(
            _(
                "the present scene can't be saved: expected fewer than {most} scenes named "
                "{base!r}; delete some",
                most=MAX_SCENES_OF_A_NAME,
                base=base,
            )
        )

    def _remember(self) -> None:
        self._remember_at = None
        if self._folder is None:
            return
        memory = {"assignment": self._last, "given": self._given, "race": self._race}
        try:
            write_atomically(self._folder / MEMORY, json.dumps(memory))
        except OSError:  # such as a full disk: the assignment is opened again after a restart
            return


def scene_name_of(assignment: Assignment) -> str:
    """Return the name of an assignment's scene; empty if there is none, or it can't be read."""
    if "\n" not in assignment.scene:
        return assignment.scene
    try:
        return Scene.loads(assignment.scene).description.name
    except AI4UError:
        return ""


def _named(name: str) -> Scene:
    scene = load_by_name(name)
    if scene is None:
        raise SceneError(_("the library has no scene {name!r}; choose another one", name=name[:60]))
    return scene


def _is_in_library(description: SceneDescription) -> bool:
    scene = load_by_name(description.name)
    return scene is not None and _fingerprint(scene.description) == _fingerprint(description)


def _has(store: SceneStore, name: str, scene: Scene) -> bool:
    try:
        return _fingerprint(store.load(name).description) == _fingerprint(scene.description)
    except (AI4UError, OSError):
        return False


def _fingerprint(description: SceneDescription) -> str:
    plain = json.dumps(Scene(description).plain(), sort_keys=True, default=str)
    return hashlib.sha256(plain.encode()).hexdigest()


def _read(path: Path) -> dict[str, Any]:
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) else {}
