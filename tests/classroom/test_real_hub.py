"""A real JupyterHub with its proxy: two students and a teacher, in browsers; the hub is restarted.

Needs jupyterhub and jupyterhub-idle-culler (pip), and configurable-http-proxy (npm) on the PATH.
"""

import contextlib
import json
import shutil
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import psutil
import pytest
from playwright.sync_api import Browser, Page

from tests.chromium import browser
from tests.lessons.hub import WORD, hub, new_ports, shows, student
from tests.waiting import LIMIT_MS, Deadline

pytestmark = [
    pytest.mark.browser,
    pytest.mark.nightly,
    pytest.mark.timeout(1200),
    pytest.mark.skipif(
        find_spec("jupyterhub") is None or shutil.which("configurable-http-proxy") is None,
        reason="needs jupyterhub and configurable-http-proxy",
    ),
]

SETTINGS = """
c.JupyterHub.load_groups = {"ai4u-teachers": {"users": ["teacher"]}}
c.JupyterHub.cleanup_servers = False  # students' servers go on while the hub is restarted

def with_tile(spawner):
    # as the package's entry point does it; the installed one may be older
    hand_out(spawner)
    file = Path(spawner.environment["JUPYTER_CONFIG_PATH"]) / "jupyter_server_config.py"
    file.write_text(
        "from ai4u_edu.cli.server_proxy import server_proxy\\n"
        "c.ServerProxy.servers = {'ai4u-edu': server_proxy()}\\n"
    )

c.Spawner.pre_spawn_hook = with_tile
"""
JOIN = "from ai4u_edu.lessons import join_class; join_class()"


class Student:
    """A student in lesson 00, with a world that the teacher sees."""

    def __init__(self, chromium: Browser, url: str, name: str) -> None:
        self.page = student(chromium, url, name)
        # such as that the notebook could not be saved while the hub was away
        dialog = self.page.locator("dialog.jp-Dialog")
        self.page.add_locator_handler(dialog, lambda it: it.get_by_role("button").last.click())
        shows(self.page)
        self.page.locator(".jp-CodeCell").nth(2).locator(".cm-content").click()
        self.page.keyboard.press("Control+A")
        self.page.keyboard.insert_text(JOIN)
        self.page.keyboard.press("Shift+Enter")
        told = self.page.get_by_text("You are ").first
        told.wait_for()
        self.name = told.inner_text().partition("You are ")[2].partition(".")[0]

    def drive(self, key: str) -> None:
        """Hold a key in the world."""
        self.page.locator("iframe[src*=token]").click(position={"x": 250, "y": 150})
        for other in ("KeyA", "KeyD"):
            self.page.keyboard.up(other)
        self.page.keyboard.down(key)

    @property
    def world(self) -> str:
        """Address of the world's page."""
        address = self.page.locator("iframe[src*=token]").get_attribute("src")
        assert address
        return address


class Teacher:
    """A teacher who has signed in on the way to the class's page."""

    def __init__(self, chromium: Browser, url: str) -> None:
        context = chromium.new_context(viewport={"width": 1366, "height": 900})
        context.set_default_timeout(LIMIT_MS)
        self.page = context.new_page()
        self.page.goto(url)
        sign_in(self.page, "teacher")
        self.page.wait_for_url("**/services/ai4u-class/teacher")

    def wait_for(self, fits: Callable[[dict[str, Any]], bool]) -> None:
        """Wait until the class fits."""
        deadline = Deadline()
        while True:
            found: dict[str, Any] | None = self.page.evaluate(
                "fetch('./teacher/state').then((answer) => answer.json()).catch(() => null)"
            )
            if found is not None and fits(found):
                return
            told = json.dumps(found and [found["rooms"], found["seats"]], indent=1)
            deadline.left(told)
            self.page.wait_for_timeout(500)  # real time: between two questions


def sign_in(page: Page, name: str) -> None:
    page.fill("input[name=username]", name)
    page.fill("input[name=password]", WORD)
    page.click("#login_submit")


