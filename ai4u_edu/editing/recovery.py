"""Scenes that were left unsaved, and the autosave of the one that runs."""

from concurrent.futures import Future
from typing import Protocol

from ai4u_edu.base.errors import AI4UError, SetupError
from ai4u_edu.editing.autosave import Autosave
from ai4u_edu.editing.change_result import ChangeResult, failed
from ai4u_edu.editing.state import EditState
from ai4u_edu.editing.unsaved import Unsaved
from ai4u_edu.scenes import Scene, SceneDescription


class _Editor(Protocol):
    """Protocol of the editor whose scene is saved (SceneEditor is one)."""

    @property
    def is_as_opened(self) -> bool: ...

    @property
    def opened(self) -> EditState: ...

    @property
    def state(self) -> EditState: ...

    def open(self, scene: Scene) -> Future[ChangeResult]: ...


class Recovery:
    """Autosaves an editor's scene, and offers a scene that an earlier server left unsaved.

    Any thread may call its methods.

    Args:
        editor: opens the scene that is restored.
    """

    def __init__(self, editor: _Editor) -> None:
        self._editor = editor
        self.unsaved: Unsaved | None = None
        """An unsaved scene to offer; it was left by a server that was killed."""
        self.autosave: Autosave | None = None
        """Writes changes to a file; None in notebooks and tests."""
        self._restored: Unsaved | None = None
        self._saved: SceneDescription | None = None
        """The scene as it was saved last."""

    @property
    def has_unsaved_changes(self) -> bool:
        """True if the scene differs from the one that was opened and from the one last saved."""
        return not self._editor.is_as_opened and not self._is_as_saved

    @property
    def _is_as_saved(self) -> bool:
        return self._editor.state.description == self._saved

    def restore(self) -> "Future[ChangeResult]":
        """Open the unsaved scene that is offered."""
        unsaved, self.unsaved = self.unsaved, None
        if unsaved is None:
            return failed(SetupError("there is no unsaved scene"))
        try:
            scene = unsaved.scene()
        except AI4UError as error:
            return failed(error)
        future = self._editor.open(scene)

        def finish(done: "Future[ChangeResult]") -> None:
            if done.cancelled() or done.exception() is not None:
                self.unsaved = self.unsaved or unsaved
            else:
                self.mark_restored(unsaved)

        future.add_done_callback(finish)
        return future

    def mark_restored(self, unsaved: Unsaved) -> None:
        """Treat the scene that was opened last as this unsaved one, so that its file is kept."""
        if self.autosave is None:
            self._restored = unsaved
        else:
            self.autosave.claim(unsaved, self._editor.opened)

    def mark_saved(self, scene: Scene) -> None:
        """Drop the autosaved file, since somebody saved the scene; offer no other one any more."""
        self.unsaved, self._saved = None, scene.description
        if self._restored is not None:
            self._restored.discard()
            self._restored = None
        if self.autosave is not None:
            self.autosave.forget(self._editor.opened)

    def discard(self) -> None:
        """Delete the unsaved scene that is offered; the running scene's autosave stays."""
        unsaved, self.unsaved = self.unsaved, None
        if unsaved is not None:
            unsaved.discard()

    def on_change(self, state: EditState, *, can_redo: bool) -> None:
        """Schedule an autosave; a scene that was not changed since it was opened needs none."""
        if self.autosave is None:
            return
        if self.has_unsaved_changes:
            self.autosave.schedule(state, self._editor.opened)
        elif can_redo or self._is_as_saved:  # every change was undone
            self.autosave.schedule(None, self._editor.opened)
