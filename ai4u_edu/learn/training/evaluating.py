"""Evaluation of a driver on seeds not used for training."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from html import escape
from typing import Any

import numpy as np
from rich.table import Table

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.learn.training.episode import EpisodeStats, wilson
from ai4u_edu.learn.training.policies import Entrant, expect_here
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import ngettext, translate
from ai4u_edu.scenes import Scene

DEFAULT_MAX_DECISIONS = 10_000
"""Decisions after which an episode is truncated in a scene without a limit of its own."""


@dataclass(frozen=True, repr=False)
class Evaluation:
    """Evaluation of one driver."""

    name: str
    scene: str
    has_goal: bool
    """True if the scene defines a success."""
    episodes: tuple[EpisodeStats, ...]

    @property
    def successes(self) -> int:
        """Episodes that reached the goal."""
        return sum(each.success for each in self.episodes)

    @property
    def success(self) -> float | None:
        """Share of the episodes that reached the goal; None in a scene without one."""
        return self.successes / len(self.episodes) if self.has_goal else None

    success_rate = success

    @property
    def interval(self) -> tuple[float, float] | None:
        """95% confidence interval of the success rate."""
        return wilson(self.successes, len(self.episodes)) if self.has_goal else None

    @property
    def rewards(self) -> list[float]:
        """Each episode's return."""
        return [each.reward for each in self.episodes]

    @property
    def lengths(self) -> list[int]:
        """Each episode's number of decisions."""
        return [each.length for each in self.episodes]

    @property
    def seconds(self) -> list[float]:
        """Each episode's duration (s) in world time."""
        return [each.seconds for each in self.episodes]

    @property
    def cells(self) -> dict[str, str]:
        """Return a table's cells by heading."""
        return {
            _("who"): self.name,
            _("success"): "-" if self.success is None else f"{self.success:.0%}",
            _("95% between"): "-" if self.interval is None else between(*self.interval),
            _("return"): f"{np.mean(self.rewards):.2f} ± {np.std(self.rewards):.2f}",
            _("length"): f"{np.mean(self.lengths):.1f} ± {np.std(self.lengths):.1f}",
        }

    def __repr__(self) -> str:
        """Return a table of one row."""
        columns = [
            (heading.ljust(width), cell.ljust(width))
            for heading, cell in self._shown_cells
            for width in [max(len(heading), len(cell))]
        ]
        rows = ["  ".join(row).rstrip() for row in zip(*columns, strict=True)]
        return "\n".join((self._title, *rows))

    def _repr_html_(self) -> str:
        headings = "".join(f"<th>{escape(heading)}</th>" for heading, _cell in self._shown_cells)
        cells = "".join(f"<td>{escape(cell)}</td>" for _heading, cell in self._shown_cells)
        return (
            f"<table><caption>{escape(self._title)}</caption>"
            f"<thead><tr>{headings}</tr></thead><tbody><tr>{cells}</tr></tbody></table>"
        )

    @property
    def _shown_cells(self) -> list[tuple[str, str]]:
        """Headings and cells in the reader's language."""
        return [(translate(heading), translate(cell)) for heading, cell in self.cells.items()]

    @property
    def _title(self) -> str:
        count = len(self.episodes)
        title = ngettext("{scene}, {n} episode", "{scene}, {n} episodes", count, scene=self.scene)
        return translate(title)

    def plain(self) -> dict[str, Any]:
        """Return all of it as plain data, for a file."""
        return {
            "name": self.name,
            "scene": self.scene,
            "episodes": len(self.episodes),
            "success": self.success,
            "interval": self.interval,
            "return": _spread(self.rewards),
            "length": _spread(self.lengths),
            "each": [each._asdict() for each in self.episodes],
        }


def between(low: float, high: float) -> str:
    """Return the limits of a share of successes, from 0 to 1, as percentages."""
    return _("{low:.1f} and {high:.1f}%", low=100 * low, high=100 * high)


def evaluation_table(evaluations: Sequence[Evaluation]) -> Table:
    """Return a table with a row for each evaluation, at least one."""
    told = Table(box=None, pad_edge=False)
    who, *others = evaluations[0].cells
    told.add_column(translate(who), overflow="fold")
    for heading in others:
        told.add_column(translate(heading), justify="right")
    for each in evaluations:
        told.add_row(*map(translate, each.cells.values()))
    return told


def evaluate(
    who: Entrant,
    scene: Scene,
    seeds: Iterable[int],
    *,
    tell: Callable[[], None] = lambda: None,
) -> Evaluation:
    """Run one episode for each seed, each of them with a new brain.

    Args:
        who: drives the agent; the others follow their brains.
        scene: the scene, with its own limit of steps.
        seeds: seeds of the episodes; trainings use none below 2**32 on purpose.
        tell: called after each episode.
    """
    sim = expect_here(who).fitted(scene).build()
    agent = sim.agent(who.agent) if who.agent else sim.agents[0]
    goal = scene.description.success
    episodes = []
    for seed in seeds:
        agent.use_brain(who.brain(agent))  # no episode depends on what a driver has kept of others
        episodes.append(_drive(sim, agent, seed, goal))
        tell()
    return Evaluation(who.name, scene.description.name, goal is not None, tuple(episodes))


def _drive(sim: ControlRequestor, agent: BasicAgent, seed: int, goal: str | None) -> EpisodeStats:
    sim.reset(seed)
    reward, length, seconds, episode = 0.0, 0, 0.0, sim.episode
    while not agent.done and length < DEFAULT_MAX_DECISIONS:
        sim.step(agent)
        if sim.episode != episode or agent.stopped or agent.paused:
            return EpisodeStats(seed, False, reward, length, False, seconds)  # it gave up
        reward += agent.reward
        length += 1
        seconds = sim.world.time
    paid = agent.ledger.episode_terms
    won = bool(goal and paid.get(goal, 0.0) > 0)
    return EpisodeStats(seed, won, reward, length, agent.terminated, seconds)


def _spread(numbers: Sequence[float]) -> dict[str, float]:
    return {
        "mean": float(np.mean(numbers)),
        "deviation": float(np.std(numbers)),
        "lowest": float(np.min(numbers)),
        "highest": float(np.max(numbers)),
    }
