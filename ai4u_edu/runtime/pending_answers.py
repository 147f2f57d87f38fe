"""The count of answers that remote brains owe, and the wait for the last one."""

import threading
from collections.abc import Callable

from ai4u_edu.agent.cycle import ControlRequestor

ANSWER_POLL_S = 0.015
"""Poll interval for brains whose answer is late, while a world waits for answers."""
HOLD_POLL_S = 0.001
"""Poll interval for brains that hold the world without announcing an answer."""


class PendingAnswers:
    """Counts the answers that the runner's thread waits for.

    The runner's thread clears and waits; links expect and notify, from any thread. A lock guards
    the count.

    Args:
        wake: set when the last answer that was expected is there, or a command comes.
        clock: seconds.
    """

    def __init__(self, wake: threading.Event, clock: Callable[[], float]) -> None:
        self._wake, self._clock = wake, clock
        self._lock = threading.Lock()
        self._count = 0

    def clear(self) -> None:
        """Expect nothing."""
        with self._lock:
            self._count = 0

    def expect(self, answers: int = 1) -> int:
        """Expect ``answers`` more answers, and return how many are outstanding."""
        with self._lock:
            self._count += answers
            return self._count

    def notify(self) -> None:
        """Note an answer. The caller's thread does nothing else: the next tick may take long."""
        with self._lock:
            self._count -= 1
            is_last = self._count <= 0
        if is_last:
            self._wake.set()

    def wait(
        self, sim: ControlRequestor, began: float, all_keep_waiting: Callable[[], bool]
    ) -> None:
        """Wait until all answers that links have announced are there, or a command comes.

        Args:
            sim: the world and its agents.
            began: time of the clock at which the brains were asked.
            all_keep_waiting: returns True if no brain needs to be asked again until then.
        """
        if sim.waiting_for_brain:
            announced = 0  # the links have done so when they were asked
        elif all_keep_waiting():
            announced = len(sim.agents)  # they have their percepts, and need not be asked
        else:
            return
        if self.expect(announced) > 0:
            self._wake.wait(ANSWER_POLL_S)
        elif self._clock() - began < HOLD_POLL_S:
            self._wake.wait(HOLD_POLL_S)
