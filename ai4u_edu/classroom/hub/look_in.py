"""The way from the teacher's page to a world on a student's server, through the hub."""

import asyncio
import re
from urllib.parse import unquote

from starlette.requests import Request
from starlette.responses import PlainTextResponse, RedirectResponse, Response

from ai4u_edu.classroom.hub.environment import HubEnvironment
from ai4u_edu.classroom.hub.hub_seats import HubSeats
from ai4u_edu.classroom.hub.sign_in import NO_STORE
from ai4u_edu.classroom.live_class import LiveClass

_PAGE = re.compile(r"user/([\w\-.@~%!+]+)(/[\w\-./@~%=?&]*)?", re.ASCII)
"""Path of a world's page, without what is before it at this hub."""


class LookIn:
    """Route that leads a teacher to the page of a room.

    The hub checks whether the teacher may use that server: an admin, or somebody to whom it is
    shared. So the class needs no permission for it.

    Args:
        live: the class.
        hub: environment of the service.
        seats: of the hub's users.
    """

    def __init__(self, live: LiveClass, hub: HubEnvironment, seats: HubSeats) -> None:
        self._live, self._hub, self._seats = live, hub, seats

    async def page(self, request: Request) -> Response:
        """Return the redirect."""
        room = self._live.rooms.get(request.path_params["room"])
        if room is None or room.link is None or room.state is None or not room.state.page:
            text = "This world has no page now. Reload the class's page.\n"
            return PlainTextResponse(text, 404, NO_STORE)
        # a student's program says where its page is; it may lead to that student's server only
        user = user_of_page(room.state.page)
        if not user or not await asyncio.to_thread(self._seats.is_of, room.seat, user):
            text = "This world gave an address that is not on its student's server.\n"
            return PlainTextResponse(text, 403, NO_STORE)
        return RedirectResponse(f"{self._hub.hub_url}{room.state.page}", 303, NO_STORE)


def user_of_page(page: str) -> str:
    """Return the name of the user on whose server a page is; empty if the path is no such page.

    >>> user_of_page("user/ada/proxy/4000/?token=abc"), user_of_page("user/ada/%2e%2e/grace/")
    ('ada', '')
    """
    found = _PAGE.fullmatch(page)
    path, _, _ = page.partition("?")
    # browsers go up at such a part, also if it is escaped
    if found is None or {".", ".."} & {*unquote(path).split("/")}:
        return ""
    return unquote(found[1])
