"""A tournament that another program shows.

``python -m ai4u_edu.games.tournament.live_process DIR WORK``

It plays the plan in the folder, and writes a line of JSON with the tournament so far when contests
have ended. It ends with all its processes as soon as its input is closed, as when the other program
has ended. The journal, in the folder WORK if there is one, has what was played by then, and the
same command goes on from there.
"""

import json
import os
import signal
import sys
import threading
import time
from pathlib import Path
from typing import Any

import psutil

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.base.process_family import kill_descendants
from ai4u_edu.base.process_priority import lower_priority
from ai4u_edu.games.jobs.processes import ProcessEngine
from ai4u_edu.games.tournament.live_view import live_view
from ai4u_edu.games.tournament.plan import Plan
from ai4u_edu.games.tournament.run import Tournament, run_tournament, write_results

MIN_SHOW_INTERVAL_S = 0.5
"""Shortest time between two lines: to rate hundreds of contests takes some time."""


def main() -> None:
    """Play the tournament."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the program that shows it
    # what a library prints is no line of ours, and processes for games inherit this one
    out = os.fdopen(os.dup(1), "wb")
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    threading.Thread(target=_end_with, args=[sys.stdin.fileno()], daemon=True).start()
    lower_priority()

    def tell(**fields: Any) -> None:
        out.write(json.dumps(fields).encode() + b"\n")
        out.flush()

    shown_at = -MIN_SHOW_INTERVAL_S

    def show(done: Tournament) -> None:
        nonlocal shown_at
        if time.monotonic() - shown_at >= MIN_SHOW_INTERVAL_S:
            shown_at = time.monotonic()
            tell(view=live_view(done))

    folder, *work = map(Path, sys.argv[1:])
    try:
        with ProcessEngine(_width()) as engine:
            journal = work[0] if work else None
            done = run_tournament(Plan.load(folder), folder, engine, journal=journal, show=show)
        write_results(done)
    except (AI4UError, OSError) as error:
        tell(problem=str(error))
    else:
        tell(view=live_view(done), is_over=True)


def _width() -> int:
    """Return the number of games at a time: half of the cores are left to others."""
    return max(1, (os.cpu_count() or 1) // 2)


def _end_with(owner: int) -> None:
    """End this process and those that it has started when the other end is closed."""
    while os.read(owner, 1024):  # not buffered: its lock would be held at the end
        pass
    kill_descendants(psutil.Process())
    os._exit(0)


if __name__ == "__main__":
    main()
