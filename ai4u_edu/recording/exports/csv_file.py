"""Export of an episode as CSV: one row for each decision of each agent."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.csv_table import csv_table
from ai4u_edu.recording.replay import Replay, ReplayMoment

Row = dict[str, Any]


def write_csv(replay: Replay, path: Path) -> Path:
    """Write an episode as CSV, and return the path.

    Columns: agent, step, tick, time (s), x, y, z (m) and heading (degrees) of its body at the
    decision; ``sensor[i]`` of its percept; ``actuator[i]`` of its action; ``reward``, and
    ``reward:term`` for each reward term; terminated, truncated.

    Args:
        replay: of the episode; the rows end where the replay is no longer exact.
        path: of the file.
    """
    rows = [row for agent in replay.episode.ids for row in _rows(replay, agent)]
    names = list(dict.fromkeys(name for row in rows for name in row))
    cells = ([row.get(name, "") for name in names] for row in rows)
    write_atomically(path, csv_table(names, cells))
    return path


def _rows(replay: Replay, agent: str) -> Iterator[Row]:
    for moment in replay.moments(agent):
        yield _row(agent, moment)


def _row(agent: str, moment: ReplayMoment) -> Row:
    decision, picture = moment.decision, moment.snapshot
    (body,) = {state.body for state in picture.agents if state.id == agent}
    (pose,) = [state for state in picture.bodies if state.name == body]
    row: Row = {
        "agent": agent,
        "step": decision.step,
        "tick": decision.begin,
        "time": picture.time,
        "x": pose.x,
        "y": pose.y,
        "z": pose.z,
        "heading": math.degrees(pose.heading),
    }
    for name, reading in moment.percept.items():
        row |= _cells(name, reading)
    for name, numbers in decision.action.items():
        row |= _cells(name, np.array(numbers))
    row["reward"] = decision.reward
    row |= {f"reward:{name}": amount for name, amount in decision.reward_terms.items()}
    return row | {"terminated": int(decision.terminated), "truncated": int(decision.truncated)}


def _cells(name: str, value: Any) -> Row:
    if isinstance(value, tuple):
        return {f"{name}[{index}]": each for index, each in enumerate(value)}
    if isinstance(value, np.ndarray):
        return {f"{name}[{index}]": each for index, each in enumerate(value.ravel().tolist())}
    return {name: int(value) if isinstance(value, bool) else value}
