"""The wall clock: lets a world run in real time, and lets others look and ask.

Whoever wants something changed submits a command; it is carried out between two decisions, in the
runner's thread. Whoever wants to look takes the latest snapshot, without a lock.
"""

import math
import sys
import threading
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import replace
from typing import Any, TypeVar

from ai4u_edu.blocks import RemoteBrain
from ai4u_edu.cycle import ControlRequestor
from ai4u_edu.publisher import FEW_TICKS, Publisher
from ai4u_edu.recording import Recorder, Replay
from ai4u_edu.recording.portrait import without_unknown_brains
from ai4u_edu.scenes import Scene
from ai4u_edu.slow_ticks import SlowTicks
from ai4u_edu.snapshot import Snapshot, Stage, picture_of, set_stage

T = TypeVar("T")

LATE = 0.25
"""A runner that is further behind than this (s) gives up catching up."""
PATIENCE = 0.25
"""Where agents decide at different times there may be no moment between all decisions; a command
waits this long (s) for one, and then takes any moment between two ticks."""
GIVE_WAY = 0.0002
"""Seconds after which a thread that computes lets another one go on. Python's own 5 ms would make a
tick late whenever pages are drawn."""

SLICE = 0.015
"""While a world waits for a call, it is looked so often (s) whether somebody wants something."""
SPRINT = 0.002
"""Seconds for which somebody who called may keep the world; a tick more, at most."""

LONGEST_TICK = 0.01
"""Seconds for which somebody who draws waits for the end of a tick."""
SOON = 0.0003
"""Who would begin to draw so shortly (s) before a tick waits for it too."""
HOPELESS = 0.02
"""A world whose ticks are late by so much (s), always, is not helped by waiting."""

ANOTHER_WORLD = "another world has taken its place; connect anew to drive there"


