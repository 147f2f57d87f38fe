"""A class as a service of a JupyterHub: who is who, and who may do what."""

from collections.abc import Iterator
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

import httpx
import pytest

from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks.brains import zoo
from ai4u_edu.classroom.hub import HubEnvironment
from ai4u_edu.classroom.hub.sign_in import COOKIE, STATE_COOKIE
from ai4u_edu.member import NotJoinedError, UnreachableError, join_at_hub
from ai4u_edu.wire.class_link import Ack, HandedIn, HandedInNetwork, LinkProblem, LinkWelcome
from tests.classroom.fake_hub import (
    ACCESS,
    NAME,
    PREFIX,
    READ,
    SECRET,
    FakeHub,
    HubClass,
    fake_hub,
    hub_class,
)
from tests.classroom.link_client import RawLink, check, state
from tests.classroom.reserved_port import reserved_port
from tests.page.server import http_client
from tests.waiting import until

pytestmark = pytest.mark.slow

HTML = {"Accept": "text/html"}


@pytest.fixture(scope="module")
def hub() -> Iterator[FakeHub]:
    with fake_hub() as hub:
        hub.add("ada")
        hub.add("grace")
        hub.add("alan", "ai4u-teachers")
        hub.add("root", admin=True)
        yield hub


@pytest.fixture(scope="module")
def school(hub: FakeHub, tmp_path_factory: pytest.TempPathFactory) -> Iterator[HubClass]:
    with hub_class(tmp_path_factory.mktemp("class"), hub) as school:
        yield school


ADA, GRACE, ALAN, ROOT = (f"token-of-{name}" for name in ("ada", "grace", "alan", "root"))


def test_a_browser_signs_in_at_the_hub_and_gets_a_seat(hub: FakeHub, school: HubClass) -> None:
    with school.client() as browser:
        away = browser.get("", headers=HTML)
        assert away.status_code == 302
        assert away.headers["location"].startswith("/hub/api/oauth2/authorize?")
        asked = {
            name: values[0]
            for name, values in parse_qs(urlsplit(away.headers["location"]).query).items()
        }
        assert asked["client_id"] == f"service-{NAME}"
        assert asked["redirect_uri"] == f"{PREFIX}oauth_callback"
        hub.codes["code-1"] = ADA
        query = {"code": "code-1", "state": asked["state"]}
        back = browser.get("oauth_callback", params=query)
        assert (back.status_code, back.headers["location"]) == (303, PREFIX)
        assert hub.forms[-1]["client_secret"] == SECRET
        assert len(hub.forms[-1]["code_verifier"]) >= 43
        cookie = next(each for each in back.headers.get_list("set-cookie") if COOKIE + "=" in each)
        assert f"Path={PREFIX}" in cookie
        assert "HttpOnly" in cookie
        assert browser.get("", headers=HTML).status_code == 200
        mine = browser.get("api/me").json()
        assert mine["name"] == school.seat(ADA).json()["name"]
        assert mine["notebooks"] == "/hub/user-redirect/"


@pytest.mark.parametrize("state_given", ["", "another"])
def test_a_sign_in_that_somebody_else_began_is_refused(
    hub: FakeHub, school: HubClass, state_given: str
) -> None:
    hub.codes["code-2"] = ADA
    with school.client() as browser:
        if state_given:
            browser.get("", headers=HTML)
            assert STATE_COOKIE in browser.cookies
        answer = browser.get("oauth_callback", params={"code": "code-2", "state": state_given})
    assert answer.status_code == 403
    assert "code-2" in hub.codes  # it was not even used


def test_a_code_that_is_not_valid_signs_nobody_in(school: HubClass) -> None:
    with school.client() as browser:
        asked = urlsplit(browser.get("", headers=HTML).headers["location"]).query
        query = {"code": "made up", "state": parse_qs(asked)["state"][0]}
        answer = browser.get("oauth_callback", params=query)
        assert answer.status_code == 403
        assert COOKIE not in browser.cookies


@pytest.mark.parametrize(
    "path", ["teacher", "teacher/state", "teacher/export", "projector", "api/names"]
)
def test_only_the_hubs_teachers_get_the_teachers_pages(school: HubClass, path: str) -> None:
    def status(token: str) -> int:
        with school.client(token) as browser:
            return browser.get(path).status_code

    found = {each: status(each) for each in ("", "made up", ADA, ALAN, ROOT)}
    assert found == {"": 401, "made up": 401, ADA: 403, ALAN: 200, ROOT: 200}


