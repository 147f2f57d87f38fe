"""A room with a token: who knows it comes in, everybody else hears why not."""

import asyncio
import re
from collections.abc import Iterator
from hmac import compare_digest
from typing import Any

import httpx
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus

from ai4u_edu.base.errors import SetupError
from ai4u_edu.page.server import Rules, hosts_for, token_for
from ai4u_edu.page.server import token_auth as guard
from ai4u_edu.page.server.host_origin import ANY_ADDRESS, is_loopback
from tests.page.server import http_client
from tests.page.server.rooms import Page, Room, served

TOKEN = "open sesame; Zoë"
"""With what an address and a cookie can't have as it is."""
QUERY = "?token=open%20sesame%3B%20Zo%C3%AB"
PATHS = ("", "healthz", "api/snapshot", "api/openapi.json", "web/page/main.js")
WHY = (
    "expected this world's token, got {}; open the address with ?token=... that its terminal shows"
)
BROWSER = "text/html,application/xhtml+xml,application/xml;q=0.9,*/*;q=0.8"
WILDCARD_HOSTS = "0.0.0.0"  # noqa: S104 - nothing listens there


@pytest.fixture(scope="module")
def room() -> Iterator[Room]:
    with served(rules=Rules(token=TOKEN)) as room:
        yield room


@pytest.fixture
def browser(room: Room) -> Iterator[httpx.Client]:
    with http_client.Client(base_url=room.url, follow_redirects=True) as browser:
        yield browser


@pytest.mark.parametrize("path", PATHS)
@pytest.mark.parametrize(
    ("query", "headers", "got"),
    [
        ("", {}, "none"),
        ("?token=", {}, "another one"),
        ("?token=guess", {}, "another one"),
        ("?Token=open%20sesame%3B%20Zo%C3%AB", {}, "none"),
        ("", {"Authorization": "Bearer guess"}, "another one"),
        ("", {"Cookie": "ai4u-edu-00000000=guess"}, "none"),
    ],
)
def test_page_and_api_are_refused_with_a_sentence(
    room: Room, path: str, query: str, headers: dict[str, str], got: str
) -> None:
    answer = http_client.get(room.url + path + query, headers=headers)
    assert (answer.status_code, answer.text) == (401, f"token: {WHY.format(got)}\n")
    assert answer.headers["WWW-Authenticate"] == "Bearer"
    assert "Set-Cookie" not in answer.headers


@pytest.mark.parametrize(
    ("query", "problem"),
    [("", ""), ("?token=guess&agent=0", "That token is wrong."), ("?agent=0", "")],
)
def test_a_browser_gets_a_page_with_a_box_for_the_token(
    room: Room, query: str, problem: str
) -> None:
    answer = http_client.get(room.url + query, headers={"Accept": BROWSER})
    assert (answer.status_code, answer.headers["WWW-Authenticate"]) == (401, "Bearer")
    assert answer.headers["Content-Type"].startswith("text/html")
    assert answer.headers["Cache-Control"] == "no-store"
    assert "script-src 'self'; style-src 'self'" in answer.headers["Content-Security-Policy"]
    assert "This world is protected" in answer.text
    assert f'<p role="alert" id="problem">{problem}</p>' in answer.text
    assert "guess" not in answer.text
    files = re.findall(r'(?:href|src)="\./(web/[^"]*)"', answer.text)
    assert files
    for file in files:  # without the token
        assert http_client.get(room.url + file).status_code == 200
    for path in PATHS[1:]:  # nothing but a page is a page
        answer = http_client.get(room.url + path, headers={"Accept": BROWSER})
        assert answer.headers["Content-Type"].startswith("text/plain")


@pytest.mark.parametrize("path", ["", "ws/input"])
@pytest.mark.parametrize(("query", "got"), [("", "none"), ("?token=guess", "another one")])
def test_sockets_are_closed_with_a_sentence(room: Room, path: str, query: str, got: str) -> None:
    with Page(room.url + path + query) as page:
        assert page.end() == (1008, WHY.format(got))
        assert page.last == {}


def test_the_reason_fits_into_a_close() -> None:
    assert len(WHY.format("another one").encode()) <= 123


