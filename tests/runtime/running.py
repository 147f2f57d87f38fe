"""Runners with a thread of their own, and waits for what it does."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from ai4u_edu.blocks.keyboard import Keyboard
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import Snapshot
from tests.waiting import LIMIT_S, Deadline


@contextmanager
def running(runner: Runner) -> Iterator[Runner]:
    """Run a world in a thread, and see to it that the thread ends.

    Keys are held until they are released, although a busy machine is silent for too long.
    """
    for agent in runner.sim.agents:
        agent.keyboard = Keyboard(clock=lambda: 0.0)
    runner.start()
    try:
        yield runner
    finally:
        runner.stop(LIMIT_S)
    assert not runner.is_left_behind


def wait_for(runner: Runner, condition: Callable[[Snapshot], object]) -> Snapshot:
    """Wait for a snapshot with a property, and return it; none is missed for long."""
    deadline = Deadline()
    seen = runner.latest
    while not condition(seen):
        seen = runner.wait(seen, deadline.left())
    return seen


def wait_for_tick(runner: Runner, tick: int) -> None:
    wait_for(runner, lambda snapshot: snapshot.tick >= tick)
