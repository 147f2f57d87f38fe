"""Watch of a shown world, which ends an endless loop in a student's code."""

import threading
from collections.abc import Sequence

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.block_errors import sentence_of
from ai4u_edu.agent.block_frames import frames_of_thread
from ai4u_edu.lessons.student_errors import is_students, line_of, mistake_in
from ai4u_edu.lessons.time_limit import CALL_LIMIT_S, TimeLimitError, endless_call, raise_in
from ai4u_edu.runtime.runner import Runner

POLL_S = 0.5


class StallWatch:
    """Thread that raises an error in a world's thread when a student's code does not return.

    The page then shows a sentence with the line, as it does for other errors of that code.

    Args:
        runner: runs the world; its errors are described by this object from now on.
        limit_s: longest time of one call, seconds.
        poll_s: interval of the looks, seconds.
    """

    def __init__(
        self, runner: Runner, limit_s: float = CALL_LIMIT_S, poll_s: float = POLL_S
    ) -> None:
        self._runner, self._limit_s, self._poll_s = runner, limit_s, poll_s
        self._text = ""
        self._stopped = threading.Event()
        self._thread = threading.Thread(target=self._watch, name="stall-watch", daemon=True)
        runner.describe_error = self.describe

    def start(self) -> None:
        """Begin to look."""
        self._thread.start()

    def stop(self) -> None:
        """End the thread, and a loop that outlives the world; call it after ``Runner.stop``."""
        self._stopped.set()
        if self._runner.is_left_behind:
            self._interrupt()

    def describe(self, error: BaseException, agents: Sequence[BasicAgent]) -> str:
        """Return the sentence on an error: with the student's line if there is one."""
        mistake = mistake_in(error) if line_of(error) else None
        if isinstance(error, TimeLimitError):
            text = self._text
        elif mistake is not None:
            text = mistake.text
        else:
            text = sentence_of(error, agents)
        return text.replace("`", '"')  # the page shows no code in a sentence

    def _watch(self) -> None:
        seen = None
        while not self._stopped.wait(self._poll_s):
            stall = self._runner.stall
            since = None if stall is None or stall.seconds < self._limit_s else stall.since
            # looked at twice: a computer that slept goes on in the middle of a call
            if since is not None and since == seen:
                self._interrupt()
            seen = since

    def _interrupt(self) -> None:
        """Raise an error in the world's thread if it is in a student's code."""
        thread = self._runner.thread_id
        calls = [
            frame
            for frame in reversed(frames_of_thread(thread))
            if is_students(frame.f_code.co_filename)
        ]
        if calls:
            self._text = endless_call(calls, self._limit_s)
            raise_in(thread, TimeLimitError)
