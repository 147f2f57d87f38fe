"""The wall clock: lets a world run in real time, and lets others look and ask.

Whoever wants something changed submits a command; it is carried out between two decisions, in the
runner's thread. Whoever wants to look takes the latest snapshot, without a lock.
"""

import logging
import math
import threading
import time
import warnings
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

from ai4u_edu.agent.block_errors import reason_for_no_decision, sentence_of, storable
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import NoDecisionError
from ai4u_edu.blocks import Brain, RemoteBrain
from ai4u_edu.recording import Recorder, Replay
from ai4u_edu.recording.scene_export import without_unknown_brains
from ai4u_edu.runtime.clock import TickSchedule
from ai4u_edu.runtime.command_queue import CommandQueue, QueuedCommand
from ai4u_edu.runtime.frame_budget import FrameBudget
from ai4u_edu.runtime.slow_ticks import SlowTicks
from ai4u_edu.runtime.snapshot_publisher import SnapshotPublisher
from ai4u_edu.runtime.stall_monitor import Stall, StallMonitor
from ai4u_edu.scenes import Scene
from ai4u_edu.snapshot import Snapshot, StaticScene, capture_snapshot, capture_static_scene

T = TypeVar("T")

logger = logging.getLogger(__name__)

PATIENCE = 0.25
"""Where agents decide at different times there may be no moment between all decisions; a command
waits this long (s) for one, and then takes any moment between two ticks."""
ANSWER_POLL_S = 0.015
"""While a world waits for scripts that will call, their brains look so often who is late."""
HOLD_POLL_S = 0.001
"""Pause between two questions to brains that have the world wait, and that nobody calls for."""
REST_POLL_S = 0.1
"""Seconds between two snapshots while the time stands still."""
STOP_S = 1.0
"""Seconds that the thread has to end; a block that does not return may keep it from that."""

RENAMED_METHODS = {
    "use": "replace_sim",
    "exchange": "replace_sim_now",
    "show": "show_past",
    "call": "notify_answer",
    "expect_call": "expect_answer",
}

ANOTHER_WORLD = "another world has taken its place; connect anew to drive there"


