"""The thread that ticks a world: commands, ticks, snapshots and errors of blocks."""

import logging
import math
import threading
import time
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from dataclasses import replace
from typing import TypeVar

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.block_errors import sentence_of, storable
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import Brain, RemoteBrain
from ai4u_edu.recording import Recorder
from ai4u_edu.recording.snapshot import Snapshot, capture_snapshot
from ai4u_edu.runtime.clock import Clock, TickSchedule
from ai4u_edu.runtime.command_queue import CommandQueue, QueuedCommand
from ai4u_edu.runtime.episode_clock import EpisodeClock
from ai4u_edu.runtime.frame_budget import FrameBudget
from ai4u_edu.runtime.pending_answers import PendingAnswers
from ai4u_edu.runtime.snapshot_publisher import SnapshotPublisher
from ai4u_edu.runtime.start_wait import StartWait
from ai4u_edu.runtime.static_scene_cache import StaticSceneCache
from ai4u_edu.runtime.tick_monitor import Stall, TickMonitor
from ai4u_edu.runtime.training_progress import TrainingProgress

T = TypeVar("T")
logger = logging.getLogger(__name__)

DECISION_WAIT_S = 0.25
"""Time that a command waits for a moment between all agents' decisions. Where agents decide at
different times there may be none; then it runs between any two ticks."""
ANSWER_POLL_S = 0.015
"""Poll interval for brains whose answer is late, while a world waits for answers."""
HOLD_POLL_S = 0.001
"""Poll interval for brains that hold the world without announcing an answer."""
REST_POLL_S, HELD_POLL_S = 0.1, 0.5
"""Time between two snapshots while the world is paused, and while it is held."""
STOP_S = 1.0
"""Time that the thread usually has to end; a block that does not return may keep it from that."""

WORLD_REPLACED = "another world has taken its place; connect anew to drive there"
"""Reason that the scripts of a replaced world are told."""


