"""Controllers for an entry's drivers, made for one game; a program gets a process of its own."""

import base64
import json
import os
import queue
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, cast

import numpy as np
import psutil

from ai4u_edu.agent import BasicAgent, ControlRequestor
from ai4u_edu.base.errors import BlockError
from ai4u_edu.base.process_family import kill_descendants
from ai4u_edu.blocks import (
    Answer,
    Block,
    Brain,
    Controller,
    LocalBrain,
    NeuralNetController,
    Percept,
)
from ai4u_edu.blocks.agent_view import AgentView
from ai4u_edu.blocks.brains.brain import Action
from ai4u_edu.blocks.brains.controllers.key_defaults import listens_to_keys
from ai4u_edu.blocks.brains.controllers.replay import ReplayController
from ai4u_edu.games.tournament.entry import Driver
from ai4u_edu.games.tournament.limits import (
    CHECK_INTERVAL_S,
    DECISION_CPU_S,
    GAME_CPU_S,
    LOAD_CPU_S,
    OverTimeError,
    over_load_time,
    over_time,
)
from ai4u_edu.games.tournament.sides import Sides
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import unpacked
from ai4u_edu.recording import Episode
from ai4u_edu.recording.episode import decode
from ai4u_edu.scenes import Scene
from ai4u_edu.world import WorldView

START_CPU_S = 20.0
"""Processor time in which a process starts and loads its program."""
SILENCE_LIMIT_S = 120.0
"""Wall time without an answer, for a program that sleeps."""
END_TIMEOUT_S = 2.0
"""Wall time in which a process that has closed its output ends by itself."""
MAX_ANSWER_BYTES = 65_536
CHILD_MODULE = "ai4u_edu.games.tournament.python_child"
MAX_WAITING_LINES = 4
"""Lines that are read before somebody asks for them; then the writer has to wait."""
READER_END_TIMEOUT_S = 1.0
"""Time in which the thread notices that the writer has ended."""
READER_JOIN_TIMEOUT_S = 0.01
ANSWERS = "answers"
"""Kind of a driver with the answers of a recorded game; see :class:`RecordedAnswers`."""


@dataclass(frozen=True)
class Made:
    """A controller, and how often it decides."""

    controller: Controller
    skip_frame: int
    repeat_action: bool


class RandomController(Controller):
    """Draws actions from the world's generator."""

    abstract = True  # an entry of a tournament

    def on_setup(self, agent: AgentView, view: WorldView) -> None:
        """Keep what it draws from."""
        self._view, self._name = view, f"{agent.id}/random entry"
        self._spaces = {
            each.action_name: each.space() for each in agent.actuators if each.is_output
        }

    def get_action(self, percept: Percept) -> Answer:  # noqa: ARG002  # it looks at nothing
        """Return a random action."""
        rng = self._view.random(self._name)
        return {name: _drawn(space, rng) for name, space in self._spaces.items()}


class RecordedAnswers(Controller):
    """Gives the answers of a recorded game again, in place of what can't be asked a second time.

    Where it has no more of them, its program failed, or the end of the game cut off a decision.
    """

    abstract = True  # for a game that is verified

    def attach(self, actions: Sequence[Action], reason: str) -> None:
        """Set the answers, and the reason for which there are no more; empty if it did not fail."""
        self._actions, self._reason, self._turn = actions, reason, 0

    def get_action(self, percept: Percept) -> Answer:  # noqa: ARG002  # it looks at nothing
        """Return the next answer.

        Raises:
            BlockError: it failed at this decision.
        """
        self._turn += 1
        if self._turn > len(self._actions) and self._reason:
            raise BlockError(unpacked(self._reason))
        return self._actions[min(self._turn, len(self._actions)) - 1]


def driver_for(drivers: Mapping[str, Driver], sides: Sides, agent_id: str) -> Driver:
    """Return an entry's driver for an agent.

    Raises:
        BlockError: the entry has none for it.
    """
    for part in (*sides.parts_of(agent_id), ""):
        if part in drivers:
            return drivers[part]
    raise BlockError(
        _(
            "it has no driver for agent {agent_id!r}; expected one of {parts_of} in "
            "NAME=PART:SPEC,PART:SPEC",
            agent_id=agent_id,
            parts_of=", ".join(sides.parts_of(agent_id)),
        )
    )


