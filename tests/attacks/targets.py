"""Mutated targets of requests, through every proxy: ``python -m tests.attacks.targets``.

Raw sockets send them, since clients normalize a target. Beside the proxies a server listens that
must never be reached; its address is in most targets. No target may cause an error of a server or a
traceback, and afterwards every server answers as before.
"""

import argparse
import random
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, field
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from urllib.parse import urlsplit

from ai4u_edu.classroom.hub.sign_in import COOKIE
from ai4u_edu.page.server.token_auth import PageCookie
from tests.attacks.raw_http import SOCKET_HEADERS, ForbiddenServer, ask, status_of
from tests.classroom.fake_hub import fake_hub, hub_class
from tests.classroom.reserved_port import reserved_port
from tests.classroom.served_class import environment, served_class
from tests.playing import played
from tests.waiting import until

ROOM_PATHS = (
    "healthz",
    "api/snapshot",
    "web/page/main.js",
    "vendor/x",
    "api/past/1.gif",
    "ws/input",
)
METHODS = (b"GET", b"GET", b"GET", b"HEAD", b"OPTIONS", b"DELETE", b"PATCH", b"CONNECT")
PIECES: tuple[str, ...] = (*"/\\.@:#?;%[]", "//", "..", "/../", "/./", ":@", "%00")
"""Pieces that are put into a target at any place."""
MAX_MUTATIONS = 4
SERVER_ERROR = 500
BUSY = 503
"""Status of a room that is not ready; no error."""


@dataclass
class Proxy:
    """A server that passes requests on, or leads to another server."""

    name: str
    url: str
    paths: tuple[str, ...]
    """Paths from which targets are made."""
    told: Callable[[], str]
    """Returns the log."""
    headers: Mapping[str, str] = field(default_factory=dict)
    """Headers of somebody who may enter."""
    is_ours: bool = True
    """False for another project's, whose errors are not ours."""


@dataclass
class Tally:
    """Statuses by proxy, and sentences about what went wrong."""

    statuses: dict[str, Counter[int]] = field(default_factory=dict)
    wrong: list[str] = field(default_factory=list)


def mutated(path: str, place: str, rng: random.Random) -> bytes:
    """Return a target that is made of a path and of the place that must not be reached."""
    text = path
    for _ in range(rng.randint(1, MAX_MUTATIONS)):
        text = rng.choice(MUTATIONS)(text, place, rng)
    if rng.random() < 0.5 and not text.startswith("/"):  # else most would be refused for that
        text = f"/{text}"
    # a line with a blank or a control character is another request, which test_requests tries
    return "".join(each if "!" <= each <= "~" else "%20" for each in text).encode() or b"%"


def attack(proxy: Proxy, beside: ForbiddenServer, count: int, seed: int, tally: Tally) -> None:
    """Send mutated targets to a proxy, and note what it answers."""
    rng = random.Random(f"{proxy.name} {seed}")
    statuses = tally.statuses.setdefault(proxy.name, Counter())
    for _ in range(count):
        target = mutated(rng.choice(proxy.paths), f"127.0.0.1:{beside.port}", rng)
        method, headers = rng.choice(METHODS), dict(proxy.headers)
        if rng.random() < 0.3:
            method, headers = b"GET", headers | SOCKET_HEADERS
        try:
            status = status_of(ask(proxy.url, target, headers, method))
        except TimeoutError:
            tally.wrong.append(f"{proxy.name}: {method!r} {target!r} was not answered")
            continue
        statuses[status] += 1
        if proxy.is_ours and status >= SERVER_ERROR and status != BUSY:
            tally.wrong.append(f"{proxy.name}: {method!r} {target!r} was answered with {status}")
        if beside.requests:
            got = beside.requests.pop()
            tally.wrong.append(f"{proxy.name}: {method!r} {target!r} reached the other: {got!r}")
    if "Traceback" in proxy.told():
        tally.wrong.append(f"{proxy.name}: the log has a traceback: {proxy.told()[-2000:]}")
    after = status_of(ask(proxy.url, proxy.paths[0].encode(), proxy.headers))
    if after not in (200, 303):
        tally.wrong.append(f"{proxy.name}: {proxy.paths[0]} is answered with {after} afterwards")


@contextmanager
def all_proxies(folder: Path) -> Iterator[list[Proxy]]:
    """Serve a class with a student's room, a class at a hub, and a world of its own."""
    with ExitStack() as stack:
        served = stack.enter_context(served_class(folder / "class"))
        ada = served.joined()
        assert ada.get("healthz").status_code == 200  # the room runs
        rooms = tuple(ada.room + each for each in ROOM_PATHS)
        cookie = PageCookie(served.token)
        teacher = {"Cookie": f"{cookie.name}={cookie.value}"}
        hub = stack.enter_context(fake_hub())
        student, boss = hub.add("mallory"), hub.add("root", admin=True)
        school = stack.enter_context(hub_class(folder / "hub", hub))
        world = stack.enter_context(played("box_chase", "--no-autosave"))
        prefix = urlsplit(school.url).path
        pages = ("", "teacher", "teacher/state", "teacher/look/seat-1", "api/me", "link", "check")
        at_hub = tuple(prefix + each for each in pages)

        def log_of_class() -> str:
            return "".join(served.told)

        yield [
            Proxy("class, student", served.url, rooms, log_of_class, ada.cookies),
            Proxy("class, teacher", served.url, rooms, log_of_class, teacher),
            Proxy("class, stranger", served.url, ("/", *rooms, "/link"), log_of_class),
            Proxy("hub, student", school.url, at_hub, str, {"Cookie": f"{COOKIE}={student}"}),
            Proxy("hub, admin", school.url, at_hub, str, {"Cookie": f"{COOKIE}={boss}"}),
            Proxy("world", world.url, ("/healthz", "/", *rooms), lambda: "".join(world.told)),
        ]


