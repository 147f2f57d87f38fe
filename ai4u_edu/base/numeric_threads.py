"""One thread for numeric libraries, in processes that compute beside others.

For small networks a second thread only waits for the first, and another count of threads adds
numbers in another order, so that the same seed would give another network. These libraries look at
their variables once, when they are loaded, and importing this package loads NumPy. So a process has
to find the variables in its environment when it starts.
"""

import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager

ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
"""Variables of the environment, for OpenMP, OpenBLAS and Intel's library."""
_LOCK = threading.Lock()


@contextmanager
def children_with_one_thread() -> Iterator[None]:
    """Give processes that are started within this context the variables of one thread.

    ``multiprocessing`` starts a process with the environment of its parent and takes no other one,
    so the parent's is changed for the moment of the start; threads wait for each other.
    """
    with _LOCK:
        before = {name: os.environ.get(name) for name in ONE_THREAD}
        os.environ.update(ONE_THREAD)
        try:
            yield
        finally:
            for name, value in before.items():
                if value is None:
                    del os.environ[name]
                else:
                    os.environ[name] = value


def restart_with_one_thread() -> None:
    """Run this program again with the variables of one thread, unless it has them already.

    Only for a command that owns its process, before it has done anything.
    """
    if ONE_THREAD.items() <= os.environ.items():
        return
    command, environment = [sys.executable, *sys.orig_argv[1:]], {**os.environ, **ONE_THREAD}
    if os.name == "posix":  # the same process, so that every signal reaches it
        os.execve(command[0], command, environment)  # noqa: S606 - the words of this process
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # it reaches the other process too
    sys.exit(subprocess.call(command, env=environment))  # noqa: S603 - the same