def make(
    driver: Driver, sim: ControlRequestor, sides: Sides, agent: BasicAgent, folder: Path, seed: int
) -> Made:
    """Return a driver's controller for an agent.

    Args:
        driver: the driver.
        sim: the world of the game, as its scene built it.
        sides: of the scene.
        agent: the agent.
        folder: a folder for files.
        seed: of the game.

    Raises:
        AI4UError: it can't be made; a sentence on the entry.
        OverTimeError: a network took too long to load.
    """
    own = agent.brain
    kind = driver["kind"]
    if kind == "network":
        return _network(driver, own, folder)
    if kind == "scene":
        return scripted(sim, sides, agent)
    if kind == "episode":
        return _recorded(driver, sides, agent, own)
    if kind == ANSWERS:
        return Made(_answers(driver, agent), own.skip_frame, own.repeat_action)
    controller: Controller
    if kind == "python":
        controller = PythonController()
        source = base64.b64decode(driver["data"]).decode("utf-8", "replace")
        controller.attach(source, driver["file"], driver["name"], f"{seed}/{agent.id}")
    elif kind == "controller":
        controller = cast(Controller, Block.types[driver["type"]]())
    else:
        controller = RandomController()
    return Made(controller, own.skip_frame, own.repeat_action)


def scripted_agents(scene: Scene, sides: Sides) -> frozenset[str]:
    """Return the ids of the agents that a scene's own scripted controllers can drive."""
    sim = scene.build()
    found = set()
    for agent in sim.agents:
        with suppress(BlockError):
            scripted(sim, sides, agent)
            found.add(agent.id)
    return frozenset(found)


def load_network(driver: Driver, folder: Path) -> NeuralNetController:
    """Return the controller of a network, which is loaded.

    Args:
        driver: the network.
        folder: gets its file.

    Raises:
        OverTimeError: that took too long.
        BlockError: it is no network.
    """
    place = folder / str(len([*folder.iterdir()]))
    place.mkdir()
    path = place / Path(driver["file"]).name[-100:]
    path.write_bytes(base64.b64decode(driver["data"]))
    controller = NeuralNetController(model_path=str(path), repeat=False)
    began = time.thread_time()
    _ = controller.network
    if time.thread_time() - began > LOAD_CPU_S:
        raise OverTimeError(over_load_time())
    return controller


def _network(driver: Driver, own: Brain, folder: Path) -> Made:
    controller = load_network(driver, folder)
    rhythm = controller.network.rhythm
    given = LocalBrain(controller=controller).changed(
        **{"skip_frame": own.skip_frame, "repeat_action": own.repeat_action} | rhythm
    )
    return Made(controller, given.skip_frame, given.repeat_action)


def scripted(sim: ControlRequestor, sides: Sides, agent: BasicAgent) -> Made:
    """Return the scene's scripted controller for an agent, or that of its counterpart.

    Raises:
        BlockError: neither has one.
    """
    for name in filter(None, (agent.id, sides.counterpart(agent.id))):
        for brain in sim.agent(name).brains:
            controller = getattr(brain, "controller", None)
            if isinstance(controller, Controller) and not listens_to_keys(type(controller)):
                fresh = type(controller)(**controller.given())
                return Made(fresh, brain.skip_frame, brain.repeat_action)
    raise BlockError(_("the scene has no scripted controller for agent {id!r}", id=agent.id))


def _answers(driver: Driver, agent: BasicAgent) -> RecordedAnswers:
    """Return the answers of an agent.

    Raises:
        BlockError: it failed before its first decision.
    """
    actions: list[Action] = []
    if driver["data"]:
        episode = decode(Episode, base64.b64decode(driver["data"]), "recording")
        actions = [each.action for each in episode.agent(agent.id)]
    if not actions:
        raise BlockError(
            unpacked(driver["reason"])
            or _("agent {id!r} has no decision in its recording", id=agent.id)
        )
    controller = RecordedAnswers()
    controller.attach(actions, driver["reason"])
    return controller


def _recorded(driver: Driver, sides: Sides, agent: BasicAgent, own: Brain) -> Made:
    episode = decode(Episode, base64.b64decode(driver["data"]), driver["file"])
    names = (agent.id, sides.counterpart(agent.id))
    record = next((each for name in names for each in episode.agents if each.id == name), None)
    if record is None or not len(record):
        raise BlockError(
            _("{file}: it has no decision of agent {id!r}", file=driver["file"], id=agent.id)
        )
    actions = [{name: list(numbers) for name, numbers in each.action.items()} for each in record]
    skip = int(record.skip[0])
    return Made(ReplayController(actions=actions, ending="repeat"), skip, own.repeat_action)


