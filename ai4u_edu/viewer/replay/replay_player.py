"""Shows the past to all who look: which episode, and which moment of it."""

import threading
from concurrent.futures import CancelledError, Future
from contextlib import suppress

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.recording import Archive, ArchiveEntry, RecordingError
from ai4u_edu.recording.frame_cache import FrameCache
from ai4u_edu.runtime.runner import Runner

NOW = 0
"""The number of the episode that is under way."""
LONGEST_BREAK = 1.0
"""Seconds for which a moment is shown at most while it plays: nobody has to wait twice."""


class ReplayPlayer:
    """One for all pages: a class looks at the same moment. Any thread may ask it for things.

    Args:
        runner: shows the pictures, and has the episodes.
    """

    def __init__(self, runner: Runner) -> None:
        self._runner = runner
        self.frame_cache: FrameCache | None = None
        """Of the episode that was chosen."""
        self.number: int | None = None
        """Of that episode; :data:`NOW` for the one that is under way."""
        self.step = 0
        """The moment that is wanted."""
        self.playing = False
        self.speed = 1.0
        """How fast it plays; 1 is the world's own time."""
        self.problem = ""
        """Why something could not be shown."""
        self._wish = 0
        self._wanted = False
        self._goes_on = False
        self._stopping = False
        self._changed = threading.Condition()
        self._thread: threading.Thread | None = None

    @property
    def archive(self) -> Archive | None:
        """The episodes that are kept; None if none are recorded."""
        recorder = self._runner.recorder
        return None if recorder is None else recorder.episodes

    @property
    def is_showing(self) -> bool:
        """Whether it is the past that is seen now."""
        return bool(self._runner.latest.past)

    def open(self, number: int, agent: str = "", step: int | None = None) -> None:
        """Chooses an episode; its pictures are made, and the present goes on.

        Args:
            number: in the archive; :data:`NOW` for the one that is under way, as far as it got.
            agent: the id of the one whose decisions are gone through, if it has it; else it is the
                one that acts first.
            step: the moment that is wanted at once, if one is; below 0 it counts from the end.
        """
        if number != NOW:
            entry = self.archive.find(number) if self.archive is not None else None
            self._load(entry, number, agent, step)
            return

        def take() -> ArchiveEntry | None:
            recorder = self._runner.recorder
            episode = recorder.current_episode() if recorder is not None else None
            if recorder is None or episode is None or not len(episode.agents[0]):
                return None
            return ArchiveEntry(recorder.episodes.next_number, episode)

        self._runner.submit(take).add_done_callback(
            lambda done: self._load(None if done.cancelled() else done.result(), NOW, agent, step)
        )

    def go_to(self, step: int) -> None:
        """Shows a moment: a decision, by its number from 0 on."""
        if self.number == NOW and self.frame_cache is not None and not self.is_showing:
            self.open(NOW, self.frame_cache.record.id, step)  # it may have gone on since
        else:
            self._want(step)

    def move(self, steps: int) -> None:
        """Goes some decisions on, or back."""
        frame_cache = self.frame_cache
        if self.number == NOW and frame_cache is not None and not self.is_showing:
            self.open(NOW, frame_cache.record.id, min(steps, 0) - 1)  # from now, and not from then
        else:
            self.go_to(self.step + steps)

    def play(self, *, on: bool = True) -> None:
        """Lets the moments follow each other; from the beginning, if it is at its end."""
        frame_cache = self.frame_cache
        if frame_cache is None:
            return
        self._want(0 if on and self.step >= frame_cache.last else self.step, playing=on)

    def back(self) -> "Future[None]":
        """Back to now."""
        self.leave()
        return self._runner.show_past(None)

    def leave(self) -> None:
        """Shows nothing more of the past, whatever was wanted; what is seen stays for now."""
        with self._changed:
            self._wish, self._wanted, self.playing = self._wish + 1, False, False
            self._changed.notify_all()

    def go_on(self) -> "Future[None]":
        """Has the world go on from the moment that is wanted; may take as long as to play it all.

        Returns:
            What the runner answers; a :class:`~ai4u_edu.recording.RecordingError` if it can't be.
        """
        frame_cache, step = self.frame_cache, self.step
        if frame_cache is None:
            return _failed("choose an episode first")
        self.leave()
        frame_cache.snapshot(
            min(step, max(frame_cache.last, 0)), timeout=None
        )  # then it is known how it goes
        if frame_cache.replay is None:
            return _failed(frame_cache.problem)
        try:
            # after the last decision there is none in whose place something else could be done
            last = len(frame_cache.record) - 1
            return self._runner.continue_from(
                frame_cache.replay, min(step, last), agent=frame_cache.record.id
            )
        except AI4UError as error:
            return _failed(str(error))

    def stop(self) -> None:
        """Ends the threads."""
        with self._changed:
            self._stopping = True
            self._changed.notify_all()
        if self._thread is not None:
            self._thread.join()
        if self.frame_cache is not None:
            self.frame_cache.stop()

    # -- how -------------------------------------------------------------------------------------

    def _load(self, entry: ArchiveEntry | None, number: int, agent: str, step: int | None) -> None:
        if entry is None:
            self.problem = (
                "nothing of it is recorded yet"
                if number == NOW
                else f"episode {number} is not kept any more"
            )
            return
        known = agent if agent in entry.episode.ids else None
        frame_cache = FrameCache(entry.episode, agent=known, number=entry.number)
        with self._changed:
            before, self.frame_cache, self.number = self.frame_cache, frame_cache.start(), number
            # who looks at what is under way wants to go back from where it is
            self.step = frame_cache.last if number == NOW else 0
            self._wish, self._wanted = self._wish + 1, False
            self.playing, self.problem = False, ""
        if before is not None:
            before.stop(wait=False)
        if self.is_showing or step is not None:
            wanted = self.step if step is None else step
            self._want(wanted if wanted >= 0 else frame_cache.last + 1 + wanted)

    def _want(self, step: int, *, playing: bool = False) -> None:
        frame_cache = self.frame_cache
        if frame_cache is None:
            return
        with self._changed:
            self.step = min(max(step, 0), max(frame_cache.last, 0))
            self._wish, self._wanted, self.playing = self._wish + 1, True, playing
            self._goes_on = False
            if self._thread is None and not self._stopping:
                self._thread = threading.Thread(target=self._run, name="past", daemon=True)
                self._thread.start()
            self._changed.notify_all()

    def _run(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._wanted or self._stopping)
                if self._stopping:
                    return
                self._wanted = False
                wish, frame_cache, step = self._wish, self.frame_cache, self.step
                goes_on, self._goes_on = self._goes_on, False
            if frame_cache is None or not self._show(frame_cache, step, wish, goes_on=goes_on):
                continue
            if self.playing:
                self._play_on(frame_cache, step, wish)

    def _show(self, frame_cache: FrameCache, step: int, wish: int, *, goes_on: bool) -> bool:
        """Shows a picture as soon as it is there; whether it was shown."""
        while (picture := frame_cache.snapshot(step, timeout=0.25)) is None:
            if wish != self._wish or self._stopping:
                return False
            if not frame_cache.is_alive or step > frame_cache.last:
                self.problem, self.playing = frame_cache.problem or "there is nothing to see", False
                return False
        with self._changed:
            if wish != self._wish:
                return False
            shown = self._runner.show_past(picture, goes_on=goes_on)
        with suppress(CancelledError, TimeoutError):
            shown.result(1.0)
        return True

    def _play_on(self, frame_cache: FrameCache, step: int, wish: int) -> None:
        """Waits as long as this moment took then, and wants the next one."""
        here = frame_cache.snapshot(step)
        there = frame_cache.snapshot(step + 1, timeout=5.0) if step < frame_cache.last else None
        if here is None or there is None or not self.is_showing:  # somebody had the world go on
            self.playing = False
            return
        pause = min((there.time - here.time) / self.speed, LONGEST_BREAK)
        with self._changed:
            self._changed.wait_for(lambda: wish != self._wish or self._stopping, pause)
            if wish == self._wish:
                self.step, self._wanted, self._goes_on = step + 1, True, True


def _failed(why: str) -> "Future[None]":
    future: Future[None] = Future()
    future.set_exception(RecordingError(why))
    return future
