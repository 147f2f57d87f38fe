"""A second host on this machine: a network namespace, joined to this one by a cable of its own.

It needs Linux, root and ``ip`` (iproute2). ``python -m tests.remote.second_host`` makes one, has a
script in it drive a world out here, with its token and without, and removes it.
"""

import contextlib
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from secrets import token_hex

from tests.playing import Played, played
from tests.waiting import LIMIT_S

HERE, THERE = "10.231.77.1", "10.231.77.2"
"""Addresses of the two ends; of a network that is nobody's."""
SCRIPT = """
import sys
from ai4u_edu.remote import RemoteError, connect
try:
    with connect(sys.argv[1], patience=float(sys.argv[2])) as robot:
        robot.reset()
        for _ in range(5):
            robot.act(move=[0, 1, 0, 0])
        print("drove to step", robot.sense().step)
except RemoteError as error:
    print(type(error).__name__, error)
"""
REFUSED = (
    "RefusedError expected this world's token, got none; take the whole address that its terminal "
    "shows, as in connect('http://teacher:8080/?token=...')"
)


def is_possible() -> bool:
    """Return True if this machine allows network namespaces."""
    if sys.platform != "linux" or os.geteuid() != 0 or not shutil.which("ip"):
        return False
    name = f"ai4u-{token_hex(3)}"
    made = subprocess.run(["ip", "netns", "add", name], capture_output=True, check=False)
    if made.returncode == 0:
        subprocess.run(["ip", "netns", "del", name], check=True)
    return made.returncode == 0


@contextlib.contextmanager
def second_host() -> Iterator[list[str]]:
    """Make a host at :data:`THERE`; yield the prefix of a command that is to run on it."""
    name = token_hex(3)
    host, near, far = f"ai4u-{name}", f"ai4u{name}a", f"ai4u{name}b"
    run("ip", "netns", "add", host)
    try:
        run("ip", "link", "add", near, "type", "veth", "peer", "name", far, "netns", host)
        run("ip", "addr", "add", f"{HERE}/30", "dev", near)
        run("ip", "link", "set", near, "up")
        inside = ["ip", "netns", "exec", host]
        run(*inside, "ip", "addr", "add", f"{THERE}/30", "dev", far)
        run(*inside, "ip", "link", "set", far, "up")
        yield inside
    finally:
        run("ip", "netns", "del", host)  # removes its network cable too


@contextlib.contextmanager
def open_world() -> Iterator[tuple[Played, str, str]]:
    """Play a world that other machines can reach; yield its process, port and token."""
    with played("box_chase", "--host", "0.0.0.0") as server:  # noqa: S104 - that is what is tried
        found = re.search(r"http://127.0.0.1:(\d+)/\?token=([\w-]+)", "".join(server.told))
        assert found, server.told
        yield server, found[1], found[2]


def script(url: str, *prefix: str) -> str:
    """Run a script that drives the world at an address, and return its output."""
    done = run(*prefix, sys.executable, "-c", SCRIPT, url, str(LIMIT_S))
    return done.strip()


def run(*command: str) -> str:
    """Run a command and return its output."""
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=LIMIT_S)
    assert done.returncode == 0, (command, done.stdout, done.stderr)
    return done.stdout


def main() -> None:
    """Tries it."""
    if not is_possible():
        sys.exit("no network namespace can be made here; it takes Linux, root and iproute2")
    with open_world() as (server, port, token), second_host() as host:
        print("".join(server.told))
        print(f"from {THERE}:", script(f"http://{HERE}:{port}/?token={token}", *host))
        print(f"from {THERE}, without:", script(f"http://{HERE}:{port}/", *host))


if __name__ == "__main__":
    main()
