"""Validation of an episode that was loaded from an untrusted file."""

import numpy as np

from ai4u_edu.recording.episode import ENDED, AgentRecord, Episode
from ai4u_edu.recording.errors import RecordingError

MAX_SKIP_FRAME = 10_000
"""The largest skip_frame that a brain may have."""


def validate_episode(episode: Episode) -> None:
    """Check that all parts of an episode fit together.

    Raises:
        RecordingError: they do not; the message names the part.
    """
    ids = [str(agent.get("id", "0")) for agent in episode.scene.agents]
    if list(episode.ids) != ids:
        raise RecordingError(f"agents: expected those of the scene, {ids}, got {list(episode.ids)}")
    for record in episode.agents:
        _check_agent(record, episode.ticks)
    _check_order(episode)
    _check_time(episode)


def _check_agent(record: AgentRecord, ticks: int) -> None:
    who, count = f"agent {record.id!r}", len(record)
    for name in ("end", "skip", "flags", "actions", "terms", "rewards", "percepts", "worlds"):
        if len(getattr(record, name)) != count:
            raise RecordingError(
                f"{who}: expected {count} {name}, one for each decision, "
                f"got {len(getattr(record, name))}"
            )
    if len(record.carried) not in (0, count):
        raise RecordingError(
            f"{who}: expected {count} carried, one for each decision, or none, "
            f"got {len(record.carried)}"
        )
    if (record.skip > MAX_SKIP_FRAME).any():
        raise RecordingError(f"{who}: skip: expected at most {MAX_SKIP_FRAME}")
    if (record.end < record.begin).any() or (record.end > ticks).any():
        raise RecordingError(f"{who}: end: expected decisions that end after they begin")
    ended = (record.flags & ENDED) > 0
    if (record.end[ended] == record.begin[ended]).any():
        raise RecordingError(f"{who}: end: expected each decision to take a tick at least")
    starts = record.starts
    if not len(starts) or len(record.firsts) != len(starts) or starts[0] != 0:
        raise RecordingError(f"{who}: starts: expected one for each of the agent's episodes")
    if (np.diff(starts.astype(np.int64)) < 0).any() or (starts > count).any():
        raise RecordingError(f"{who}: starts: expected numbers of decisions, in order")


def _check_order(episode: Episode) -> None:
    order = episode.order
    for index, record in enumerate(episode.agents):
        if int((order == index).sum()) != len(record):
            raise RecordingError(f"order: expected all decisions of agent {record.id!r} once each")
    if order[order < 0].tolist() != [-1 - i for i in range(len(episode.restarts))]:
        raise RecordingError("order: expected all restarts once each, in order")
    if len(order) and int(order.max()) >= len(episode.agents):
        raise RecordingError("order: expected numbers of agents")
    for restart in episode.restarts:
        known = all(0 <= index < len(episode.agents) for index in restart.agents)
        if not restart.agents or len(set(restart.agents)) < len(restart.agents) or not known:
            raise RecordingError("restarts: expected numbers of agents")


def _check_time(episode: Episode) -> None:
    """Check that ticks do not decrease; a replay would wait forever for an earlier one."""
    restarts = [restart.tick for restart in episode.restarts]
    # other values may not fit into the array
    known = all(0 <= tick <= episode.ticks for tick in restarts)
    ticks = np.zeros(len(episode.order), np.int64)
    for places, record in zip(episode.places, episode.agents, strict=True):
        ticks[places] = record.begin
    ticks[episode.restart_places] = restarts if known else -1
    if not known or (np.diff(ticks) < 0).any() or (ticks > episode.ticks).any():
        raise RecordingError("order: expected what happened later to come later")
