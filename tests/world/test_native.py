"""The seam to Chipmunk: an unknown pymunk gets the public API, with the same bits."""

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import pytest

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.check.rollout import RandomDrive
from ai4u_edu.world import native

ROOT = Path(__file__).parents[2]
SCENES = "yardstick", "box_chase", "jumper", "push_block"
PROGRAM = """
import pymunk
pymunk.version = "{version}"
from ai4u_edu.world import native
from tests.world.test_native import rollout
print(native.IS_NATIVE, rollout())
"""


def rollout() -> str:
    """Return a checksum of all percepts and bodies of some scenes that are driven at random."""
    found = hashlib.sha256()
    for name in SCENES:
        sim = Scene.load(name).build(seed=2)
        for agent in sim.agents:
            skip = agent.brain.skip_frame
            agent.use_brain(LocalBrain(controller=RandomDrive(agent), skip_frame=skip))
        sim.reset(seed=2)
        for _ in range(60):
            found.update(sim.step().data)
            for body in sim.world.bodies.values():
                found.update(repr((body.pose, body.velocity, body.angular_velocity)).encode())
            if sim.agents[0].done:
                sim.reset()
    return found.hexdigest()


@pytest.mark.parametrize(("version", "is_native"), [("7.3.9", True), ("7.4.0", False)])
def test_another_pymunk_gives_the_same_bits(version: str, is_native: bool) -> None:
    assert native.IS_NATIVE, "the pinned pymunk is known"
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM.format(version=version)],
        cwd=ROOT,
        env=dict(os.environ),
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.split() == [str(is_native), rollout()]


def test_nothing_compiled_gives_the_same_bits() -> None:
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM.format(version="7.3.1")],
        cwd=ROOT,
        env={**os.environ, "AI4U_COMPILED": "0"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.split() == ["True", rollout()]
