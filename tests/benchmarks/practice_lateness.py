"""Delay of worlds' ticks while a network practises beside them, and while it does not.

``python -m tests.benchmarks.practice_lateness`` answers: does a training disturb the world, or the
other rooms of a class?

A class on this machine; each room's robot is driven by a script of its own in lockstep, at the
world's own speed, and has a panel that reads everything. The first student practises by rewards.
The practice's process is stopped and continued in turns (SIGSTOP, SIGCONT), so that worlds, scripts
and other load on the machine are the same with it and without it; neighbouring turns are compared.
A tick's delay is the time from the tick before it, beyond the period, so the time that a world
waits for its script counts.

It takes ``2 * pairs * seconds`` and about a minute more to start: 5 minutes by default.
"""

import argparse
import json
import multiprocessing
import os
import statistics
import tempfile
import threading
import time
from collections.abc import Sequence
from contextlib import ExitStack, suppress
from pathlib import Path

import numpy as np
import psutil
from websockets.exceptions import ConnectionClosed

from ai4u_edu.remote import RemoteError
from ai4u_edu.remote import connect as connect_script
from ai4u_edu.teach.background import NICENESS
from tests.benchmarks import tick_lateness
from tests.classroom.served_class import Student, served_class
from tests.classroom.student_page import script_address
from tests.classroom.test_trainings import process_of
from tests.page.panel.rooms import PanelPage
from tests.waiting import until

DECISIONS = 1_000_000
"""Decisions of the practice, so that it never ends by itself: about four minutes of a core."""
AWAY = {"touch": -1.0}
"""Factors with which it never reaches the goal, and so does not end early."""
AS_SERVED = {"ai4u_edu.teach.background.NICENESS": NICENESS}
"""Constants of a class that tests replace, as they are for users."""
SETTLING_S = 0.5
"""Time after each change that is not counted."""

Turn = tuple[float, float]
"""Begin and end (s) of a time by the clock of all processes."""


def main() -> None:
    """Measure in turns, and print a table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--seconds", type=float, default=10.0, help="of a turn")
    parser.add_argument("--pairs", type=int, default=12, help="turns with and without it")
    parser.add_argument("--rooms", type=int, default=3)
    chosen = parser.parse_args()
    multiprocessing.set_start_method("spawn")
    with tempfile.TemporaryDirectory() as name:
        turns, delays = measure(Path(name), chosen.rooms, chosen.pairs, chosen.seconds)
    print(f"load average {os.getloadavg()[0]:.1f}, {os.cpu_count()} cores, {chosen.rooms} rooms")
    print(
        "| world | ticks | delay, median, without and with | 99th percentile, without and with "
        "| difference of the 99th percentile, median of the pairs (least to most) |\n"
        "|---|---|---|---|---|"
    )
    for index, ticks in enumerate(delays):
        title = "practises" if index == 0 else f"other room {index}"
        print(f"| {title} | {row(ticks, turns)} |")


def measure(
    folder: Path, rooms: int, pairs: int, seconds: float
) -> tuple[list[dict[bool, Turn]], list[list[tuple[float, float]]]]:
    """Return the turns by whether it practised, and each room's ticks: their time and delay (s)."""
    os.environ["AI4U_LATENESS_FOLDER"] = str(folder)
    options = ("box_chase", "--blocks", str(tick_lateness.__file__))
    with (
        served_class(folder / "class", *options, replaced=AS_SERVED) as served,
        ExitStack() as stack,
    ):
        gateway = psutil.Process(served.process.pid)
        students = [served.joined()]
        pages = [stack.enter_context(panel_of(students[0]))]
        (practising,) = listening(gateway)
        students += [served.joined() for _ in range(rooms - 1)]
        pages += [stack.enter_context(panel_of(student)) for student in students[1:]]
        for student in students:
            args = (script_address(student),)
            script = multiprocessing.Process(target=drive, args=args, daemon=True)
            script.start()
            stack.callback(script.terminate)
        pages[0].done("teach_practise", steps=DECISIONS, weights=AWAY)
        pages[0].part("teach", lambda part: part["practice"] and part["practice"]["rewards"])
        for page in pages:
            threading.Thread(target=read_all, args=(page,), daemon=True).start()
        practice = process_of(served, "practice_process")
        turns = []
        for pair in range(pairs):
            turn: dict[bool, Turn] = {}
            for practises in (pair % 2 == 0, pair % 2 == 1):  # growing load is in both alike
                practice.resume() if practises else practice.suspend()
                time.sleep(SETTLING_S)  # real time: ticks of the turn before are done by then
                began = time.monotonic()
                time.sleep(seconds)  # real time: length of a turn
                turn[practises] = began, time.monotonic()
            turns.append(turn)
        if not practice.is_running() or practice.status() == psutil.STATUS_ZOMBIE:
            raise SystemExit("expected a practice until the end; take fewer or shorter turns")
        practice.resume()
        (folder / tick_lateness.REQUEST).touch()
        others = [pid for pid in listening(gateway) if pid != practising]
        files = [folder / f"{pid}.json" for pid in (practising, *others)]
        until(lambda: all(file.is_file() for file in files))
        ticks = [json.loads(file.read_text()) for file in files]
        delays = [[(began, delay) for began, _, delay in room] for room in ticks]
    return turns, delays


def listening(process: psutil.Process) -> list[int]:
    """Return the ids of the processes below another one that listen: rooms."""
    return [
        child.pid
        for child in process.children(recursive=True)
        if any(one.status == psutil.CONN_LISTEN for one in child.net_connections("tcp"))
    ]


def panel_of(student: Student) -> PanelPage:
    """Return the panel of a student's page, once it has the tab Teach."""
    page = PanelPage(student.address + "ws/panel", additional_headers=student.cookies)
    page.part("teach", lambda part: part["rewards"])
    return page


def read_all(page: PanelPage) -> None:
    """Read what a panel is sent, until it is closed."""
    with suppress(ConnectionClosed, OSError):
        for _ in page.socket:
            pass


def drive(address: str) -> None:
    """Drive in lockstep, as a student's script does."""
    with (
        suppress(RemoteError, KeyboardInterrupt),
        connect_script(address, agent="0", mode="lockstep") as robot,
    ):
        percept = robot.reset()
        for number in range(10**9):
            if percept.done:
                robot.reset()
            turning = 0.3 if number % 40 < 20 else -0.3
            robot.act(move=[0.2, turning, 0.0, 0.0])
            percept = robot.sense()


def row(ticks: Sequence[tuple[float, float]], turns: Sequence[dict[bool, Turn]]) -> str:
    """Return the cells of a world's row."""
    times, delays = np.array(ticks).T
    by_turn = [
        {
            practises: 1000 * delays[(times >= began) & (times < ended)]
            for practises, (began, ended) in turn.items()
        }
        for turn in turns
    ]
    cells = [f"{sum(len(one) for turn in by_turn for one in turn.values()):,}"]
    for share in (50, 99):
        values = [
            float(np.percentile(np.concatenate([turn[practises] for turn in by_turn]), share))
            for practises in (False, True)
        ]
        cells.append("{:.2f} and {:.2f} ms".format(*values))
    differences = [
        float(np.percentile(turn[True], 99) - np.percentile(turn[False], 99)) for turn in by_turn
    ]
    median, least, most = statistics.median(differences), min(differences), max(differences)
    return " | ".join([*cells, f"{median:+.2f} ms ({least:+.2f} to {most:+.2f})"])


if __name__ == "__main__":
    main()
