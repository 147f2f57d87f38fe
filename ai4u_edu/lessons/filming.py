"""``film``: an episode as an animation in the notebook, without a server."""

from collections import deque
from typing import Any

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.lessons.notebook_output import card, image, put
from ai4u_edu.lessons.pictures import FRAMES_PER_S, MAX_ANIMATION_S, animation, moving
from ai4u_edu.lessons.rollouts import DEFAULT_MAX_DECISIONS, Drive, drives
from ai4u_edu.lessons.time_limit import TimeLimit, TimeLimitError
from ai4u_edu.recording import Episode
from ai4u_edu.scenes import Scene
from ai4u_edu.snapshot import Snapshot, capture_snapshot


def film(
    world: "ControlRequestor | Scene | Episode | str",
    brain: Any = None,
    *,
    seed: int = 0,
    limit: int = DEFAULT_MAX_DECISIONS,
) -> None:
    """Run one episode at full speed, and show its end as an animation.

    Args:
        world: a scene or its name, a world with its agents; or an episode that was recorded.
        brain: the first agent's driver; left out, its own.
        seed: seed of the episode.
        limit: decisions after which it is truncated.
    """
    if isinstance(world, Episode):
        put(image(animation(world), "the episode"), f"An episode of {world.seconds:.1f} s.")
        return
    shown: deque[Snapshot] = deque(maxlen=FRAMES_PER_S * MAX_ANIMATION_S)
    due = 0.0

    def watch(drive: Drive) -> None:
        nonlocal due
        if drive.sim.world.time >= due or drive.agent.done:
            shown.append(capture_snapshot(drive.sim))
            due = drive.sim.world.time + 0.99 / FRAMES_PER_S

    source = (lambda: world) if isinstance(world, ControlRequestor) else world
    with TimeLimit() as time_limit:
        try:
            (drive,) = drives(source, brain, [seed], limit=limit, watch=watch)
        except TimeLimitError:
            put(card("vermillion", "Stopped.", [time_limit.text]), f"Stopped. {time_limit.text}")
            return
    ends = (
        (drive.won, "the robot reached its goal"),
        (drive.fell, "the robot fell"),
        (drive.agent.done, "the episode was over"),
        (True, "the film stops"),
    )
    how = next(words for happened, words in ends if happened)
    words = f"Seed {seed}: after {drive.steps} decisions {how}."
    put(f"<p>{words}</p>{image(moving(shown), 'the episode')}", words)
