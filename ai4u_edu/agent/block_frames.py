"""The block that a stack of Python frames is in: for errors that name none, and endless loops."""

import gc
import os
import sys
import sysconfig
import threading
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import CodeType, FrameType, TracebackType

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.events import Event
from ai4u_edu.blocks import Actuator, Brain, Controller, RewardFunc, Sensor
from ai4u_edu.blocks.block import Block
from ai4u_edu.locale import Text
from ai4u_edu.locale import gettext as _

KINDS: tuple[tuple[type[Block], Text], ...] = (
    (Sensor, _("Sensor {name}")),
    (Actuator, _("Actuator {name}")),
    (RewardFunc, _("Reward function {name}")),
    (Brain, _("Brain {name}")),
    (Controller, _("Controller {name}")),
)
"""The kinds of blocks, with their names in a sentence."""
NAME_FIELDS = ("perception_key", "action_name", "name")
MAX_NAME_CHARS = 80
_walking = threading.RLock()
"""Held while frames are looked at, and no garbage is collected."""


@dataclass(frozen=True, slots=True)
class CodePlace:
    """The block, or the event's handler, and the line that some frames are in."""

    block: str
    """Kind, class and name, such as ``Sensor WallDistance 'wall'``, or ``Handler of end_of_step``;
    empty outside all of them."""
    agent: str
    """The id of the block's agent; empty if it is not known."""
    where: str
    """File and line, such as ``my_blocks.py, line 12``; a line of a user's own if there is one."""

    def __str__(self) -> str:
        """Name the block and its agent, to begin a sentence with.

        >>> str(CodePlace("Sensor WallDistance 'wall'", "0", "my_blocks.py, line 12"))
        "Sensor WallDistance 'wall' of agent '0'"
        """
        return str(self.title)

    @property
    def title(self) -> str:
        """The same, as a text that can be translated."""
        block = self.block or _("The world")
        return _("{block} of agent {id!r}", block=block, id=self.agent) if self.agent else block


def frames_of_thread(thread_id: int) -> list[FrameType]:
    """Return what a thread runs now, outermost call first; empty if it has ended.

    Python makes these objects when they are asked for, so nothing is collected here.
    """
    if not hasattr(sys, "_current_frames"):  # CPython has it; another Python may not
        return []
    frames = []
    with _nothing_collected():
        frame = sys._current_frames().get(thread_id)
        while frame is not None:
            frames.append(frame)
            frame = frame.f_back
    return frames[::-1]


@contextmanager
def _nothing_collected() -> Iterator[None]:
    """Let no garbage be collected while frames of another thread are made, or their locals are.

    Python would collect it in the middle of that. What runs then lets the other thread go on:
    CPython 3.11 reads frames that are gone, which ends the process, or waits for ever (CPython's
    issue 106883).
    """
    with _walking:
        collects = gc.isenabled()
        gc.disable()
        try:
            yield
        finally:
            if collects:
                gc.enable()


@_nothing_collected()
def find_place(
    calls: Sequence[tuple[FrameType, int]], agents: Iterable[BasicAgent] = ()
) -> CodePlace:
    """Find the block that some calls are in.

    Args:
        calls: frames and their current lines, outermost call first.
        agents: of the world that runs; one of them may own the block.
    """
    owners = [_first_argument(frame) for frame, _line in calls]
    first = next((n for n, each in enumerate(owners) if isinstance(each, Block)), None)
    if first is None:  # a handler of a block's own is that block's
        first = next((n for n, each in enumerate(owners) if isinstance(each, Event)), 0)
    owner = owners[first] if owners else None
    inner = calls[first:]
    own = [call for call in inner if _is_users(call[0])]
    frame_and_line = (own or inner)[-1:]
    places = [
        _("{file}, line {line}", file=_file_of(frame), line=line) for frame, line in frame_and_line
    ]
    where: str = places[0] if places else ""
    if isinstance(owner, Event):
        agent = calls[first][0].f_locals.get("agent")
        event = getattr(owner, "name", "")  # not there yet while it is made
        return CodePlace(_("Handler of {event}", event=event), getattr(agent, "id", ""), where)
    if not isinstance(owner, Block):
        return CodePlace("", "", where)
    return CodePlace(describe(owner), _agent_of(owner, agents, calls[:first]), where)


