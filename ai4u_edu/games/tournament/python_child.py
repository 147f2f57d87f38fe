"""The process of a Python program.

``python -m ai4u_edu.games.tournament.python_child CPU_S PARENT_ID``

On POSIX it is a guard, which starts the program in a second process and writes a line of JSON with
its id. When the program ends, or the parent does, the guard ends all that the program has started,
also in other sessions: it adopts them. On Linux, where the system lets a user do that, the program
sees no processes but its own, so it can neither end nor stop the guard or the tournament.

The second process reads a line of JSON and answers with one, until its input ends. It gives up what
a program in a game does not need before it loads the program. What its user can do with files, it
can do too.
"""

import ctypes
import json
import os
import random
import signal
import sys
from contextlib import suppress
from typing import Any, NoReturn

import psutil

from ai4u_edu.base.process_family import adopt_orphans, end_with_parent, kill_descendants
from ai4u_edu.locale import Text, packed
from ai4u_edu.locale import gettext as _
from ai4u_edu.program import Program, ProgramError
from ai4u_edu.program.texts import make_texts_with

MEMORY_BYTES = 2**30
CLONE_NEWNS, CLONE_NEWUSER, CLONE_NEWPID, CLONE_NEWNET = 0x20000, 0x10000000, 0x20000000, 0x40000000
MS_REC, MS_PRIVATE = 0x4000, 0x40000
NO_LIMIT_S = 1e9
"""Wall time does not count; the other process measures processor time."""


def main() -> None:
    """Start the program's process, and end with it."""
    cpu_s, parent = map(int, sys.argv[1:])
    if sys.platform == "win32":
        _write_line(1, {"pid": os.getpid()})
        serve(cpu_s)
        return
    has_own_ids = _leave_namespaces()
    adopt_orphans()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: _end(1))
    end_with_parent(parent, signal.SIGTERM)
    guard = os.getpid()
    program = os.fork()
    if program == 0:
        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, signal.SIG_DFL)
        end_with_parent(0 if has_own_ids else guard)
        if has_own_ids:
            _show_own_processes()
        serve(cpu_s)
        os._exit(0)
    _write_line(1, {"pid": program})
    nothing = os.open(os.devnull, os.O_RDWR)
    for descriptor in (0, 1):  # who waits for their ends waits for those of the program
        os.dup2(nothing, descriptor)
    _, status = os.waitpid(program, 0)
    code = os.waitstatus_to_exitcode(status)
    if code >= 0:
        _end(code)
    kill_descendants(psutil.Process())
    if code != -signal.SIGKILL:
        signal.signal(-code, signal.SIG_DFL)
    os.kill(os.getpid(), -code)
    os._exit(1)


def _end(code: int) -> NoReturn:
    """End all that the program has started, and this process."""
    kill_descendants(psutil.Process())
    os._exit(code)


def _leave_namespaces() -> bool:
    """Have processes that are started from now on see no others, and no network; on Linux.

    Returns:
        True if they have ids of their own.
    """
    if not sys.platform.startswith("linux"):
        return False
    libc = ctypes.CDLL(None, use_errno=True)
    for flags in (CLONE_NEWPID | CLONE_NEWNET, CLONE_NEWUSER | CLONE_NEWPID | CLONE_NEWNET):
        if libc.unshare(flags) == 0:
            return True
    for flags in (CLONE_NEWNET, CLONE_NEWUSER | CLONE_NEWNET):
        if libc.unshare(flags) == 0:  # some systems forbid all of it
            break
    return False


def _show_own_processes() -> None:
    """Have /proc show the processes of this namespace alone; it shows those of the one before."""
    libc = ctypes.CDLL(None, use_errno=True)
    is_own = libc.unshare(CLONE_NEWNS) == 0
    if is_own and libc.mount(b"none", b"/", None, MS_REC | MS_PRIVATE, None) == 0:
        libc.mount(b"proc", b"/proc", b"proc", 0, None)


def _write_line(descriptor: int, message: dict[str, Any]) -> None:
    os.write(descriptor, json.dumps(message).encode() + b"\n")


def serve(cpu_s: int) -> None:
    """Answer until the input ends.

    Args:
        cpu_s: limit of processor time.
    """
    out = os.dup(1)
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # what the program prints is no answer
    give_up(cpu_s)
    make_texts_with(Text)  # which the other process unpacks
    file = ""
    program: Program | None = None
    for line in sys.stdin.buffer:
        answer: dict[str, Any]
        try:
            message = json.loads(line)
            if "source" in message:
                file = message["file"]
                program = _loaded(message)
                answer = {"answer": None}
            elif program is None:
                answer = {"error": packed(_("no program was loaded"))}
            elif "begin" in message:
                program.begin()
                answer = {"answer": None}
            else:
                answer = {"answer": program.decide(message["percept"])}
        except ProgramError as error:
            answer = {"error": packed(error.in_file(file))}
        except MemoryError:
            answer = {"error": packed(_("it needs more memory than a program may have"))}
        except (Exception, SystemExit) as error:  # the program's
            answer = {"error": f"{type(error).__name__}: {error}"[:500]}
        with suppress(BrokenPipeError):  # the other process has ended, and so does the input
            _write_line(out, answer)


def _loaded(message: dict[str, Any]) -> Program:
    random.seed(message["seed"])
    outputs = {name: (low, high) for name, (low, high) in message["outputs"].items()}
    return Program.load(
        message["source"],
        message["file"],
        message["name"],
        outputs,
        limit_s=NO_LIMIT_S,
        keeps_lines=False,
    )


def give_up(cpu_s: int) -> None:
    """Give up memory, processor time, and content of files."""
    if sys.platform == "win32":
        return
    import resource

    for kind, limit in (
        (resource.RLIMIT_CPU, cpu_s),
        (resource.RLIMIT_AS, MEMORY_BYTES),
        (resource.RLIMIT_FSIZE, 0),
        (resource.RLIMIT_CORE, 0),
    ):
        _, hard = resource.getrlimit(kind)
        resource.setrlimit(kind, (limit if hard < 0 else min(limit, hard), hard))


if __name__ == "__main__":
    main()