def _drawn(space: Any, rng: np.random.Generator) -> Any:
    if hasattr(space, "n"):
        return int(space.start + rng.integers(space.n))
    return rng.uniform(space.low, space.high)


class PythonController(Controller):
    """Sends readings to a process that runs a program, and takes its actions.

    The program runs as in the page, see :mod:`ai4u_edu.program`. The process has limits on
    processor time and memory, and on Linux no network where the system lets a process give it up;
    see :mod:`ai4u_edu.games.tournament.python_child`. It is no sandbox: it has
    the rights of its user.
    """

    abstract = True  # an entry of a tournament

    def attach(self, source: str, file: str, name: str, seed: str) -> None:
        """Set the program.

        Args:
            source: its text.
            file: its name, for messages.
            name: of the function or the class in it; empty for ``decide``.
            seed: of Python's random numbers.
        """
        self._load = {"source": source, "file": file, "name": name, "seed": seed}
        self._child: _Child | None = None

    def on_setup(self, agent: AgentView, view: WorldView) -> None:  # noqa: ARG002  # a hook's form
        """Start the process, and load the program.

        Raises:
            BlockError: a mistake in the program.
        """
        outputs = {each.action_name: each.limits() for each in agent.actuators if each.is_output}
        self._child = _Child()
        self._child.ask(self._load | {"outputs": outputs}, START_CPU_S)

    def on_reset(self, agent: AgentView, view: WorldView) -> None:  # noqa: ARG002  # a hook's form
        """Begin an episode of the program."""
        if self._child is not None:
            self._child.ask({"begin": True}, DECISION_CPU_S)

    def get_action(self, percept: Percept) -> Action:
        """Return the program's action.

        Raises:
            BlockError: a mistake in the program, or it took too long.
        """
        if self._child is None:
            raise BlockError(_("the program was not started"))
        answer = self._child.ask({"percept": _plain(percept)}, DECISION_CPU_S)
        if not isinstance(answer, dict):
            raise BlockError(_("expected numbers by the actuator's name"))
        return answer

    def close(self) -> None:
        """End the process."""
        if self._child is not None:
            self._child.close()
            self._child = None


