"""The files of ``web/``: our scripts and styles, and libraries of others in ``web/vendor/``.

Beside them the package that runs a student's program; see ``web/vendor/README.md``.
"""

import asyncio
import gzip
import hashlib
import io
import posixpath
import re
import time
import zipfile
from collections.abc import Callable, Iterable
from functools import lru_cache
from pathlib import Path

from starlette.requests import Request
from starlette.responses import FileResponse, PlainTextResponse, Response

from ai4u_edu.base.errors import SetupError
from ai4u_edu.locale import gettext as _

_PROGRAM = Path(__file__).resolve().parents[2] / "program"
_PACKED = ".gz"
_SCRIPTS = {".js", ".mjs"}
_VENDOR_TYPES = {
    ".js": "text/javascript",
    ".mjs": "text/javascript",
    ".wasm": "application/wasm",
    ".zip": "application/zip",
}
# a system's own media types are not reliable: some call a .js plain text
_MEDIA_TYPES = {
    ".css": "text/css",
    ".js": "text/javascript",
    ".svg": "image/svg+xml",
    ".woff2": "font/woff2",
}
WEB_PATHS = ("/web", "/web-{version}")
"""Paths of the folder in routes."""
_ADDRESS = '"./web/'
"""Beginning of a file's address in the text of a page."""
FOLDERS = (
    "blocks",
    "classroom",
    "code",
    "fonts",
    "missions",
    "page",
    "pages",
    "panel",
    "remote",
    "scenes",
    "shared",
    "styles",
    "teach",
)
"""Folders with the files. What else lies in ``web/`` is for development, or a library's."""
_STATIC_IMPORT = re.compile(r'^(?:import|\} from) (?:.*from )?"(\.[\w./]+\.js)";', re.MULTILINE)
ALWAYS_ASK = {"Cache-Control": "no-cache"}
"""Headers of what a browser may keep, but asks for each time."""
NEVER_ASK = {"Cache-Control": "private, max-age=31536000, immutable"}
"""Headers of a file whose address changes with its content."""
_POLICIES = {
    "code/worker.js": (
        "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'none'"
    )
}
"""Content security policies of workers. The one that runs a student's program connects to nobody:
the page hands it what it needs."""


