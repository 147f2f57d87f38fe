"""Every block explains itself."""

import pytest

from ai4u_edu import Block
from ai4u_edu.blocks.lesson_page import built_in_blocks, lesson_page, summary
from ai4u_edu.errors import NameNotFoundError

BLOCKS = [cls for kind in built_in_blocks().values() for cls in kind]


@pytest.mark.parametrize("cls", BLOCKS, ids=lambda cls: cls.__name__)
def test_a_page_has_a_summary_and_all_parameters(cls: type[Block]) -> None:
    page = lesson_page(cls.__name__)
    assert len(summary(cls)) > 20
    for name in cls.parameters():
        assert f"\n{name} " in page


def test_exactly() -> None:
    lines = lesson_page("VelocitySensor").splitlines()
    assert "max_speed             20.0     0..10000 m" in lines
    needed = lesson_page("BearingSensor")
    assert "target                (needed)  text" in needed


def test_an_unknown_block() -> None:
    with pytest.raises(NameNotFoundError, match="did you mean 'BearingSensor'"):
        lesson_page("BearingSenser")