class _Child:
    def __init__(self) -> None:
        env = {
            "PYTHONPATH": os.pathsep.join(filter(None, sys.path)),
            "PYTHONHASHSEED": "0",  # sets in the same order in each game
            "OPENBLAS_NUM_THREADS": "1",
        }
        if sys.platform == "win32":
            env["SYSTEMROOT"] = os.environ.get("SYSTEMROOT", "")
        limit_s = str(int(GAME_CPU_S + START_CPU_S))
        self._folder = tempfile.TemporaryDirectory(prefix="ai4u-program-")
        self._process = subprocess.Popen(  # noqa: S603  # our own module, with the user's program
            [sys.executable, "-B", "-m", CHILD_MODULE, limit_s, str(os.getpid())],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            cwd=self._folder.name,
            env=env,
            start_new_session=sys.platform != "win32",
        )
        self._guard = self._program = psutil.Process(self._process.pid)
        self._reader = LineReader(self._out, MAX_ANSWER_BYTES)
        try:
            self._program = psutil.Process(json.loads(self._line(START_CPU_S, 0.0))["pid"])
        except (BlockError, ValueError, psutil.Error):
            self.close()
            raise BlockError(_("the program's process did not start")) from None

    def ask(self, message: dict[str, Any], limit_s: float) -> Any:
        """Send a message and return the answer; a processor time of ``limit_s`` is allowed."""
        before = self._used_s()
        try:
            self._in.write(json.dumps(message).encode() + b"\n")
            self._in.flush()
        except OSError:
            raise BlockError(self._ended()) from None
        line = self._line(limit_s, before)
        try:
            answer = json.loads(line)
            if "error" in answer:
                raise BlockError(unpacked(str(answer["error"])))
            return answer["answer"]
        except (ValueError, TypeError, KeyError, RecursionError):
            raise BlockError(_("expected an answer of the program, got other data")) from None

    def _line(self, limit_s: float, before_s: float) -> bytes:
        """Return the next line of the process.

        Args:
            limit_s: processor time that it may take for it.
            before_s: processor time that it had taken before.
        """
        since = time.monotonic()
        line = None
        while line is None:
            line = self._reader.line(CHECK_INTERVAL_S)
            if line is not None and not line.endswith(b"\n") and len(line) <= MAX_ANSWER_BYTES:
                raise BlockError(self._ended())
            used = self._used_s() - before_s
            if used > limit_s:
                self.close()
                raise BlockError(over_time(used))
            if line is None and time.monotonic() - since > SILENCE_LIMIT_S:
                self.close()
                raise BlockError(
                    _(
                        "the program did not answer for {silence_limit_s:g} s",
                        silence_limit_s=SILENCE_LIMIT_S,
                    )
                )
        if len(line) > MAX_ANSWER_BYTES:
            self.close()
            raise BlockError(_("expected an answer of at most {most} bytes", most=MAX_ANSWER_BYTES))
        return line

    def close(self) -> None:
        """End the process, and all that it has started."""
        for process in (self._guard, self._program):
            kill_descendants(process)
            with suppress(psutil.Error):
                process.kill()
        if sys.platform != "win32":
            with suppress(OSError):  # those of its group that it has not started
                os.killpg(self._process.pid, signal.SIGKILL)
        with suppress(subprocess.TimeoutExpired):  # one that another process traces
            self._process.wait(END_TIMEOUT_S)
        with suppress(OSError):
            self._in.close()
        self._reader.close()
        self._folder.cleanup()

    @property
    def _in(self) -> IO[bytes]:
        if self._process.stdin is None:
            raise RuntimeError("started without a pipe")
        return self._process.stdin

    @property
    def _out(self) -> IO[bytes]:
        if self._process.stdout is None:
            raise RuntimeError("started without a pipe")
        return self._process.stdout

    def _used_s(self) -> float:
        try:
            times = self._program.cpu_times()
        except psutil.Error:
            return 0.0
        return float(sum(times[:4]))  # also of processes that it has started and that have ended

    def _ended(self) -> str:
        try:
            code = self._process.wait(END_TIMEOUT_S)
        except subprocess.TimeoutExpired:
            self.close()
            return _("the program's process has closed its output")
        if code < 0:
            return _("the program's process was ended by {name}", name=signal.Signals(-code).name)
        return _("the program's process ended (exit status {code})", code=code)


def _plain(percept: Percept) -> dict[str, Any]:
    return {
        name: reading.tolist() if isinstance(reading, np.ndarray) else reading
        for name, reading in percept.items()
    }


class LineReader:
    """Reads a pipe in a thread of its own: Windows can't wait for a pipe with a time limit.

    One other thread calls it.

    Args:
        pipe: what is read; it is closed with the reader.
        max_bytes: a longer line is cut off there.
    """

    def __init__(self, pipe: IO[bytes], max_bytes: int) -> None:
        self._pipe, self._max_bytes = pipe, max_bytes
        self._lines: queue.Queue[bytes] = queue.Queue(MAX_WAITING_LINES)
        self._is_closed = False
        self._thread = threading.Thread(target=self._read, name="line reader", daemon=True)
        self._thread.start()

    def line(self, timeout_s: float) -> bytes | None:
        """Return the next line; None if none comes in time.

        At the end of the pipe the line has no line break, and is usually empty; nor has a line that
        was cut off.
        """
        try:
            return self._lines.get(timeout=timeout_s)
        except queue.Empty:
            return None

    def close(self) -> None:
        """End the thread and close the pipe, once the writer has ended.

        If somebody else still holds the pipe open, both stay.
        """
        self._is_closed = True
        until = time.monotonic() + READER_END_TIMEOUT_S
        while self._thread.is_alive() and time.monotonic() < until:
            with suppress(queue.Empty):  # it may wait for a place in the queue
                self._lines.get_nowait()
            self._thread.join(READER_JOIN_TIMEOUT_S)
        if not self._thread.is_alive():
            self._pipe.close()

    def _read(self) -> None:
        line = b"\n"
        while line.endswith(b"\n") and not self._is_closed:
            try:
                line = self._pipe.readline(self._max_bytes + 1)
            except (OSError, ValueError):
                line = b""
            self._lines.put(line)
