"""viser's own port: only the proxy may use it."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from viser import ViserServer
    from viser.infra import WebsockClientConnection


def shut_side_door(viser_server: "ViserServer") -> None:
    """Has a viser refuse browsers that come around the proxy, and forget how to open tunnels.

    viser accepts any page that finds its port. Every browser names the page it comes from and our
    proxy does not; so whoever names one came around.
    """
    from viser import _messages

    web = viser_server._websock_server
    for kind in (_messages.ShareUrlRequest, _messages.ShareUrlDisconnect):
        if kind in web._incoming_handlers:
            web.unregister_handler(kind)

    async def refuse_browsers(client: "WebsockClientConnection") -> None:
        connection = web._live_connections[client.client_id]
        request = connection.request
        if request is None or "Origin" in request.headers:
            await connection.close(1008, "this is the viewer's inner port; use the page's own")

    web._client_connect_cb.insert(0, refuse_browsers)  # before viser sends anything
