"""A part of the scene that is now and then built anew."""

from collections.abc import Iterator
from contextlib import contextmanager

from viser import FrameHandle, SceneApi


class Subtree:
    """The node under which a part of the scene hangs.

    Args:
        scene: viser's scene.
        name: of the node; two names are in use by turns, ``<name>0`` and ``<name>1``.
    """

    def __init__(self, scene: SceneApi, name: str) -> None:
        self._scene = scene
        self._name = name
        self._turn = 0
        self._frame: FrameHandle | None = None

    @contextmanager
    def rebuild(self) -> Iterator[str]:
        """Gives the name of a new, empty node; the old one goes once the new one is complete."""
        old, self._turn = self._frame, 1 - self._turn
        new = self._scene.add_frame(f"/{self._name}{self._turn}", show_axes=False)
        try:
            yield new.name
        except BaseException:
            new.remove()
            self._turn = 1 - self._turn
            raise
        self._frame = new
        if old is not None:
            old.remove()
