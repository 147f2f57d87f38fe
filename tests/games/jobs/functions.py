"""Functions that jobs of the tests call, in other processes, too."""

import os
import signal
import threading
import time
from pathlib import Path
from typing import Any

import psutil

from ai4u_edu.base.errors import AI4UError
from tests.waiting import until


def square(number: float) -> float:
    return number * number


def square_on_machine(number: int, begins: str) -> tuple[int, str]:
    """Return the square, and the id of Ray's node that computed it, once a file is there."""
    import ray

    until(Path(begins).exists)
    return number * number, ray.get_runtime_context().get_node_id()


def pid(number: int) -> int:
    return os.getpid()


def meet(folder: str, number: int, count: int) -> int:
    """Return the id of this process when as many jobs run beside this one."""
    (Path(folder) / str(number)).touch()
    until(lambda: len([*Path(folder).iterdir()]) >= count)
    return os.getpid()


def rest_from(number: int, limit: int) -> int:
    """Return the number if it is below a limit; else do not end."""
    if number >= limit:
        rest(3600)
    return number


def nested(number: int) -> dict[Any, Any]:
    return {"pair": (number, 0.1 + 0.2), 1: None}


def fail(text: str) -> None:
    raise ValueError(text)


def refuse(folder: str) -> None:
    note_call(folder)
    raise AI4UError("expected another folder")


def no_data() -> object:
    return object()


def note_call(folder: str) -> int:
    """Count the calls, which may be in other processes, and return the number of this one."""
    for number in range(1, 100):
        try:
            (Path(folder) / str(number)).touch(exist_ok=False)
        except FileExistsError:
            continue
        return number
    raise AssertionError


def fail_twice(folder: str) -> str:
    if note_call(folder) < 3:
        raise OSError("not yet")
    return "at last"


def die_once(folder: str) -> str:
    if note_call(folder) == 1:
        os.kill(os.getpid(), signal.SIGKILL)
    return "alive"


def die(number: int) -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def numeric_threads() -> int:
    """Return how many threads NumPy's library has started in this process, besides its own."""
    import numpy as np

    matrix = np.ones((1000, 1000))
    assert (matrix @ matrix)[0, 0] == 1000
    return psutil.Process().num_threads() - threading.active_count()


def rest(seconds: float) -> None:
    time.sleep(seconds)  # real time: the test ends it earlier


def end(code: int) -> None:
    """End this process some time after all of its pipes, as a busy machine does it."""
    os.closerange(3, 1000)
    time.sleep(0.3)  # real time: a longer time changes nothing
    os._exit(code)


def hold(path: str, busy: bool) -> None:
    """Hold the lock on a file for as long as this process lives."""
    import fcntl

    with Path(path).open("wb") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        while busy:
            pass
        rest(3600)


def stop_once(folder: str) -> str:
    """Stop this process at the first call, as SIGSTOP does."""
    if note_call(folder) == 1:
        os.kill(os.getpid(), signal.SIGSTOP)
    return "goes on"


def play_among_others(**game_arguments: Any) -> Any:
    """Play a game whose programs see all processes."""
    from ai4u_edu.games.tournament import drivers
    from ai4u_edu.games.tournament.game import game

    drivers.CHILD_MODULE = "tests.attacks.child_among_others"
    return game(**game_arguments)
