"""Evaluation in jobs: the seeds in parts, each of them on a core of its own."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.games.jobs import Engine, Job, run_jobs
from ai4u_edu.learn.training.episode import EpisodeStats
from ai4u_edu.learn.training.evaluating import Evaluation, evaluate
from ai4u_edu.learn.training.policies import Entrant, entrant
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes.scene_data import SceneData, scene_from

PARTS_PER_CORE = 4
"""Parts for each job that runs at a time: more of them even out slow episodes, and cost more."""


def evaluate_on(
    engine: Engine,
    drives: Sequence[tuple[str, SceneData]],
    seeds: Sequence[int],
    *,
    agent: str = "",
    tell: Callable[[int], object] = lambda _episodes: None,
) -> list[Evaluation]:
    """Run one episode for each driver and seed, as :func:`evaluate` does, on an engine.

    Args:
        engine: runs the episodes; on other machines, files have to lie at the same paths.
        drives: names of drivers, as for :func:`ai4u_edu.learn.training.policies.entrant`, each with
            the scene in which it drives; one at least.
        seeds: of each driver's episodes; expected is one at least.
        agent: id of the agent that is driven and measured; default: the driver's.
        tell: called after each part with its number of episodes.

    Raises:
        AI4UError: a part of the episodes could not be run.
    """
    size = -(-len(seeds) * len(drives) // (engine.width * PARTS_PER_CORE))
    parts = [list(seeds[start : start + size]) for start in range(0, len(seeds), size)]
    jobs = [
        [Job.of(evaluate_part, who=who, scene=scene, seeds=part, agent=agent) for part in parts]
        for who, scene in drives
    ]
    done: dict[str, dict[str, Any]] = {}
    for outcome in run_jobs((job for group in jobs for job in group), engine):
        arguments = outcome.job.arguments
        if not outcome.is_done:
            first, last = arguments["seeds"][0], arguments["seeds"][-1]
            raise AI4UError(
                _(
                    "{who}, seeds {first} to {last}: {problem}",
                    who=arguments["who"],
                    first=first,
                    last=last,
                    problem=outcome.error,
                )
            )
        done[outcome.job.key] = outcome.result
        tell(len(arguments["seeds"]))
    return [_joined([done[job.key] for job in group]) for group in jobs]


def _joined(results: Sequence[dict[str, Any]]) -> Evaluation:
    first, episodes = results[0], [each for result in results for each in result["episodes"]]
    return Evaluation(
        first["name"],
        first["scene"],
        first["has_goal"],
        tuple(EpisodeStats(*each) for each in episodes),
    )


def evaluate_part(who: str, scene: SceneData, seeds: list[int], agent: str) -> dict[str, Any]:
    """Run some of the episodes; a job's function."""
    loaded = scene_from(scene)
    driver = _entrant(who, loaded.description.name)
    result = evaluate(replace(driver, agent=agent or driver.agent), loaded, seeds)
    return {
        "name": result.name,
        "scene": result.scene,
        "has_goal": result.has_goal,
        "episodes": [list(each) for each in result.episodes],
    }


@lru_cache(maxsize=4)  # a process has several parts of one evaluation
def _entrant(who: str, scene: str) -> Entrant:
    return entrant(who, scene)
