"""Recording of episodes by a driver."""

from collections.abc import Iterable

from ai4u_edu.learn.training.evaluating import DEFAULT_MAX_DECISIONS
from ai4u_edu.learn.training.policies import Entrant, expect_here
from ai4u_edu.recording import Episode, Recorder
from ai4u_edu.scenes import Scene

MAX_EPISODES = 100_000
"""Limit of kept episodes."""


def show(who: Entrant, scene: Scene, seeds: Iterable[int]) -> list[Episode]:
    """Record one episode for each seed.

    Args:
        who: drives the agent, with a new brain in each episode; the others follow their brains.
        scene: the scene, with its own limit of steps.
        seeds: seeds of the episodes.
    """
    fitted = expect_here(who).fitted(scene)
    sim = fitted.build()
    agent = sim.agent(who.agent) if who.agent else sim.agents[0]
    recorder = Recorder(sim, scene=fitted.description, keep=MAX_EPISODES)
    for seed in seeds:
        agent.use_brain(who.brain(agent))
        sim.reset(seed)
        for _ in range(DEFAULT_MAX_DECISIONS):  # so often too if it takes no decisions
            if agent.done or agent.stopped or agent.paused:
                break
            sim.step(agent)
    recorder.finish()
    return list(recorder.episodes)
