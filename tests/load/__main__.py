"""A class at work: ``python -m tests.load --brains 30,60,100``.

One world at 60 ticks a second in which several scripts drive an agent each, in realtime, 15 times
a second with 16 rays, while as many viewers look at the page. Agents take turns in deciding
(``spread_decisions``), unless it is ``--at-once``. The scripts are real ones of
``ai4u_edu.remote``, the viewers bare clients of viser's socket and of the panel's that read
everything. World and server have one process, all brains another one, all viewers a third; how much
of a core each took stands in the table, since they compete for the same cores. ``--apart`` gives
the server a core of its own, as it has where scripts and pages are on other machines. How many
others wanted the cores meanwhile (the load average) stands in the table too: a figure counts only
where it is small. ``--floor`` measures besides, in turns, a server that has no world and only says
as much to the same clients: better than that no server can be on that machine.
"""

import argparse
import multiprocessing
import os
from collections.abc import Callable
from functools import partial
from multiprocessing.connection import Connection
from typing import Any

import numpy as np

from tests.load import clients, world
from tests.load.floor import serve_floor

HEAD = """\
| brains | viewers | besides | tick late p50 / p99 | observation old p50 / p99 | viewer frames/s \
least / median | server, brains, viewers (cores) | load |
|---|---|---|---|---|---|---|---|"""

_CORES: dict[str, set[int]] = {"server": set(), "clients": set()}


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--brains", default="30,60,100")
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--quick", action="store_true", help="5 s each")
    parser.add_argument("--no-viewers", action="store_true")
    parser.add_argument("--floor", action="store_true", help="a server without a world, besides")
    parser.add_argument("--apart", action="store_true", help="a core for the server alone")
    parser.add_argument("--at-once", action="store_true", help="all agents decide in one tick")
    options = parser.parse_args()
    ours = partial(world.serve, in_turn=not options.at_once)
    cores = sorted(os.sched_getaffinity(0)) if options.apart else []
    _CORES.update(server=set(cores[:1]), clients=set(cores[1:] or cores))
    multiprocessing.set_start_method("spawn")
    seconds = 5.0 if options.quick else options.seconds
    load = ", ".join(f"{each:.1f}" for each in os.getloadavg())
    print(f"{os.cpu_count()} cores; load averages before: {load}; {seconds:g} s each")
    print(HEAD, flush=True)
    counts = [int(each) for each in options.brains.split(",")]
    for count in counts:
        print(measure(count, 0, seconds, serve=ours), flush=True)
        if not options.no_viewers:
            print(measure(count, count, seconds, serve=ours), flush=True)
        for viewers in (0, count) if options.floor else ():
            print(measure(count, viewers, seconds, serve=serve_floor), flush=True)
    least = min(counts)
    print(measure(least, 5, seconds, slow=5, serve=ours), flush=True)
    print(measure(least, 5, seconds, flooding=True, serve=ours), flush=True)
    print(measure(least, 30, seconds, stopped=25, serve=ours), flush=True)


def measure(
    brains: int,
    viewers: int,
    seconds: float,
    *,
    slow: int = 0,
    stopped: int = 0,
    flooding: bool = False,
    serve: Callable[[int, Connection], None] = world.serve,
) -> str:
    """Return one line of the table."""
    here, there = multiprocessing.Pipe()
    served = multiprocessing.Process(target=serve, args=(brains, there), daemon=True)
    served.start()
    _pin(served, "server")
    url = here.recv()
    parties: list[tuple[Any, Any, int]] = [(clients.brains, list(range(brains)), slow)]
    parties += [(clients.viewers, viewers, stopped)] if viewers else []
    parties += [(clients.flood, 1, 0)] if flooding else []
    ends = [_begin(party, url, count, odd, seconds) for party, count, odd in parties]
    _wait(ends[0], clients.WARMUP_S + 1)
    here.send("begin")
    here.recv()
    found = [end.recv() for end in ends]
    here.send("told")
    told = here.recv()
    here.send("end")
    served.join(20)
    besides = ["no world"] if serve is serve_floor else []
    besides += [f"{slow} brains slow"] if slow else []
    besides += [f"{stopped} viewers never read"] if stopped else []
    besides += [f"flood, closed: {found[-1].closes}"] if flooding else []
    ages = [
        age
        for number, each in enumerate(found[0].ages.values())
        for age in each[15 * int(clients.WARMUP_S) :]
        if number >= slow
    ]
    frames = sorted(found[1].frames) if viewers else []
    seen = f"{frames[0]:.0f} / {np.median(frames):.0f}" if frames else "-"
    took = clients.WARMUP_S + seconds
    used = [told.processor / seconds, *(each.processor / took for each in found)]
    late = told.late[: int(60 * (seconds - 1))]  # then they all go at once
    return (
        f"| {brains} | {viewers} | {'; '.join(besides) or '-'} | {_ms(late)} | {_ms(ages)} "
        f"| {seen} | {', '.join(f'{each:.2f}' for each in used)} | {os.getloadavg()[0]:.1f} |"
    )


def _begin(party: Any, url: str, count: Any, odd: int, seconds: float) -> Connection:
    here, there = multiprocessing.Pipe()
    clients = multiprocessing.Process(
        target=party, args=(url, count, odd, seconds, there), daemon=True
    )
    clients.start()
    _pin(clients, "clients")
    return here


def _pin(process: multiprocessing.process.BaseProcess, kind: str) -> None:
    """Pin a process, and the ones that it starts later, to some cores."""
    if _CORES[kind] and process.pid is not None:
        os.sched_setaffinity(process.pid, _CORES[kind])


def _wait(end: Connection, seconds: float) -> None:
    end.poll(seconds)


def _ms(seconds: list[float]) -> str:
    if not seconds:
        return "-"
    middle, most = np.percentile(seconds, (50, 99)) * 1000
    return f"{middle:.1f} / {most:.1f} ms"


if __name__ == "__main__":
    main()
