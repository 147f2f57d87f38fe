"""A part of the scene that is rebuilt as a whole."""

from collections.abc import Iterator
from contextlib import contextmanager

from viser import FrameHandle, SceneApi

from ai4u_edu.page.viewer.scene.geometry import Array, heading_wxyz


class Subtree:
    """The parent node of a part of the scene.

    Args:
        scene: viser's scene.
        name: name of the node; it alternates between ``<name>0`` and ``<name>1``.
    """

    def __init__(self, scene: SceneApi, name: str) -> None:
        self._scene = scene
        self._name = name
        self._suffix = 0
        self._frame: FrameHandle | None = None

    @contextmanager
    def rebuild(self) -> Iterator[str]:
        """Yield the name of a new, empty node that replaces the old one at the end of the block.

        If the block raises, the new node is removed and the old one stays.
        """
        old, self._suffix = self._frame, 1 - self._suffix
        new = self._scene.add_frame(f"/{self._name}{self._suffix}", show_axes=False)
        try:
            yield new.name
        except BaseException:
            new.remove()
            self._suffix = 1 - self._suffix
            raise
        self._frame = new
        if old is not None:
            old.remove()

    def place(self, position: Array, heading: float) -> None:
        """Move the parent node to a position (m) and a heading (rad)."""
        if self._frame is not None:
            self._frame.position, self._frame.wxyz = position, heading_wxyz(heading)

    def remove(self) -> None:
        """Take this part from the scene; :meth:`rebuild` brings another one."""
        if self._frame is not None:
            self._frame.remove()
            self._frame = None
