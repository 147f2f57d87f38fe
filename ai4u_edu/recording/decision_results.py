"""Results of replayed decisions."""

from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.recording.player import Player
from ai4u_edu.recording.snapshot import capture_agent

DecisionResult = dict[str, Any]
"""Fields of an :class:`~ai4u_edu.recording.snapshot.AgentState`, with their values."""
_FIELDS = (
    "action",
    "clipped",
    "reward",
    "reward_terms",
    "episode_reward",
    "episode_terms",
    "phase",
    "history",
    "stages",
    "seconds_left",
)
"""Fields of an agent's state that belong to the decision that has just ended."""


class DecisionResults:
    """Collects the results of an agent's decisions while a player replays them.

    Args:
        player: replays the episode.
        index: of the agent.
        into: gets the results by the index of the decision.
    """

    def __init__(self, player: Player, index: int, into: dict[int, DecisionResult]) -> None:
        self._player = player
        self._index = index
        self._into = into
        player.sim.agents[index].percept_ready.connect(self._on_percept)

    def _on_percept(self, agent: BasicAgent) -> None:
        decision = self._player.taken[self._index] - 1
        if not agent.steps or decision in self._into:
            return  # the episode has just begun, or the result is known
        sim, began = self._player.sim, self._player.episode.agents[self._index].begin[decision]
        phase = sim.phase(agent)._replace(tick=sim.world.ticks - int(began))
        state = capture_agent(agent, phase=phase)
        self._into[decision] = {name: getattr(state, name) for name in _FIELDS}


def decision_at(player: Player, index: int) -> int:
    """Return the decision that an agent takes or carries out at this tick; -1 for none."""
    record, taken, tick = player.episode.agents[index], player.taken[index], player.sim.world.ticks
    if taken < len(record) and record.begin[taken] == tick:
        return taken
    has_one = taken and (player.sim.agents[index].steps or record.end[taken - 1] > tick)
    return taken - 1 if has_one else -1  # after a restart it has taken none yet
