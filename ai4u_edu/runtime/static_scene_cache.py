"""Cache of a world's static scene, which snapshots share."""

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.recording.snapshot import StaticScene, capture_static_scene


class StaticSceneCache:
    """The static scene that snapshots share, captured anew if something was built.

    Belongs to the world's thread.

    Args:
        sim: the world and its agents.
    """

    def __init__(self, sim: ControlRequestor) -> None:
        self._version: tuple[int, str, str] | None = None
        self._scene = capture_static_scene(sim)

    def of(self, sim: ControlRequestor) -> StaticScene:
        """Return a world's static scene; the same object as long as nothing in it has changed."""
        version = sim.world.generation, sim.goal, sim.success
        if self._version != version:
            self._version = version
            self._scene = self.shared(capture_static_scene(sim))
        return self._scene

    def shared(self, other: StaticScene) -> StaticScene:
        """Return the cached scene if another one is equal to it, else that other one."""
        return self._scene if other is self._scene or other == self._scene else other

    def invalidate(self) -> None:
        """Compare with the world again; another one may have the same version."""
        self._version = None
