"""A class of six rooms, attacked while it works: ``python -m tests.attacks.class_hammer``.

Students send odd messages to their own rooms, keep programs in the class, and drive by scripts.
Strangers try other people's doors, guess codes, hold sockets open, and send odd targets. The
teacher's page goes on meanwhile. Nobody may get in, no program may get lost, no process may end or
grow, and the first SIGTERM has to end all.
"""

import argparse
import random
import statistics
import sys
import threading
import time
from collections.abc import Callable, Mapping
from contextlib import ExitStack, suppress
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import httpx
import psutil
from websockets.exceptions import ConnectionClosed, InvalidStatus

from ai4u_edu.base.errors import ActionError
from ai4u_edu.page.server.token_auth import PageCookie
from ai4u_edu.remote import RemoteError, connect
from tests.attacks.hammer import GONE, KEYS, Tally, ends_at_once, tracebacks_in
from tests.attacks.panel import Panel
from tests.attacks.raw_http import SOCKET_HEADERS, ForbiddenServer, ask, status_of
from tests.attacks.targets import BUSY, METHODS, ROOM_PATHS, SERVER_ERROR, mutated
from tests.classroom.served_class import ServedClass, Student, served_class
from tests.classroom.student_page import script_address
from tests.page.server import http_client
from tests.page.server.rooms import Page, open_socket
from tests.waiting import LIMIT_S, Deadline

ROOMS = 6
LEAST_SAMPLES = 6
"""Samples of a process's memory that make a growth."""
SCENES = ("box_chase", "maze", "sumo", "soccer")
GROWTH_MB_PER_H = 5.0
SETTLED_S = 1800.0
"""Time (s) in which a process reaches its size: its heap takes the room that bursts need, and its
bounded stores of episodes and files fill. Growth is a fault from then on, in a run that goes on
for at least as long again; over less it is noise."""
TEACHERS_PATHS = (
    "teacher",
    "teacher/state",
    "teacher/export",
    "teacher/socket",
    "projector/socket",
)
ENTERED = ("200", "open")
"""Answers to those who get in."""


@dataclass
class Attack:
    """A class under attack: what its attackers know of it."""

    served: ServedClass
    students: list[Student]
    addresses: dict[str, str]
    """Address of each room for scripts, by room."""
    beside: ForbiddenServer
    tally: Tally = field(default_factory=Tally)
    over: threading.Event = field(default_factory=threading.Event)
    kept: dict[str, tuple[str, int]] = field(default_factory=dict)
    """Latest program that the class has acknowledged, and its version, by room."""


def attack_class(seconds: float, seed: int, folder: Path) -> tuple[Tally, list[str]]:
    """Attack a class for a while; return the tally, and lines about its memory and output."""
    with ExitStack() as stack:
        served = stack.enter_context(served_class(folder))
        students = [served.joined() for _ in range(ROOMS)]
        for student in students:
            assert student.get("healthz").status_code == 200  # the room runs
        seats = [(each["number"], each["room"]) for each in served.state()["seats"]]
        addresses = {student.room: script_address(student) for student in students}
        attack = Attack(served, students, addresses, stack.enter_context(ForbiddenServer()))
        memory = Memory(served.process.pid)
        work: list[partial[None]] = []
        for number, student in enumerate(students):
            for act in (misuse_panel, hold_keys, keep_programs, drive_by_script):
                rng = random.Random(f"{act.__name__} {number} {seed}")
                work.append(partial(act, attack, student, rng))
        for act_alone in (try_doors, guess_codes, hold_sockets, send_targets, teach):
            rng = random.Random(f"{act_alone.__name__} {seed}")
            work.append(partial(act_alone, attack, rng))
        threads = [
            threading.Thread(
                target=_guarded, args=(attack, each), name=each.func.__name__, daemon=True
            )
            for each in work
        ]
        for thread in threads:
            thread.start()
        end = time.monotonic() + seconds  # real time: length of the attack
        # real time: period of the samples of memory
        while time.monotonic() < end and not attack.over.wait(min(5.0, seconds / 10)):
            memory.sample(attack.tally)
        attack.over.set()
        scripts = [each for each in threads if each.name == drive_by_script.__name__]
        _join(attack.tally, [each for each in threads if each not in scripts])
        _judge(attack, seats)
        lines = memory.judge(attack.tally, seconds)
        attack.tally.wrong += ends_at_once(served.process, LIMIT_S)
        _join(attack.tally, scripts)  # one waits as long as its world stands still
    told = "".join(served.told)
    attack.tally.wrong += tracebacks_in(told)
    return attack.tally, [*lines, "The class said:", *told.splitlines()]  # also why a room ended


