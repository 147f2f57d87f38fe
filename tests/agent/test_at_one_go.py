"""A decision that only drives passes at one go, and nobody can tell from what comes of it."""

import os
import random
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ai4u_edu import (
    Actuator,
    Body,
    CBMoveActuator,
    CircleShape,
    DiscreteActuator,
    LocalBrain,
    RBMoveActuator,
    Scene,
    World,
)
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.world import Drive
from ai4u_edu.world.native import ticks as _ticks
from tests.builders import small_sim, small_world
from tests.check.samples import built_in_kinds, sample_of
from tests.world.one_go import state, tell

needs_compiler = pytest.mark.skipif(_ticks.compiled() is None, reason="nothing is compiled here")

ROOT = Path(__file__).parents[2]
ALONE = [name for name in Scene.names() if len(Scene.load(name).description.agents) == 1]


@pytest.fixture
def batches(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """How many ticks passed at one go, each time."""
    counted: list[int] = []
    drive = World.drive

    def counting(self: World, *args: Any) -> int:
        counted.append(drive(self, *args))
        return counted[-1]

    monkeypatch.setattr(World, "drive", counting)
    return counted


def cruise(name: str, decisions: int = 200) -> list[bytes]:
    """All that happens in a scene where somebody drives at random, and jumps now and then."""
    sim = Scene.load(name).build()
    agent, chance = sim.agents[0], random.Random(name)
    (low, high) = agent.fitting.actuators["move"].limits()
    chosen: dict[str, Any] = {}
    skip = agent.brain.skip_frame
    agent.use_brain(LocalBrain(controller=lambda percept: chosen, skip_frame=skip))
    sim.reset(seed=4)
    seen = []
    for turn in range(decisions):
        if turn % 4 == 0:
            numbers = np.array([chance.uniform(*each) for each in zip(low, high, strict=True)])
            if len(low) == 4 and chance.random() < 0.8:
                numbers[2:] = 0.0  # no jump
            chosen["move"] = round(numbers[0]) if len(low) == 1 else numbers
        sim.step()
        seen.append(agent.percept.data + repr((agent.reward_terms, state(sim.world))).encode())
        if agent.done:
            sim.reset()
    return seen


@needs_compiler
@pytest.mark.parametrize("name", ALONE)
def test_in_every_scene(name: str, batches: list[int], monkeypatch: pytest.MonkeyPatch) -> None:
    quick = cruise(name)
    if name in ("box_chase", "jumper", "sample_scene", "yardstick"):
        assert sum(count > 3 for count in batches) > 60, (
            "the others have something to do at each tick"
        )
    monkeypatch.setattr(World, "drive", lambda self, *args: 0)
    assert cruise(name) == quick


PROGRAM = """
import hashlib
from ai4u_edu.world.native import ticks as _ticks
from tests.agent.test_at_one_go import cruise
seen = [cruise(name, 60) for name in ("box_chase", "jumper", "yardstick")]
print(_ticks.compiled() is None, hashlib.sha256(repr(seen).encode()).hexdigest())
"""


@needs_compiler
def test_who_compiles_nothing_sees_the_same() -> None:
    told = []
    for switch in ("0", ""):
        done = subprocess.run(
            [sys.executable, "-c", PROGRAM],
            cwd=ROOT,
            env={**os.environ, "AI4U_COMPILED": switch},
            capture_output=True,
            text=True,
            check=True,
        )
        told.append(done.stdout.split())
    assert [without for without, _ in told] == ["True", "False"]
    assert told[0][1] == told[1][1]


def at_rest(chance: random.Random) -> tuple[World, Body]:
    world = World()
    robot = world.add_body("robot", CircleShape(), heading_deg=chance.uniform(-180, 180))
    return world, robot


@pytest.mark.parametrize(
    "actuator",
    [
        *(sample_of(each).block for each in built_in_kinds() if issubclass(each, Actuator)),
        CBMoveActuator(dead_zone=0.0, move_amount=3.0),
    ],
    ids=lambda each: type(each).__name__,
)
def test_an_actuator_does_what_it_says(actuator: Actuator) -> None:
    chance, said = random.Random(1), 0
    actuator.prepare()
    for _ in range(100):
        action = tuple(
            chance.choice((0.0, -0.0, chance.uniform(*each))) for each in actuator._limits
        )
        action = tuple(map(round, action)) if not actuator.is_continuous else action
        drive = actuator.steady_drive(action)
        if drive is None:
            continue
        said += 1
        place = chance.getstate()
        world, robot = at_rest(chance)
        chance.setstate(place)
        other_world, other = at_rest(chance)
        for _ in range(3):
            actuator.act(robot, action)
            tell(other, drive)
            assert state(world) == state(other_world)
            world.tick()
            other_world.tick()
            assert state(world) == state(other_world)
    drives = {"RBMove", "CBMove", "Discrete", "DifferentialDrive", "Car", "ForceMove"}
    name = type(actuator).__name__.removesuffix("Actuator")
    assert bool(said) == (name in drives and not getattr(actuator, "move_noise", 0.0))


class Quiet(RBMoveActuator):
    """Nothing new."""


class AnotherAct(RBMoveActuator):
    """Drives as the other one, and more."""

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        super().act(body, action)
        body.apply_force(0.0, 1.0)


class AnotherDrive(DiscreteActuator):
    """Drives in its own way."""

    def drive(self, body: Body, *numbers: float, **more: float) -> None:
        body.set_velocity(1.0, 0.0)


class Mixed:
    """Brings an act along."""

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        body.set_velocity(0.0, 1.0)


class WithMixed(Mixed, RBMoveActuator):
    """Has that act."""


class SaysSo(AnotherAct):
    """Has an act of its own, and says what it does."""

    def act(self, body: Body, action: tuple[float, ...]) -> None:
        body.set_angular_velocity(0.0)

    def steady_drive(self, action: tuple[float, ...]) -> Drive | None:
        return Drive(9.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("kind", "speed"),
    [(Quiet, 1.0), (AnotherAct, None), (AnotherDrive, None), (WithMixed, None), (SaysSo, 9.0)],
)
def test_what_was_said_of_another_act_is_not_inherited(
    kind: type[Actuator], speed: float | None
) -> None:
    action = (3.0,) if kind is AnotherDrive else (1.0, 0.0, 0.0, 0.0)
    drive = kind().steady_drive(action)
    assert (drive and drive.forward) == speed


def test_a_handler_is_asked_at_each_tick() -> None:
    actuator, asked = DiscreteActuator(), []
    sim = small_sim(actuators=[actuator], controller=lambda percept: {"move": 3}, skip_frame=4)
    sim.step()
    actuator.handler = lambda body, index: asked.append(index)
    sim.step()
    assert asked == [3] * 5


def ahead(_percept: Any) -> dict[str, Any]:
    return {"move": [1.0, 0.5, 0.0, 0.0]}


def both(make: Callable[[], ControlRequestor], decisions: int = 3) -> World:
    """The world after some decisions; it is the same when they pass tick by tick."""
    quick, plain = make(), make()
    for _ in range(decisions):
        quick.step()
        plain.tick()
        while not plain.between_decisions():
            plain.tick()
    assert state(quick.world) == state(plain.world)
    assert quick.agents[0].reward_terms == plain.agents[0].reward_terms
    return quick.world


def test_who_acts_only_once_does_so_at_the_first_tick(batches: list[int]) -> None:
    def make() -> ControlRequestor:
        brain = LocalBrain(controller=ahead, skip_frame=4, repeat_action=False)
        return small_sim(brains=[brain])

    world = both(make)
    assert not any(batches)
    assert 0.0 < world["robot"].velocity[0] < 1.9, "it slows down in between"


@needs_compiler
def test_who_falls_out_of_the_world_ends_the_decision_there(batches: list[int]) -> None:
    def make() -> ControlRequestor:
        world = World(fall_threshold=-1e-9)
        world.add_floor("plate", small_world(plate=4).floors[0].shape)
        world.add_body("robot", CircleShape(), position=(1.9, 0))
        return small_sim(world=world, controller=ahead, skip_frame=9)

    world = both(make, 1)
    assert world["robot"].fallen
    assert world.ticks == 4
    assert batches == [4]


def test_who_is_out_of_the_world_has_one_tick() -> None:
    def make() -> ControlRequestor:
        sim = small_sim(controller=ahead, skip_frame=9)
        sim.agents[0].body.leave()
        return sim

    assert both(make, 1).ticks == 1


@needs_compiler
def test_two_who_act_take_turns_at_each_tick(batches: list[int]) -> None:
    both(
        lambda: small_sim(
            actuators=[RBMoveActuator(), RBMoveActuator(action_name="more", move_amount=3)],
            controller=lambda percept: {"more": [1, 0, 0, 0], "move": [0, 1, 0, 0]},
            skip_frame=4,
        )
    )
    assert not batches


@needs_compiler
def test_a_step_takes_as_many_ticks_as_it_should(batches: list[int]) -> None:
    sim = small_sim(controller=ahead, skip_frame=6)
    for count in range(1, 20):
        sim.step()
        assert sim.world.ticks == 7 * count
    assert set(batches) >= {7, 4}, "and a second ends in the middle of some"
