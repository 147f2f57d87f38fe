"""A world that runs by the wall clock, and what other threads may ask of it."""

import math
import warnings
from concurrent.futures import Future
from typing import TYPE_CHECKING

from ai4u_edu.agent.block_errors import reason_for_no_decision
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import NoDecisionError
from ai4u_edu.recording import Recorder, Replay
from ai4u_edu.recording.scene_export import without_unknown_brains
from ai4u_edu.recording.snapshot import Snapshot
from ai4u_edu.runtime.world_thread import WorldThread
from ai4u_edu.scenes import Scene

RENAMED_METHODS = {
    "use": "replace_sim",
    "exchange": "replace_sim_now",
    "show": "show_past",
    "call": "notify_answer",
    "expect_call": "expect_answer",
}


class Runner(WorldThread):
    """Runs a world in a thread of its own; pauses, resets, steps and replaces it on request.

    A block that does not return delays nothing but the world; :attr:`stall` reports it. All methods
    below may be called from any thread: they queue a command, which runs between two decisions, and
    return its future at once. To look at the world, take :attr:`latest`.
    """

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
            seed: the episode's seed; left out, the same one if it is locked, else a new one.
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
            for _ in range(ticks):
                self._tick()
                if self.error or self._stopping:
                    return

        return self.submit(command)

    def step_decision(self, agent_id: str | None = None) -> "Future[None]":
        """Tick a paused world until an agent's decision is over.

        Args:
            agent_id: left out, the first agent's. If the agent takes no more decisions in this
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
                raise NoDecisionError(f"agent {agent.id!r} took no decision: {why}")

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
            if goes_on and self._past is None:
                return
            if not self.paused:
                self._set_paused(True)
            self._past = None if past is None else self._as_past(past)

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
            agent: its id; left out, the one that acts first.

        Raises:
            RecordingError: there was no such decision, or it can't be replayed exactly.
        """
        replay.check(step, agent)  # here, since it may take longer than the world should wait

        def command() -> None:
            if not replay.fits(self.sim):
                other = Scene(without_unknown_brains(replay.episode.scene)).build()
                other.reset(replay.episode.seed)
                self._replace(other, None)
            replay.continue_from(step, agent=agent, sim=self.sim)
            self.error, self._past, self.paused = "", None, False

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
            recorder: of the other world. Left out, the present recorder listens to it from now on.
            seed: of the episode that begins.
        """
        return self.submit(lambda: self.replace_sim_now(sim, recorder, seed=seed))

    def replace_sim_now(
        self, sim: ControlRequestor, recorder: Recorder | None = None, *, seed: int | None = None
    ) -> None:
        """Run another world at once, as :meth:`replace_sim` does; only for the world's thread."""
        if not sim.episode:
            sim.reset(seed)  # before anything else: if it fails, all stays as it was
        self._replace(sim, recorder)

    def expect_answer(self) -> None:
        """Announce that :meth:`notify_answer` will be called; only for the world's thread."""
        self._answers.expect()

    def notify_answer(self) -> None:
        """Wake the world's thread if this is the last answer that it waits for."""
        self._answers.notify()

    def _reset(self, seed: int | None) -> None:
        self.sim.reset(seed)
        self.error, self._past = "", None

    def _set_paused(self, paused: bool) -> None:
        self.paused = paused
        if not paused:
            self._past = None
        else:
            self._release_keys()

    def _release_keys(self) -> None:
        for agent in self.sim.agents:
            agent.keyboard.release()

    def _check_not_held(self) -> None:
        if self.is_held:
            raise NoDecisionError("the teacher has stopped the world; wait until it goes on")

    if not TYPE_CHECKING:  # a type checker is to report the old names

        def __getattr__(self, name: str) -> object:
            """Return a method by the name that it had before; deprecated for one release."""
            new = RENAMED_METHODS.get(name)
            if new is None:
                raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
            warnings.warn(f"Runner.{name} is now Runner.{new}", DeprecationWarning, stacklevel=2)
            return getattr(self, new)
