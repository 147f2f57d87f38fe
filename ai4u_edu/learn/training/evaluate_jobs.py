"""Evaluation in jobs: the seeds in parts, each of them on a core of its own."""

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks.loading import load_blocks
from ai4u_edu.games.jobs import Engine, Job, run_jobs
from ai4u_edu.learn.training.episode import EpisodeStats
from ai4u_edu.learn.training.evaluating import Evaluation, evaluate
from ai4u_edu.learn.training.policies import Entrant, entrant
from ai4u_edu.scenes import Scene

PARTS_PER_CORE = 4
"""Parts for each job that runs at a time: more of them even out slow episodes, and cost more."""


def evaluate_on(
    engine: Engine,
    who: str,
    scene: str,
    seeds: Sequence[int],
    *,
    own_blocks: Sequence[str] = (),
    tell: Callable[[int], object] = lambda _episodes: None,
) -> Evaluation:
    """Run one episode for each seed, as :func:`evaluate` does, on an engine.

    Args:
        engine: runs the episodes; on other machines, files have to lie at the same paths.
        who: names the driver, as for :func:`ai4u_edu.learn.training.policies.entrant`.
        scene: name or path.
        seeds: of the episodes; expected is one at least.
        own_blocks: Python files with blocks that the scene needs.
        tell: called after each part with its number of episodes.

    Raises:
        AI4UError: a part of the episodes could not be run.
    """
    size = -(-len(seeds) // (engine.width * PARTS_PER_CORE))
    parts = [list(seeds[start : start + size]) for start in range(0, len(seeds), size)]
    jobs = [
        Job.of(evaluate_part, who=who, scene=scene, seeds=part, own_blocks=list(own_blocks))
        for part in parts
    ]
    done: dict[str, dict[str, Any]] = {}
    for outcome in run_jobs(jobs, engine):
        if not outcome.is_done:
            first, last = outcome.job.arguments["seeds"][0], outcome.job.arguments["seeds"][-1]
            raise AI4UError(f"{who}, seeds {first} to {last}: {outcome.error}")
        done[outcome.job.key] = outcome.result
        tell(len(outcome.job.arguments["seeds"]))
    results = [done[job.key] for job in jobs]
    first_result, episodes = results[0], [each for result in results for each in result["episodes"]]
    return Evaluation(
        first_result["name"],
        first_result["scene"],
        first_result["has_goal"],
        tuple(EpisodeStats(*each) for each in episodes),
    )


def evaluate_part(who: str, scene: str, seeds: list[int], own_blocks: list[str]) -> dict[str, Any]:
    """Run some of the episodes; a job's function."""
    for file in own_blocks:
        _load_blocks(file)
    loaded = _scene(scene)
    told = evaluate(_entrant(who, loaded.description.name), loaded, seeds)
    return {
        "name": told.name,
        "scene": told.scene,
        "has_goal": told.has_goal,
        "episodes": [list(each) for each in told.episodes],
    }


# a process has several parts of one evaluation

_load_blocks = lru_cache(maxsize=None)(load_blocks)


@lru_cache(maxsize=4)
def _scene(source: str) -> Scene:
    return Scene.load(source)


@lru_cache(maxsize=4)
def _entrant(who: str, scene: str) -> Entrant:
    return entrant(who, scene)
