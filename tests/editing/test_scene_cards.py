"""Cards of scenes that can be chosen."""

from ai4u_edu.editing.scene_cards import card


def test_a_card_tells_level_and_time() -> None:
    found = card("box_chase")
    assert (found.level, found.minutes) == ("easy", 2)
