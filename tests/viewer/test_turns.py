"""Pages that are drawn in turn."""

import pytest

from ai4u_edu.viewer.backend.turns import AT_ONCE, Turns


@pytest.mark.parametrize("pages", [1, AT_ONCE, AT_ONCE + 1, 100])
def test_all_have_had_their_turn_after_the_rounds(pages: int) -> None:
    turns, drawn = Turns(), []
    for _ in range(Turns.rounds(pages)):
        now = turns.next(range(pages))
        assert len(now) == len(set(now)) == min(pages, AT_ONCE)
        drawn += now
    assert set(drawn) == set(range(pages))


def test_pages_may_go_meanwhile() -> None:
    turns = Turns()
    turns.next(range(100))
    assert turns.next(range(3)) == [0, 1, 2]
    assert turns.next(()) == []
    assert Turns.rounds(0) == 1
