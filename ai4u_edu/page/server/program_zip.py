"""The package that runs a student's program, for the Python in the student's browser."""

import hashlib
import io
import zipfile
from functools import lru_cache
from pathlib import Path

from starlette.requests import Request
from starlette.responses import Response

from ai4u_edu.page.server.web_files import ALWAYS_ASK

_FOLDER = Path(__file__).resolve().parents[2] / "program"
_DATE = (2026, 1, 1, 0, 0, 0)  # one for all files, so that the same files make the same bytes


async def program_zip(request: Request) -> Response:
    """Return ``ai4u_edu/program`` as a ZIP file, from which Python can import it.

    Its ``ai4u_edu/__init__.py`` is empty, since ours would import the whole library.
    """
    content, etag = _zip()
    headers = {**ALWAYS_ASK, "ETag": etag}
    if request.headers.get("if-none-match") == etag:
        return Response(status_code=304, headers=headers)
    return Response(content, headers=headers, media_type="application/zip")


@lru_cache(maxsize=1)
def _zip() -> tuple[bytes, str]:
    files = {"ai4u_edu/__init__.py": b""}
    for path in sorted(_FOLDER.glob("*.py")):
        files[f"ai4u_edu/{_FOLDER.name}/{path.name}"] = path.read_bytes()
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for name, content in files.items():
            archive.writestr(zipfile.ZipInfo(name, _DATE), content, zipfile.ZIP_DEFLATED)
    return packed.getvalue(), f'"{hashlib.sha256(packed.getvalue()).hexdigest()[:32]}"'
