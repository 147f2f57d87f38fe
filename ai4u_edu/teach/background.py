"""Processes that learn beside a world that must not wait for them."""

import os
import subprocess
import sys
from contextlib import suppress

import msgspec
import psutil
from msgspec import Struct

from ai4u_edu.base.numeric_threads import ONE_THREAD
from ai4u_edu.base.process_family import end_with_parent
from ai4u_edu.locale import packed

NICENESS = 19
"""Niceness of the processes that are started here."""
MAX_MEMORY_BYTES = 512 * 2**20


def start_process(module: str) -> "subprocess.Popen[bytes]":
    """Start a module as a process that waits for its request, and writes to a pipe."""
    return subprocess.Popen(  # noqa: S603 - a module of ours, named in the code
        [sys.executable, "-m", module, str(os.getpid()), str(NICENESS)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env=os.environ | ONE_THREAD,
    )


def send_request(process: "subprocess.Popen[bytes]", request: Struct) -> None:
    """Give a process its request, as JSON.

    Raises:
        OSError: it has ended already.
    """
    assert process.stdin is not None  # noqa: S101 - start_process asks for the pipe
    process.stdin.write(msgspec.json.encode(request, enc_hook=packed))
    process.stdin.close()


def cpu_s(process: "subprocess.Popen[bytes]") -> float:
    """Return the processor time (s) that a process has used; 0 after its end."""
    with suppress(psutil.Error):
        times = psutil.Process(process.pid).cpu_times()
        return float(times.user + times.system)
    return 0.0


def leave_the_processor_to_others() -> None:
    """Give this process a low priority and little memory, and end it with its parent.

    Its arguments are the parent's id (a parent that was killed before this has another one) and the
    niceness, which the parent says.
    """
    if sys.platform == "win32":
        return
    end_with_parent(int(sys.argv[1]))
    import resource

    os.nice(int(sys.argv[2]))
    _, hard = resource.getrlimit(resource.RLIMIT_DATA)
    resource.setrlimit(resource.RLIMIT_DATA, (MAX_MEMORY_BYTES, hard))
