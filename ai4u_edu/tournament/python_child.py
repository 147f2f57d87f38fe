"""The process of a Python program: ``python -m ai4u_edu.tournament.python_child CPU_SECONDS``.

It reads a line of JSON and answers with one, until its input ends. It gives up what a program in a
game does not need before it loads the program. The files that its user can read, it can read too.
"""

import ctypes
import json
import os
import random
import sys
from typing import Any

from ai4u_edu.program import Program, ProgramError

MEMORY_BYTES = 2**30
CLONE_NEWUSER, CLONE_NEWNET = 0x10000000, 0x40000000
NO_LIMIT_S = 1e9
"""Wall time does not count; the other process measures processor time."""


def main() -> None:
    """Answer until the input ends."""
    lines = sys.stdin.buffer
    out = os.fdopen(os.dup(1), "wb")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # what the program prints is no answer
    give_up(int(sys.argv[1]))
    program: Program | None = None
    for line in lines:
        answer: dict[str, Any]
        try:
            message = json.loads(line)
            if "source" in message:
                program = _loaded(message)
                answer = {"answer": None}
            elif program is None:
                answer = {"error": "no program was loaded"}
            elif "begin" in message:
                program.begin()
                answer = {"answer": None}
            else:
                answer = {"answer": program.decide(message["percept"])}
        except ProgramError as error:
            where = f", line {error.line}" if error.line else ""
            file = "" if program is None else program.file
            answer = {"error": f"{file}{where}: {error.text}".removeprefix(", ").removeprefix(": ")}
        except MemoryError:
            answer = {"error": "it needs more memory than a program may have"}
        except (Exception, SystemExit) as error:  # the program's
            answer = {"error": f"{type(error).__name__}: {error}"[:500]}
        out.write(json.dumps(answer).encode() + b"\n")
        out.flush()


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
    """Give up memory, processor time, files to write, and on Linux the network."""
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
    if sys.platform.startswith("linux"):
        libc = ctypes.CDLL(None, use_errno=True)
        if libc.unshare(CLONE_NEWNET) != 0:
            libc.unshare(CLONE_NEWUSER | CLONE_NEWNET)  # some systems forbid both


if __name__ == "__main__":
    main()
