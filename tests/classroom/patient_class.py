"""``ai4u-edu class`` with limits that no machine reaches or changes.

``python -m tests.classroom.patient_class [--replace MODULE.NAME=NUMBER ...] [OPTION ...]``

A class that is served runs in a process of its own, and a test can't give its parts other limits.
Processes of rooms import this module, too, so that it loads nothing before it is run.
"""

import sys
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

OPTION = "--replace"


def main() -> None:
    """Replace the limits, and run the command."""
    arguments = sys.argv[1:]
    be_patient()
    while arguments and arguments[0] == OPTION:
        path, number = arguments[1].split("=")
        module, _, name = path.rpartition(".")
        replace(module, name, float(number))
        arguments = arguments[2:]
    sys.argv = ["ai4u-edu", "class", *arguments]
    import_module("ai4u_edu.cli.main").main()


def be_patient() -> None:
    """Let no part of a class give up while a test waits for it."""
    import dataclasses
    import functools

    from ai4u_edu.classroom import gateway, live_class, local_rooms, room_watch
    from ai4u_edu.games.jobs import isolated
    from ai4u_edu.page.server.limits.timeouts import DEFAULT_TIMEOUTS
    from tests.waiting import LIMIT_S

    connections = ("request", "linger", "stall", "handshake", "ping", "close")
    limits = dict.fromkeys(connections, LIMIT_S)
    gateway.SERVER_LIMITS["timeouts"] = dataclasses.replace(DEFAULT_TIMEOUTS, **limits)
    local_rooms.TIMEOUTS = gateway.SERVER_LIMITS["timeouts"]
    of_rooms = ("answer_timeout_s", "start_timeout_s", "end_timeout_s")
    patient = functools.partial(room_watch.RoomLimits, **dict.fromkeys(of_rooms, LIMIT_S))
    room_watch.RoomLimits = patient  # type: ignore[assignment, misc]  # it makes them, too
    # one practice at a time, as on two cores: tests wait for a place in its line
    live_class.core_count = lambda: 2  # type: ignore[attr-defined]  # it imports the function
    # with the lowest priority they would get no time beside the tests' other work
    replace("ai4u_edu.teach.background", "NICENESS", 0)
    isolated.serve_jobs = serve_jobs_with_usual_priority  # type: ignore[attr-defined]
    for module, names in (
        ("ai4u_edu.classroom.hub.api", ["TIMEOUT_S"]),
        ("ai4u_edu.classroom.link_endpoint", ["HELLO_TIMEOUT_S"]),
        ("ai4u_edu.classroom.open_limits", ["STRANGER_SOCKET_S"]),
        ("ai4u_edu.classroom.room_proxy", ["OPEN_TIMEOUT_S", "ANSWER_TIMEOUT_S"]),
        ("ai4u_edu.classroom.tournament.runner", ["END_TIMEOUT_S"]),
    ):
        for name in names:
            replace(module, name, LIMIT_S)


def serve_jobs_with_usual_priority(
    pipe: "Connection", *, is_tied: bool, folder: Path | None = None, has_low_priority: bool = False
) -> None:
    """Run jobs at the priority of the tests: with a low one they get no time beside other work."""
    from ai4u_edu.games.jobs.worker import serve_jobs

    assert has_low_priority
    serve_jobs(pipe, is_tied=is_tied, folder=folder)


def replace(module: str, name: str, number: float) -> None:
    """Give a constant of a module another value; the module "timeouts" is the server's limits."""
    if module == "timeouts":
        import dataclasses

        from ai4u_edu.classroom.gateway import SERVER_LIMITS

        SERVER_LIMITS[module] = dataclasses.replace(SERVER_LIMITS[module], **{name: number})
        return
    loaded = import_module(module)
    assert hasattr(loaded, name), f"{module} has no {name}"
    setattr(loaded, name, type(getattr(loaded, name))(number))  # a whole number stays one


if __name__ == "__main__":
    main()
