"""No target of a request leads a class's gateway anywhere but to the sender's own room."""

from collections.abc import Iterator

import pytest

from tests.attacks.raw_http import SOCKET_HEADERS, ForbiddenServer, ask, status_of
from tests.attacks.targets import attack_all
from tests.classroom.served_class import ServedClass, Student, served_class
from tests.waiting import LIMIT_S

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[ServedClass]:
    with served_class(tmp_path_factory.mktemp("class")) as served:
        yield served


@pytest.fixture(scope="module")
def ada(served: ServedClass) -> Student:
    student = served.joined()
    assert student.get("healthz").status_code == 200  # the room runs
    return student


@pytest.fixture
def beside() -> Iterator[ForbiddenServer]:
    with ForbiddenServer() as server:
        yield server


@pytest.mark.parametrize("kind", ["request", "socket"])
@pytest.mark.parametrize(
    "form",
    [
        "%2fr%2f{room}%2f@{place}/any/path",
        "%2fr/{room}/@{place}/any/path",
        "%2Fr%2F{room}%2F:x@{place}/ws/input",
        "@{place}/r/{room}/healthz",
        ":80@{place}/r/{room}/healthz",
        ".{place}/r/{room}/healthz",
        "http://{place}/r/{room}/healthz",
        "%2fr/{room}/x",
        "{place}",
        "*",
    ],
)
def test_a_target_that_does_not_begin_with_a_slash_is_refused(
    served: ServedClass, ada: Student, beside: ForbiddenServer, form: str, kind: str
) -> None:
    room, place = ada.room.split("/")[2], f"127.0.0.1:{beside.port}"
    target = form.format(room=room, place=place).encode()
    headers = {**ada.cookies, **(SOCKET_HEADERS if kind == "socket" else {})}
    for method in (b"GET",) if kind == "socket" else (b"GET", b"POST", b"PUT", b"DELETE"):
        answer = ask(served.url, target, headers, method)
        assert status_of(answer) == 400, answer
        assert b"begins with a slash" in answer
    assert beside.requests == []
    assert "Traceback" not in "".join(served.told)


@pytest.mark.parametrize(
    "rest",
    [
        "a/../../../api/snapshot",
        "%2e%2e/%2e%2e/api/snapshot",
        "%252e%252e/api/snapshot",
        "@{place}/api/snapshot",
        "api/snapshot#@{place}/",
        "api/snapshot;x=1",
        "api/snapshot?x=1#y",
        "\\@{place}\\api\\snapshot",
        "[{place}]",
        "{{}}|^`<>\"'",
        "%ff%00%0d%0aHost:%20{place}",
    ],
)
def test_a_room_gets_the_path_that_access_was_decided_on(
    served: ServedClass, ada: Student, beside: ForbiddenServer, rest: str
) -> None:
    """Nothing behind the room's own path is another one after it was normalized."""
    place = f"127.0.0.1:{beside.port}"
    target = (ada.room + rest.format(place=place)).encode()
    ordinary = ask(served.url, target, ada.cookies)
    of_socket = ask(served.url, target, {**ada.cookies, **SOCKET_HEADERS})
    expected = 200 if rest.startswith("api/snapshot?") else 404
    assert status_of(ordinary) == expected, ordinary
    assert status_of(of_socket) == 403, of_socket
    assert beside.requests == []
    assert "Traceback" not in "".join(served.told)


@pytest.mark.parametrize(
    "headers",
    [
        {"User-Agent": "\xe9\xff"},
        {"Cookie": "a/b=c"},
        {"Cookie": 'x{y}="\xe9'},
        {"Host": "localhost:99999"},
        {"Host": "localhost:0"},
        {"Host": "[::::]"},
        {"Host": "user@localhost"},
    ],
)
@pytest.mark.parametrize("path", ["api/snapshot", "ws/input", ""])
def test_odd_headers_cause_no_error_of_the_server(
    served: ServedClass, ada: Student, headers: dict[str, str], path: str
) -> None:
    cookie = "; ".join(filter(None, [ada.cookies["Cookie"], headers.get("Cookie", "")]))
    sent = {**headers, "Cookie": cookie}
    for kind in ({}, SOCKET_HEADERS):
        answer = ask(served.url, (ada.room + path).encode(), {**sent, **kind})
        assert status_of(answer) in (101, 200, 403, 404), answer
    assert ada.client.get(ada.room + "healthz", timeout=LIMIT_S).status_code == 200
    assert "Traceback" not in "".join(served.told)


def test_no_mutated_target_reaches_another_server_through_any_proxy() -> None:
    assert attack_all(60, seed=1).wrong == []


@pytest.mark.nightly
@pytest.mark.timeout(3600)
@pytest.mark.needs("hub")
def test_none_of_ten_thousand_does() -> None:
    assert attack_all(1700, seed=2, has_jupyter=True).wrong == []