class Runner:
    """Ticks a world against the wall clock, in a thread of its own.

    Physics and the code of blocks run in that thread only, so a block that does not return delays
    nothing but the world; :attr:`stall` reports it. Commands, :meth:`notify_answer` and
    :meth:`stop` may be called from any thread: they only queue, set one event and return.

    Args:
        sim: the world and its agents.
        seed: of the first episode.
        time_scale: how fast the time runs; left out, as the sim says. ``math.inf`` for as fast as
            it goes.
        recorder: keeps the episodes; it has to listen to the same sim.
        clock: seconds; to be replaced in tests.
    """

    def __init__(
        self,
        sim: ControlRequestor,
        *,
        seed: int | None = None,
        time_scale: float | None = None,
        recorder: Recorder | None = None,
        clock: Callable[[], float] = time.perf_counter,
    ) -> None:
        self.sim = sim
        self.recorder = recorder
        self.paused = False
        self.error = ""
        self.time_scale = sim.default_time_scale
        if time_scale is not None:
            self.set_time_scale(time_scale)
        self._clock = clock
        self._wake = threading.Event()
        self._queue = CommandQueue(clock, self._wake)
        self._stopping = False
        self._thread: threading.Thread | None = None
        self._expected = 0
        self._expecting = threading.Lock()
        self._schedule = TickSchedule(clock)
        self._monitor = StallMonitor(clock, lambda: self.sim.agents)
        self._slow = SlowTicks(clock)
        sim.reset(seed)
        self._past: Snapshot | None = None
        self._generation = -1
        self._static_scene: StaticScene
        self.frame_budget = FrameBudget()
        self._publisher = SnapshotPublisher(self._picture(), self.frame_budget, clock)

    # -- for those who look ----------------------------------------------------------------------

    @property
    def latest(self) -> Snapshot:
        """What everything looked like after the last tick; replaced, never changed."""
        return self._publisher.latest

    def wait(self, seen: Snapshot, timeout: float) -> Snapshot:
        """The latest snapshot, as soon as it is another one than ``seen`` (or after timeout s)."""
        return self._publisher.wait(seen, timeout)

    @property
    def stall(self) -> Stall | None:
        """The tick or the command that has not ended for too long; None while all is well."""
        return self._monitor.stall

    @property
    def lateness(self) -> float:
        """Lateness (s) with which ticks lately began, on average."""
        return self._schedule.lateness

    def is_unpaced(self) -> bool:
        """Whether the time runs as fast as it can, and not by the clock."""
        return math.isinf(self.time_scale)

    # -- for those who ask -----------------------------------------------------------------------

    def submit(self, command: Callable[[], T]) -> "Future[T]":
        """Has a command carried out in the runner's thread, between two decisions."""
        return self._queue.submit(command)

    def pause(self) -> "Future[None]":
        """Stops the time; held keys are let go."""
        return self.submit(lambda: self._set_paused(True))

    def resume(self) -> "Future[None]":
        """Lets the time go on."""
        return self.submit(lambda: self._set_paused(False))

    def reset(self, seed: int | None = None) -> "Future[None]":
        """Begins a new episode, and clears an error."""

        def carry_out() -> None:
            self.sim.reset(seed)
            self.error, self._past = "", None

        return self.submit(carry_out)

    def step(self, ticks: int = 1) -> "Future[None]":
        """Lets a paused world go on by some ticks."""

        def carry_out() -> None:
            for _ in range(ticks):
                self._tick()
                if self.error or self._stopping:
                    return

        return self.submit(carry_out)

    def step_decision(self, agent_id: str | None = None) -> "Future[None]":
        """Lets a paused world go on until an agent's decision is over.

        Args:
            agent_id: whose; left out, the first one's. Of an agent that takes no more decisions in
                this episode, a single tick passes.

        Raises:
            NoDecisionError: the agent took none: it waits for its script. A tick has passed, unless
                the world waits for that script.
        """

        def carry_out() -> None:
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
                raise NoDecisionError(f"agent {agent.id!r} took no decision: {why}")

        return self.submit(carry_out)

    def scale_time(self, time_scale: float) -> "Future[None]":
        """Lets the time run faster or slower."""
        return self.submit(lambda: self.set_time_scale(time_scale))

    def show_past(self, past: Snapshot | None, *, goes_on: bool = False) -> "Future[None]":
        """Has all who look see a moment of the past; meanwhile the time stands still.

        It goes on with the world as it is now, which nothing of this changes: as soon as somebody
        has it go on, or begin anew, what is seen is what is now.

        Args:
            past: the moment; none: now, paused.
            goes_on: whether it follows another one, and is not shown if the world goes on already.
        """

        def carry_out() -> None:
            if goes_on and self._past is None:
                return
            if not self.paused:
                self._set_paused(True)
            self._past = None if past is None else self._as_past(past)

        return self.submit(carry_out)

    def continue_from(
        self, replay: Replay, step: int, *, agent: str | None = None
    ) -> "Future[None]":
        """Brings the world to a moment of a recorded episode, and lets it go on from there.

        Agents keep the brains that they have. An episode of another world, or of other blocks, is
        continued in its own world, with the brains that its scene says. What is recorded then has
        the episode up to that moment in it.

        Args:
            replay: of the episode.
            step: the agent's decision, from 0 on, in place of which something else is done.
            agent: its id; left out, the one that acts first.

        Raises:
            RecordingError: there was no such decision, or it can't be played again exactly.
        """
        replay.check(step, agent)  # here, since it may take longer than the world should wait

        def carry_out() -> None:
            if not replay.fits(self.sim):
                other = Scene(without_unknown_brains(replay.episode.scene)).build()
                other.reset(replay.episode.seed)
                self._replace(other, None)
            replay.continue_from(step, agent=agent, sim=self.sim)
            self.error, self._past, self.paused = "", None, False

        return self.submit(carry_out)

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
            recorder: of the other world. Left out, the present recorder listens to it from now on.
            seed: of the episode that begins.
        """
        return self.submit(lambda: self.replace_sim_now(sim, recorder, seed=seed))

    def replace_sim_now(
        self, sim: ControlRequestor, recorder: Recorder | None = None, *, seed: int | None = None
    ) -> None:
        """Run another world at once, as :meth:`replace_sim` does; only for the runner's thread."""
        if not sim.episode:
            sim.reset(seed)  # before anything else: if it fails, all stays as it was
        self._replace(sim, recorder)

    # -- for links that answer -------------------------------------------------------------------

    def expect_answer(self) -> None:
        """Count an answer for which :meth:`notify_answer` will be called; a link says so."""
        with self._expecting:
            self._expected += 1

    def notify_answer(self) -> None:
        """Wake the runner's thread: an answer that it waits for is there. Thread-safe.

        Where several are expected, the last one wakes it. Nothing else is done in the caller's
        thread, since the next tick may take long.
        """
        with self._expecting:
            self._expected -= 1
            is_last = self._expected <= 0
        if is_last:
            self._wake.set()

    if not TYPE_CHECKING:  # a type checker is to report the old names

        def __getattr__(self, name: str) -> object:
            """Return a method by the name that it had before; deprecated for one release."""
            new = RENAMED_METHODS.get(name)
            if new is None:
                raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
            warnings.warn(f"Runner.{name} is now Runner.{new}", DeprecationWarning, stacklevel=2)
            return getattr(self, new)

    # -- the thread ------------------------------------------------------------------------------

    def start(self) -> None:
        """Begins to tick."""
        self._thread = threading.Thread(target=self._run, name="runner", daemon=True)
        self._schedule.due = self._clock()
        self._thread.start()
        self._monitor.start()

    def stop(self) -> None:
        """Ends the thread; commands that still wait are cancelled, brains are closed.

        A block that does not return has the thread left behind, after :data:`STOP_S`: then the
        brains, which it uses, stay as they are; :attr:`is_left_behind` tells.
        """
        self._stopping = True
        self._queue.close()
        self._wake.set()
        thread = self._thread
        if thread is None:
            self._end()
        elif thread is not threading.current_thread():
            thread.join(STOP_S)
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

    def set_time_scale(self, time_scale: float) -> None:
        """Sets the time scale at once; only for the runner's thread, or before it starts."""
        if not time_scale > 0:
            raise ValueError(f"time scale: expected a number above 0, got {time_scale}")
        self.time_scale = time_scale

    def advance(self) -> None:
        """Carries out what was asked, and lets one tick pass unless the time stands still.

        The runner's own thread does nothing else; who has none may call it instead.
        """
        self._wake.clear()
        self._monitor.begin()
        try:
            self._carry_out_commands()
            if self.paused or self.error:
                self._rest()
            else:
                self._tick(leaps=self.is_unpaced())
                self._keep_time()
        finally:
            self._monitor.end()

    def _run(self) -> None:
        while not self._stopping:
            with self._expecting:
                self._expected = 0
            began = self._clock()
            self._attempt(self.advance)
            self._wait_for_answers(began)
        self._end()

    def _wait_for_answers(self, began: float) -> None:
        """Waits until all links that will call have called, or somebody wants something else."""
        if self.sim.waiting_for_brain:
            to_come = 0
        elif self.is_unpaced() and self._all_keep_waiting():
            to_come = len(self.sim.agents)  # they were told already, and need not be asked
        else:
            return
        with self._expecting:
            self._expected += to_come
            expected = self._expected
        if expected > 0:
            self._wake.wait(ANSWER_POLL_S)
        elif self._clock() - began < HOLD_POLL_S:
            self._wake.wait(HOLD_POLL_S)  # brains that have the world wait, and nobody will call

    def _all_keep_waiting(self) -> bool:
        self._monitor.begin()
        try:
            return all(agent.brain.keeps_waiting for agent in self.sim.agents)
        finally:
            self._monitor.end()

    def _end(self) -> None:
        """Ends what belongs to the thread that runs the world; that thread does it, if it can."""
        self._monitor.begin()
        if self.recorder is not None:
            self.recorder.finish()
        for agent in self.sim.agents:
            self._close(agent.brain)
        self._monitor.end()

    def _rest(self) -> None:
        self._schedule.rest()
        self._monitor.end()
        self._wake.wait(REST_POLL_S)
        self._monitor.begin()
        for agent in self.sim.agents:
            self._attempt(agent.brain.idle)
        self._publish()  # keys that are held, and the like, go on
        self._schedule.rest()

    def _tick(self, *, leaps: bool = False) -> None:
        """A tick, or as many as make a decision."""
        self._monitor.begin()
        began, self._past = self._clock(), None
        ticks = 1

        def tick() -> None:
            nonlocal ticks
            if leaps:
                ticks = self.sim.step_decision() or 1
            else:
                self.sim.tick()

        self._attempt(tick)
        ended = self._clock()
        if not self.sim.waiting_for_brain:  # a world that waits for a script is not slow
            self._schedule.ticked += ticks
            self._slow.note((ended - began) / ticks, self.sim.world.count_contacts)
        next_tick_at = self._schedule.due + self._period
        if self.error or self.frame_budget.is_snapshot_due(ended, next_tick_at):
            self._publish()

    def _keep_time(self) -> None:
        self._schedule.tick_ended(self._period, held=self.sim.waiting_for_brain)
        self._monitor.end()
        self._schedule.sleep(self._wake, self._listen)

    def _listen(self) -> bool:
        """Carries out what is asked for in a long pause; whether the pause goes on."""
        self._monitor.begin()
        self._carry_out_commands()
        self._monitor.end()
        self._schedule.due = min(self._schedule.due, self._clock() + self._period)
        return not (self.paused or self.error or self._stopping)

    @property
    def _period(self) -> float:
        """Seconds from one tick to the next, by the wall clock."""
        return self.sim.world.dt / self.time_scale

    def _carry_out_commands(self) -> None:
        while (first := self._queue.first) is not None and not self._stopping:
            standing = (
                self.paused
                or self.error
                or self.sim.waiting_for_brain
                or self.sim.between_decisions()
            )
            if not standing and self._clock() - first.asked_at < PATIENCE:
                return
            command = self._queue.take()
            if command is not None:
                self._carry_out(command)

    def _carry_out(self, command: QueuedCommand) -> None:
        self._monitor.begin()
        try:
            result = self.recorder.guard(command.run) if self.recorder else command.run()
        except BaseException as error:  # it belongs to whoever asked
            self._publish()
            command.future.set_exception(storable(error, self.sim.agents))
            if not self._may_keep(error):
                raise
        else:
            self._publish()  # first: who asked, and hears that it is done, looks at once
            command.future.set_result(result)

    # -- errors of blocks ------------------------------------------------------------------------

    def _attempt(self, act: Callable[[], object]) -> None:
        """Runs what may raise anything, as a student's block does; the page shows it then."""
        try:
            act()
        except BaseException as error:
            if not self._may_keep(error):
                raise
            self.error = sentence_of(error, self.sim.agents)

    def _may_keep(self, error: BaseException) -> bool:
        """Return True for a block's error; Ctrl-C's comes to the main thread only."""
        return isinstance(error, Exception) or threading.current_thread() is self._thread

    def _close(self, brain: Brain, reason: str = "") -> None:
        """Closes a brain that drives no more; whatever it raises stops nobody else."""
        try:
            if reason and isinstance(brain, RemoteBrain):
                brain.close(reason)
            else:
                brain.close()
        except BaseException as error:
            if not self._may_keep(error):
                raise
            logger.warning("%s could not be closed", type(brain).__name__, exc_info=True)

    # -- what it is made of ----------------------------------------------------------------------

    def _set_paused(self, paused: bool) -> None:
        self.paused = paused
        if not paused:
            self._past = None
        else:
            for agent in self.sim.agents:
                agent.keyboard.release()

    def _replace(self, sim: ControlRequestor, recorder: Recorder | None) -> None:
        before, self.sim = self.sim, sim
        if recorder is not None:
            if self.recorder is not None and self.recorder is not recorder:
                self.recorder.set_enabled(False)
            self.recorder = recorder
        elif self.recorder is not None:
            self.recorder.listen_to(sim)
        self.error, self._past, self._generation = "", None, -1
        self._slow.clear()
        self._schedule.forget()
        stay = [agent.brain for agent in sim.agents]
        for agent in before.agents:
            agent.keyboard.release()
            brain = agent.brain
            if any(brain is each for each in stay):
                continue
            self._close(brain, ANOTHER_WORLD)

    def _publish(self) -> None:
        self._attempt(lambda: self._publisher.publish(lambda: self._past or self._picture()))
        if self.error and self.latest.error != self.error and self._past is None:
            # a block keeps the world from being seen: what was seen last, with the reason
            self._publisher.publish(lambda: replace(self.latest, error=self.error))

    def _as_past(self, past: Snapshot) -> Snapshot:
        """Return a past snapshot as it is shown; it shares the current static scene if equal."""
        same = past.static_scene is self._static_scene or past.static_scene == self._static_scene
        return replace(
            past,
            static_scene=self._static_scene if same else past.static_scene,
            paused=True,
            time_scale=self.time_scale,
        )

    def _picture(self) -> Snapshot:
        sim = self.sim
        if sim.world.generation != self._generation:
            self._generation = sim.world.generation
            static_scene = capture_static_scene(sim)
            if getattr(self, "_static_scene", None) != static_scene:
                self._static_scene = static_scene
        return capture_snapshot(
            sim,
            self._static_scene,
            paused=self.paused,
            time_scale=self.time_scale,
            real_time_factor=self._real_time_factor(),
            error=self.error,
            slow_tick=self._slow.slowest,
        )

    def _real_time_factor(self) -> float:
        measured = self._schedule.real_time_factor(self.sim.world.dt)
        if measured is not None:
            return measured
        return 0.0 if self.paused else 1.0 if self.is_unpaced() else self.time_scale