def misuse_panel(attack: Attack, student: Student, rng: random.Random) -> None:
    """Send commands and messages of any kind to the own room; leave and come back."""
    while not attack.over.is_set():
        with Panel(student.address, student.cookies) as panel:
            attack.over.wait(0.3)  # real time: its first answers have usually come; it needs none
            for _ in range(rng.randint(20, 200)):
                if attack.over.is_set() or not panel.is_open:
                    break
                panel.use_any(rng)
                attack.tally.count("messages of a panel")
                attack.over.wait(rng.uniform(0.0, 0.2))
            for kind, number in panel.answers.items():
                attack.tally.count(f"commands {kind}", number)


def hold_keys(attack: Attack, student: Student, rng: random.Random) -> None:
    """Hold keys in the own room, reset, and send odd messages."""
    odd = ('{"type":"keys","held":9}', "[]", "x" * 5000, '{"type":"command","name":"../x"}')
    while not attack.over.is_set():
        with Page(student.address + "ws/input", additional_headers=student.cookies) as page:
            for _ in range(rng.randint(20, 100)):
                if attack.over.is_set():
                    return
                page.hold(*rng.sample(KEYS, 2))
                if rng.random() < 0.1:
                    page.send("command", name=rng.choice(("reset", "resume")))
                elif rng.random() < 0.1:
                    page.socket.send(rng.choice(odd))
                attack.tally.count("messages of a keyboard")
                attack.over.wait(rng.uniform(0.05, 0.2))


def keep_programs(attack: Attack, student: Student, rng: random.Random) -> None:
    """Save programs in the class, and look whether the latest one that it took is there."""
    saved = 0
    while not attack.over.wait(rng.uniform(1.5, 3.0)):  # real time: the class takes one a second
        source, version = attack.kept.get(student.room, ("", 0))
        where = {"scene": "Maze", "agent": "robot"}
        answer = student.client.get("api/program", params=where)
        attack.tally.count(f"programs read, answer {answer.status_code}")
        if answer.status_code == 200 and source and answer.json().get("source") != source:
            attack.tally.wrong.append(f"a program was lost: {answer.text[:200]}")
        saved += 1
        source = f"# number {saved}\n" + "x = 1\n" * rng.randint(0, 500)
        body = {**where, "source": source, "base": version, "device": student.room}
        answer = student.client.put("api/program", json=body)
        attack.tally.count(f"programs saved, answer {answer.status_code}")
        if answer.status_code == 200:
            attack.kept[student.room] = source, answer.json()["version"]


def drive_by_script(attack: Attack, student: Student, rng: random.Random) -> None:
    """Drive the own room's first agent by a script, and come again."""
    while not attack.over.is_set():
        try:
            # real time: who is refused comes again
            with connect(attack.addresses[student.room], agent="0", patience=2.0) as robot:
                for _ in range(rng.randint(1, 100)):
                    if attack.over.is_set():
                        break
                    try:
                        robot.act(move=[1, rng.uniform(-1, 1), 0, 0])
                        robot.sense()
                        attack.tally.count("decisions of a script")
                    except ActionError:  # the episode is over, or the actuator is gone
                        robot.reset()
        except RemoteError:
            attack.tally.count("refusals to a script")
            attack.over.wait(1.0)  # real time: pause of a script that comes again


def try_doors(attack: Attack, rng: random.Random) -> None:
    """Ask for rooms and for the teacher's pages as somebody who may not."""
    while not attack.over.is_set():
        victim, other = rng.sample(attack.students, 2)
        cookie, token = next(iter(victim.client.cookies.items()))
        spoilt = token[:-1] + rng.choice("0123456789abcdef".replace(token[-1], ""))
        headers: dict[str, str] = rng.choice(
            (
                {},
                other.cookies,
                {"Cookie": f"{cookie}={spoilt}"},
                {"Cookie": f"{cookie}=; {cookie}={'0' * len(token)}"},
                {"Cookie": f'{cookie}="{token[:8]}"'},
                {"Authorization": f"Bearer {token}"},
                {"Authorization": f"Bearer {attack.served.token[:-1]}"},
                {"X-Forwarded-For": "127.0.0.1", "X-Forwarded-Host": "localhost"},
                {"X-Forwarded-User": "teacher", "Authorization": "Bearer "},
            )
        )
        if rng.random() < 0.5:
            path = victim.room + rng.choice((*ROOM_PATHS, "ws/panel", "ws/remote", ""))
            if path.endswith(("vendor/x", "main.js")):
                continue
        else:
            path = "/" + rng.choice(TEACHERS_PATHS)
        if rng.random() < 0.4:
            answer = _answer_of_socket(attack.served.url + path.removeprefix("/"), headers)
        else:
            answer = str(status_of(ask(attack.served.url, path.encode(), headers)))
        attack.tally.count(f"doors that were tried, answer {answer}")
        if answer in ENTERED:
            attack.tally.wrong.append(f"{path} with {headers} was entered: {answer}")
        attack.over.wait(rng.uniform(0.0, 0.1))


