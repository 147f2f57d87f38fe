"""Lets somebody drive, and keeps the episodes."""

from collections.abc import Iterable

from ai4u_edu.recording import Episode, Recorder
from ai4u_edu.scenes import Scene
from ai4u_edu.training.evaluating import LONGEST
from ai4u_edu.training.policies import Entrant, expect_here

MOST = 100_000
"""Episodes; more are not kept."""


def show(who: Entrant, scene: Scene, seeds: Iterable[int]) -> list[Episode]:
    """One recorded episode for each seed.

    Args:
        who: drives the agent, by a new brain in each episode; the others do as their brains say.
        scene: where; with its own limit of steps.
        seeds: of the episodes.
    """
    fitted = expect_here(who).fitted(scene)
    sim = fitted.build()
    agent = sim.agent(who.agent) if who.agent else sim.agents[0]
    recorder = Recorder(sim, scene=fitted.description, keep=MOST)
    for seed in seeds:
        agent.use_brain(who.brain(agent))
        sim.reset(seed)
        for _ in range(LONGEST):  # so often too if it takes no decisions
            if agent.done or agent.stopped or agent.paused:
                break
            sim.step(agent)
    recorder.finish()
    return list(recorder.episodes)
