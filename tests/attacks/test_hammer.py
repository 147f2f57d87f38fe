"""Pages and scripts at one world, all at once; ``python -m tests.attacks.hammer`` takes longer."""

import pytest

from tests.attacks.hammer import hammer

pytestmark = pytest.mark.alone


def test_pages_and_scripts_hammer_one_world_and_it_goes_on() -> None:
    tally = hammer(3.0, "box_chase", seed=3, ends_within=60)  # other tests may use the cores
    assert tally.wrong == []
    assert tally.done["commands done"] > 10
    assert tally.done["messages of a keyboard"] > 20
