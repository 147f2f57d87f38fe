"""Pictures of the library's scenes over HTTP, for rooms and for the teacher's page of a class."""

import asyncio
import hashlib
from functools import cache

from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response

from ai4u_edu.page.editing.scene_pictures import PICTURE_SUFFIX, library_picture, picture_file
from ai4u_edu.page.server.web_files import ALWAYS_ASK, NEVER_ASK
from ai4u_edu.scenes import Scene

PICTURE_PATH = "/api/scenes/{file}"
"""Path of the route."""


@cache
def picture_address(name: str) -> str:
    """Return the address of a scene's picture, relative to a page.

    It changes with the picture, so that browsers keep one for good.

    Args:
        name: of a scene of the library.
    """
    file = picture_file(name)
    version = "" if file is None else f"?v={_hash(file.read_bytes())}"
    return f"api/scenes/{name}{PICTURE_SUFFIX}{version}"


async def library_picture_route(request: Request) -> Response:
    """Return the picture of a scene of the library, 304 if the browser has it already, or 404."""
    file = str(request.path_params["file"])
    name = file.removesuffix(PICTURE_SUFFIX)
    if not file.endswith(PICTURE_SUFFIX) or name not in Scene.names():
        return PlainTextResponse(f"no scene is called {name[:80]!r}; see api/scenes\n", 404)
    data = await asyncio.to_thread(library_picture, name)
    etag = f'"{_hash(data)}"'
    headers = {**(NEVER_ASK if "v" in request.query_params else ALWAYS_ASK), "ETag": etag}
    if request.headers.get("if-none-match") == etag:
        return Response(status_code=304, headers=headers)
    return Response(data, media_type="image/png", headers=headers)


def _hash(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()[:16]
