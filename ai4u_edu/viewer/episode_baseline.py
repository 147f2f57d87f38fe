"""Baseline from the recorded episode that is shown: the mean of what an agent sensed in it."""

from ai4u_edu.blocks import Percept
from ai4u_edu.explain.baseline import mean_of
from ai4u_edu.explain.live import MAX_MEAN_PERCEPTS, MIN_MEAN_PERCEPTS, NamedBaseline
from ai4u_edu.recording.frame_cache import FrameCache
from ai4u_edu.runtime.replay_player import ReplayPlayer
from ai4u_edu.snapshot import Snapshot


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