def test_a_program_with_a_teachers_token_has_a_seat_and_no_commands(school: HubClass) -> None:
    """Servers of teachers run code, too, which has the server's token."""
    headers = {"Authorization": f"token {ALAN}"}
    answer = http_client.get(f"{school.url}teacher/state", headers=headers, trust_env=False)
    assert answer.status_code == 401


def test_a_teacher_is_led_to_the_wall_and_a_student_is_not(school: HubClass) -> None:
    with school.client(ALAN) as browser:
        answer = browser.get("", headers=HTML)
    assert (answer.status_code, answer.headers["location"]) == (303, f"{PREFIX}teacher")


def test_a_notebook_finds_the_class_and_its_seat_without_arguments(school: HubClass) -> None:
    seat = join_at_hub(variables=school.variables(ADA, "ada"))
    assert seat.url == school.url
    assert seat.name == school.seat(ADA).json()["name"]
    other = join_at_hub(variables=school.variables(GRACE, "grace"))
    assert other.name != seat.name
    with RawLink(school, seat.token) as link:
        assert link.next(LinkWelcome).name == seat.name
        link.send(check("right"))
        numbers = {each["name"]: each["number"] for each in school.state(ALAN)["seats"]}
        own = str(numbers[seat.name])
        until(lambda: "04.2" in school.state(ALAN)["progress"].get(own, {}))
        assert school.state(ALAN)["progress"].get(str(numbers[other.name]), {}) == {}


def test_a_notebook_is_told_why_it_can_not_join(hub: FakeHub, school: HubClass) -> None:
    with pytest.raises(NotJoinedError, match="expected a server of a JupyterHub"):
        join_at_hub(variables={})
    unknown = school.variables("made up", "ada")
    with pytest.raises(NotJoinedError, match="This hub has no class"):
        join_at_hub(variables=unknown)
    token = hub.add("lin", scopes=(READ,))
    with pytest.raises(NotJoinedError, match="access:services!service=ai4u-class"):
        join_at_hub(variables=school.variables(token, "lin"))
    with reserved_port() as port, pytest.raises(UnreachableError):
        join_at_hub(variables={**unknown, "JUPYTERHUB_API_URL": f"http://127.0.0.1:{port}/hub/api"})


@pytest.mark.parametrize("token", ["", "made up", "Bearer x", "token\n", "é"])
def test_a_link_without_a_token_of_the_hub_is_refused(school: HubClass, token: str) -> None:
    with RawLink(school, token) as link:
        code, problem = link.end()
    assert code == 1008
    assert problem is not None
    assert problem.code == "secret"


def test_a_service_has_no_seat(hub: FakeHub, school: HubClass) -> None:
    hub.users["token-of-a-service"] = {"kind": "service", "name": "x", "scopes": [ACCESS]}
    assert school.seat("token-of-a-service").status_code == 401


def test_look_in_leads_to_the_students_own_server_only(school: HubClass) -> None:
    seat = school.seat(ADA).json()

    (ours,) = (
        each["number"] for each in school.state(ALAN)["seats"] if each["name"] == seat["name"]
    )
    room = f"seat-{ours}"

    def can_look_in() -> bool:
        return any(each["id"] == room and each["look_in"] for each in school.state(ALAN)["rooms"])

    def looked_in(page: str) -> httpx.Response:
        until(lambda: not can_look_in())  # the page of the link before is forgotten
        with RawLink(school, ADA) as link, school.client(ALAN) as teacher:
            link.next(LinkWelcome)
            link.send(state(page=page))
            until(can_look_in)
            return teacher.get(f"teacher/look/{room}")

    fine = looked_in("user/ada/proxy/4000/?token=abc-_")
    assert fine.status_code == 303
    assert fine.headers["location"] == "/hub/user/ada/proxy/4000/?token=abc-_"
    for page in (
        "user/grace/proxy/4000/",
        "//evil.example/",
        "user/ada/../grace/",
        "user/ada/%2E%2e/grace/",
        "user/ada/./../../logout",
    ):
        assert looked_in(page).status_code == 403, page
    with school.client(GRACE) as student:
        assert student.get("teacher/look/seat-1").status_code == 403


