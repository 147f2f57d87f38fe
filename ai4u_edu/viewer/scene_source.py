"""The scene of a snapshot: that of the running world, or of the recorded episode."""

from concurrent.futures import CancelledError

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.recording.scene_export import export_scene, without_unknown_brains
from ai4u_edu.runtime.replay_player import ReplayPlayer
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.snapshot import Snapshot

EXPORT_TIMEOUT_S = 2.0
"""Time that the world's thread has to describe its world."""


class SceneSource:
    """Describes the world of a snapshot, so that it can be copied; one thread calls it.

    The same object comes again as long as the world is the same.

    Args:
        runner: runs the world.
        player: has the episode that is shown in a snapshot of the past.
    """

    def __init__(self, runner: Runner, player: ReplayPlayer) -> None:
        self._runner, self._player = runner, player
        self._version: object = None
        self._scene: SceneDescription | None = None

    def __call__(self, snapshot: Snapshot) -> SceneDescription:
        """Return the scene of a snapshot; brains of unknown types are left out.

        Raises:
            AI4UError: the world does not answer, or no file can hold it.
        """
        # blocks that were changed have other descriptions
        agents = tuple((agent.sensor_infos, agent.brain) for agent in snapshot.agents)
        version = snapshot.static_scene, agents
        if self._scene is not None and version == self._version:
            return self._scene
        episode = self._player.frame_cache
        if snapshot.past and episode is not None:
            scene = without_unknown_brains(episode.episode.scene)
        else:
            scene = self._exported()
        if scene != self._scene:  # the next episode of the same world is another static scene
            self._scene = scene
        self._version = version
        assert self._scene is not None  # noqa: S101 - set above, or it was equal to one
        return self._scene

    def _exported(self) -> SceneDescription:
        def export() -> SceneDescription:
            return without_unknown_brains(export_scene(self._runner.sim))

        if not self._runner.thread_id:
            return export()
        try:
            return self._runner.submit(export).result(EXPORT_TIMEOUT_S)
        except (TimeoutError, CancelledError):
            raise AI4UError("The world does not answer: a block of it may not return.") from None
