"""A clone does what its drives show, and knows how well."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from gymnasium import spaces

from ai4u_edu.base.errors import SetupError
from ai4u_edu.learn.small.behaviour_cloning import (
    CONTRADICTION,
    ONE_CHOICE,
    ONE_DRIVE,
    STOOD_STILL,
    CloningResult,
    DriveData,
    clone_drives,
)


def f32(numbers: Any) -> npt.NDArray[np.float32]:
    return np.array(numbers, np.float32)


READINGS = spaces.Box(-1, 1, (3,))
TURN = spaces.Box(f32([-2, 0]), f32([2, 1]))
CHOICES = spaces.Discrete(3, start=5)
UPDATES = 300


def drives(count: int, length: int = 60, seed: int = 0) -> list[DriveData]:
    """Drives that turn towards a light with full force, and jump if the last reading is high."""
    generator = np.random.default_rng(seed)
    found = []
    for _ in range(count):
        seen = generator.uniform(-1, 1, (length, 3)).astype(np.float32)
        actions = np.stack([2 * np.sign(seen[:, 0]), seen[:, 2] > 0.5], axis=1)
        found.append(DriveData(seen, actions.astype(np.float32)))
    return found


def learn(
    shown: Sequence[DriveData], space: spaces.Space[Any] = TURN, seed: int = 0
) -> CloningResult:
    return clone_drives(shown, READINGS, space, updates=UPDATES, seed=seed)


def test_numbers_are_learned_with_their_ranges() -> None:
    clone = learn(drives(6))
    actions = clone.network.act(f32([[0.8, 0, 0], [-0.8, 0, 0.9]]))
    np.testing.assert_allclose(actions, [[2, 0], [-2, 1]], atol=0.2)
    assert clone.alike > 0.8
    assert clone.commonest < 0.6
    assert clone.held_out == 60
    assert clone.remarks == ()
    assert clone.errors[0][0] == 0  # before it has learned anything
    assert clone.errors[-1][0] == UPDATES
    assert clone.errors[-1][1] < clone.errors[0][1]


def test_choices_are_learned_as_choices() -> None:
    shown = [
        DriveData(drive.observations, 5 + np.digitize(drive.observations[:, 0], [-0.3, 0.3]))
        for drive in drives(6)
    ]
    clone = learn(shown, CHOICES)
    assert clone.network.act(f32([[-1, 0, 0], [0, 0, 0], [1, 0, 0]])).tolist() == [5, 6, 7]
    assert clone.alike > 0.8


def test_the_observation_after_the_last_decision_teaches_nothing() -> None:
    with_last = [
        DriveData(np.concatenate([drive.observations, np.ones((1, 3))]), drive.actions)
        for drive in drives(2)
    ]
    one, other = learn(drives(2)), learn(with_last)
    assert np.array_equal(one.network.parameters, other.network.parameters)


def test_the_same_seed_gives_the_same_network() -> None:
    one, same, other = (learn(drives(3), seed=seed) for seed in (1, 1, 2))
    assert np.array_equal(one.network.parameters, same.network.parameters)
    assert (one.alike, one.errors) == (same.alike, same.errors)
    assert not np.array_equal(one.network.parameters, other.network.parameters)


def test_rewards_teach_the_critic_what_a_moment_is_worth() -> None:
    seen = np.linspace(-1, 1, 50, dtype=np.float32)[:, None] * np.ones((1, 3), np.float32)
    rewards = np.zeros(50)
    rewards[-1] = 100.0  # as for a box that is reached
    drive = DriveData(seen, np.ones((50, 2), np.float32), rewards)
    first, last = learn([drive, drive]).network.values(seen[[0, -1]])
    assert last == pytest.approx(100.0, abs=10.0)
    assert first == pytest.approx(100.0 * 0.98**49, abs=10.0)


def test_without_rewards_the_critic_says_nothing() -> None:
    assert learn(drives(2)).network.values(np.ones((1, 3))).tolist() == [0.0]


@pytest.mark.parametrize("count", [1, 4])
def test_of_few_drives_blocks_are_held_out(count: int) -> None:
    clone = clone_drives(drives(count, 120), READINGS, TURN, block=10, updates=UPDATES)
    assert clone.held_out == round(0.2 * 12 * count) * 10


def test_held_out_moments_are_not_known_by_heart() -> None:
    # every drive does something else in the same moments: nothing can be learned from the others
    generator = np.random.default_rng(0)
    seen = generator.uniform(-1, 1, (40, 3)).astype(np.float32)
    shown = [DriveData(seen, generator.choice([-2.0, 2.0], (40, 2)) * [1, 0]) for _ in range(8)]
    assert learn(shown).alike < 0.7


def test_always_doing_the_commonest_scores_what_it_is_worth() -> None:
    seen = np.random.default_rng(0).uniform(-1, 1, (100, 3)).astype(np.float32)
    actions = np.tile(f32([2, 0]), (100, 1))
    actions[::4] = [-2, 0]  # every fourth
    shown = [DriveData(seen, actions) for _ in range(5)]
    assert learn(shown).commonest == 0.75


def test_one_drive_gets_a_sentence() -> None:
    assert learn(drives(1)).remarks == (ONE_DRIVE,)


def test_standing_still_gets_a_sentence() -> None:
    still = [DriveData(drive.observations, 0 * drive.actions) for drive in drives(3)]
    assert learn(still).remarks == (STOOD_STILL,)
    once = [DriveData(drive.observations, np.full(60, 6)) for drive in drives(3)]
    assert learn(once, CHOICES).remarks == (ONE_CHOICE,)


def test_contradicting_drives_get_a_sentence() -> None:
    shown = drives(3)
    shown += [DriveData(drive.observations, drive.actions * f32([-1, 1])) for drive in shown]
    assert learn(shown).remarks == (CONTRADICTION,)
    seen, actions = (
        np.concatenate([getattr(drive, name) for drive in shown])
        for name in ("observations", "actions")
    )
    one = [DriveData(seen, actions)]
    assert learn(one).remarks == (ONE_DRIVE,), "of one drive, none can be left out"


def test_a_reading_that_never_changed_is_left_out() -> None:
    shown = drives(5)
    for drive in shown:
        drive.observations[:, 1] = 0.25
    network = learn(shown).network
    seen = f32([[0.8, 0.25, 0], [0.8, -1, 0]])
    assert np.array_equal(*network.act(seen))


LIGHT = spaces.Box(-1, 1, (1,))
KEYS = f32([[-0.4, 0], [0.4, 0], [0, 0.5]])
"""Left, right, and straight on."""


def key_drives(count: int = 5, lag: int = 0, pause: int = 0) -> list[DriveData]:
    """Drives by keys towards a light whose bearing is the reading: left, right, or straight on.

    Args:
        count: of drives.
        lag: decisions between what is seen and the key that answers it.
        pause: decisions in the middle of a drive in which nothing is pressed nor moves.
    """
    generator = np.random.default_rng(0)
    drives = []
    for _ in range(count):
        seen = np.cumsum(generator.uniform(-0.3, 0.3, (60, 1)), axis=0)
        seen = np.clip(seen + generator.uniform(-1, 1), -1, 1)
        wanted = np.where(seen < -0.2, KEYS[0], np.where(seen > 0.2, KEYS[1], KEYS[2]))
        actions = np.concatenate([np.zeros((lag, 2)), wanted[: 60 - lag]])
        seen = np.insert(seen, [30] * pause, seen[30], axis=0)
        actions = np.insert(actions, [30] * pause, 0.0, axis=0)
        drives.append(DriveData(f32(seen), f32(actions)))
    return drives


def clone_of_person(drives: Sequence[DriveData], delay: int = 0) -> CloningResult:
    space = spaces.Box(f32([-1, 0]), f32([1, 1]))
    return clone_drives(drives, LIGHT, space, updates=1000, person_delay=delay)


BEARINGS = f32([[-0.9], [-0.4], [0], [0.4], [0.9]])
ANSWERS = KEYS[[0, 0, 2, 1, 1]]


def test_a_clone_of_key_drives_does_nothing_but_what_keys_do() -> None:
    clone = clone_of_person(key_drives())
    every = np.linspace(-1, 1, 500, dtype=np.float32)[:, None]
    assert np.array_equal(np.unique(clone.network.act(every), axis=0), np.unique(KEYS, axis=0))
    assert np.array_equal(clone.network.act(BEARINGS), ANSWERS)
    assert clone.alike > 0.9
    assert 0.0 < clone.errors[-1][1] < clone.errors[0][1] < 1.0


def test_a_stick_may_mean_any_number() -> None:
    seen = np.random.default_rng(0).uniform(-1, 1, (5, 60, 1)).astype(np.float32)
    shown = [DriveData(rows, np.concatenate([0.5 * rows, 0 * rows], axis=1)) for rows in seen]
    actions = clone_of_person(shown, delay=2).network.act(BEARINGS)
    np.testing.assert_allclose(actions[:, 0], 0.5 * BEARINGS[:, 0], atol=0.1)


def test_the_delay_of_a_person_is_not_learned() -> None:
    late = key_drives(lag=2)
    assert clone_of_person(late).alike < clone_of_person(late, delay=2).alike
    assert np.array_equal(clone_of_person(late, delay=2).network.act(BEARINGS), ANSWERS)


def test_pauses_of_a_person_are_not_learned() -> None:
    for drive in (paused := key_drives(pause=40)):
        drive.observations[30:71] = 0.8  # most of what it did there was to rest
    clone = clone_of_person(paused)
    assert np.array_equal(clone.network.act(f32([[0.8]])), KEYS[[1]])
    assert clone.held_out == 60


def test_to_stop_at_the_end_is_learned() -> None:
    shown = [
        DriveData(
            np.concatenate([drive.observations, np.full((20, 1), 0.8, np.float32)]),
            np.concatenate([drive.actions, np.zeros((20, 2), np.float32)]),
        )
        for drive in key_drives()
    ]
    assert clone_of_person(shown).network.act(f32([[0.8]])).tolist() == [[0, 0]]


def test_to_wait_until_something_is_seen_is_learned() -> None:
    # a light that is red or green: whoever waits sees something else afterwards
    light = np.repeat([-1.0, 1.0], 20)[:, None]
    drive = DriveData(f32(light), np.where(light > 0, KEYS[2], 0.0).astype(np.float32))
    actions = clone_of_person([drive] * 5).network.act(f32([[-1], [1]]))
    assert actions.tolist() == [[0, 0], KEYS[2].tolist()]


def test_drives_of_nobody_are_learned_as_they_are() -> None:
    space = spaces.Box(f32([-1, 0]), f32([1, 1]))
    network = clone_drives(key_drives(), LIGHT, space, updates=UPDATES).network
    assert network.key_actions is None


def test_a_short_drive_of_a_person_is_enough() -> None:
    short = DriveData(f32([[-0.5], [-0.5], [0.5]]), KEYS[[0, 0, 1]])
    assert clone_of_person([short] * 5, delay=2).network.act(BEARINGS).shape == (5, 2)


@pytest.mark.parametrize("length", [0, 1])
def test_too_little_to_learn_from(length: int) -> None:
    with pytest.raises(SetupError, match=f"at least 2 decisions, got {length}"):
        learn(drives(1, length))


def test_actions_without_a_range_cannot_be_learned() -> None:
    with pytest.raises(SetupError, match="one actuator whose numbers have a range, got Box"):
        learn(drives(2), spaces.Box(-np.inf, np.inf, (2,)))


def test_several_actuators_cannot_be_learned() -> None:
    several = spaces.Dict(move=TURN, arm=CHOICES)
    with pytest.raises(SetupError, match="expected an agent with one actuator to learn"):
        learn(drives(2), several)