def test_a_browser_gets_a_cookie_and_an_address_without_the_token(
    room: Room, browser: httpx.Client
) -> None:
    first = browser.get(QUERY + "&agent=0", follow_redirects=False)
    assert (first.status_code, first.headers["Location"]) == (303, "./?agent=0")
    assert first.headers["Cache-Control"] == "no-store"
    assert first.headers["Referrer-Policy"] == "no-referrer"
    cookie = first.headers["Set-Cookie"]
    assert "HttpOnly" in cookie
    assert "SameSite=lax" in cookie
    assert "sesame" not in cookie
    second = browser.get(QUERY)
    assert second.status_code == 200
    assert str(second.url) == room.url
    assert "page/main.js" in second.text
    for path in PATHS:
        assert browser.get(path).status_code == 200
    said = "; ".join(f"{name}={value}" for name, value in browser.cookies.items())
    with Page(room.url + "ws/input", additional_headers={"Cookie": said}) as page:
        page.receive("hello")


def test_another_worlds_cookie_opens_nothing(browser: httpx.Client) -> None:
    browser.get(QUERY)
    with served(rules=Rules(token="another token")) as other:
        assert http_client.get(other.url, cookies=dict(browser.cookies)).status_code == 401
        (name,) = browser.cookies
        with http_client.Client(base_url=other.url) as second:
            second.get("?token=another%20token")
            assert name not in second.cookies  # so that both are kept, whatever their ports


@pytest.mark.parametrize(
    "given",
    [
        {"params": {"token": TOKEN}},
        {"headers": {"Authorization": f"Bearer {TOKEN}".encode("latin-1")}},
    ],
)
def test_a_program_says_the_token_with_each_request(room: Room, given: dict[str, Any]) -> None:
    answer = http_client.get(room.url + "api/snapshot", **given)
    assert answer.status_code == 200
    assert "Set-Cookie" not in answer.headers
    with Page(room.url + "ws/input" + QUERY) as page:
        page.receive("hello")


def test_secrets_are_compared_in_constant_time(room: Room, monkeypatch: pytest.MonkeyPatch) -> None:
    compared: list[bytes] = []

    def compare(one: bytes, other: bytes) -> bool:
        compared.append(other)
        return compare_digest(one, other)

    monkeypatch.setattr(guard, "compare_digest", compare)
    assert http_client.get(room.url + "healthz?token=guess").status_code == 401
    assert b"guess" in compared


def test_a_foreign_page_is_refused_before_it_is_asked_for_a_token(room: Room) -> None:
    answer = http_client.get(room.url + QUERY, headers={"Host": "evil.example"})
    assert (answer.status_code, answer.text[:5]) == (403, "Host:")
    with pytest.raises(InvalidStatus, match="403"):
        Page(room.url + "ws/input" + QUERY, additional_headers={"Origin": "http://evil.example"})


def test_without_a_token_nothing_is_asked() -> None:
    with served() as room:
        assert http_client.get(room.url, follow_redirects=False).status_code == 200
        answer = http_client.get(room.url + "?token=whatever", follow_redirects=False)
        assert answer.status_code == 200
        with room.page() as page:
            page.receive("hello")


def test_token_is_needed_beyond_loopback_only() -> None:
    assert token_for("localhost") == token_for("127.0.0.1") == token_for("::1") == ""
    fresh = {token_for(WILDCARD_HOSTS), token_for(WILDCARD_HOSTS), token_for("192.0.2.7")}
    assert len(fresh) == 3
    assert all(len(each) >= 32 for each in fresh)
    assert token_for("127.0.0.1", "chosen by me") == token_for(WILDCARD_HOSTS, "chosen by me")
    with pytest.raises(SetupError, match="--token: expected at least 8 characters, got 5"):
        token_for("127.0.0.1", "short")


def test_loopback_addresses_and_their_hosts() -> None:
    assert is_loopback("127.0.0.2")
    assert not is_loopback("")
    assert not is_loopback("no such name.invalid")
    assert hosts_for("127.0.0.2") == (*hosts_for("127.0.0.1"), "127.0.0.2")
    assert ANY_ADDRESS not in hosts_for("127.0.0.2")


def test_oversized_frame_closes_the_socket(room: Room) -> None:
    with Page(room.url + "ws/input" + QUERY, compression=None) as page:
        page.socket.send("x" * (2**20 + 1))
        with pytest.raises(ConnectionClosed, match="1009"):
            page.receive("error")


def test_malformed_tokens_in_an_address_get_401(room: Room) -> None:
    async def ask() -> list[int]:
        async with http_client.AsyncClient(base_url=room.url) as client:
            odd = ["?token=%ff%fe", "?token=%00", "?%", "?token=a&token=b", "?token=" + "x" * 5000]
            answers = await asyncio.gather(*[client.get(each) for each in odd])
            return [answer.status_code for answer in answers]

    assert set(asyncio.run(ask())) == {401}