@contextmanager
def at_jupyter(folder: Path) -> Iterator[Proxy]:
    """Serve a world behind a Jupyter server, as on a JupyterHub."""
    folder.mkdir()
    secret = "secret-of-the-server"
    with reserved_port() as port, (folder / "log").open("w") as log:
        (folder / "jupyter_server_config.py").write_text(
            "from ai4u_edu.cli.server_proxy import server_proxy\n"
            "c.ServerProxy.servers = {'ai4u-edu': server_proxy()}\n"
            "c.ServerApp.jpserver_extensions = {'jupyter_server_proxy': True}\n"
            f"c.IdentityProvider.token = {secret!r}\n"
            f"c.ServerApp.root_dir = {str(folder)!r}\n"
            f"c.ServerApp.port = {port}\n"
            "c.ServerApp.port_retries = 0\n"
            "c.ServerApp.open_browser = False\n"
            "c.ServerApp.allow_root = True\n"
        )
        variables = environment() | {"JUPYTER_CONFIG_DIR": str(folder)}
        command = [sys.executable, "-m", "jupyter_server"]
        with subprocess.Popen(command, env=variables, stdout=log, stderr=log) as process:
            url, headers = f"http://127.0.0.1:{port}/", {"Authorization": f"token {secret}"}
            paths = tuple(f"/ai4u-edu/{each}" for each in ROOM_PATHS)
            try:
                until(lambda: _is_there(url, paths[0], headers))
                yield Proxy("jupyter", url, paths, str, headers, is_ours=False)
            finally:
                process.terminate()


def _is_there(url: str, path: str, headers: Mapping[str, str]) -> bool:
    with suppress(OSError):
        return status_of(ask(url, path.encode(), headers)) == 200
    return False


def _encode(text: str, _: str, rng: random.Random) -> str:
    """Escape some characters, in either case, and some of the escapes again."""
    share = rng.choice((0.05, 0.3, 1.0))
    form = rng.choice(("%{:02x}", "%{:02X}", "%25{:02x}"))
    return "".join(
        form.format(ord(each)) if rng.random() < share and ord(each) < 128 else each
        for each in text
    )


def _insert(text: str, place: str, rng: random.Random) -> str:
    pieces: list[str] = [*PIECES, place, f"@{place}", f"//{place}"]
    at, piece = rng.randint(0, len(text)), rng.choice(pieces)
    return text[:at] + piece + text[at:]


def _without_slash(text: str, _: str, rng: random.Random) -> str:
    return rng.choice(("", "%2f", "%2F", "\\", "*", ".", "x")) + text.removeprefix("/")


def _with_address(text: str, place: str, rng: random.Random) -> str:
    form = rng.choice(
        (
            "http://{place}{text}",
            "HTTP://x@{place}{text}",
            "//{place}{text}",
            "@{place}{text}",
            ":80@{place}{text}",
            "{text}@{place}/",
            "{text}#@{place}/",
            "{text}?@{place}/",
            "{place}",
            "\\\\{place}{text}",
            "/\\{place}{text}",
            "{text}/..//{place}/",
        )
    )
    return form.format(place=place, text=text)


def _change_case(text: str, _: str, rng: random.Random) -> str:
    return "".join(rng.choice((each.upper(), each.lower())) for each in text)


def _change_port(text: str, _: str, rng: random.Random) -> str:
    return text + rng.choice((":0", ":99999", ":-1", ":80", "::1", ":%38%30"))


MUTATIONS = (_encode, _insert, _insert, _without_slash, _with_address, _change_case, _change_port)


def attack_all(count: int, seed: int, *, has_jupyter: bool = False) -> Tally:
    """Send random targets to each proxy.

    Args:
        count: of targets.
        seed: of the mutations.
        has_jupyter: True to try a world behind a Jupyter server, too.
    """
    tally = Tally()
    with ExitStack() as stack:
        folder = Path(stack.enter_context(TemporaryDirectory()))
        beside = stack.enter_context(ForbiddenServer())
        proxies = stack.enter_context(all_proxies(folder))
        if has_jupyter:
            proxies.append(stack.enter_context(at_jupyter(folder / "jupyter")))
        for proxy in proxies:
            attack(proxy, beside, count, seed, tally)
    return tally


def main() -> None:
    """Read the command line, attack, and print the statuses."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=10_000, help="targets for all proxies")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    has_jupyter = find_spec("jupyter_server_proxy") is not None
    tally = attack_all(options.count // 6, options.seed, has_jupyter=has_jupyter)
    for name, statuses in tally.statuses.items():
        print(f"{name}: {dict(sorted(statuses.items()))}")
    print("\n".join(tally.wrong) or "nothing went wrong")
    sys.exit(bool(tally.wrong))


if __name__ == "__main__":
    main()
