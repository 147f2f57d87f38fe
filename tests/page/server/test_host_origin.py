"""Foreign pages neither read nor drive."""

from collections.abc import Iterator
from itertools import product

import httpx
import pytest
from starlette.applications import Starlette
from starlette.types import ASGIApp
from websockets.exceptions import InvalidStatus

from ai4u_edu.page.server import LOOPBACK, RoomMount, hosts_for
from ai4u_edu.page.server.host_origin import ANY_ADDRESS
from tests.page.server import http_client
from tests.page.server.rooms import UPGRADE, Page, Room, raw_answer, served

PATHS = ("", "healthz", "api/snapshot", "api/openapi.json", "web/page/main.js", "nothing")
SOCKETS = ("", "ws/input")
WILDCARD_HOSTS = "0.0.0.0"  # noqa: S104 - a name to be asked by, nothing listens there


@pytest.fixture(scope="module")
def room() -> Iterator[Room]:
    with served() as room:
        yield room


@pytest.fixture(scope="module")
def client() -> Iterator[httpx.Client]:
    with http_client.Client() as client:
        yield client


def port_of(room: Room) -> str:
    return room.url.rstrip("/").rpartition(":")[2]


@pytest.mark.parametrize("path", PATHS)
def test_another_name_is_refused(room: Room, path: str) -> None:
    answer = http_client.get(room.url + path, headers={"Host": f"evil.example:{port_of(room)}"})
    assert answer.status_code == 403
    assert answer.text == (
        "Host: expected one of 127.0.0.1, [::1], localhost, got "
        f"'evil.example:{port_of(room)}'; a name is allowed with --allow-host NAME\n"
    )


@pytest.mark.parametrize(
    "host",
    [
        "127.0.0.1.evil.example",
        "localhost.evil.example",
        "127.0.0.2",
        "10.0.0.1",
        WILDCARD_HOSTS,
        "localhost:8080:1",
        "localhost:",
        "[::2]",
        "::1",
        "evil.example#localhost",
        "a b",
        "",
    ],
)
def test_names_that_only_look_like_ours_are_refused(room: Room, host: str) -> None:
    assert raw_answer(room.url, f"Host: {host}")[0] in (400, 403)


@pytest.mark.parametrize("host", ["localhost", "LOCALHOST:1", "127.0.0.1:8080", "[::1]:8080"])
def test_our_own_names_are_let_in_at_any_port(room: Room, host: str) -> None:
    assert raw_answer(room.url + "healthz", f"Host: {host}")[0] == 200


def test_no_name_and_two_names_are_refused(room: Room) -> None:
    assert raw_answer(room.url)[0] in (400, 403)
    assert raw_answer(room.url, "Host: localhost", "Host: evil.example")[0] in (400, 403)
    two = ("Host: localhost", "Host: evil.example", *UPGRADE)
    assert raw_answer(room.url + "ws/input", *two)[0] in (400, 403)


@pytest.mark.parametrize("path", SOCKETS)
@pytest.mark.parametrize(
    "origin",
    [
        "http://evil.example",
        "null",
        "http://localhost:1",
        "file://",
        "http://127.0.0.1.evil.example",
        "http://127.0.0.1",
        "chrome-extension://127.0.0.1:{port}",
        "http://x@127.0.0.1:{port}",
        "",
    ],
)
def test_a_page_from_elsewhere_opens_no_socket(room: Room, path: str, origin: str) -> None:
    origin = origin.replace("{port}", port_of(room))
    with pytest.raises(InvalidStatus) as refused:
        Page(room.url + path, additional_headers={"Origin": origin})
    assert refused.value.response.status_code == 403
    told = refused.value.response.body
    assert told is not None
    assert told.decode().startswith(f"Origin: expected http://127.0.0.1:{port_of(room)} (the page")


@pytest.mark.parametrize("path", SOCKETS)
def test_a_socket_under_another_name_is_refused(room: Room, path: str) -> None:
    evil = f"evil.example:{port_of(room)}"
    lines = (f"Host: {evil}", f"Origin: http://{evil}", *UPGRADE)
    assert raw_answer(room.url + path, *lines)[0] == 403


