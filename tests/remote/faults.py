"""Decisions over a bad network: ``python -m tests.remote.faults --decisions 10000``.

Several scripts in a second process, each at a world of its own, through a proxy that drops,
repeats, reorders, delays, stalls and breaks. What the worlds carried out must be what the scripts
decided: every action exactly once, in order, on the step that it answers; and what they saw must be
what was there.
"""

import argparse
import multiprocessing
import sys
import threading
import time
from collections import Counter
from contextlib import ExitStack
from typing import Any

from tests.remote.faulty_proxy import Faults, FaultyProxy
from tests.remote.rooms import connect, log_of, log_room

BAD = Faults(
    drop=0.05,
    duplicate=0.05,
    reorder=0.10,
    latency=0.3,
    single_bytes=0.02,
    stall=0.001,
    reset=0.005,
    half_open=0.0005,
)
"""Faults far worse than those of a school's network."""
EPISODE = 50

Entry = tuple[int, int, float]


def drive(url: str, decisions: int) -> list[Entry]:
    """Drive for some decisions, and return the number sent on each step."""
    decided: list[Entry] = []
    with connect(url, mode="lockstep") as robot:
        percept = robot.reset()
        while True:
            place = [float(percept.episode), float(percept.step)]
            if percept["place"].tolist() != place:
                raise AssertionError(f"expected to see {place}, got {percept['place'].tolist()}")
            if len(decided) == decisions:
                return decided
            if percept.done:
                percept = robot.reset()
                continue
            number = float(len(decided) + 1)
            robot.act(log=[number])
            decided.append((percept.episode, percept.step, number))
            percept = robot.sense()


def drive_all(urls: list[str], decisions: int, answers: Any) -> None:
    """A process with a script for each world."""

    def one(place: int) -> None:
        try:
            answers.put((place, drive(urls[place], decisions)))
        except BaseException as error:
            answers.put((place, f"{type(error).__name__}: {error}"))

    threads = [threading.Thread(target=one, args=(place,)) for place in range(len(urls))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def run(decisions: int, scripts: int, faults: Faults = BAD, seed: int = 1) -> list[str]:
    """Lets scripts decide, ``decisions`` in all; what was wrong, in sentences."""
    context = multiprocessing.get_context("spawn")
    began = time.monotonic()  # real time: shown to a person
    each = -(-decisions // scripts)
    wrong: list[str] = []
    with ExitStack() as stack:
        rooms = [stack.enter_context(log_room(max_steps=EPISODE)) for _ in range(scripts)]
        proxies = [
            stack.enter_context(FaultyProxy(room.url, faults, seed + number))
            for number, room in enumerate(rooms)
        ]
        answers = context.Queue()
        process = context.Process(
            target=drive_all, args=([proxy.url for proxy in proxies], each, answers), daemon=True
        )
        process.start()
        for _ in rooms:
            place, decided = answers.get()
            done = log_of(rooms[place])
            if isinstance(decided, str):
                wrong.append(f"script {place}: {decided}")
            elif done != decided:
                wrong.append(f"world {place}: {_difference(done, decided)}")
        process.join()
        happened: Counter[str] = sum((proxy.happened for proxy in proxies), Counter())
    took = time.monotonic() - began  # real time: shown to a person
    print(f"{each * scripts} decisions by {scripts} scripts in {took:.0f} s; {dict(happened)}")
    return wrong


def _difference(done: list[Entry], decided: list[Entry]) -> str:
    for number, (one, other) in enumerate(zip(done, decided, strict=False)):
        if one != other:
            return f"entry {number} is {one}, and {other} was decided"
    return f"{len(done)} actions were carried out, and {len(decided)} decided"


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--decisions", type=int, default=10_000)
    parser.add_argument("--scripts", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    wrong = run(options.decisions, options.scripts, seed=options.seed)
    print("\n".join(wrong) or "every action exactly once, in order, on its step")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