class Runner:
    """Ticks a world against the wall clock, in a thread of its own.

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
        self._commands: deque[tuple[float, Callable[[], None], Future[Any]]] = deque()
        self._wake = threading.Condition()
        self._stopping = False
        self._thread: threading.Thread | None = None
        self._turn = threading.Lock()  # whoever has it may let the world go on
        self._is_ticking = threading.Lock()
        self._is_asleep = False  # until the next tick is due
        self._called = threading.Event()
        self._expected = 0
        self._due = 0.0
        self.lateness = 0.0
        """How late (s) ticks lately began, on average."""
        self._window: deque[tuple[float, int]] = deque(maxlen=60)
        self._ticked = 0
        self._slow = SlowTicks(clock)
        sim.reset(seed)
        self._past: Snapshot | None = None
        self._generation = -1
        self._stage: Stage
        self._publisher = Publisher(self._picture(), clock)

    # -- for those who look ----------------------------------------------------------------------

    @property
    def latest(self) -> Snapshot:
        """What everything looked like after the last tick; replaced, never changed."""
        return self._publisher.latest

    def wait(self, seen: Snapshot, timeout: float) -> Snapshot:
        """The latest snapshot, as soon as it is another one than ``seen`` (or after timeout s)."""
        return self._publisher.wait(seen, timeout)

    def give_way(self) -> None:
        """Waits until no tick is due or under way; not long, nor in a world without a pause.

        One thread computes at a time. A tick between others that compute takes as many times as
        long; so who only draws says this between one thing and the next.
        """
        if self.is_unpaced() or self.lateness > HOPELESS:
            return
        enough = self._clock() + LONGEST_TICK
        while self._is_asleep and self._due - SOON < self._clock() < enough:
            time.sleep(GIVE_WAY)  # it would not get the processor when it wakes up
        if self._is_ticking.acquire(timeout=LONGEST_TICK):
            self._is_ticking.release()

    def is_unpaced(self) -> bool:
        """Whether the time runs as fast as it can, and not by the clock."""
        return math.isinf(self.time_scale)

    # -- for those who ask -----------------------------------------------------------------------

    def submit(self, command: Callable[[], T]) -> "Future[T]":
        """Has a command carried out in the runner's thread, between two decisions."""
        future: Future[T] = Future()

        def carry_out() -> None:
            if not future.set_running_or_notify_cancel():
                return
            try:
                result = self.recorder.guard(command) if self.recorder else command()
            except Exception as error:  # it belongs to whoever asked
                self._publish()
                future.set_exception(error)
            else:
                self._publish()  # first: who asked, and hears that it is done, looks at once
                future.set_result(result)

        with self._wake:
            if self._stopping:
                future.cancel()
            else:
                self._commands.append((self._clock(), carry_out, future))
                self._wake.notify()
        return future

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

        return self.submit(carry_out)

    def step_decision(self, agent_id: str | None = None) -> "Future[None]":
        """Lets a paused world go on until an agent's decision is over.

        Args:
            agent_id: whose; left out, the first one's. Of an agent that takes no more decisions in
                this episode, a single tick passes.
        """

        def carry_out() -> None:
            sim = self.sim
            agent = sim.agents[0] if agent_id is None else sim.agent(agent_id)
            self._tick()
            phase = sim.phase(agent)
            while phase.tick < phase.ticks and not (agent.done or self.error or sim.held):
                self._tick()
                phase = sim.phase(agent)

        return self.submit(carry_out)

    def scale_time(self, time_scale: float) -> "Future[None]":
        """Lets the time run faster or slower."""
        return self.submit(lambda: self.set_time_scale(time_scale))

    def show(self, past: Snapshot | None, *, goes_on: bool = False) -> "Future[None]":
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

    def use(
        self, sim: ControlRequestor, recorder: Recorder | None = None, *, seed: int | None = None
    ) -> "Future[None]":
        """Lets another world run in place of this one; the pace and the pause stay.

        Who held a key of the old one's lets go, and its agents' brains are closed, but for those
        that drive agents of the new one. Whoever has hold of an agent finds out by looking whether
        it is still among ``runner.sim.agents``.

        Args:
            sim: the other world. If it has begun no episode yet, one begins; else it goes on where
                it stands.
            recorder: of the other world. Left out, the one that there is listens to it from now on.
            seed: of the episode that begins.
        """
        return self.submit(lambda: self.exchange(sim, recorder, seed=seed))

    def exchange(
        self, sim: ControlRequestor, recorder: Recorder | None = None, *, seed: int | None = None
    ) -> None:
        """Lets another world run, as :meth:`use` does, at once; only for the runner's thread."""
        if not sim.episode:
            sim.reset(seed)  # before anything else: if it fails, all stays as it was
        self._replace(sim, recorder)

    # -- for those who are waited for ------------------------------------------------------------

    def expect_call(self) -> None:
        """Said by a link that was asked: its answer will come with a :meth:`call`."""
        self._expected += 1

    def call(self) -> None:
        """Something that the world waits for is there.

        When all is there, a world that runs as fast as it goes goes on right here, in the caller's
        thread, until it waits again: to wake the runner's thread, and to be woken by it, takes
        longer than a tick does.
        """
        self._expected -= 1
        if self._expected > 0:
            return
        if not self._may_sprint() or not self._turn.acquire(blocking=False):
            self._called.set()
            return
        try:
            end = self._clock() + SPRINT
            while self._may_sprint() and self._clock() < end:
                self._expected = 0
                self._tick(leaps=True)
                if self.sim.held:
                    return
                self._keep_time()
                if all(agent.brain.keeps_waiting for agent in self.sim.agents):
                    self._expected = len(self.sim.agents)
                    return
        finally:
            self._turn.release()
        self._called.set()

    # -- the thread ------------------------------------------------------------------------------

    def start(self) -> None:
        """Begins to tick."""
        sys.setswitchinterval(min(sys.getswitchinterval(), GIVE_WAY))
        self._thread = threading.Thread(target=self._run, name="runner", daemon=True)
        self._due = self._clock()
        self._thread.start()

    def stop(self) -> None:
        """Ends the thread; commands that still wait are cancelled, brains are closed."""
        with self._wake:
            self._stopping = True
            self._wake.notify()
        if self._thread is not None:
            self._thread.join()
        while self._commands:
            self._commands.popleft()[2].cancel()
        if self.recorder is not None:
            self.recorder.finish()
        for agent in self.sim.agents:
            agent.brain.close()

    def set_time_scale(self, time_scale: float) -> None:
        """Sets the time scale at once; only for the runner's thread, or before it starts."""
        if not time_scale > 0:
            raise ValueError(f"time scale: expected a number above 0, got {time_scale}")
        self.time_scale = time_scale

    def advance(self) -> None:
        """Carries out what was asked, and lets one tick pass unless the time stands still.

        The runner's own thread does nothing else; who has none may call it instead.
        """
        self._carry_out_commands()
        if self.paused or self.error:
            self._rest()
        else:
            self._tick(leaps=self.is_unpaced())
            self._keep_time()

    def _may_sprint(self) -> bool:
        """Whether there is nothing to wait for but ticks, and a thread that would do them."""
        standing = self.paused or self.error or self._commands or self._stopping
        return self.is_unpaced() and self._thread is not None and not standing

    def _run(self) -> None:
        while not self._stopping:
            with self._turn:
                self._expected = 0
                self.advance()
            self._called.clear()  # whoever called before others were asked called for nothing
            if self.sim.held and self._expected > 0:
                self._called.wait(SLICE)

    def _rest(self) -> None:
        self._window.clear()
        self.lateness = 0.0
        with self._wake:
            self._wake.wait_for(lambda: self._commands or self._stopping, 0.1)
        for agent in self.sim.agents:
            agent.brain.idle()
        self._publish()  # keys that are held, and the like, go on
        self._due = self._clock()

    def _tick(self, *, leaps: bool = False) -> None:
        """A tick, or as many as make a decision."""
        began, self._past = self._clock(), None
        ticks = 1
        with self._is_ticking:
            try:
                if leaps:
                    ticks = self.sim.leap() or 1
                else:
                    self.sim.tick()
            except Exception as error:  # a student's block may raise anything; the page shows it
                self.error = _sentence(error)
            ended = self._clock()
            if not self.sim.held:  # a world that waits for a script is not slow
                self._ticked += ticks
                self._slow.note((ended - began) / ticks, self.sim.world.count_contacts)
            self._show(ended, ended - began)

    def _show(self, now: float, took: float) -> None:
        """Publishes how it looks after a tick, if there is time for that, or something is wrong."""
        period = self.sim.world.dt / self.time_scale
        next_due = self._due + period
        is_due = self._publisher.is_due(now, took=took, next_due=next_due, period=period)
        if is_due or self.error:
            self._publish()

    def _keep_time(self) -> None:
        now = self._clock()
        self._window.append((now, self._ticked))
        if self.sim.held:
            self._due = now  # the time stood still: there is nothing to catch up with
            return
        period = self.sim.world.dt / self.time_scale
        self._due = max(self._due + period, now - LATE)
        late = max(now - self._due, 0.0) if period else 0.0  # as fast as it goes is never late
        self.lateness += FEW_TICKS * (late - self.lateness)
        if self._due > now:
            self._is_asleep = True
            time.sleep(self._due - now)
            self._is_asleep = False

    def _carry_out_commands(self) -> None:
        while self._commands:
            asked, command, _ = self._commands[0]
            standing = self.paused or self.error or self.sim.held or self.sim.between_decisions()
            if not standing and self._clock() - asked < PATIENCE:
                return
            self._commands.popleft()
            command()

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
                self.recorder.switch(False)
            self.recorder = recorder
        elif self.recorder is not None:
            self.recorder.listen_to(sim)
        self.error, self._past, self._generation = "", None, -1
        self._slow.clear()
        self._window.clear()
        stay = [agent.brain for agent in sim.agents]
        for agent in before.agents:
            agent.keyboard.release()
            brain = agent.brain
            if any(brain is each for each in stay):
                continue
            if isinstance(brain, RemoteBrain):
                brain.close(ANOTHER_WORLD)
            else:
                brain.close()

    def _publish(self) -> None:
        self._publisher.publish(lambda: self._past or self._picture())

    def _as_past(self, past: Snapshot) -> Snapshot:
        """A moment of the past, as it is shown; where it can be, on the stage that is there now."""
        same = past.stage is self._stage or past.stage == self._stage
        return replace(
            past,
            stage=self._stage if same else past.stage,
            paused=True,
            time_scale=self.time_scale,
        )

    def _picture(self) -> Snapshot:
        sim = self.sim
        if sim.world.generation != self._generation:
            self._generation = sim.world.generation
            stage = set_stage(sim)
            if getattr(self, "_stage", None) != stage:
                self._stage = stage
        return picture_of(
            sim,
            self._stage,
            paused=self.paused,
            time_scale=self.time_scale,
            real_time_factor=self._real_time_factor(),
            error=self.error,
            slow_tick=self._slow.slowest,
        )

    def _real_time_factor(self) -> float:
        if len(self._window) < 2:
            return (
                0.0 if self.paused else self.time_scale if math.isfinite(self.time_scale) else 1.0
            )
        (began, first), (ended, last) = self._window[0], self._window[-1]
        return (last - first) * self.sim.world.dt / max(ended - began, 1e-9)


def _sentence(error: Exception) -> str:
    notes = "".join(f" ({note})" for note in getattr(error, "__notes__", ()))
    return f"{type(error).__name__}: {error}{notes}"
