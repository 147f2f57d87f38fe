"""Four pages and two scripts at one world, all at once: ``python -m tests.attacks.hammer``.

Pages send every command of their panel and every message of viser's, with likely and odd
arguments, hold keys, ask for resets and pauses; scripts drive, reset and come back. Afterwards the
world has to go on, the log has to be free of tracebacks, and the first SIGTERM has to end the
server.
"""

import argparse
import json
import random
import re
import signal
import sys
import threading
import traceback
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from tempfile import TemporaryDirectory
from typing import Any

from websockets.exceptions import ConnectionClosed, InvalidHandshake
from websockets.sync.client import connect as open_socket
from websockets.typing import Origin

from ai4u_edu.agent.block_frames import frames_of_thread
from ai4u_edu.base.errors import ActionError
from ai4u_edu.remote import RemoteError, connect
from tests.attacks.panel import Panel
from tests.playing import Played, played
from tests.waiting import LIMIT_S, until

ENDS_WITHIN_S = 3.0
"""Time in which a server has to end; a command under way takes up to a second of a free core."""
KEYS = ("KeyW", "KeyS", "KeyA", "KeyD", "Space")
GONE = (ConnectionClosed, InvalidHandshake, OSError, EOFError, TimeoutError)


@dataclass
class Tally:
    """Counts of what was done, and sentences about what went wrong."""

    done: dict[str, int] = field(default_factory=dict)
    wrong: list[str] = field(default_factory=list)

    def count(self, name: str, more: int = 1) -> None:
        """Count more of something."""
        self.done[name] = self.done.get(name, 0) + more


def hammer(
    seconds: float,
    scene: str,
    seed: int,
    ends_within: float = ENDS_WITHIN_S,
    at_least: Mapping[str, int] | None = None,
) -> Tally:
    """Hammer a served scene, and judge how it stands afterwards.

    Args:
        seconds: how long; longer if not enough was done by then.
        at_least: counts of the tally that are enough.
    """
    enough = at_least or {}
    tally = Tally()
    with (
        TemporaryDirectory() as saved,
        played(scene, "--no-autosave", "--scenes", saved) as server,
    ):
        over = threading.Event()
        workers: list[Callable[[Played, random.Random, Tally, threading.Event], None]] = [
            *[use_panel] * 4,
            *[drive_by_keys] * 2,
            *[drive_by_script] * 2,
        ]
        threads = [
            threading.Thread(
                target=_guarded,
                args=(work, server, random.Random(n + seed), tally, over),
                daemon=True,
            )
            for n, work in enumerate(workers)
        ]
        for thread in threads:
            thread.start()
        over.wait(seconds)
        until(
            lambda: tally.wrong or all(tally.done.get(each, 0) >= enough[each] for each in enough)
        )
        over.set()
        for thread in threads[:6]:  # the pages; a script waits as long as the world is paused
            thread.join(LIMIT_S)
        tally.wrong += _goes_on(server)
        for thread in threads[6:]:
            thread.join(LIMIT_S)
        waits = _has_blocks_error(server)  # as long as nobody mends the block, a script waits too
        stuck = [each for each in (threads[:6] if waits else threads) if each.is_alive()]
        tally.wrong += [f"{_stack(each)}did not end: {_summary(server)}" for each in stuck]
        tally.wrong += ends_at_once(server.process, ends_within)
    tally.wrong += tracebacks_in("".join(server.told))
    return tally


def tracebacks_in(log: str) -> list[str]:
    """Return the part of a server's log around its first traceback, if it has one."""
    found = re.search("Traceback|never retrieved", log)
    if found is None:
        return []
    at = found.start()
    return [f"the log has a traceback:\n{log[max(at - 1000, 0) : at + 4000]}"]


def use_panel(server: Played, rng: random.Random, tally: Tally, over: threading.Event) -> None:
    """Send a panel's commands; leave and come back now and then."""
    while not over.is_set():
        with Panel(server.url) as panel:
            over.wait(0.3)  # real time: its first answers have usually come; it needs none
            for _ in range(rng.randint(20, 200)):
                if over.is_set() or not panel.is_open:
                    break
                panel.use_any(rng)
                tally.count("messages of a panel")
                over.wait(rng.uniform(0.0, 0.05))
            for kind, number in panel.answers.items():
                tally.count(f"commands {kind}", number)