def _answer_of_socket(url: str, headers: Mapping[str, str]) -> str:
    """Return how a request for a WebSocket ends; one that is closed with a reason opens before."""
    try:
        with open_socket(url, additional_headers=headers, max_size=None) as socket:
            socket.recv(LIMIT_S)
    except InvalidStatus as refused:
        return str(refused.response.status_code)
    except ConnectionClosed:
        return "closed"
    except TimeoutError:
        pass
    return "open"


def guess_codes(attack: Attack, rng: random.Random) -> None:
    """Ask for a seat with wrong codes, and with bodies that are none."""
    with http_client.Client(base_url=attack.served.url) as client:
        while not attack.over.is_set():
            code = "".join(rng.choices("BCDFGHJKLM", k=5))
            body: Any = {"code": code, "name": "Red Fox", "request": f"{rng.getrandbits(64):020}"}
            if rng.random() < 0.3:
                body[rng.choice((*body, "more"))] = rng.choice((None, [], "x" * 3000, 7))
            answer = client.post("api/join", json=body)
            attack.tally.count(f"codes that were guessed, answer {answer.status_code}")
            if answer.status_code == 200:
                attack.tally.wrong.append(f"a wrong code was taken: {body}")
            attack.over.wait(rng.uniform(0.0, 0.5))


def hold_sockets(attack: Attack, rng: random.Random) -> None:
    """Open sockets that anybody may open, say nothing, and let them lie."""
    while not attack.over.is_set():
        with ExitStack() as stack:
            for _ in range(rng.randint(5, 60)):
                path = rng.choice(("check/socket", "link"))
                with suppress(*GONE):
                    stack.enter_context(open_socket(attack.served.url + path))
                    attack.tally.count("sockets that were held")
            attack.over.wait(rng.uniform(1.0, 15.0))


def send_targets(attack: Attack, rng: random.Random) -> None:
    """Send mutated targets of requests, as a stranger, a student and the teacher."""
    teacher = PageCookie(attack.served.token)
    while not attack.over.is_set():
        student = rng.choice(attack.students)
        paths = ("/", "/link", "/teacher/state", *(student.room + each for each in ROOM_PATHS))
        place = f"127.0.0.1:{attack.beside.port}"
        target = mutated(rng.choice(paths), place, rng)
        headers = rng.choice(({}, student.cookies, {"Cookie": f"{teacher.name}={teacher.value}"}))
        socket = SOCKET_HEADERS if rng.random() < 0.3 else {}
        method = b"GET" if socket else rng.choice(METHODS)
        status = status_of(ask(attack.served.url, target, {**headers, **socket}, method))
        attack.tally.count("mutated targets")
        if status >= SERVER_ERROR and status != BUSY:
            attack.tally.wrong.append(f"{method!r} {target!r} was answered with {status}")
        attack.over.wait(rng.uniform(0.0, 0.1))


def teach(attack: Attack, rng: random.Random) -> None:
    """Look at the class, assign scenes, ask for attention, and hold races."""
    served = attack.served
    rooms = [each.room.split("/")[2] for each in attack.students]
    while not attack.over.wait(rng.uniform(1.0, 3.0)):  # real time: period of a teacher's page
        commands: tuple[tuple[str, dict[str, Any]], ...] = (
            ("assign", {"rooms": rng.sample(rooms, 2), "scene": rng.choice(SCENES)}),
            ("attention", {"kind": "pause", "message": "Look here", "seconds": 2.0}),
            ("attention", {"kind": "", "message": ""}),
            ("show", {"kind": "room", "room": rng.choice(rooms)}),
            ("race", {"scene": "box_chase", "countdown": 1.0}),
            ("end race", {}),
            ("new code", {}),
            ("rename", {"seat": rng.randint(1, ROOMS), "name": "Old Name"}),
        )
        do, rest = rng.choice(commands)
        answer = served.command(do, **rest)
        attack.tally.count(f"teacher: {do}, answer {answer.status_code}")
        served.state()


