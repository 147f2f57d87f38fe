"""A cookie that a room sets reaches the browser that asked, and no other room or browser."""

from urllib.parse import urlsplit

from starlette.requests import Request
from starlette.responses import PlainTextResponse
from starlette.types import Receive, Scope, Send

from ai4u_edu.classroom.room_host import RoomAddress
from ai4u_edu.classroom.room_proxy import RoomProxy
from ai4u_edu.page.server import ServerThread
from tests.page.server import http_client
from tests.page.server.rooms import PATIENT


def test_a_rooms_cookie_is_not_sent_in_the_name_of_others() -> None:
    got: list[str] = []

    async def room(scope: Scope, receive: Receive, send: Send) -> None:
        got.append(Request(scope).headers.get("cookie", ""))
        # the proxy has no end in which it would close a connection that is kept
        answer = PlainTextResponse("here", headers={"Connection": "close"})
        answer.set_cookie("secret", "of-one")
        await answer(scope, receive, send)

    proxy = RoomProxy(["page"], lambda _: "")

    with ServerThread(room, timeouts=PATIENT) as inner:
        address = RoomAddress("127.0.0.1", urlsplit(inner.url).port or 0, "token")

        async def gateway(scope: Scope, receive: Receive, send: Send) -> None:
            await proxy.http(address, 1, scope, receive, send)

        with ServerThread(gateway, timeouts=PATIENT) as outer:
            first = http_client.get(outer.url)
            assert first.cookies["secret"] == "of-one"
            http_client.get(outer.url)
            http_client.get(outer.url, headers={"Cookie": "other=1; page=2"})
    assert got == ["", "", "page=2"]
