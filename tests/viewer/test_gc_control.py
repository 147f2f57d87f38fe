"""What Python's search for garbage looks at while pages are there."""

import gc
from collections.abc import Iterator
from weakref import ref

import pytest

from ai4u_edu.viewer.backend.gc_control import MANY, NEW, SETTLED, Housekeeping


class Knot:
    """Garbage as soon as nobody else has it."""

    def __init__(self) -> None:
        self.itself = self


class Clock:
    now = 0.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock() -> Iterator[Clock]:
    before = gc.get_threshold()
    gc.disable()
    yield Clock()
    gc.enable()
    gc.unfreeze()
    gc.set_threshold(*before)


def test_what_stays_is_set_aside_when_pages_have_settled(clock: Clock) -> None:
    usual = gc.get_threshold()
    housekeeping, pages = Housekeeping(clock), {1: "page"}
    assert gc.get_threshold()[0] == NEW
    housekeeping.look(pages.keys())
    knot, stays = ref(Knot()), Knot()
    clock.now += SETTLED / 2
    housekeeping.look(pages.keys())
    assert knot() is not None
    before = gc.get_freeze_count()
    clock.now += SETTLED
    housekeeping.look(pages.keys())
    assert knot() is None
    assert gc.get_freeze_count() > before
    assert not any(each is stays for each in gc.get_objects())
    housekeeping.end()
    assert gc.get_freeze_count() == 0
    assert gc.get_threshold() == usual


def test_it_is_done_once(clock: Clock) -> None:
    before = gc.get_freeze_count()
    housekeeping = Housekeeping(clock)
    assert gc.get_freeze_count() > before + 1000  # what is there to begin with
    for pages in ({1}, {1}, {1}):
        housekeeping.look(pages)
        knot = ref(Knot())
        clock.now += SETTLED
    housekeeping.look({1})
    assert knot() is not None


@pytest.mark.parametrize(("gone", "is_found"), [(1, False), (MANY, True)])
def test_what_pages_left_behind_is_found_when_many_have_gone(
    gone: int, is_found: bool, clock: Clock
) -> None:
    housekeeping, knot = Housekeeping(clock), Knot()
    left = ref(knot)
    for pages in (range(100), range(100 - gone)):
        housekeeping.look(frozenset(pages))
        clock.now += SETTLED
        housekeeping.look(frozenset(pages))
        knot = Knot()
    assert (left() is None) == is_found
