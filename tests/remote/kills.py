"""Scripts that are killed in the middle of a step: ``python -m tests.remote.kills --times 200``.

A script in a process of its own drives at full speed, and is killed (SIGKILL) at any moment. Every
other time another process takes its session up again within the grace time; the other times nobody
comes. Measured from the kill on: until the agent is told to do nothing, until the session goes on,
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

from ai4u_edu.agent import BasicAgent
from ai4u_edu.server.scripts import Rules
from tests.remote.rooms import log_room
from tests.server.rooms import Room
from tests.waiting import until

STOPPED, FREE, RESUMED = 0.5, 5.0, 1.0
"""Seconds that it may take."""
GRACE = Rules().grace
SCRIPT = """
import sys
from ai4u_edu.remote import connect
robot = connect(sys.argv[1], "a", session=sys.stdin.readline().strip(), patience=30)
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
            [sys.executable, "-c", SCRIPT, url],
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
        now = time.monotonic()
        self.process.wait()
        for pipe in (self.process.stdin, self.process.stdout):
            if pipe is not None:
                pipe.close()
        return now


def run(times: int, seed: int = 1, grace: float = GRACE) -> tuple[Times, list[str]]:
    """Kills so often; how long everything took, and what was wrong beside that."""
    rng = random.Random(seed)
    found, wrong = Times(), []
    with log_room(time_scale=1.0, grace=grace) as room:
        agent = room.sim.agents[0]
        before = agent.brain
        once(room, agent, rng, found, resumes=True)  # what is loaded once stays
        once(room, agent, rng, found, resumes=False)
        held = holdings()
        found = Times()
        for number in range(times):
            once(room, agent, rng, found, resumes=number % 2 == 0)
            if agent.brain is not before or agent.brains != [before]:
                wrong.append(f"after kill {number}: expected the brain from before")
        until(lambda: holdings() <= held)  # else threads or open files are left over
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


def once(room: Room, agent: BasicAgent, rng: random.Random, found: Times, *, resumes: bool) -> None:
    """Kill a script, and perhaps a second one that has resumed its session."""
    before = agent.brain
    driver, heir = Driver(room.url), Driver(room.url)
    session = driver.begin()
    until(lambda: agent.last_action.get("log") == (5.0,))
    time.sleep(rng.uniform(0.0, 0.1))
    killed = driver.kill()
    if resumes:
        assert heir.begin(session).startswith(session.partition(":")[0])
        found.resumed.append(time.monotonic() - killed)
        until(lambda: agent.last_action.get("log") == (5.0,))
        killed = heir.kill()
    else:
        heir.kill()
    until(lambda: agent.last_action.get("log") != (5.0,))
    found.stopped.append(time.monotonic() - killed)
    until(lambda: agent.brain is before and len(agent.brains) == 1)
    found.free.append(time.monotonic() - killed)


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