def drive_by_keys(server: Played, rng: random.Random, tally: Tally, over: threading.Event) -> None:
    """Hold keys, take over, let go, reset, pause and resume."""
    url = server.url.replace("http", "ws", 1) + "ws/input"
    orders = ("reset", "pause", "resume", "resume")
    while not over.is_set():
        with open_socket(url, origin=Origin(server.url.rstrip("/")), proxy=None) as page:
            for _ in range(rng.randint(20, 100)):
                if over.is_set():
                    break
                said: dict[str, Any] = {"type": "keys", "held": rng.sample(KEYS, 2)}
                if rng.random() < 0.1:
                    said = {"type": "do", "id": 0, "command": rng.choice(orders)}
                elif rng.random() < 0.1:
                    said = {"type": rng.choice(("take", "let_go"))}
                page.send(json.dumps(said))
                tally.count("messages of a keyboard")
                over.wait(rng.uniform(0.01, 0.05))


def drive_by_script(
    server: Played, rng: random.Random, tally: Tally, over: threading.Event
) -> None:
    """Drive the first agent that is free, in either mode; reset, and come back."""
    while not over.is_set():
        mode = rng.choice(("realtime", "lockstep"))
        try:
            # real time: a script that is refused comes again, and so does one that is too slow
            with connect(server.url, agent="0", mode=mode, patience=2.0) as robot:  # type: ignore[arg-type]  # one of two
                if rng.random() < 0.5:
                    robot.reset()
                for _ in range(rng.randint(1, 100)):
                    if over.is_set():
                        break
                    try:
                        robot.act(move=[1, rng.uniform(-1, 1), 0, 0])
                        robot.sense()
                        tally.count("decisions of a script")
                    except ActionError:  # the episode is over, or a page took the actuator away
                        robot.reset()
                        tally.count("resets of a script")
        except RemoteError:
            tally.count("refusals to a script")
            over.wait(0.2)  # real time: pause of a script that comes again


def ends_at_once(process: Any, within: float = ENDS_WITHIN_S) -> list[str]:
    """Send the first SIGTERM; say so if the process has not ended in time, or not well."""
    process.send_signal(signal.SIGTERM)
    try:
        code = process.wait(within)
    except Exception as error:  # psutil's and subprocess's time-outs are no relatives
        process.kill()
        return [f"it did not end within {within} s of the first SIGTERM: {error}"]
    return [] if code == 0 else [f"it ended with exit code {code}"]


def _goes_on(server: Played) -> list[str]:
    """Reset and resume from a page that has just come, and look whether ticks pass."""
    with Panel(server.url) as panel:
        panel.do("new_start")
        before = _place(server.snapshot())

        def has_moved() -> bool:
            if server.snapshot()["paused"]:  # what a page asked for may come only now
                panel.do("resume")
                return False
            return _place(server.snapshot()) != before or _has_blocks_error(server)

        try:
            until(has_moved)
        except AssertionError:
            return [f"the world stands still: {_summary(server)}, before at {before}"]
    try:
        until(lambda: server.health()["status"] == "ok" or _has_blocks_error(server))
    except AssertionError:
        return [f"it is not well: {_summary(server)}"]
    return []


def _has_blocks_error(server: Played) -> bool:
    """Return True if the world says which block can't go on: pages may have taken what it needs."""
    error = str(server.snapshot()["error"])
    return error.startswith(("BlockError: agent ", "ReadingError: agent ", "ActionError: "))


def _stack(thread: threading.Thread) -> str:
    """The calls that a worker is in."""
    frames = frames_of_thread(thread.ident or 0)[-8:]
    calls = traceback.StackSummary.extract((frame, frame.f_lineno) for frame in frames)
    return "".join(calls.format())


def _summary(server: Played) -> dict[str, Any]:
    about = server.snapshot()
    return {key: value for key, value in about.items() if key not in ("agents", "bodies")} | {
        "brains": [agent["brain"] for agent in about["agents"]],
        "health": server.health(),
    }


def _place(snapshot: dict[str, Any]) -> tuple[int, int]:
    return int(snapshot["episode"]), int(snapshot["tick"])


def _guarded(
    work: Callable[[Played, random.Random, Tally, threading.Event], None],
    server: Played,
    rng: random.Random,
    tally: Tally,
    over: threading.Event,
) -> None:
    while not over.is_set():
        try:
            work(server, rng, tally, over)
        except GONE as error:
            tally.count(f"{work.__name__}: {error}")
            over.wait(0.1)  # real time: pause of a page that comes again
        except Exception as error:
            tally.wrong.append(f"{work.__name__}: {error!r}")
            return


def main() -> None:
    """Read the command line, hammer, and print the tally."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--scene", default="box_chase")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    tally = hammer(options.seconds, options.scene, options.seed)
    for name, number in sorted(tally.done.items()):
        print(f"{number:>8} {name}")
    print("\n".join(tally.wrong) or "nothing went wrong")
    sys.exit(bool(tally.wrong))


if __name__ == "__main__":
    main()