def test_our_own_page_and_programs_open_sockets(room: Room) -> None:
    for headers in ({"Origin": room.url.rstrip("/")}, {}):
        with Page(room.url + "ws/input", additional_headers=headers) as page:
            page.receive("hello")


def test_answers_are_not_for_other_pages(room: Room) -> None:
    for path in PATHS:
        headers = http_client.get(room.url + path).headers
        assert headers["X-Content-Type-Options"] == "nosniff"
        assert headers["Cross-Origin-Resource-Policy"] == "same-origin"
        assert "Access-Control-Allow-Origin" not in headers


def test_a_name_can_be_allowed_and_then_drives_through_a_proxy_too() -> None:
    with served(proxy_hosts=["Hub.Example"]) as room:
        assert raw_answer(room.url + "healthz", "Host: hub.example:443")[0] == 200
        assert raw_answer(room.url + "healthz", "Host: evil.example")[0] == 403
        with Page(
            room.url + "ws/input", additional_headers={"Origin": "https://hub.example"}
        ) as page:
            page.receive("hello")
        lines = ("Host: hub.example", "Origin: https://hub.example:443", *UPGRADE)
        assert raw_answer(room.url + "ws/input", *lines)[0] == 101


def test_any_name_can_be_allowed_but_its_pages_stay_among_themselves() -> None:
    with served(allowed_hosts=("*",)) as room:
        assert raw_answer(room.url + "healthz", "Host: whatever.example")[0] == 200
        lines = ("Host: whatever.example", *UPGRADE)
        ours, foreign = "Origin: http://whatever.example", "Origin: http://evil.example"
        assert raw_answer(room.url + "ws/input", *lines, ours)[0] == 101
        assert raw_answer(room.url + "ws/input", *lines, foreign)[0] == 403


def test_listening_everywhere_allows_addresses_but_no_foreign_names() -> None:
    assert hosts_for("127.0.0.1") == hosts_for("localhost") == hosts_for("::1") == LOOPBACK
    assert ANY_ADDRESS in hosts_for(WILDCARD_HOSTS)
    with served(allowed_hosts=hosts_for(WILDCARD_HOSTS)) as room:
        for host in ("192.168.1.5:8080", "[fe80::1]:8080", "localhost"):
            assert raw_answer(room.url + "healthz", f"Host: {host}")[0] == 200
        for host in ("evil.example", "999.1.1.1", "[::g]"):
            assert raw_answer(room.url + "healthz", f"Host: {host}")[0] == 403


FETCHED = {"Sec-Fetch-Mode": "no-cors", "Sec-Fetch-Dest": "image"}
VISIT = {"Sec-Fetch-Mode": "navigate", "Sec-Fetch-Dest": "document"}
EVERY_PATH = (
    *PATHS,
    "api/past",
    "api/past/1.gif",
    "web/styles/page/page.css",
    "ws/input",
    "ws/remote",
)


@pytest.mark.parametrize("site", ["cross-site", "same-site", "Cross-Site", "anything"])
def test_another_site_is_refused_everywhere(client: httpx.Client, room: Room, site: str) -> None:
    for path, how in product(EVERY_PATH, (FETCHED, {})):
        answer = client.get(room.url + path, headers={"Sec-Fetch-Site": site, **how})
        assert answer.status_code == 403
        assert answer.text.startswith("Sec-Fetch-Site: expected same-origin (the page that")


@pytest.mark.parametrize("method", ["GET", "HEAD", "POST", "PUT", "DELETE", "OPTIONS"])
def test_another_origin_is_refused_with_any_method(
    client: httpx.Client, room: Room, method: str
) -> None:
    origins = ("http://evil.example", "null", "http://127.0.0.1:1", "https://127.0.0.1")
    for path, origin in product(EVERY_PATH, origins):
        answer = client.request(method, room.url + path, headers={"Origin": origin})
        assert answer.status_code == 403


