"""Libraries of ``web/vendor/`` that pages load, and the package that runs a student's program.

See the README in that folder.
"""

import asyncio
import gzip
import hashlib
import io
import zipfile
from functools import lru_cache
from pathlib import Path

from starlette.requests import Request
from starlette.responses import FileResponse, PlainTextResponse, Response

from ai4u_edu.page.server.web_files import ALWAYS_ASK, NEVER_ASK, takes_gzip, web_folder

_PROGRAM = Path(__file__).resolve().parents[2] / "program"
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
        is_packed = takes_gzip(request) and (suffix in _SCRIPTS or path.suffix == _PACKED)
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


async def program_zip(request: Request) -> Response:
    """Return ``ai4u_edu/program`` as a ZIP file, from which Python can import it.

    Its ``ai4u_edu/__init__.py`` is empty, since ours would import the whole library.
    """
    content, etag = _program()
    headers = {**ALWAYS_ASK, "ETag": etag}
    if request.headers.get("if-none-match") == etag:
        return Response(status_code=304, headers=headers)
    return Response(content, headers=headers, media_type="application/zip")


@lru_cache(maxsize=64)
def _etag(path: Path, _modified_ns: int, *, is_packed: bool) -> str:
    digest = hashlib.sha256(path.read_bytes()).hexdigest()[:32]
    return f'"{digest}-gzip"' if is_packed else f'"{digest}"'


@lru_cache(maxsize=16)
def _pack(path: Path, _modified_ns: int) -> bytes:
    return gzip.compress(path.read_bytes(), mtime=0)


def _unpack(path: Path, _modified_ns: int) -> bytes:
    return gzip.decompress(path.read_bytes())


@lru_cache(maxsize=1)
def _program() -> tuple[bytes, str]:
    date = (2026, 1, 1, 0, 0, 0)  # one for all files, so that the same files make the same bytes
    files = {"ai4u_edu/__init__.py": b""}
    for path in sorted(_PROGRAM.glob("*.py")):
        files[f"ai4u_edu/{_PROGRAM.name}/{path.name}"] = path.read_bytes()
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for name, content in files.items():
            archive.writestr(zipfile.ZipInfo(name, date), content, zipfile.ZIP_DEFLATED)
    return packed.getvalue(), f'"{hashlib.sha256(packed.getvalue()).hexdigest()[:32]}"'
