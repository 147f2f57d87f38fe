"""A world that runs by the wall clock, and what other threads may ask of it."""

import logging
import math
import threading
import time
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from dataclasses import replace
from typing import TypeVar

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.block_errors import may_be_kept, reason_for_no_decision, sentence_of, storable
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import NoDecisionError
from ai4u_edu.blocks import Brain, RemoteBrain
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording import Recorder, Replay
from ai4u_edu.runtime.clock import Clock, EpisodeClock, StartWait, TickSchedule
from ai4u_edu.runtime.command_queue import CommandQueue, QueuedCommand
from ai4u_edu.runtime.frame_budget import FrameBudget
from ai4u_edu.runtime.pending_answers import PendingAnswers
from ai4u_edu.runtime.snapshot_publisher import SnapshotPublisher
from ai4u_edu.runtime.tick_monitor import Stall, TickMonitor
from ai4u_edu.runtime.training_progress import TrainingProgress
from ai4u_edu.snapshot import Snapshot, capture_snapshot

T = TypeVar("T")
logger = logging.getLogger(__name__)

DECISION_WAIT_S = 0.25
"""Time that a command waits for a moment between all agents' decisions. Where agents decide at
different times there may be none; then it runs between any two ticks."""
REST_POLL_S, HELD_POLL_S = 0.1, 0.5
"""Time between two snapshots while the world is paused, and while it is held."""
STOP_S = 1.0
"""Time that the thread usually has to end; a block that does not return may keep it from that."""
WORLD_REPLACED = _("another world has taken its place; connect again to drive there")
"""Reason sent to the scripts of a replaced world."""


