"""Chance comes from one seed an episode."""

from zlib import crc32

import numpy as np
import pytest

from ai4u_edu.seeding import Seeds


def test_children_do_not_depend_on_each_other() -> None:
    one, other = Seeds(5), Seeds(5)
    other.child("a").random(100)
    assert one.child("b").random() == other.child("b").random()


def test_the_next_episode_follows_from_the_seed_alone() -> None:
    one, other = Seeds(5), Seeds(5)
    other.generator.random(100)
    assert one.next().seed == other.next().seed != 5


@pytest.mark.parametrize("seed", [0, 7, 2**32 - 1, 2**32, 2**70 + 3])
def test_a_generator_is_numpys_own_of_the_seed_and_the_names_checksum(seed: int) -> None:
    for name in ("", "vision", "random/box 1"):
        expected = np.random.default_rng([seed, crc32(name.encode())])
        assert Seeds(seed).child(name).random(5).tolist() == expected.random(5).tolist()


def test_bad_seed() -> None:
    with pytest.raises(ValueError, match=r"^seed: expected a whole number >= 0, got -1$"):
        Seeds(-1)
