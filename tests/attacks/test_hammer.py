"""Pages and scripts at one world, all at once; ``python -m tests.attacks.hammer`` takes longer."""

import pytest

from tests.attacks.hammer import hammer
from tests.waiting import LIMIT_S

pytestmark = pytest.mark.alone


def test_pages_and_scripts_hammer_one_world_and_it_goes_on() -> None:
    enough = {"commands done": 11, "messages of a keyboard": 21}
    tally = hammer(3.0, "box_chase", seed=3, ends_within=LIMIT_S, at_least=enough)
    assert tally.wrong == []
