"""Same descriptions, seed and inputs: the same trajectory, bit for bit."""

import gc
import os
import random
import subprocess
import sys
from pathlib import Path

import pytest

from ai4u_edu.world import Body
from tests.world.random_worlds import make_world
from tests.world.trajectory import make, run

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def trajectory() -> bytes:
    return run(make())


def test_the_world_is_a_busy_one() -> None:
    world = make()
    run(world, 50)
    robot = world["robot"]
    assert not robot.on_ground
    run(world, 310)
    assert robot.position[0] > -1.0, "over the step"
    moved = [name for name, body in world.bodies.items() if body.position != start(body)]
    assert sum(name.startswith("box") for name in moved) >= 3
    assert {"wedge", "capsule", "ball"} <= set(moved)
    assert world["ball"].fallen
    assert world.contacts.of("robot")


def start(body: Body) -> tuple[float, float]:
    return body.description.position


def test_in_another_process(trajectory: bytes) -> None:
    for hash_seed in ("1", "2"):
        output = subprocess.run(
            [sys.executable, "-m", "tests.world.trajectory"],
            cwd=ROOT,
            env={**os.environ, "PYTHONHASHSEED": hash_seed, "PYTHONPATH": str(ROOT)},
            capture_output=True,
            check=True,
        ).stdout
        assert output == trajectory


def test_in_a_new_world(trajectory: bytes) -> None:
    assert run(make()) == trajectory


def test_after_a_reset_and_other_worlds(trajectory: bytes) -> None:
    world = make()
    run(world, 77)
    rng = random.Random(1)
    others = [make_world(rng, sticks=True) for _ in range(5)]
    for other in others:
        for _ in range(60):
            other.tick()
    world.reset(3)
    others.clear()
    gc.collect()
    assert run(world) == trajectory
    world.reset(3)
    assert run(world) == trajectory


def test_another_seed_is_another_trajectory(trajectory: bytes) -> None:
    world = make()
    world.reset()
    seed = world.seeds.seed
    other = run(world)
    assert other != trajectory
    world = make()
    world.reset(seed)
    assert run(world) == other
