"""Access control for viser's own port: only the proxy may connect.

viser accepts anybody who finds its port: pages from elsewhere, and programs of other users of this
machine, who were never asked for a token.
"""

from secrets import token_urlsafe
from typing import TYPE_CHECKING

from ai4u_edu.page.server.token_auth import is_same_secret

if TYPE_CHECKING:
    from viser import ViserServer
    from viser.infra import WebsockClientConnection

PROXY_SECRET_HEADER = "X-AI4U-Edu-Proxy"  # noqa: S105 - the header's name
PROXY_SECRET = token_urlsafe(24)
"""The proxy's authentication towards viser, unless a room has its own; no browser gets it."""


def lock_viser_port(viser_server: "ViserServer", secret: str = PROXY_SECRET) -> None:
    """Make a viser server close every connection that does not come from the proxy.

    Args:
        viser_server: the server.
        secret: of the proxy.
    """
    web = viser_server._websock_server

    async def refuse_others(client: "WebsockClientConnection") -> None:
        connection = web._live_connections[client.client_id]
        request = connection.request
        given = "" if request is None else request.headers.get(PROXY_SECRET_HEADER, "")
        if not is_same_secret(secret, given):
            await connection.close(1008, "this is the viewer's inner port; use the page's own")

    web.on_client_connect(refuse_others)  # viser sends nothing before these callbacks have returned
