"""The player of recorded episodes, which shows the same decision on all pages."""

import threading
from concurrent.futures import Future, wait

from ai4u_edu.base.errors import AI4UError, text_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording import Archive, ArchiveEntry, RecordingError
from ai4u_edu.recording.frame_cache import FrameCache
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import Snapshot

RUNNING_EPISODE = 0
"""Number of the episode that is still running."""
MAX_PAUSE_S = 1.0
"""Longest time (s) between two decisions during playback, which shortens long waits."""
FRAME_POLL_S = 0.25
"""Interval (s) at which a wait for a frame checks whether the frame is still wanted."""


class ReplayPlayer:
    """The player that all pages share. Its public methods may be called from any thread.

    A thread of its own waits for the frames of the wanted decision and shows them; it starts with
    the first request. Each request has a new id, and work for an older id is dropped.

    Args:
        runner: shows the frames and holds the episodes.
    """

    def __init__(self, runner: Runner) -> None:
        self._runner = runner
        self.frame_cache: FrameCache | None = None
        """Frames of the chosen episode."""
        self.number: int | None = None
        """Number of that episode, or :data:`RUNNING_EPISODE`."""
        self.step = 0
        """The wanted decision, counted from 0; the end comes after the last decision."""
        self.is_playing = False
        self.speed = 1.0
        """Playback speed; 1 is the recorded speed."""
        self.problem = ""
        """The reason why something could not be shown."""
        self._request_id = 0
        self._has_request = False
        self._is_next_frame = False
        """True if the requested frame follows the shown one in a playback."""
        self._stopping = False
        self._changed = threading.Condition()
        self._thread: threading.Thread | None = None

    @property
    def archive(self) -> Archive | None:
        """The kept episodes; None if nothing is recorded."""
        recorder = self._runner.recorder
        return None if recorder is None else recorder.episodes

    @property
    def is_showing(self) -> bool:
        """True while the pages show a recorded frame instead of the present."""
        return bool(self._runner.latest.past)

    def open(self, number: int, agent: str = "", step: int | None = None) -> None:
        """Choose an episode and compute its frames, while the world continues.

        Args:
            number: the episode's number, or :data:`RUNNING_EPISODE` for the running one so far.
            agent: id of the agent whose decisions are stepped through; if the episode has no such
                agent, the one that acts first.
            step: decision to show at once; below 0 it counts from the end. None shows nothing yet.
        """
        if number != RUNNING_EPISODE:
            entry = self.archive.find(number) if self.archive is not None else None
            self._load(entry, number, agent, step)
            return

        def copy_running_episode() -> ArchiveEntry | None:
            recorder = self._runner.recorder
            episode = recorder.current_episode() if recorder is not None else None
            if recorder is None or episode is None or not len(episode.agents[0]):
                return None
            return ArchiveEntry(recorder.episodes.next_number, episode)

        self._runner.submit(copy_running_episode).add_done_callback(
            lambda done: self._load(
                None if done.cancelled() else done.result(), RUNNING_EPISODE, agent, step
            )
        )

    def go_to(self, step: int) -> None:
        """Show a decision, counted from 0."""
        if self.number == RUNNING_EPISODE and self.frame_cache is not None and not self.is_showing:
            # reload, because the running episode has continued since
            self.open(RUNNING_EPISODE, self.frame_cache.record.id, step)
        else:
            self._request(step)

    def move(self, steps: int) -> None:
        """Step forward by some decisions, or backward."""
        frame_cache = self.frame_cache
        if self.number == RUNNING_EPISODE and frame_cache is not None and not self.is_showing:
            # relative to the present, because the running episode has continued since
            self.open(RUNNING_EPISODE, frame_cache.record.id, min(steps, 0) - 1)
        else:
            self.go_to(self.step + steps)

    def play(self, *, on: bool = True) -> None:
        """Start or stop the playback; at the end of the episode it starts from the beginning."""
        frame_cache = self.frame_cache
        if frame_cache is None:
            return
        step = 0 if on and self.step >= frame_cache.last else self.step
        self._request(step, play=on)

    def return_to_present(self) -> "Future[None]":
        """Show the present again."""
        self.cancel()
        return self._runner.show_past(None)

    def cancel(self) -> None:
        """Drop the pending request and stop the playback; the shown frame stays."""
        with self._changed:
            self._request_id += 1
            self._has_request = self.is_playing = False
            self._changed.notify_all()

    def continue_from_here(self) -> "Future[None]":
        """Continue the world from the wanted decision.

        Blocks until the episode has been replayed up to there.

        Returns:
            The runner's result; :class:`~ai4u_edu.recording.RecordingError` if it is impossible.
        """
        frame_cache, step = self.frame_cache, self.step
        if frame_cache is None:
            return _failed(_("choose an episode first"))
        self.cancel()
        # wait for the frame: the replay exists from then on
        frame_cache.snapshot(min(step, max(frame_cache.last, 0)), timeout=None)
        if frame_cache.replay is None:
            return _failed(frame_cache.problem)
        try:
            # from the end, continue at the last decision, the last one that can be replaced
            last = len(frame_cache.record) - 1
            return self._runner.continue_from(
                frame_cache.replay, min(step, last), agent=frame_cache.record.id
            )
        except AI4UError as error:
            return _failed(text_of(error))

    def stop(self) -> None:
        """Stop the threads and wait for them."""
        with self._changed:
            self._stopping = True
            self._changed.notify_all()
        if self._thread is not None:
            self._thread.join()
        if self.frame_cache is not None:
            self.frame_cache.stop()

    # -- internals -------------------------------------------------------------------------------

    def _load(self, entry: ArchiveEntry | None, number: int, agent: str, step: int | None) -> None:
        if entry is None:
            self.problem = (
                _("nothing of it is recorded yet")
                if number == RUNNING_EPISODE
                else _("episode {number} is not kept any more", number=number)
            )
            return
        known = agent if agent in entry.episode.ids else None
        frame_cache = FrameCache(entry.episode, agent=known, number=entry.number)
        with self._changed:
            before, self.frame_cache, self.number = self.frame_cache, frame_cache.start(), number
            # in the running episode people step back from the present
            self.step = frame_cache.last if number == RUNNING_EPISODE else 0
            self._request_id += 1
            self._has_request = self.is_playing = False
            self.problem = ""
        if before is not None:
            before.stop(wait=False)
        if self.is_showing or step is not None:
            wanted = self.step if step is None else step
            self._request(wanted if wanted >= 0 else frame_cache.last + 1 + wanted)

    def _request(self, step: int, *, play: bool = False) -> None:
        frame_cache = self.frame_cache
        if frame_cache is None:
            return
        with self._changed:
            self.step = min(max(step, 0), max(frame_cache.last, 0))
            self._request_id += 1
            self._has_request, self.is_playing, self._is_next_frame = True, play, False
            if self._thread is None and not self._stopping:
                self._thread = threading.Thread(target=self._run, name="replay", daemon=True)
                self._thread.start()
            self._changed.notify_all()

    def _run(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._has_request or self._stopping)
                if self._stopping:
                    return
                self._has_request = False
                request_id, frame_cache, step = self._request_id, self.frame_cache, self.step
                goes_on, self._is_next_frame = self._is_next_frame, False
            if frame_cache is None:
                continue
            shown = self._show(frame_cache, step, request_id, goes_on=goes_on)
            if shown is not None and self.is_playing:
                self._request_next(frame_cache, shown, step, request_id)

    def _is_current(self, request_id: int) -> bool:
        return request_id == self._request_id and not self._stopping

    def _wait_for_frame(
        self, frame_cache: FrameCache, step: int, request_id: int
    ) -> Snapshot | None:
        """Wait for a frame; return None if there is none, or if it is no longer wanted."""
        while (snapshot := frame_cache.snapshot(step, timeout=FRAME_POLL_S)) is None:
            if not (
                self._is_current(request_id) and frame_cache.is_alive and step <= frame_cache.last
            ):
                return None
        return snapshot

    def _show(
        self, frame_cache: FrameCache, step: int, request_id: int, *, goes_on: bool
    ) -> Snapshot | None:
        """Wait for a frame, show it and return it; return None if it was not shown."""
        snapshot = self._wait_for_frame(frame_cache, step, request_id)
        with self._changed:
            if not self._is_current(request_id):
                return None
            if snapshot is None:
                self.problem = frame_cache.problem or _("there is nothing to see")
                self.is_playing = False
                return None
            shown = self._runner.show_past(snapshot, goes_on=goes_on)
        # However long the world takes to show it, playback goes on from there.
        while not wait([shown], FRAME_POLL_S).done:
            if not self._is_current(request_id):
                return None
        return snapshot

    def _request_next(
        self, frame_cache: FrameCache, this: Snapshot, step: int, request_id: int
    ) -> None:
        """Wait as long as the decision took when recorded, and request the next one."""
        following = None
        if step < frame_cache.last:
            following = self._wait_for_frame(frame_cache, step + 1, request_id)
        with self._changed:
            if not self._is_current(request_id):
                return
            # not showing any more: somebody returned to the present or continued the world
            if following is None or not self.is_showing:
                self.is_playing = False
                return
            pause = min((following.time - this.time) / self.speed, MAX_PAUSE_S)
            self._changed.wait_for(lambda: not self._is_current(request_id), pause)
            if self._is_current(request_id):
                self.step, self._has_request, self._is_next_frame = step + 1, True, True


def _failed(reason: str) -> "Future[None]":
    future: Future[None] = Future()
    future.set_exception(RecordingError(reason))
    return future