class WebFiles:
    """The files of ``FOLDERS``, by their path in ``web/``; new ones are seen after a second.

    A page asks for some forty of them at once, so they are kept in memory until they change: for
    each, a response from the disk would change threads three times.

    Args:
        clock: returns the time (s) by which they are looked up.

    Raises:
        SetupError: the files are missing.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._folder, self._clock = web_folder(), clock

    def response(self, request: Request, *names: str) -> Response:
        """Return a file, or several of one kind as one; 304 if the browser has it, or 404.

        Names are compared, so no path leads out of the folders. The browser keeps what it asks for
        with the present version.
        """
        files = _files(self._folder, int(self._clock()))
        for name in names:
            if name not in files:
                return PlainTextResponse(f"no file is called {name[:80]!r}\n", 404)
        content, etag = _read(files[name] for name in names)
        is_packed = takes_gzip(request)
        etag = f'"{etag}-gzip"' if is_packed else f'"{etag}"'
        is_present = request.path_params.get("version") == self.version
        headers = {**(NEVER_ASK if is_present else ALWAYS_ASK), "ETag": etag}
        headers["Vary"] = "Accept-Encoding"
        if names[0] in _POLICIES:
            headers["Content-Security-Policy"] = _POLICIES[names[0]]
        if request.headers.get("if-none-match") == etag:
            return Response(status_code=304, headers=headers)
        if is_packed:
            content, headers["Content-Encoding"] = _pack(content), "gzip"
        return Response(content, headers=headers, media_type=_MEDIA_TYPES[files[names[0]].suffix])

    @property
    def version(self) -> str:
        """Version of all files together, looked up once a second."""
        return _version(self._folder, int(self._clock()))

    def versioned(self, page: str) -> str:
        """Return a page that asks for the files at addresses with their version.

        A file's imports are relative to its own address, and so have the version, too.
        """
        return page.replace(_ADDRESS, f'"./web-{self.version}/')

    def modules(self, *entries: str) -> list[str]:
        """Return modules and all that they import, in the order in which browsers find them.

        What ``import()`` loads later is not among them.
        """
        found = list(entries)
        for name in found:
            text = (self._folder / name).read_text(encoding="utf-8")
            folder = posixpath.dirname(name)
            imported = (posixpath.join(folder, path) for path in _STATIC_IMPORT.findall(text))
            found += [path for path in map(posixpath.normpath, imported) if path not in found]
        return found


def web_folder() -> Path:
    """Return the folder of our scripts and styles: in the package, or in a checkout."""
    package = Path(__file__).resolve().parents[2]
    for folder in (package / "web", package.parent / "web"):
        if (folder / "page" / "main.js").is_file():
            return folder
    raise SetupError(
        _(
            "expected the page's files in {folder}, found none; install ai4u-edu again",
            folder=str(package / "web"),
        )
    )


@lru_cache(maxsize=4)
def _files(folder: Path, _second: int) -> dict[str, Path]:
    paths = (path for name in FOLDERS for path in (folder / name).rglob("*"))
    return {
        path.relative_to(folder).as_posix(): path
        for path in paths
        if path.suffix in _MEDIA_TYPES and path.is_file()
    }


@lru_cache(maxsize=1)
def _version(folder: Path, second: int) -> str:
    files = _files(folder, second)
    tags = sorted((name, _read([path])[1]) for name, path in files.items())
    return hashlib.sha256(repr(tags).encode()).hexdigest()[:16]


def _read(paths: Iterable[Path]) -> tuple[bytes, str]:
    """Return the content of files as one, and its tag."""
    return _read_once(tuple((path, path.stat().st_mtime_ns) for path in paths))


@lru_cache(maxsize=256)
def _read_once(files: tuple[tuple[Path, int], ...]) -> tuple[bytes, str]:
    """Do so for files of a time of change (ns)."""
    content = b"\n".join(path.read_bytes() for path, _ in files)
    return content, hashlib.sha256(content).hexdigest()[:32]


@lru_cache(maxsize=256)
def _pack(content: bytes) -> bytes:
    return gzip.compress(content, mtime=0)


def takes_gzip(request: Request) -> bool:
    """Return True if a browser reads what is packed with gzip."""
    offers = request.headers.get("accept-encoding", "").lower().split(",")
    return any(each.partition(";")[0].strip() == "gzip" for each in offers)


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
            name: path for name, path in paths.items() if Path(name).suffix in _VENDOR_TYPES
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
        etag = await asyncio.to_thread(
            _file_tag, path, path.stat().st_mtime_ns, is_packed=is_packed
        )
        headers = {
            **(NEVER_ASK if "v" in request.query_params else ALWAYS_ASK),
            "ETag": etag,
            "Vary": "Accept-Encoding",
        }
        if request.headers.get("if-none-match") == etag:
            return Response(status_code=304, headers=headers)
        if is_packed:
            headers["Content-Encoding"] = "gzip"
        kind = _VENDOR_TYPES[suffix]
        if is_packed == (path.suffix == _PACKED):
            return FileResponse(path, headers=headers, media_type=kind)
        turn = _packed_file if is_packed else _unpacked_file
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
def _file_tag(path: Path, _modified_ns: int, *, is_packed: bool) -> str:
    digest = hashlib.sha256(path.read_bytes()).hexdigest()[:32]
    return f'"{digest}-gzip"' if is_packed else f'"{digest}"'


@lru_cache(maxsize=16)
def _packed_file(path: Path, _modified_ns: int) -> bytes:
    return gzip.compress(path.read_bytes(), mtime=0)


def _unpacked_file(path: Path, _modified_ns: int) -> bytes:
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
