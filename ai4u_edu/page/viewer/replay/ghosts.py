"""Ghosts: recorded episodes that drive beside the living agents, on all pages."""

from collections.abc import Sequence

from ai4u_edu.page.viewer.backend.local_server import LocalServer
from ai4u_edu.page.viewer.replay.ghost_drive import GhostDrive
from ai4u_edu.page.viewer.scene.layers import Layers
from ai4u_edu.recording import Episode
from ai4u_edu.recording.snapshot import Snapshot, StaticScene


class Ghosts:
    """The ghosts of one or more episodes. They are not bodies: nothing senses or touches them.

    Any thread may call :meth:`race` and :meth:`race_all`; the viewer's thread calls :meth:`build`
    and :meth:`draw`.

    Args:
        server: viser's server.
    """

    def __init__(self, server: LocalServer) -> None:
        self._scene = server.scene
        self.drives: tuple[GhostDrive, ...] = ()
        """The ghosts that are shown, or will be as soon as their paths are computed."""
        self._drawn: tuple[GhostDrive, ...] = ()
        self._layers: Layers | None = None
        self._count = 0

    def race(self, episode: Episode | None, name: str = "") -> None:
        """Show an episode's ghost in place of all others.

        Args:
            episode: the recorded episode; None removes all ghosts.
            name: the episode's name.
        """
        self.drives = () if episode is None else (self._drive(episode, name, "ghost"),)

    def race_all(self, drives: Sequence[tuple[Episode, str]]) -> None:
        """Show the ghosts of several episodes in place of all others, each under its name.

        Args:
            drives: recorded episodes with the names of who drove.
        """
        self.drives = tuple(
            self._drive(episode, name, name, place) for place, (episode, name) in enumerate(drives)
        )

    @property
    def name(self) -> str:
        """Names of the episodes; empty if there is no ghost."""
        return ", ".join(each.name for each in self.drives if not each.problem)

    def text(self, snapshot: Snapshot) -> str:
        """Return the ghosts' names and any problem; empty if there is no ghost."""
        if not self.drives:
            return ""
        well = [each for each in self.drives if not each.problem]
        if not well:
            return f"No ghost: {self.drives[0].problem}"
        text = f"{'Ghost' if len(well) == 1 else 'Ghosts'}: {self.name}"
        warning = well[0].warning(snapshot)
        return f"{text}. {warning}" if warning else text

    def build(self, static_scene: StaticScene) -> None:
        """Rebuild the ghosts at the next drawing, for a new static scene."""
        self._layers = Layers.of(static_scene)

    def draw(self, snapshot: Snapshot) -> None:
        """Move the ghosts to their poses at the snapshot's time."""
        drives, layers = self.drives, self._layers
        for gone in self._drawn:
            if gone not in drives:
                gone.remove()
        self._drawn = drives
        if layers is not None:
            for each in drives:
                each.draw(snapshot, layers)

    def _drive(
        self, episode: Episode, name: str, label: str, place: int | None = None
    ) -> GhostDrive:
        self._count += 1
        return GhostDrive(self._scene, f"ghost{self._count}-", episode, name, label, place)
