"""PPO in NumPy: what it learns from."""

from dataclasses import replace

import numpy as np
import pytest

from ai4u_edu.base.errors import AI4UError, SetupError
from ai4u_edu.learn.envs import SceneEnv
from ai4u_edu.learn.small.ppo import FIRST_SEED, Ppo
from tests.learn.small.corridor import FEW, corridor

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("chooses", [False, True])
def test_it_learns_from_real_decisions_alone(chooses: bool) -> None:
    """An environment that gets the same actions sees and pays the same, reset for reset.

    A world whose episode ends begins the next one in the same step, so that no decision is spent on
    that; what would have come after an episode that was cut off counts, after one that ended it
    does not.
    """
    # it trusts the critic's guess of what comes after a decision alone, which can be compared
    settings = replace(FEW, steps=60, trust=0.0)
    ppo = Ppo(corridor(chooses=chooses), settings)
    network = ppo.network
    if not chooses:
        network.actor.biases[-1][0] = 1.0  # ahead, so that some episodes end at the box
    experience = ppo.drive()
    ends: set[str] = set()
    for world in range(settings.worlds):
        env = SceneEnv(corridor(chooses=chooses), observation="flat")
        seen, _ = env.reset(seed=FIRST_SEED + world)
        for step, taken in enumerate(experience.taken[:, world]):
            np.testing.assert_array_equal(experience.inputs[step, world], network.scaled(seen))
            (action,) = network.to_actions(taken[None])
            seen, reward, terminated, truncated, _ = env.step(action)
            after = 0.0 if terminated else network.values(seen[None])[0]
            expected = reward + settings.discount * after
            assert experience.returns[step, world] == pytest.approx(expected, abs=1e-5)
            if terminated or truncated:
                ends.add("terminated" if terminated else "truncated")
                seen, _ = env.reset()
    assert "truncated" in ends
    assert chooses or "terminated" in ends


def test_it_begins_with_the_network_that_it_gets() -> None:
    clone = Ppo(corridor(), FEW, seed=5).network
    ppo = Ppo(corridor(), FEW, begin_with=clone)
    assert np.array_equal(ppo.network.actor.parameters, clone.actor.parameters)
    assert np.exp(clone.log_spread) == pytest.approx(0.6)
    assert np.exp(ppo.network.log_spread) == pytest.approx(0.2)  # so that it keeps what it can
    ppo.improve()
    assert not np.array_equal(ppo.network.actor.parameters, clone.actor.parameters)


def test_a_network_of_another_agent_is_refused() -> None:
    other = Ppo(corridor(chooses=True), FEW).network
    with pytest.raises(SetupError, match="begin_with: expected a network of this agent"):
        Ppo(corridor(), FEW, begin_with=other)


def test_an_unknown_reward_term_is_refused() -> None:
    with pytest.raises(SetupError, match=r"no reward term is called 'tuch'.*'touch'"):
        Ppo(corridor(), FEW, reward_weights={"tuch": 2.0})


def test_numbers_that_are_not_finite_end_a_training() -> None:
    ppo = Ppo(corridor(), FEW)
    ppo.network.critic.parameters[:] = np.nan
    with pytest.raises(AI4UError, match="not finite any more"):
        ppo.improve()