def test_nothing_that_the_class_shows_or_stores_names_a_user(
    hub: FakeHub, school: HubClass
) -> None:
    token = hub.add("veryuniqueusername", "ai4u-teachers")
    assert school.seat(token).status_code == 200
    with RawLink(school, token) as link, school.client(token) as teacher:
        link.next(LinkWelcome)
        link.send(state(page="user/veryuniqueusername/proxy/4000/?token=secret-of-page"))
        until(lambda: any(each["look_in"] for each in school.state(token)["rooms"]))
        told = teacher.get("teacher/state").content
        exported = teacher.get("teacher/export").content
    stored = b"".join(each.read_bytes() for each in school.folder.rglob("*") if each.is_file())
    for found in (told, exported, stored):
        assert found
        for word in (b"veryunique", b"token-of", b"secret-of-page"):
            assert word not in found


def test_a_hub_that_is_away_ends_no_link(hub: FakeHub, school: HubClass) -> None:
    own, late = hub.add("emmy"), hub.add("sonja")
    name = school.seat(own).json()["name"]
    with RawLink(school, own) as link:
        link.next(LinkWelcome)
        hub.is_down = True
        try:
            assert school.seat(late).status_code == 503
            with RawLink(school, late) as refused:
                assert refused.end() == (1013, None)  # so it tries again
            link.send(check("right", exercise="00.1", own="key-of-emmy"))
            assert link.next(Ack).key == "key-of-emmy"
        finally:
            hub.is_down = False
    assert school.seat(own).json()["name"] == name


def test_who_is_sent_out_may_sign_in_again_and_who_is_banned_may_not(
    hub: FakeHub, school: HubClass
) -> None:
    token = hub.add("kurt")
    name = school.seat(token).json()["name"]
    number = next(each["number"] for each in school.state(ALAN)["seats"] if each["name"] == name)

    def command(do: str) -> None:
        with school.client(ALAN) as teacher:
            answer = teacher.post("teacher/command", json={"do": do, "seat": number})
            assert answer.status_code == 200, answer.text

    with RawLink(school, token) as link:
        link.next(LinkWelcome)
        command("kick")
        assert link.next(LinkProblem).code == "over"
    with RawLink(school, token) as link:
        assert link.end()[0] == 1008  # a program does not come back by itself
    assert school.seat(token).json()["name"] == name
    command("ban")
    assert school.seat(token).status_code == 403


@pytest.mark.nightly
def test_seats_are_there_after_a_restart_and_gone_after_forget(
    hub: FakeHub, tmp_path: Path
) -> None:
    with hub_class(tmp_path, hub) as school:
        name = school.seat(ADA).json()["name"]
        assert school.seat(GRACE).json()["name"] != name
    with hub_class(tmp_path, hub) as school:
        assert school.seat(ADA).json()["name"] == name
        assert len(school.state(ALAN)["seats"]) == 2
        with school.client(ALAN) as teacher:
            assert teacher.post("teacher/command", json={"do": "forget"}).status_code == 200
        assert school.state(ALAN)["seats"] == []
        assert school.seat(ADA).status_code == 200


@pytest.mark.nightly
def test_a_network_comes_over_the_link_and_plays(hub: FakeHub, tmp_path: Path) -> None:
    with hub_class(tmp_path, hub) as school:
        name = school.seat(ADA).json()["name"]
        with RawLink(school, ADA) as link:
            data = zoo.network_of("box_chase").read_bytes()
            link.send(HandedInNetwork("key-of-a-network", "box_chase", "", "mine.onnx", data))
            link.next(Ack)
            told = link.next(HandedIn, lambda each: each.networks[:1] != ())
            while told.networks[0].verdict == "open":
                told = link.next(HandedIn)
            assert told.networks[0].reason == ""
        with school.client(ALAN) as teacher:
            for command in (
                {"do": "tournament", "scene": "box_chase"},
                {"do": "start tournament", "own_player": True},
            ):
                answer = teacher.post("teacher/command", json=command)
                assert answer.status_code == 200, answer.text
            until(lambda: school.state(ALAN)["tournament"]["phase"] == "over")
            results = school.state(ALAN)["tournament"]["results"]
            assert {each["name"] for each in results["standings"]} == {name, "The scene's player"}
            assert name in teacher.get("teacher/tournament").text
        with school.client(GRACE) as student:
            assert student.get("teacher/tournament").status_code == 403


def test_without_a_hub_the_command_says_what_is_missing() -> None:
    with pytest.raises(SetupError, match=r"--hub: expected a service.*JUPYTERHUB_API_TOKEN"):
        HubEnvironment.read({})