def calls_of_thread(thread_id: int) -> list[tuple[FrameType, int]]:
    """Return the frames of a thread with the lines that they are at, outermost call first."""
    return [(frame, line_at(frame.f_code, frame.f_lasti)) for frame in frames_of_thread(thread_id)]


def calls_of_error(trace: TracebackType | None) -> list[tuple[FrameType, int]]:
    """Return the frames that an error came through with their lines, outermost call first."""
    calls = []
    while trace is not None:
        calls.append((trace.tb_frame, line_at(trace.tb_frame.f_code, trace.tb_lasti)))
        trace = trace.tb_next
    return calls


def line_at(code: CodeType, instruction: int) -> int:
    """Return the line of an instruction, or the one before it for an instruction without a line.

    Python gives no line to some jumps back to a loop's head; ``frame.f_lineno`` and
    ``traceback.tb_lineno`` are None there.

    Args:
        code: the function's.
        instruction: offset of the instruction, such as ``frame.f_lasti``.
    """
    lines = [line for start, _end, line in code.co_lines() if line and start <= instruction]
    return lines[-1] if lines else code.co_firstlineno


def describe(block: Block) -> str:
    """Name a block in a sentence: kind, class, and its own name if it has one.

    >>> from ai4u_edu import TouchSensor
    >>> describe(TouchSensor(target="box"))
    "Sensor TouchSensor 'touch'"
    """
    kind = next((words for base, words in KINDS if isinstance(block, base)), _("Block {name}"))
    if isinstance(block, Brain):
        controller = getattr(block, "controller", None)
        inner = f"({type(controller).__name__})" if isinstance(controller, Block) else ""
        return Text(kind.msgid, {"name": f"{type(block).__name__}{inner}"})
    names = (getattr(block, field, "") for field in NAME_FIELDS)
    name = next((name for name in names if isinstance(name, str) and name), "")
    shown = f" {name[:MAX_NAME_CHARS]!r}" if name else ""
    return Text(kind.msgid, {"name": f"{type(block).__name__}{shown}"})


def _first_argument(frame: FrameType) -> object:
    """Return ``self`` of a method's frame, by whatever name it goes."""
    code = frame.f_code
    return frame.f_locals.get(code.co_varnames[0]) if code.co_argcount else None


def _file_of(frame: FrameType) -> str:
    """Return the name of a frame's file; of a notebook's cell it would be a number."""
    path = Path(frame.f_code.co_filename)
    return _("a notebook's cell") if path.parent.name.startswith("ipykernel_") else path.name


def _agent_of(
    block: Block, agents: Iterable[BasicAgent], outer: Sequence[tuple[FrameType, int]]
) -> str:
    for agent in agents:
        owned = (*agent.sensors, *agent.actuators, *agent.rewards, *agent.brains)
        if any(each is block for each in owned):
            return agent.id
    for frame, _line in reversed(outer):  # an agent that is about to be put into the world
        for value in frame.f_locals.values():
            if isinstance(value, BasicAgent):
                return getattr(value, "id", "")  # not there yet while it is made
    return ""


def _is_users(frame: FrameType) -> bool:
    """Return whether a frame runs a user's own code, and not this package's or a library's."""
    file = frame.f_code.co_filename
    return not file.startswith(_FOREIGN)


def _foreign() -> tuple[str, ...]:
    paths = sysconfig.get_paths()
    folders = {paths[name] for name in ("stdlib", "platstdlib", "purelib", "platlib")}
    folders.add(str(Path(__file__).parent.parent))
    return ("<frozen", *(f"{folder}{os.sep}" for folder in folders))


_FOREIGN = _foreign()
