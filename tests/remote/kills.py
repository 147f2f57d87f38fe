"""Scripts that are killed in the middle of a step: ``python -m tests.remote.kills --times 200``.

A script in a process of its own drives at full speed, and is killed (SIGKILL) at any moment. Every
other time another process takes its session up again; the other times nobody comes within the grace
time. Measured from the kill on: until the agent is told to do nothing, until the session goes on,
until the seat is free. In the end the server has as many threads and open files as before.
"""

import argparse
import random
import subprocess
import sys
import threading
import time
from dataclasses import dataclass, field

import psutil

from ai4u_edu.page.server.scripts import Rules
from tests.page.server.rooms import Room
from tests.remote.rooms import connect, log_room
from tests.waiting import LIMIT_S, until

STOPPED, FREE, RESUMED = 0.5, 5.0, 1.0
"""Seconds that it may take on a machine that is not busy; no test compares them."""
GRACE = Rules().grace
SCRIPT = """
import sys
from ai4u_edu.remote import connect
patience = float(sys.argv[2])
robot = connect(sys.argv[1], "a", session=sys.stdin.readline().strip(), patience=patience)
robot.sense()
print(robot.session, flush=True)
while True:
    robot.act(log=[5])
    robot.sense()
"""


@dataclass
class Times:
    """Seconds from each kill on."""

    stopped: list[float] = field(default_factory=list)
    free: list[float] = field(default_factory=list)
    resumed: list[float] = field(default_factory=list)


class Driver:
    """A script in a process of its own, ready to be told which session it takes up."""

    def __init__(self, url: str) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-c", SCRIPT, url, str(LIMIT_S)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )

    def begin(self, session: str = "") -> str:
        """Has it drive; its session."""
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        self.process.stdin.write(session + "\n")
        self.process.stdin.flush()
        return self.process.stdout.readline().strip()

    def kill(self) -> float:
        """Kills it; when that was."""
        self.process.kill()
        now = time.monotonic()  # real time: measured for a person
        self.process.wait()
        for pipe in (self.process.stdin, self.process.stdout):
            if pipe is not None:
                pipe.close()
        return now


def run(times: int, seed: int = 1, grace: float = GRACE) -> tuple[Times, list[str]]:
    """Kill this many scripts; return how long everything took, and what was wrong besides.

    Args:
        times: number of kills that are counted.
        seed: of the moments at which scripts are killed.
        grace: time (s) for which a seat is kept for a script that nobody succeeds.
    """
    rng = random.Random(seed)
    found, wrong = Times(), []
    with log_room(time_scale=1.0) as patient, log_room(time_scale=1.0, grace=grace) as other:
        befores = {id(room): room.sim.agents[0].brain for room in (patient, other)}
        succeeded(patient, rng, found)  # what is loaded once stays
        abandoned(other, rng, found)
        held = holdings()
        found = Times()
        for number in range(times):
            room = other if number % 2 else patient
            (abandoned if number % 2 else succeeded)(room, rng, found)
            agent, before = room.sim.agents[0], befores[id(room)]
            if agent.brain is not before or agent.brains != [before]:
                wrong.append(f"after kill {number}: expected the brain from before")
        # else threads or open files are left over
        until(lambda: all(now <= then for now, then in zip(holdings(), held, strict=True)))
        print(f"(threads, open files) {held} before, {holdings()} after")
    return found, wrong


def too_late(found: Times) -> list[str]:
    """Return a line for each time that exceeds its limit."""
    wrong = []
    for name, limit in (("stopped", STOPPED), ("free", FREE), ("resumed", RESUMED)):
        taken: list[float] = getattr(found, name)
        print(f"{name}: {len(taken)} times, at most {max(taken, default=0):.2f} s of {limit} s")
        if max(taken, default=0) > limit:
            wrong.append(f"{name} after {max(taken):.2f} s; expected at most {limit} s")
    return wrong


def succeeded(room: Room, rng: random.Random, found: Times) -> None:
    """Kill a script, let another process resume its session, and end that in an orderly way."""
    agent = room.sim.agents[0]
    before = agent.brain
    driver, heir = Driver(room.url), Driver(room.url)
    session = driver.begin()
    killed = kill_at_any_moment(driver, room, rng)
    assert heir.begin(session).startswith(session.partition(":")[0])
    found.resumed.append(time.monotonic() - killed)  # real time: measured for a person
    until(lambda: agent.last_action.get("log") == (5.0,))
    note_stop(heir.kill(), room, found)
    connect(room.url, "a", session=session).close()
    until(lambda: agent.brain is before and len(agent.brains) == 1)


def abandoned(room: Room, rng: random.Random, found: Times) -> None:
    """Kill a script that nobody succeeds."""
    agent = room.sim.agents[0]
    before = agent.brain
    driver = Driver(room.url)
    driver.begin()
    killed = kill_at_any_moment(driver, room, rng)
    note_stop(killed, room, found)
    until(lambda: agent.brain is before and len(agent.brains) == 1)
    found.free.append(time.monotonic() - killed)  # real time: measured for a person


def kill_at_any_moment(driver: Driver, room: Room, rng: random.Random) -> float:
    """Kill a script while it drives; return when that was."""
    until(lambda: room.sim.agents[0].last_action.get("log") == (5.0,))
    # real time: so that it is another moment each time; all are right
    time.sleep(rng.uniform(0.0, 0.1))
    return driver.kill()


def note_stop(killed: float, room: Room, found: Times) -> None:
    """Wait until the agent of a killed script stops, and note how long that took."""
    until(lambda: room.sim.agents[0].last_action.get("log") != (5.0,))
    found.stopped.append(time.monotonic() - killed)  # real time: measured for a person


def holdings() -> tuple[int, int]:
    """Threads and open files of this process, the server's."""
    return threading.active_count(), psutil.Process().num_fds()


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--times", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    found, wrong = run(options.times, options.seed)
    wrong += too_late(found)
    print("\n".join(wrong) or "nothing went wrong")
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
