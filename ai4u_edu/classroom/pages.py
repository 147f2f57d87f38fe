"""The pages of a class that are not a room's, with a policy for all of them."""

from collections.abc import Awaitable, Callable
from functools import lru_cache

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from ai4u_edu.page.server.library_pictures import PICTURE_PATH, library_picture_route
from ai4u_edu.page.server.standalone import standalone_page
from ai4u_edu.page.server.web_files import WEB_PATHS, WebFiles


async def web_file(request: Request) -> Response:
    """Return a script or a style."""
    return _web_files().response(request, request.path_params["file"])


FILE_ROUTES = [
    *[Route(path + "/{file:path}", web_file) for path in WEB_PATHS],
    Route(PICTURE_PATH, library_picture_route),
]
"""Routes of the files that these pages load; everybody may have them."""


def page_route(name: str) -> Callable[[Request], Awaitable[Response]]:
    """Return a route's function that answers with a page of ``web/pages/``."""

    async def answer(_: Request) -> Response:
        return standalone_page(name)

    return answer


@lru_cache(maxsize=1)
def _web_files() -> WebFiles:
    return WebFiles()
