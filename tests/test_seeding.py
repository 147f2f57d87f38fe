"""Chance comes from one seed an episode."""

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


def test_bad_seed() -> None:
    with pytest.raises(ValueError, match=r"^seed: expected a whole number >= 0, got -1$"):
        Seeds(-1)
