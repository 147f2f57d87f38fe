"""Payments of touch, fall and distance rewards."""

from typing import Any

import pytest

from ai4u_edu import (
    BoxShape,
    CircleShape,
    ControlRequestor,
    FallReward,
    MinDistReward,
    RewardFunc,
    TouchRewardFunc,
)
from ai4u_edu.base.errors import ReadingError
from tests.builders import small_sim, small_world


def drive(forward: float) -> Any:
    return lambda percept: {"move": [forward, 0, 0, 0]}


def paid(sim: ControlRequestor, steps: int) -> list[float]:
    amounts = []
    for _ in range(steps):
        sim.step()
        amounts.append(sim.agents[0].reward)
    return amounts


def test_touch_pays_once() -> None:
    reward = TouchRewardFunc(target="box", reward=7)
    amounts = paid(small_sim(rewards=[reward], controller=drive(1.0)), 150)
    assert amounts.count(7.0) == 1
    assert amounts.count(0.0) == 149
    assert amounts.index(7.0) == pytest.approx(90, abs=2)  # 3 m at 2 m/s, 60 ticks a second


def test_touch_can_end_the_episode() -> None:
    reward = TouchRewardFunc(target="box", reward=7, cause_episode_to_end=True)
    sim = small_sim(rewards=[reward], controller=drive(1.0), skip_frame=4)
    while not sim.agents[0].done:
        sim.step()
    assert (sim.agents[0].terminated, sim.agents[0].reward_terms) == (True, {"touch": 7.0})


def test_touch_again_after_the_cool_down() -> None:
    world = small_world()
    world.add_area("all", CircleShape(radius=100))
    reward = TouchRewardFunc(target="all", reward=1, only_one_time=False, cool_down=0.5)
    amounts = paid(small_sim(rewards=[reward], world=world), 120)
    assert sum(amounts) == 4.0


def test_touch_of_an_area_is_by_the_centre() -> None:
    world = small_world()
    world.add_area("goal", BoxShape(size=(1, 1)), position=(2, 0))
    sim = small_sim(
        rewards=[TouchRewardFunc(target="goal", reward=1)], world=world, controller=drive(1.0)
    )
    while not sim.agents[0].reward:
        sim.step()
    assert sim.agents[0].body.position[0] == pytest.approx(1.5, abs=0.05)


def test_a_touch_in_the_middle_of_a_decision_counts() -> None:
    # the robot bounces off and has left the box long before the decision is over
    from ai4u_edu import World

    world = World(damping=1.0)
    world.add_body("robot", CircleShape(radius=0.5), elasticity=1.0, velocity=(8, 0))
    wall = BoxShape(size=(1, 4))
    world.add_body("box", wall, position=(4, 0), kind="static", elasticity=1.0)
    sim = small_sim(
        actuators=[],
        rewards=[TouchRewardFunc(target="box", reward=1)],
        world=world,
        skip_frame=59,
    )
    sim.step()
    assert sim.agents[0].body.velocity[0] < 0
    assert sim.agents[0].body.position[0] < 2.5
    assert sim.agents[0].reward == 1.0


def test_fall_pays_when_below_and_at_most_once() -> None:
    sim = small_sim(
        rewards=[FallReward(fail_reward=0.25)], world=small_world(plate=2), controller=drive(1.0)
    )
    amounts = []
    while not sim.agents[0].done:
        amounts += paid(sim, 1)
    assert amounts.count(-1.0) == 1
    assert set(amounts) == {-1.0, 0.25}
    first = amounts.index(-1.0)
    assert first == pytest.approx(30, abs=1)  # 1 m at 2 m/s
    assert len(amounts) - first > 20  # and then it fell on to the threshold


def test_min_dist_first_step_is_free_then_best_or_cost() -> None:
    commands = iter([0, 1, 1, 0, -1, -1, 1])
    sim = small_sim(
        rewards=[MinDistReward(target="box")],
        controller=lambda percept: {"move": [next(commands), 0, 0, 0]},
    )
    good, bad = 0.01, -0.001
    assert paid(sim, 7) == [0.0, good, good, bad, bad, bad, bad]


def test_a_reward_that_is_no_number_names_its_block() -> None:
    class Silly(RewardFunc):
        """Pays in words."""

        amount: Any = None

        def on_update(self, body: Any, view: Any) -> Any:
            return self.amount

    for amount, told in (
        (None, "expected a number from on_update, got None"),
        ("much", "expected a number from on_update, got 'much'"),
        (float("nan"), "expected a finite number, got nan"),
    ):
        with pytest.raises(ReadingError) as caught:
            small_sim(rewards=[Silly(amount=amount)]).step()
        assert str(caught.value) == f"agent '0', Silly 'silly': {told}"


def test_on_tick_is_called_after_every_tick_of_a_decision() -> None:
    class Ticks(RewardFunc):
        """Counts."""

        def on_reset(self, agent: Any, view: Any) -> None:
            self.count = 0

        def on_tick(self, body: Any, view: Any) -> None:
            self.count += 1

        def on_update(self, body: Any, view: Any) -> float:
            return self.count

    assert paid(small_sim(rewards=[Ticks()], skip_frame=3), 2) == [4.0, 8.0]