def statuses(state: dict[str, Any]) -> dict[str, str]:
    """Return the status of each world, by the seat's name."""
    names = {seat["number"]: seat["name"] for seat in state["seats"]}
    return {names[room["seats"][0]]: room["status"] for room in state["rooms"]}


def is_back(state: dict[str, Any], *students: Student) -> bool:
    """Return True if the worlds of all students are linked to the class."""
    found = statuses(state)
    return all(found.get(each.name, "away") != "away" for each in students)


def status_of(page: Page, url: str) -> int:
    """Return the status of the page at an address, for whoever has signed in there."""
    other = page.context.new_page()
    answer = other.goto(url)
    assert answer is not None
    other.close()
    return answer.status


def test_a_class_at_a_hub_before_and_after_a_restart(tmp_path: Path) -> None:
    ports = new_ports()
    with browser() as chromium:
        with hub(tmp_path, SETTINGS, ports) as (url, root), ended_at_failure(root):
            school = url.replace("/hub/", "/services/ai4u-class/")
            ada, grace = (Student(chromium, url, each) for each in ("ada", "grace"))
            assert ada.name != grace.name
            teacher = Teacher(chromium, school)
            ada.drive("KeyA")
            grace.drive("KeyD")
            driving = {ada.name: "driving", grace.name: "driving"}
            teacher.wait_for(lambda state: statuses(state) == driving)
            both_are_drawn(teacher, ada, grace)
            the_teacher_looks_in(teacher, ada)
            neither_reaches_the_other(school, ada, grace)
        assert not (tmp_path / "ai4u-class" / "class.sqlite3").read_bytes().count(b"grace")
        with hub(tmp_path, SETTINGS.replace("False", "True"), ports):
            # nobody reloads a page, and no cell is run again
            teacher.wait_for(lambda state: is_back(state, ada, grace))
            ada.drive("KeyD")
            grace.drive("KeyA")
            teacher.wait_for(lambda state: statuses(state) == driving)
            neither_reaches_the_other(school, ada, grace)
            a_world_without_a_notebook(url, teacher, ada, grace)


@contextlib.contextmanager
def ended_at_failure(hub: psutil.Process) -> Iterator[None]:
    """End students' servers, which would outlast the hub, after a failure."""
    try:
        yield
    except BaseException:
        for each in hub.children(recursive=True):
            each.terminate()
        raise


def both_are_drawn(teacher: Teacher, *students: Student) -> None:
    for each in students:
        teacher.page.get_by_role("button", name=each.name).first.wait_for()


def the_teacher_looks_in(teacher: Teacher, there: Student) -> None:
    """The hub asks a teacher once whether to go to somebody else's server."""
    teacher.page.get_by_role("button", name=there.name).first.click()
    with teacher.page.context.expect_page() as opened:
        teacher.page.get_by_role("link", name="Look in").click()
    page = opened.value
    page.get_by_role("button", name="Authorize").click()
    page.locator(".ai4u-keycap").first.wait_for()
    assert "/user/ada/proxy/" in page.url
    page.close()
    teacher.page.keyboard.press("Escape")


def neither_reaches_the_other(school: str, one: Student, other: Student) -> None:
    assert status_of(one.page, one.world) == 200
    assert status_of(one.page, other.world) in (403, 404)
    assert status_of(other.page, one.world) in (403, 404)
    for path in ("teacher", "teacher/state", "teacher/look/seat-1", "projector"):
        assert status_of(one.page, school + path) == 403


def a_world_without_a_notebook(
    url: str, teacher: Teacher, other: Student, student: Student
) -> None:
    """The tile of JupyterLab starts a world on the student's server, and takes the place there."""
    address = url.replace("/hub/", "/user/grace/ai4u-edu/")
    tile = student.page.context.new_page()
    tile.goto(address)
    tile.locator(".ai4u-keycap").first.wait_for()
    teacher.wait_for(lambda state: statuses(state)[student.name] == "waiting")
    tile.keyboard.down("KeyA")
    teacher.wait_for(lambda state: statuses(state)[student.name] == "driving")
    assert status_of(other.page, address) in (403, 404)