@pytest.mark.parametrize("kind", ["document", "iframe"])
@pytest.mark.parametrize("site", ["cross-site", "same-site"])
def test_a_link_and_a_notebooks_frame_open_the_page(
    client: httpx.Client, room: Room, site: str, kind: str
) -> None:
    headers = {"Sec-Fetch-Site": site, "Sec-Fetch-Mode": "navigate", "Sec-Fetch-Dest": kind}
    assert client.get(room.url, headers=headers).status_code == 200
    assert client.get(room.url + "?agent=0", headers=headers).status_code == 200
    for path in EVERY_PATH[1:]:
        assert client.get(room.url + path, headers=headers).status_code == 403
    for method in ("POST", "PUT"):
        assert client.request(method, room.url, headers=headers).status_code == 403
    headers["Sec-Fetch-Dest"] = "object"
    assert client.get(room.url, headers=headers).status_code == 403


def test_same_origin_and_typed_addresses_are_allowed(client: httpx.Client, room: Room) -> None:
    for site in ("same-origin", "none"):
        for path in ("", "healthz", "web/page/main.js", "api/past"):
            for how in (FETCHED, VISIT):
                headers = {"Sec-Fetch-Site": site, **how}
                assert client.get(room.url + path, headers=headers).status_code == 200
    headers = {"Origin": room.url.rstrip("/"), "Sec-Fetch-Site": "same-origin"}
    assert client.get(room.url + "api/snapshot", headers=headers).status_code == 200


def test_another_site_opens_no_socket_that_says_no_origin(room: Room) -> None:
    for path in SOCKETS:
        with pytest.raises(InvalidStatus, match="403"):
            Page(room.url + path, additional_headers={"Sec-Fetch-Site": "same-site"})


@pytest.mark.parametrize("prefix", ["/lab", "/user/ann/proxy"])
def test_a_room_under_a_path_is_guarded_too(client: httpx.Client, prefix: str) -> None:
    def under(app: ASGIApp) -> ASGIApp:
        return Starlette(routes=[RoomMount(prefix, app)])

    with served(wrap=under) as room:
        base = room.url.rstrip("/") + prefix
        foreign = {"Sec-Fetch-Site": "same-site"}
        for path in ("/healthz", "/api/past/1.gif", "/"):
            assert client.get(base + path, headers=foreign | FETCHED).status_code == 403
        assert client.get(base + "/", headers=foreign | VISIT).status_code == 200
        assert client.get(base + "/healthz", headers=foreign | VISIT).status_code == 403
        with pytest.raises(InvalidStatus, match="403"):
            Page(base + "/ws/input", additional_headers={"Origin": "http://evil.example"})


@pytest.mark.parametrize("path", SOCKETS)
def test_another_port_of_our_own_names_opens_no_socket(path: str) -> None:
    names = hosts_for(WILDCARD_HOSTS)
    own = names[4]
    with served(allowed_hosts=names) as room:
        port = port_of(room)
        for name in (own, "192.168.1.5", WILDCARD_HOSTS, "localhost"):
            lines = (f"Host: {name}:{port}", *UPGRADE)
            for origin in (f"http://{name}:9", f"http://{name}", f"https://{name}:{port}"):
                answer = raw_answer(room.url + path, *lines, f"Origin: {origin}")
                assert answer[0] == 403, origin
            ours = raw_answer(room.url + "ws/input", *lines, f"Origin: http://{name}:{port}")
            assert ours[0] == 101


def test_a_hub_that_ends_tls_passes_our_page_on_and_no_other() -> None:
    with served(allowed_hosts=("*",)) as room:
        lines = ("Host: hub.example", *UPGRADE)
        for origin, status in (
            ("https://hub.example", 101),
            ("https://hub.example:443", 101),
            ("http://hub.example", 101),
            ("http://hub.example:443", 403),
            ("https://hub.example:8443", 403),
            ("https://other.hub.example", 403),
        ):
            answer = raw_answer(room.url + "ws/input", *lines, f"Origin: {origin}")
            assert answer[0] == status, origin


def test_a_refusal_repeats_no_endless_header(client: httpx.Client, room: Room) -> None:
    answer = client.get(room.url, headers={"Origin": "http://" + "x" * 6000})
    assert answer.status_code == 403
    assert len(answer.text) < 600
