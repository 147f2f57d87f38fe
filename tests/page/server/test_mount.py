"""A room under a path: nothing in it knows where it is."""

from collections.abc import Callable

import pytest
from starlette.applications import Starlette
from starlette.routing import Mount
from starlette.types import ASGIApp

from ai4u_edu.page.server import RoomMount, room_app
from tests.page.server import http_client
from tests.page.server.rooms import NOWHERE, Page, raw_answer, served


def under(prefix: str) -> Callable[[ASGIApp], ASGIApp]:
    def wrap(app: ASGIApp) -> ASGIApp:
        return Starlette(routes=[RoomMount(prefix, app)])

    return wrap


@pytest.mark.parametrize("prefix", ["/lab", "/user/ann/proxy"])
def test_everything_works_under_a_prefix(prefix: str) -> None:
    with served(wrap=under(prefix)) as room:
        base = room.url.rstrip("/") + prefix
        for path in ("/", "/web/page/main.js", "/healthz", "/api/snapshot", "/api/openapi.json"):
            assert http_client.get(base + path).status_code == 200
        assert http_client.get(base, follow_redirects=True).url.path == prefix + "/"
        with Page(base + "/ws/input?agent=0") as page:
            assert page.receive("hello")["agent"] == "0"
        assert http_client.get(room.url).status_code == 404
        assert raw_answer(room.url + "healthz", "Host: localhost")[0] == 404


def test_two_rooms_under_one_port_know_nothing_of_each_other() -> None:
    with served(title="one") as one:

        def both(app: ASGIApp) -> ASGIApp:
            first = room_app(one.runner, viser_port=NOWHERE, title="one")
            return Starlette(routes=[RoomMount("/one", first), Mount("/", app)])

        with served(title="two", wrap=both) as two:
            for path, title in (("one/healthz", "one"), ("healthz", "two")):
                assert http_client.get(two.url + path).json()["scene"] == title
            with Page(two.url + "one/ws/input") as page, two.page() as other:
                assert page.receive("hello")["you"] == other.receive("hello")["you"] == 1
                page.hold("KeyW")
                other.receive("state", held=[])
                page.receive("state", held=["KeyW"])
                assert two.held == []
