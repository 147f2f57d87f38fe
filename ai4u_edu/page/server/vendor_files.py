"""Libraries of others, which pages load from ``web/vendor/``; see the README there."""

import asyncio
import gzip
import hashlib
from functools import lru_cache
from pathlib import Path

from starlette.requests import Request
from starlette.responses import FileResponse, PlainTextResponse, Response

from ai4u_edu.page.server.web_files import ALWAYS_ASK, NEVER_ASK, web_folder

_PACKED = ".gz"
_SCRIPTS = {".js", ".mjs"}
_MEDIA_TYPES = {
    ".js": "text/javascript",
    ".mjs": "text/javascript",
    ".wasm": "application/wasm",
    ".zip": "application/zip",
}


class VendorFiles:
    """The files of ``web/vendor/`` and its subfolders.

    They are large, and a class loads them thirty times: so they are sent packed. A file that is
    kept packed on the disk is sent from there; scripts are packed once and kept in memory.
    """

    def __init__(self) -> None:
        folder = web_folder() / "vendor"
        paths = {
            path.relative_to(folder).as_posix().removesuffix(_PACKED): path
            for path in folder.rglob("*")
        }
        self._paths = {
            name: path for name, path in paths.items() if Path(name).suffix in _MEDIA_TYPES
        }

    async def file(self, request: Request) -> Response:
        """Return a file, 304 if the browser has it already, or 404.

        Names are compared, so no path leads out of the folder.
        """
        name = request.path_params["file"]
        path = self._paths.get(name)
        if path is None:
            return PlainTextResponse(f"no file is called {name[:80]!r}\n", 404)
        suffix = Path(name).suffix
        is_packed = _takes_gzip(request) and (suffix in _SCRIPTS or path.suffix == _PACKED)
        etag = await asyncio.to_thread(_etag, path, path.stat().st_mtime_ns, is_packed=is_packed)
        headers = {
            **(NEVER_ASK if "v" in request.query_params else ALWAYS_ASK),
            "ETag": etag,
            "Vary": "Accept-Encoding",
        }
        if request.headers.get("if-none-match") == etag:
            return Response(status_code=304, headers=headers)
        if is_packed:
            headers["Content-Encoding"] = "gzip"
        kind = _MEDIA_TYPES[suffix]
        if is_packed == (path.suffix == _PACKED):
            return FileResponse(path, headers=headers, media_type=kind)
        turn = _pack if is_packed else _unpack
        content = await asyncio.to_thread(turn, path, path.stat().st_mtime_ns)
        return Response(content, headers=headers, media_type=kind)


def _takes_gzip(request: Request) -> bool:
    offers = request.headers.get("accept-encoding", "").lower().split(",")
    return any(each.partition(";")[0].strip() == "gzip" for each in offers)


@lru_cache(maxsize=64)
def _etag(path: Path, _modified_ns: int, *, is_packed: bool) -> str:
    digest = hashlib.sha256(path.read_bytes()).hexdigest()[:32]
    return f'"{digest}-gzip"' if is_packed else f'"{digest}"'


@lru_cache(maxsize=16)
def _pack(path: Path, _modified_ns: int) -> bytes:
    return gzip.compress(path.read_bytes(), mtime=0)


def _unpack(path: Path, _modified_ns: int) -> bytes:
    return gzip.decompress(path.read_bytes())
