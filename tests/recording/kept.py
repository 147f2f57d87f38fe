"""Drives in all scenes of the library, kept as files to compare every later version with.

``python -m tests.recording.kept SCENE`` records those of a scene, without a name those of all. That
is needed for a new scene, and after a change that is meant to change what happens in one: it breaks
the recordings of everybody else, too.
"""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ai4u_edu import BasicAgent, LocalBrain, Percept, Scene
from ai4u_edu.agent.driving_keys import keys_of
from ai4u_edu.check.rollout import RandomDrive
from ai4u_edu.recording import Episode, Recorder
from tests.scenes.solvers import solver_of

FOLDER = Path(__file__).parent / "kept"
SEED = 11
MAX_DECISIONS = 150

Controller = Callable[[Percept], Any]


def _random_drive(agent: BasicAgent, _scene: str) -> Controller:
    drive = RandomDrive(agent)
    drive.restart(SEED)
    return drive


def _solver(_agent: BasicAgent, scene: str) -> Controller:
    return solver_of(scene)


DRIVERS: dict[str, Callable[[BasicAgent, str], Controller]] = {
    "random": _random_drive,  # uses all components of all actuators
    "solved": _solver,  # reaches what the scene rewards
}
"""Drivers in place of a person, by the ending of a file's name."""

KEPT = [f"{scene}-{driver}" for scene in Scene.names() for driver in DRIVERS]
"""Names of all kept drives."""


def path_of(name: str) -> Path:
    """Return the file of a kept drive."""
    return FOLDER / f"{name}.episode"


def record(name: str) -> Episode:
    """Record a drive. Agents that no person drives do as their scene's brains say."""
    scene_name, driver = name.rsplit("-", 1)
    scene = Scene.load(scene_name)
    sim = scene.build()
    for agent in sim.agents:
        if keys_of(agent):
            agent.use_brain(
                LocalBrain(
                    controller=DRIVERS[driver](agent, scene_name),
                    skip_frame=agent.brain.skip_frame,
                    repeat_action=agent.brain.repeat_action,
                )
            )
    recorder = Recorder(sim, scene=scene.description)
    sim.reset(SEED)
    for _ in range(MAX_DECISIONS):
        if all(agent.done for agent in sim.agents):
            break
        sim.step()
    recorder.finish()
    return recorder.episodes[-1]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="*", choices=[[], *Scene.names()], metavar="SCENE")
    scenes = parser.parse_args().scenes or Scene.names()
    FOLDER.mkdir(exist_ok=True)
    for path in FOLDER.glob("*.episode"):
        if path.stem not in KEPT:
            path.unlink()
    for name in KEPT:
        if name.rpartition("-")[0] in scenes:
            print(name, record(name).save(path_of(name)).stat().st_size)
