"""viser's own port: only the proxy may use it."""

from secrets import token_urlsafe
from typing import TYPE_CHECKING

from ai4u_edu.server.token_auth import same

if TYPE_CHECKING:
    from viser import ViserServer
    from viser.infra import WebsockClientConnection

KNOCK_HEADER = "X-AI4U-Edu-Knock"
KNOCK = token_urlsafe(24)
"""What the proxy says in this header; known in this process alone."""


def shut_side_door(viser_server: "ViserServer") -> None:
    """Has a viser refuse whoever comes around the proxy, and forget how to open tunnels.

    viser accepts anybody who finds its port: pages from elsewhere, and programs of others who work
    on this machine and were never asked for a token.
    """
    from viser import _messages

    web = viser_server._websock_server
    for kind in (_messages.ShareUrlRequest, _messages.ShareUrlDisconnect):
        if kind in web._incoming_handlers:
            web.unregister_handler(kind)

    async def refuse_others(client: "WebsockClientConnection") -> None:
        connection = web._live_connections[client.client_id]
        request = connection.request
        knock = "" if request is None else request.headers.get(KNOCK_HEADER, "")
        if not same(KNOCK, knock):
            await connection.close(1008, "this is the viewer's inner port; use the page's own")

    web._client_connect_cb.insert(0, refuse_others)  # before viser sends anything
