"""A training by PPO: what it keeps, when it ends, and that it can go on."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ai4u_edu.base.errors import SetupError
from ai4u_edu.learn.small.actor_critic import ActorCritic
from ai4u_edu.learn.small.ppo import PpoSettings
from ai4u_edu.learn.small.ppo_training import PolicyCheck, PpoTraining
from tests.learn.small.corridor import FEW, corridor

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("chooses", [False, True])
def test_it_learns(chooses: bool) -> None:
    settings = PpoSettings(worlds=8, steps=32, check_every=512, check_episodes=3)
    training = PpoTraining(corridor(chooses=chooses), settings, seed=1)
    training.learn(20_000)
    assert training.is_enough
    assert training.best_check is not None
    assert training.best_check.success == 1.0


def test_the_same_seed_gives_the_same_network() -> None:
    one, same, other = (PpoTraining(corridor(), FEW, seed=seed) for seed in (1, 1, 2))
    for training in (one, same, other):
        training.learn(100)
    assert np.array_equal(one.ppo.network.parameters, same.ppo.network.parameters)
    assert one.checks == same.checks
    assert not np.array_equal(one.ppo.network.parameters, other.ppo.network.parameters)


def test_a_budget_counts_decisions() -> None:
    training = PpoTraining(corridor(), FEW)
    training.learn(100)
    assert training.ppo.decisions == 128  # four rounds of 2 worlds with 16 decisions
    assert [check.decisions for check in training.checks] == [64, 128]


def test_weights_change_the_reward_and_nothing_else() -> None:
    plain = PpoTraining(corridor(), FEW).check()
    weighted = PpoTraining(corridor(), FEW, reward_weights={"touch": 0.0, "min_dist": 10.0}).check()
    assert weighted.score == plain.score
    assert plain.reward == plain.score
    assert weighted.reward != plain.reward
    assert (weighted.success, weighted.length) == (plain.success, plain.length)


def test_with_other_rewards_the_best_network_is_the_one_they_ask_for() -> None:
    training = PpoTraining(corridor(), FEW, reward_weights={"touch": -1.0})
    training.checks = [check(success=1.0, reward=-1.0), check(success=0.0, reward=0.0)]
    assert training.best_check == training.checks[1]
    assert not replace_all(training, success=1.0).is_enough
    training = PpoTraining(corridor(), FEW)
    training.checks = [check(success=1.0, reward=-1.0), check(success=0.0, reward=0.0)]
    assert training.best_check == training.checks[0]
    assert replace_all(training, success=1.0).is_enough


def check(**changes: Any) -> PolicyCheck:
    return replace(PolicyCheck(0, 0.0, 0.0, 0.0, 10.0), **changes)


def replace_all(training: PpoTraining, **changes: Any) -> PpoTraining:
    training.checks = [replace(each, **changes) for each in training.checks]
    return training


def test_the_best_network_is_kept() -> None:
    training = PpoTraining(corridor(), FEW)
    training.ppo.network.actor.biases[-1][0] = 1.0  # straight to the box
    best = training.check()
    assert best.success == 1.0
    kept = training.ppo.network.parameters.copy()
    training.ppo.network.actor.parameters[:] = 0.0  # it stands still
    assert training.check().success == 0.0
    assert training.best_check == best
    assert np.array_equal(training.best.parameters, kept)


def test_a_training_goes_on_from_its_file(tmp_path: Path) -> None:
    training = PpoTraining(corridor(), FEW, seed=3, reward_weights={"min_dist": 2.0})
    training.learn(100)
    training.save(tmp_path / "state.npz")
    other = PpoTraining.resume(tmp_path / "state.npz", corridor())
    assert np.array_equal(other.ppo.network.parameters, training.ppo.network.parameters)
    assert np.array_equal(other.best.parameters, training.best.parameters)
    assert (other.ppo.decisions, other.checks, other.ppo.reward_weights, other.ppo.seed) == (
        training.ppo.decisions,
        training.checks,
        training.ppo.reward_weights,
        3,
    )
    other.learn(200)
    assert other.ppo.decisions == 224
    assert not np.array_equal(other.ppo.network.parameters, training.ppo.network.parameters)


def test_a_file_of_another_kind_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "state.npz"
    PpoTraining(corridor(), FEW).save(path)
    for content in (b"", b"no training", path.read_bytes()[:5000]):
        path.write_bytes(content)
        with pytest.raises(SetupError, match="expected a saved training"):
            PpoTraining.resume(path, corridor())


@pytest.mark.parametrize("name", ["key_actions", "best", "state"])
def test_a_file_that_lacks_an_array_is_refused(tmp_path: Path, name: str) -> None:
    path = tmp_path / "state.npz"
    PpoTraining(corridor(), FEW).save(path)
    with np.load(path) as file:
        arrays = {each: file[each] for each in file.files if each != name}
    np.savez(path, **arrays)
    with pytest.raises(SetupError, match=f"expected a saved training of this agent: .*{name}"):
        PpoTraining.resume(path, corridor())


def test_a_training_of_another_agent_is_refused(tmp_path: Path) -> None:
    PpoTraining(corridor(), FEW).save(tmp_path / "state.npz")
    with pytest.raises(SetupError, match="expected a saved training of this agent"):
        PpoTraining.resume(tmp_path / "state.npz", corridor(chooses=True))


def test_a_training_that_began_with_a_network_of_other_layers_goes_on(tmp_path: Path) -> None:
    clone = PpoTraining(corridor(), replace(FEW, layers=(8,))).ppo.network
    training = PpoTraining(corridor(), FEW, begin_with=clone)
    training.save(tmp_path / "state.npz")
    assert PpoTraining.resume(tmp_path / "state.npz", corridor()).ppo.network.layers == (8,)


def test_a_training_that_began_with_a_clone_of_key_drives_goes_on(tmp_path: Path) -> None:
    plain = PpoTraining(corridor(), FEW).ppo.network
    keys = np.array([[0.0, 0, 0, 0], [0.5, 0, 0, 0], [0, 0.5, 0, 0]])
    clone = ActorCritic(plain.observation_space, plain.action_space, (8,), keys)
    clone.draw(np.random.default_rng(0))
    training = PpoTraining(corridor(), FEW, begin_with=clone)
    training.learn(64)
    assert not np.array_equal(training.ppo.network.parameters, clone.parameters)
    training.save(tmp_path / "state.npz")
    other = PpoTraining.resume(tmp_path / "state.npz", corridor())
    seen = np.random.default_rng(1).normal(size=(20, len(clone.middle)))
    actions = other.ppo.network.act(seen)
    assert np.array_equal(actions, training.ppo.network.act(seen))
    assert {tuple(action) for action in actions.tolist()} <= set(map(tuple, keys.tolist()))
    other.learn(128)
    assert other.ppo.decisions == 128


def test_a_practice_makes_the_keys_of_a_clone_stronger() -> None:
    plain = PpoTraining(corridor(), FEW).ppo.network
    keys = np.array([[0.0, 0, 0, 0], [0.25, 0.125, 0, 0], [1, 0, 0, 0]])
    clone = ActorCritic(plain.observation_space, plain.action_space, (8,), keys)
    clone.draw(np.random.default_rng(0))
    network = PpoTraining(corridor(), FEW, begin_with=clone).ppo.network
    assert network.key_actions is not None
    assert network.key_actions.tolist() == [*keys.tolist(), [1, 0.5, 0, 0]]
    seen = np.random.default_rng(1).normal(size=(20, len(clone.middle)))
    assert np.array_equal(network.act(seen), clone.act(seen))
    assert np.array_equal(network.values(seen), clone.values(seen))
    again = PpoTraining(corridor(), FEW, begin_with=network).ppo.network
    assert np.array_equal(again.parameters, network.parameters)


def test_an_episode_of_a_check_is_cut_off() -> None:
    training = PpoTraining(corridor(), replace(FEW, check_decisions=3))
    training.ppo.network.actor.parameters[:] = 0.0  # it stands still
    assert training.check().length == 3.0