class WorldThread:
    """Ticks a world against the wall clock, and runs commands between two decisions.

    Physics and the code of blocks run in this thread only. :meth:`submit`, :meth:`wait`,
    :meth:`stop` and the properties may be used from any thread; methods with an underscore and
    those that say so belong to the world's thread.

    Args:
        sim: the world and its agents.
        seed: of the first episode.
        time_scale: how fast the time runs (``math.inf``: unlimited); left out, as the sim says.
        recorder: keeps the episodes; it has to listen to the same sim.
        wait_for_key: True may wait on an episode's first frame; see :class:`StartWait`.
        frame_budget: limits of how often the world is drawn; left out, the usual ones.
        clock: seconds; a :class:`~ai4u_edu.runtime.clock.Clock` also sleeps between two ticks.
    """

    def __init__(
        self,
        sim: ControlRequestor,
        *,
        seed: int | None = None,
        time_scale: float | None = None,
        recorder: Recorder | None = None,
        wait_for_key: bool = False,
        frame_budget: FrameBudget | None = None,
        clock: Callable[[], float] | Clock = time.perf_counter,
    ) -> None:
        self.sim = sim
        self.recorder = recorder
        self.training: TrainingProgress | None = None
        """Progress of the training whose policy drives in this world; replaced, never changed."""
        self.paused, self.error = False, ""
        self.is_held = False
        """True while the world stands still for a teacher; see :meth:`Runner.hold`."""
        self.describe_error: Callable[[BaseException, Sequence[BasicAgent]], str] = sentence_of
        """Returns the sentence on a block's error that pages show; may be replaced."""
        self.time_scale = sim.default_time_scale
        if time_scale is not None:
            self.set_time_scale(time_scale)
        self.frame_budget = frame_budget or FrameBudget()
        whole_clock = clock if isinstance(clock, Clock) else Clock(clock)
        self._clock = read = whole_clock.read
        self._wake = threading.Event()
        self._queue = CommandQueue(read, self._wake)
        self._answers = PendingAnswers(self._wake)
        self._stopping = False
        self._thread: threading.Thread | None = None
        self._schedule = TickSchedule(whole_clock)
        self._monitor = TickMonitor(read, lambda: self.sim.agents)
        self._start_wait = StartWait(is_enabled=wait_for_key)
        self._episode_clock = EpisodeClock()
        sim.reset(seed)
        self._past: Snapshot | None = None
        self._static_scenes = StaticSceneCache(sim)
        self._publisher = SnapshotPublisher(self._picture(), self.frame_budget, read)

    # -- for any thread --------------------------------------------------------------------------

    @property
    def latest(self) -> Snapshot:
        """The latest snapshot; replaced, never changed."""
        return self._publisher.latest

    def wait(self, seen: Snapshot, timeout: float) -> Snapshot:
        """Return the latest snapshot as soon as it is not ``seen``, or after ``timeout`` s."""
        return self._publisher.wait(seen, timeout)

    @property
    def stall(self) -> Stall | None:
        """The tick or command that has not ended for too long; None if there is none."""
        return self._monitor.stall

    @property
    def lateness(self) -> float:
        """Moving average of the lateness (s) of ticks."""
        return self._schedule.lateness

    def is_unpaced(self) -> bool:
        """Return True if the world runs as fast as it can, and not by the clock."""
        return math.isinf(self.time_scale)

    def submit(self, command: Callable[[], T]) -> "Future[T]":
        """Run a command in the world's thread, between two decisions."""
        return self._queue.submit(command)

    def start(self) -> None:
        """Start to tick."""
        self._thread = threading.Thread(target=self._run, name="runner", daemon=True)
        self._schedule.due = self._clock()
        self._thread.start()
        self._monitor.start()

    def stop(self, timeout: float | None = None) -> None:
        """End the thread; cancel commands that still wait, and close brains.

        If a block does not return in time, the thread is left behind with the brains that it uses;
        :attr:`is_left_behind` is True then.

        Args:
            timeout: time (s) that the thread has to end; default: :data:`STOP_S`.
        """
        self._stopping = True
        self._queue.close()
        self._wake.set()
        thread = self._thread
        if thread is None:
            self._end()
        elif thread is not threading.current_thread():
            thread.join(STOP_S if timeout is None else timeout)
        if self.is_left_behind:
            where = self._monitor.under_way()
            logger.warning("the world is left behind unfinished: %s", where or "it did not end")
            if self.recorder is not None:
                self.recorder.finish()
        self._monitor.stop()

    @property
    def is_left_behind(self) -> bool:
        """True if the thread was to end and still runs; only the end of the process ends it."""
        return self._stopping and self._thread is not None and self._thread.is_alive()

    # -- for the world's thread, or before it starts ---------------------------------------------

    def set_time_scale(self, time_scale: float) -> None:
        """Set the time scale at once.

        Raises:
            ValueError: it is not above 0.
        """
        if not time_scale > 0:
            raise ValueError(f"time scale: expected a number above 0, got {time_scale}")
        self.time_scale = time_scale

    def advance(self) -> None:
        """Run the commands that wait, and tick once unless the world is paused, held or waits.

        The world's thread does nothing else; code without such a thread may call it instead.
        """
        self._wake.clear()
        self._monitor.begin()
        try:
            self._run_commands()
            if self.paused or self.error or self.is_held or self._must_wait_for_key():
                self._rest()
            else:
                self._tick(whole_decision=self.is_unpaced())
                self._keep_time()
        finally:
            self._monitor.end()

    def _run(self) -> None:
        while not self._stopping:
            self._answers.clear()
            began = self._clock()
            self._attempt(self.advance)
            self._wait_for_answers(began)
        self._end()

    def _wait_for_answers(self, began: float) -> None:
        """Wait until all answers that links have announced are there, or a command comes."""
        if self.sim.waiting_for_brain:
            announced = 0  # the links have done so when they were asked
        elif self.is_unpaced() and self._all_keep_waiting():
            announced = len(self.sim.agents)  # they have their percepts, and need not be asked
        else:
            return
        if self._answers.expect(announced) > 0:
            self._wake.wait(ANSWER_POLL_S)
        elif self._clock() - began < HOLD_POLL_S:
            self._wake.wait(HOLD_POLL_S)

    def _all_keep_waiting(self) -> bool:
        self._monitor.begin()
        try:
            return all(agent.brain.keeps_waiting for agent in self.sim.agents)
        finally:
            self._monitor.end()

    def _end(self) -> None:
        self._monitor.begin()
        if self.recorder is not None:
            self.recorder.finish()
        for agent in self.sim.agents:
            self._close(agent.brain)
        self._monitor.end()

    # -- ticks -----------------------------------------------------------------------------------

    @property
    def _period(self) -> float:
        """Seconds from one tick to the next, by the wall clock."""
        return self.sim.world.dt / self.time_scale

    def _must_wait_for_key(self) -> bool:
        if self._start_wait.begins(self.sim):
            self._publish()  # at once: pages show that it waits
        return self._start_wait.is_waiting

    def _rest(self) -> None:
        self._schedule.rest()
        self._monitor.end()
        self._wake.wait(HELD_POLL_S if self.is_held else REST_POLL_S)
        self._monitor.begin()
        for agent in self.sim.agents:
            self._attempt(agent.brain.idle)
        self._publish()  # keys may be pressed in a paused world, and scripts may connect
        self._schedule.rest()

    def _tick(self, *, whole_decision: bool = False) -> None:
        """Tick once, or as many times as make a decision."""
        self._monitor.begin()
        began, ticks, self._past = self._clock(), 1, None

        def tick() -> None:
            nonlocal ticks
            if whole_decision:
                ticks = self.sim.step_decision() or 1
            else:
                self.sim.tick()

        self._attempt(tick)
        self._episode_clock.note_ends(self.sim)
        ended = self._clock()
        if not self.sim.waiting_for_brain:  # a world that waits for a script is not slow
            self._schedule.ticked += ticks
            self._monitor.note_tick((ended - began) / ticks, self.sim.world.count_contacts)
        next_tick_at = self._schedule.due + self._period
        if self.error or self.frame_budget.is_snapshot_due(ended, next_tick_at):
            self._publish()

    def _keep_time(self) -> None:
        self._schedule.tick_ended(self._period, held=self.sim.waiting_for_brain)
        self._monitor.end()
        self._schedule.sleep(self._wake, self._run_commands_in_pause)

    # -- commands --------------------------------------------------------------------------------

    def _run_commands_in_pause(self) -> bool:
        """Run commands in a long pause between two ticks; return True to continue the pause."""
        self._monitor.begin()
        self._run_commands()
        self._monitor.end()
        self._schedule.due = min(self._schedule.due, self._clock() + self._period)
        return not (self.paused or self.error or self.is_held or self._stopping)

    def _run_commands(self) -> None:
        while (first := self._queue.first) is not None and not self._stopping:
            is_between_decisions = (
                self.paused
                or self.error
                or self.is_held
                or self.sim.waiting_for_brain
                or self.sim.between_decisions()
            )
            if not is_between_decisions and self._clock() - first.asked_at < DECISION_WAIT_S:
                return
            command = self._queue.take()
            if command is not None:
                self._run_command(command)

    def _run_command(self, command: QueuedCommand) -> None:
        self._monitor.begin()
        try:
            result = self.recorder.guard(command.run) if self.recorder else command.run()
        except BaseException as error:  # it belongs to the caller
            self._publish()
            command.future.set_exception(storable(error, self.sim.agents))
            if not self._may_keep(error):
                raise
        else:
            self._publish()  # before the result: the caller may read the snapshot at once
            command.future.set_result(result)

    # -- errors of blocks ------------------------------------------------------------------------

    def _attempt(self, act: Callable[[], object]) -> None:
        """Call what may raise anything, as a student's block does; the page shows the error."""
        try:
            act()
        except BaseException as error:
            if not self._may_keep(error):
                raise
            self.error = self.describe_error(error, self.sim.agents)

    def _may_keep(self, error: BaseException) -> bool:
        """Return True for a block's error; Ctrl-C is raised in the main thread only."""
        return isinstance(error, Exception) or threading.current_thread() is self._thread

    def _close(self, brain: Brain, reason: str = "") -> None:
        """Close a brain that no longer drives, and log its error."""
        try:
            if reason and isinstance(brain, RemoteBrain):
                brain.close(reason)
            else:
                brain.close()
        except BaseException as error:
            if not self._may_keep(error):
                raise
            logger.warning("%s could not be closed", type(brain).__name__, exc_info=True)

    def _replace(self, sim: ControlRequestor, recorder: Recorder | None) -> None:
        before, self.sim = self.sim, sim
        if recorder is not None:
            if self.recorder is not None and self.recorder is not recorder:
                self.recorder.set_enabled(False)
            self.recorder = recorder
        elif self.recorder is not None:
            self.recorder.listen_to(sim)
        self.error, self._past = "", None
        self._static_scenes.invalidate()
        sim.is_seed_locked = before.is_seed_locked
        self._monitor.forget()
        self._schedule.forget()
        kept = [agent.brain for agent in sim.agents]
        for agent in before.agents:
            agent.keyboard.release()
            brain = agent.brain
            if not any(brain is each for each in kept):
                self._close(brain, WORLD_REPLACED)

    # -- snapshots -------------------------------------------------------------------------------

    def _publish(self) -> None:
        self._attempt(lambda: self._publisher.publish(lambda: self._past or self._picture()))
        if self.error and self.latest.error != self.error and self._past is None:
            # a block makes the snapshot fail: publish the last one, with the reason
            self._publisher.publish(lambda: replace(self.latest, error=self.error))

    def _as_past(self, past: Snapshot) -> Snapshot:
        """Return a past snapshot as it is shown; it shares the current static scene if equal."""
        shared = self._static_scenes.shared(past.static_scene)
        return replace(past, static_scene=shared, paused=True, time_scale=self.time_scale)

    def _picture(self) -> Snapshot:
        sim = self.sim
        return capture_snapshot(
            sim,
            self._static_scenes.of(sim),
            paused=self.paused,
            time_scale=self.time_scale,
            real_time_factor=self._real_time_factor(),
            error=self.error,
            slow_tick=self._monitor.slow_tick,
            episode_time=self._episode_clock.read(sim),
            waiting=self._start_wait.reason(sim, is_held=self.is_held, has_error=bool(self.error)),
        )

    def _real_time_factor(self) -> float:
        measured = self._schedule.real_time_factor(self.sim.world.dt)
        if measured is not None:
            return measured
        return 0.0 if self.paused else 1.0 if self.is_unpaced() else self.time_scale