class Memory:
    """Resident memory of a class's processes over time.

    Args:
        pid: of the class.
    """

    def __init__(self, pid: int) -> None:
        self._class = psutil.Process(pid)
        self._samples: dict[int, list[tuple[float, int]]] = {}
        """Time (s) and bytes, by process."""
        self._began = time.monotonic()  # real time: growth is told by the hour

    def sample(self, tally: Tally) -> None:
        """Note what the processes have now; a room's process that is gone is a fault."""
        now = time.monotonic() - self._began  # real time: as above
        there = {}
        for process in (self._class, *self._class.children(recursive=True)):
            with suppress(psutil.NoSuchProcess):
                there[process.pid] = process.memory_info().rss
        for pid in self._samples.keys() - there.keys():
            if len(self._samples[pid]) > 1:  # no process that lived for a moment
                tally.wrong.append(f"process {pid} ended after {now:.0f} s")
                del self._samples[pid]
        for pid, size in there.items():
            self._samples.setdefault(pid, []).append((now, size))

    def judge(self, tally: Tally, seconds: float) -> list[str]:
        """Return a line for each process; one that grows is a fault in a long run."""
        lines = []
        for pid, samples in self._samples.items():
            settled = [sample for sample in samples if sample[0] >= SETTLED_S]
            is_judged = seconds >= 2 * SETTLED_S and len(settled) >= LEAST_SAMPLES
            later = settled if is_judged else samples[len(samples) // 5 :]
            if len(later) < LEAST_SAMPLES:
                continue
            growth = _growth(later)
            name = "class" if pid == self._class.pid else "room"
            first, last = later[0][1] / 1e6, later[-1][1] / 1e6
            sizes = " ".join(f"{size / 1e6:.0f}" for _, size in samples[:: len(samples) // 20 + 1])
            lines.append(
                f"{name} {pid}: {first:.1f} -> {last:.1f} MB, {growth:+.1f} MB/h after "
                f"{later[0][0]:.0f} s ({sizes})"
            )
            if is_judged and growth > GROWTH_MB_PER_H:
                tally.wrong.append(f"grows: {lines[-1]}")
        return lines


def _growth(samples: list[tuple[float, int]]) -> float:
    """Return the growth (MB/h) of samples of time (s) and bytes.

    It is that between the medians of the first third and the last: memory that is taken for a
    moment and given back does not count, as it would for a line through all samples.
    """
    third = len(samples) // 3
    parts = samples[:third], samples[-third:]
    began, ended = (statistics.median(time_s for time_s, _ in part) for part in parts)
    first, last = (statistics.median(size for _, size in part) for part in parts)
    return (last - first) / (ended - began) * 3600 / 1e6


def _judge(attack: Attack, seats: list[tuple[int, str]]) -> None:
    """Look whether everybody and everything is still there, and nobody else."""
    wrong, served = attack.tally.wrong, attack.served
    now = [(each["number"], each["room"]) for each in served.state()["seats"]]
    if now != seats:
        wrong.append(f"the seats were {seats}, and are {now}")
    if attack.beside.requests:
        wrong.append(f"another server was reached: {attack.beside.requests[:3]}")
    for student in attack.students:
        deadline = Deadline()
        with suppress(AssertionError):  # told below, with all else
            while (answer := student.get("api/snapshot")).status_code == BUSY:
                deadline.left(answer.text)
        if answer.status_code != 200:
            wrong.append(f"{student.room} is answered with {answer.status_code}: {answer.text}")
        source, _ = attack.kept.get(student.room, ("", 0))
        params = {"scene": "Maze", "agent": "robot"}
        kept = student.client.get("api/program", params=params).json().get("source", "")
        if source and kept != source:
            wrong.append(f"the program of {student.room} was lost; there is {kept[:40]!r}")


def _join(tally: Tally, threads: list[threading.Thread]) -> None:
    for thread in threads:
        thread.join(LIMIT_S)
    tally.wrong += [f"did not end: {each.name}" for each in threads if each.is_alive()]


def _guarded(attack: Attack, work: Callable[[], None]) -> None:
    while not attack.over.is_set():
        try:
            work()
        except (*GONE, httpx.TransportError) as error:
            attack.tally.count(f"{type(error).__name__} to an attacker")
            attack.over.wait(0.2)  # real time: pause of a page that comes again
        except Exception as error:
            attack.tally.wrong.append(f"{error!r}")
            attack.over.set()
            raise


def main() -> None:
    """Read the command line, attack, and print the tally."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    with TemporaryDirectory() as folder:
        tally, memory = attack_class(options.seconds, options.seed, Path(folder))
    for name, number in sorted(tally.done.items()):
        print(f"{number:>8} {name}")
    print("\n".join(memory))
    print("\n".join(tally.wrong) or "nothing went wrong")
    sys.exit(bool(tally.wrong))


if __name__ == "__main__":
    main()