class Runner:
    """Runs a world in a thread of its own; pauses, resets, steps and replaces it on request.

    The world's thread alone runs physics and the code of blocks; no lock guards the world. Other
    threads read :attr:`latest`, which is immutable, or :meth:`submit` a command, as the methods
    from :meth:`pause` to :meth:`replace_sim` do: it runs between two decisions, and its future is
    returned at once. The parts that threads share have their own locks: the queue of commands, the
    count of answers, the latest snapshot, the monitor of long ticks. A block that does not return
    delays nothing but the world; :attr:`stall` reports it.

    Args:
        sim: the world and its agents.
        seed: of the first episode.
        time_scale: how fast the time runs (``math.inf``: unlimited); default: the sim's.
        recorder: keeps the episodes; it has to listen to the same sim.
        wait_for_key: True may wait on an episode's first frame; see :class:`StartWait`.
        frame_budget: limits of how often the world is drawn; default: the usual ones.
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
        """True while the world stands still for a teacher; see :meth:`hold`."""
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
        self._answers = PendingAnswers(self._wake, read)
        self._stopping = False
        self._thread: threading.Thread | None = None
        self._schedule = TickSchedule(whole_clock)
        self._monitor = TickMonitor(read, lambda: self.sim.agents)
        self._start_wait = StartWait(is_enabled=wait_for_key)
        self._episode_clock = EpisodeClock()
        sim.reset(seed)
        self._publisher = SnapshotPublisher(sim, self.frame_budget, read)
        self._publisher.latest = self._picture()

    # -- for any thread ----------------------------------------------------------------------------

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

    @property
    def thread_id(self) -> int:
        """Identifier of the world's thread; 0 while it does not run."""
        thread = self._thread
        return thread.ident or 0 if thread is not None and thread.is_alive() else 0

    @property
    def next_tick_at(self) -> float:
        """Time (s, of ``time.monotonic``) at which the next tick is due; infinity if none is.

        It lies in the past while that tick runs.
        """
        if self.paused or self.error or self.is_held or self.is_unpaced():
            return math.inf
        return self._schedule.due

    @property
    def is_waiting_for_key(self) -> bool:
        """True while the world waits on its first frame until a key is pressed."""
        return self._start_wait.is_waiting

    @property
    def is_left_behind(self) -> bool:
        """True if the thread was to end and still runs; only the end of the process ends it."""
        return self._stopping and self._thread is not None and self._thread.is_alive()

    def start(self) -> None:
        """Start to tick."""
        self._thread = threading.Thread(target=self._run, name="runner", daemon=True)
        self._schedule.due = self._clock()  # the first tick is due at once
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

    def submit(self, command: Callable[[], T]) -> "Future[T]":
        """Run a command in the world's thread, between two decisions."""
        return self._queue.submit(command)

    def pause(self) -> "Future[None]":
        """Pause the world, and release all keys."""
        return self.submit(lambda: self._set_paused(True))

    def resume(self) -> "Future[None]":
        """Let a paused world run."""
        return self.submit(lambda: self._set_paused(False))

    def hold(self, is_held: bool) -> "Future[None]":
        """Let the world stand still, with scripts and clocks, or end that; for a teacher.

        While it is held, all keys are released, commands to run or to tick it do not end that, and
        ``latest.waiting`` is ``teacher``. Pause, resets and edits are carried out as ever; a world
        that was paused is paused afterwards.

        Args:
            is_held: False to end it.
        """

        def command() -> None:
            self.is_held = is_held
            self._release_keys()

        return self.submit(command)

    def reset(self, seed: int | None = None) -> "Future[None]":
        """Begin a new episode, and clear an error.

        Args:
            seed: the episode's seed; default: the same one if it is locked, else a new one.
        """
        return self.submit(lambda: self._reset(seed))

    def try_again(self) -> "Future[None]":
        """Begin a new episode with the present seed: the same start again."""
        return self.submit(lambda: self._reset(self.sim.world.seeds.seed))

    def new_start(self) -> "Future[None]":
        """Begin a new episode with a new seed, also if the seed is locked."""
        return self.submit(lambda: self._reset(self.sim.world.seeds.next().seed))

    def lock_seed(self, is_locked: bool) -> "Future[None]":
        """Let each reset without a seed repeat the present seed, or draw a new one."""

        def command() -> None:
            self.sim.is_seed_locked = is_locked

        return self.submit(command)

    def start_episode(self) -> "Future[None]":
        """Let a world that waits for a key run; a paused or held one goes on waiting."""

        def command() -> None:
            if not (self.paused or self.error or self.is_held):
                self._start_wait.end(self.sim)

        return self.submit(command)

    def step(self, ticks: int = 1) -> "Future[None]":
        """Tick a paused world.

        Raises:
            NoDecisionError: the world is held; see :meth:`hold`.
        """

        def command() -> None:
            self._check_not_held()
            for _tick in range(ticks):
                self._tick()
                if self.error or self._stopping:
                    return

        return self.submit(command)

    def step_decision(self, agent_id: str | None = None) -> "Future[None]":
        """Tick a paused world until an agent's decision is over.

        Args:
            agent_id: default: the first agent's. If the agent takes no more decisions in this
                episode, the world ticks once.

        Raises:
            NoDecisionError: the agent took none: it waits for its script. The world has ticked
                once, unless it waits for that script. Or the world is held; see :meth:`hold`.
        """

        def command() -> None:
            self._check_not_held()
            sim = self.sim
            agent = sim.agents[0] if agent_id is None else sim.agent(agent_id)
            before, is_over = (agent.episode, agent.steps), agent.done
            self._tick()
            while sim.is_deciding(agent) and not (
                self.error or sim.waiting_for_brain or self._stopping
            ):
                self._tick()
            if (agent.episode, agent.steps) == before and not (is_over or self.error):
                why = reason_for_no_decision(agent)
                raise NoDecisionError(
                    _("agent {id!r} took no decision: {why}", id=agent.id, why=why)
                )

        return self.submit(command)

    def scale_time(self, time_scale: float) -> "Future[None]":
        """Let the time run faster or slower."""
        return self.submit(lambda: self.set_time_scale(time_scale))

    def show_past(self, past: Snapshot | None, *, goes_on: bool = False) -> "Future[None]":
        """Publish a snapshot of the past in place of the present, and pause the world.

        The world itself does not change. The present is published again as soon as the world runs,
        ticks or begins a new episode.

        Args:
            past: None to publish the present again; the world stays paused.
            goes_on: True for the next snapshot of a replay, which is left out if the present has
                been published since the last one.
        """

        def command() -> None:
            if goes_on and self._publisher.past is None:
                return
            if not self.paused:
                self._set_paused(True)
            self._publisher.show_past(past, self.time_scale)

        return self.submit(command)

    def continue_from(
        self, replay: Replay, step: int, *, agent: str | None = None
    ) -> "Future[None]":
        """Bring the world to a moment of a recorded episode, and let it run from there.

        Agents keep their brains. An episode of another world, or of other blocks, is continued in
        its own world, with the brains of its scene. What is recorded from then on includes the
        episode up to that moment.

        Args:
            replay: of the episode.
            step: the agent's decision, from 0 on, in place of which something else is done.
            agent: its id; default: the one that acts first.

        Raises:
            RecordingError: there was no such decision, or it can't be replayed exactly.
        """
        replay.check(step, agent)  # here, since it may take longer than the world should wait

        def command() -> None:
            if not replay.fits(self.sim):
                if self.recorder is not None:
                    self.recorder.scene = replay.episode.scene
                self.replace_sim_now(replay.build(), seed=replay.episode.seed)
            replay.continue_from(step, agent=agent, sim=self.sim)
            self.error, self._publisher.past, self.paused = "", None, False

        return self.submit(command)

    def replace_sim(
        self, sim: ControlRequestor, recorder: Recorder | None = None, *, seed: int | None = None
    ) -> "Future[None]":
        """Run another world in place of this one; time scale and pause stay.

        Keys held in the old world are released. Brains of its agents are closed, except those that
        also drive agents of the new one. Code that holds an agent can check whether it is still in
        ``runner.sim.agents``.

        Args:
            sim: the other world. If it has no episode yet, one begins; else it continues where it
                is.
            recorder: of the other world. Default: the present one, which listens to it from now on.
            seed: of the episode that begins.
        """
        return self.submit(lambda: self.replace_sim_now(sim, recorder, seed=seed))

    def notify_answer(self) -> None:
        """Wake the world's thread if this is the last answer that it waits for."""
        self._answers.notify()

    # -- for the world's thread, or before it starts -----------------------------------------------

    def set_time_scale(self, time_scale: float) -> None:
        """Set the time scale at once.

        Raises:
            ValueError: it is not above 0.
        """
        if not time_scale > 0:
            raise ValueError(
                _("time scale: expected a number above 0, got {time_scale}", time_scale=time_scale)
            )
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

    def replace_sim_now(
        self, sim: ControlRequestor, recorder: Recorder | None = None, *, seed: int | None = None
    ) -> None:
        """Run another world at once, as :meth:`replace_sim` does; only for the world's thread."""
        if not sim.episode:
            sim.reset(seed)  # before anything else: if it fails, all stays as it was
        before, self.sim = self.sim, sim
        if recorder is not None:
            if self.recorder is not None and self.recorder is not recorder:
                self.recorder.set_enabled(False)
            self.recorder = recorder
        elif self.recorder is not None:
            self.recorder.listen_to(sim)
        self.error, self._publisher.past = "", None
        self._publisher.forget_static_scene()
        sim.is_seed_locked = before.is_seed_locked  # the person's choice outlasts the world
        self._monitor.forget()
        self._schedule.forget()
        kept = [agent.brain for agent in sim.agents]
        for agent in before.agents:
            agent.keyboard.release()
            if not any(agent.brain is brain for brain in kept):
                self._close(agent.brain, WORLD_REPLACED)

    def expect_answer(self) -> None:
        """Announce that :meth:`notify_answer` will be called; only for the world's thread."""
        self._answers.expect()

    def _run(self) -> None:
        while not self._stopping:
            self._answers.clear()  # before brains are asked, who announce answers then
            began = self._clock()
            self._attempt(self.advance)
            self._answers.wait(self.sim, began, self._all_keep_waiting)
        self._end()

    def _all_keep_waiting(self) -> bool:
        """Return True if no brain needs to be asked again until an answer comes."""
        if not self.is_unpaced():
            return False
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
        began, ticks, self._publisher.past = self._clock(), 1, None

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
            if command is not None:  # else all that waited were cancelled
                self._run_command(command)

    def _run_command(self, command: QueuedCommand) -> None:
        self._monitor.begin()
        try:
            result = self.recorder.guard(command.run) if self.recorder else command.run()
        except BaseException as error:  # it belongs to the caller
            self._publish()
            command.future.set_exception(storable(error, self.sim.agents))
            if not may_be_kept(error):
                raise
        else:
            self._publish()  # before the result: the caller may read the snapshot at once
            command.future.set_result(result)

    def _set_paused(self, paused: bool) -> None:
        self.paused = paused
        if not paused:
            self._publisher.past = None
        else:
            self._release_keys()

    def _reset(self, seed: int | None) -> None:
        self.sim.reset(seed)
        self.error, self._publisher.past = "", None

    def _release_keys(self) -> None:
        for agent in self.sim.agents:
            agent.keyboard.release()

    def _check_not_held(self) -> None:
        if self.is_held:
            raise NoDecisionError(_("the teacher has stopped the world; wait until it goes on"))

    def _attempt(self, act: Callable[[], object]) -> None:
        """Call what may raise anything, as a student's block does; the page shows the error."""
        try:
            act()
        except BaseException as error:
            if not may_be_kept(error):
                raise
            self.error = self.describe_error(error, self.sim.agents)

    def _close(self, brain: Brain, reason: str = "") -> None:
        """Close a brain that no longer drives, and log its error."""
        try:
            if reason and isinstance(brain, RemoteBrain):
                brain.close(reason)
            else:
                brain.close()
        except BaseException as error:
            if not may_be_kept(error):
                raise
            logger.warning("%s could not be closed", type(brain).__name__, exc_info=True)

    def _publish(self) -> None:
        self._attempt(lambda: self._publisher.publish(self._picture))
        if self.error and self.latest.error != self.error and self._publisher.past is None:
            # a block makes the snapshot fail: publish the last one, with the reason
            self._publisher.publish(lambda: replace(self.latest, error=self.error))

    def _picture(self) -> Snapshot:
        sim = self.sim
        return capture_snapshot(
            sim,
            self._publisher.static_scene(sim),
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
