"""Libraries of others that pages load, and the package for a student's program."""

import gzip
import hashlib
import io
import re
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from ai4u_edu.page.server import Rules
from ai4u_edu.page.server.web_files import FOLDERS, web_folder
from ai4u_edu.wire import native
from tests.page.server import http_client
from tests.page.server.rooms import Room, open_socket, raw_answer, served
from tests.remote.rooms import patient_rules
from tests.waiting import LIMIT_S

VENDOR = web_folder() / "vendor"
TOKEN = "open sesame"
KINDS = {
    "msgpack.js": "text/javascript",
    "pyodide/pyodide.mjs": "text/javascript",
    "pyodide/pyodide.asm.mjs": "text/javascript",
    "pyodide/pyodide.asm.wasm": "application/wasm",
    "pyodide/python_stdlib.zip": "application/zip",
}
PACKED = sorted(set(KINDS) - {"pyodide/python_stdlib.zip"})
VERSIONED = re.compile(r"vendor/([\w./-]+)\?v=(\w*)")


@pytest.fixture(scope="module")
def room() -> Iterator[Room]:
    with served() as room:
        yield room


def content_of(name: str) -> bytes:
    path = VENDOR / name
    return path.read_bytes() if path.exists() else gzip.decompress(Path(f"{path}.gz").read_bytes())


@pytest.mark.parametrize("name", KINDS)
@pytest.mark.parametrize("encoding", ["gzip, br", "br;q=0.5", ""])
def test_a_file_is_the_same_packed_or_not(room: Room, name: str, encoding: str) -> None:
    answer = http_client.get(f"{room.url}web/vendor/{name}", headers={"Accept-Encoding": encoding})
    assert answer.content == content_of(name)
    assert answer.headers["Content-Type"].partition(";")[0] == KINDS[name]
    is_packed = "gzip" in encoding and name in PACKED
    assert (answer.headers.get("Content-Encoding") == "gzip") == is_packed


def test_a_browser_keeps_for_good_what_has_a_version(room: Room) -> None:
    url = f"{room.url}web/vendor/msgpack.js"
    first = http_client.get(url)
    assert first.headers["Cache-Control"] == "no-cache"
    again = http_client.get(url, headers={"If-None-Match": first.headers["ETag"]})
    assert (again.status_code, again.content) == (304, b"")
    assert "immutable" in http_client.get(f"{url}?v=1").headers["Cache-Control"]


def test_versions_in_addresses_are_those_of_the_files() -> None:
    found = {
        (name, version)
        for folder in FOLDERS
        for path in (web_folder() / folder).rglob("*.js")
        for name, version in VERSIONED.findall(path.read_text(encoding="utf-8"))
    }
    assert {name for name, _ in found} >= set(KINDS)
    assert found == {(name, hashlib.sha256(content_of(name)).hexdigest()[:8]) for name, _ in found}


@pytest.mark.parametrize(
    "name",
    [
        "",
        "README.md",
        "pyodide",
        "pyodide/",
        "pyodide/LICENSE",
        "pyodide/pyodide.asm.wasm.gz",
        "pyodide//pyodide.mjs",
        "pyodide/../msgpack.js",
        "../page/main.js",
        "%2e%2e/page/main.js",
        "..%2fpage%2fmain.js",
        "..%2f..%2fpyproject.toml",
        "MSGPACK.js",
        "msgpack.js%00",
        "/etc/passwd",
    ],
)
def test_unknown_vendor_files_are_refused(room: Room, name: str) -> None:
    assert raw_answer(f"{room.url}web/vendor/{name}", "Host: localhost")[0] in (400, 404)


def test_the_worker_may_connect_to_nobody(room: Room) -> None:
    policy = http_client.get(f"{room.url}web/code/worker.js").headers["Content-Security-Policy"]
    assert policy.split("; ") == [
        "default-src 'none'",
        "script-src 'self' 'wasm-unsafe-eval'",
        "worker-src 'none'",
    ]
    known = http_client.get(f"{room.url}web/code/worker.js").headers["ETag"]
    again = http_client.get(f"{room.url}web/code/worker.js", headers={"If-None-Match": known})
    assert (again.status_code, again.headers["Content-Security-Policy"]) == (304, policy)


def test_the_program_package_has_a_package_of_its_own_around_it(room: Room) -> None:
    answer = http_client.get(f"{room.url}program.zip")
    assert answer.headers["Content-Type"] == "application/zip"
    with zipfile.ZipFile(io.BytesIO(answer.content)) as archive:
        assert archive.testzip() is None
        names = archive.namelist()
        assert b"msgspec" not in archive.read("ai4u_edu/__init__.py")
    assert all(re.fullmatch(r"ai4u_edu/(program/)?\w+\.py", name) for name in names)
    again = http_client.get(
        f"{room.url}program.zip", headers={"If-None-Match": answer.headers["ETag"]}
    )
    assert (again.status_code, again.content) == (304, b"")


def test_a_room_with_a_token_asks_for_it_first() -> None:
    with served(rules=Rules(token=TOKEN)) as room, http_client.Client(base_url=room.url) as browser:
        paths = ["web/vendor/msgpack.js", "web/vendor/pyodide/pyodide.mjs", "program.zip"]
        assert [browser.get(path).status_code for path in paths] == [401] * 3
        browser.get(f"?token={TOKEN}")
        assert [browser.get(path).status_code for path in paths] == [200] * 3


def test_the_page_that_has_the_token_may_drive_an_agent() -> None:
    hello = native.encode(native.Hello(native.VERSION, "", "", "realtime", (), "", "s" * 16))
    with served(rules=patient_rules(token=TOKEN)) as room:
        with http_client.Client(base_url=room.url) as browser:
            browser.get(f"?token={TOKEN}")
            cookie = "; ".join(f"{name}={value}" for name, value in browser.cookies.items())
        for headers, expected in (({}, native.Problem), ({"Cookie": cookie}, native.Welcome)):
            with open_socket(
                f"{room.url}ws/remote",
                subprotocols=[native.SUBPROTOCOL],
                additional_headers=headers,
            ) as socket:
                socket.send(hello)
                heard = native.decode(
                    socket.recv(LIMIT_S, decode=False), native.MAX_WORLD_FRAME_BYTES
                )
                assert isinstance(heard, expected)
