"""Explanations of a running world's agents, also in a recorded episode that its pages look at."""

from concurrent.futures import CancelledError

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks import Brain, Percept
from ai4u_edu.explain.baseline import mean_of
from ai4u_edu.explain.elsewhere import PoseTrial
from ai4u_edu.explain.explanations import Explanations
from ai4u_edu.explain.live import (
    MAX_MEAN_PERCEPTS,
    MIN_MEAN_PERCEPTS,
    LiveExplainer,
    NamedBaseline,
)
from ai4u_edu.explain.live_maps import LiveMaps
from ai4u_edu.recording.frame_cache import FrameCache
from ai4u_edu.recording.scene_export import export_scene, without_unknown_brains
from ai4u_edu.runtime.frame_budget import SENSES_PER_S
from ai4u_edu.runtime.replay_player import ReplayPlayer
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.snapshot import Snapshot

EXPORT_TIMEOUT_S = 2.0
"""Time that the world's thread has to describe its world."""


def explanations_of(runner: Runner, player: ReplayPlayer) -> Explanations:
    """Return what explains the agents of a running world.

    Args:
        runner: runs the world.
        player: plays the recorded episodes that its pages look at.
    """

    def latest() -> Snapshot:
        return runner.latest

    def brain_of(agent_id: str) -> Brain | None:
        agents = runner.sim.agents
        return next((agent.brain for agent in agents if agent.id == agent_id), None)

    explainer = LiveExplainer(latest, brain_of, EpisodeBaseline(player))
    thrift = runner.frame_budget.senses_per_s / SENSES_PER_S  # less than 1 in a class's rooms
    maps = LiveMaps(
        latest, explainer, SceneSource(runner, player), thrift, lambda: runner.next_tick_at
    )
    return Explanations(explainer, maps, PoseTrial(latest, explainer, SceneSource(runner, player)))


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


class EpisodeBaseline:
    """Computes the baseline of the episode that pages look at; one thread calls it.

    Args:
        player: has the episode.
    """

    def __init__(self, player: ReplayPlayer) -> None:
        self._player = player
        self._key: tuple[FrameCache, str] | None = None
        self._found: NamedBaseline | None = None

    def __call__(self, snapshot: Snapshot, agent_id: str) -> NamedBaseline | None:
        """Return the mean of an agent's percepts in the episode of a snapshot.

        Returns:
            None for a snapshot of the present, for an episode of a few decisions, and until the
            whole episode has been replayed.
        """
        frame_cache = self._player.frame_cache
        if not snapshot.past or frame_cache is None:
            return None
        if self._key != (frame_cache, agent_id):
            percepts = _percepts(frame_cache, agent_id)
            if percepts is None:
                return None
            words = f"the mean of {len(percepts)} percepts of episode {frame_cache.number}"
            is_long = len(percepts) >= MIN_MEAN_PERCEPTS
            self._found = NamedBaseline(words, mean_of(percepts)) if is_long else None
            self._key = frame_cache, agent_id
        return self._found


def _percepts(frame_cache: FrameCache, agent_id: str) -> list[Percept] | None:
    """Return an agent's percepts in an episode, some of them if it is long; None until then."""
    count, stride = frame_cache.last, frame_cache.stride  # others are not kept
    stride *= max(1, -(-count // (stride * MAX_MEAN_PERCEPTS)))
    found: list[Percept] = []
    # the last one first: until it is there, there is no need to look at the others
    for step in reversed(range(0, count, stride)):
        frame = frame_cache.snapshot(step)
        if frame is None:
            return None
        found += [agent.percept for agent in frame.agents if agent.id == agent_id]
    return found
