"""TargetFallReward: the fall of another body."""

import pytest

from ai4u_edu import TargetFallReward
from ai4u_edu.base.errors import BlockError
from tests.builders import small_sim, small_world


def test_it_pays_once_as_soon_as_the_target_falls() -> None:
    reward = TargetFallReward(target="box", success_reward=5, fail_reward=-0.5)
    sim = small_sim(rewards=[reward], world=small_world(plate=10))
    paid = []
    for decision in range(80):
        if decision == 10:
            sim.world["box"].move_to(7, 0)
        sim.step()
        paid.append(sim.agents[0].reward)
    assert sim.world["box"].fallen
    assert paid == [-0.5] * 10 + [5.0] + [-0.5] * 69
    sim.reset()
    sim.step()
    assert sim.agents[0].reward == -0.5


def test_what_left_the_world_is_below_anything() -> None:
    reward = TargetFallReward(target="box", cause_episode_to_end=True)
    sim = small_sim(rewards=[reward], world=small_world())
    sim.world["box"].leave()
    sim.step()
    assert (sim.agents[0].reward, sim.agents[0].terminated) == (1.0, True)


def test_its_own_fall_is_nothing_to_it() -> None:
    reward = TargetFallReward(target="box")
    sim = small_sim(rewards=[reward], world=small_world(plate=10))
    sim.agents[0].body.move_to(7, 0)
    sim.step()
    assert sim.agents[0].reward == 0.0


def test_an_unknown_target() -> None:
    with pytest.raises(BlockError, match="no body is named 'bx'; did you mean 'box'"):
        small_sim(rewards=[TargetFallReward(target="bx")])
