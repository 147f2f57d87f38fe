"""viser's page with ours inside, and our files."""

import json
import os
import re
from collections.abc import Iterator
from itertools import count
from pathlib import Path

import pytest
from starlette.responses import PlainTextResponse
from websockets.sync.connection import Connection

from ai4u_edu.page.server.page import STYLES
from ai4u_edu.page.server.web_files import FOLDERS, WebFiles, web_folder
from tests.page.server import http_client
from tests.page.server.rooms import Room, open_socket, raw_answer, served
from tests.waiting import LIMIT_S, until

SVG_NAMESPACE = "http://www.w3.org/2000/svg"
"""A name, which no browser asks for."""
FILES = [
    path.relative_to(web_folder()).as_posix()
    for folder in FOLDERS
    for path in sorted((web_folder() / folder).rglob("*"))
    if path.is_file() and path.suffix in {".css", ".html", ".js", ".woff2"}
]


@pytest.fixture(scope="module")
def room() -> Iterator[Room]:
    with served(title='<script>alert("x")</script>') as room:
        yield room


def test_the_page_is_visers_with_our_script_and_style(room: Room) -> None:
    text = http_client.get(room.url).text
    folder = f"./web-{WebFiles().version}"
    assert re.findall('rel="stylesheet" href="(.+?)"', text) == [f"{folder}/styles/all.css"]
    assert f'<script type="module" src="{folder}/page/main.js"></script>' in text
    assert '<div id="root"></div>' in text
    assert "<iframe" not in text


def test_a_title_is_text(room: Room) -> None:
    text = http_client.get(room.url).text
    assert "<title>&lt;script&gt;alert(&quot;x&quot;)&lt;/script&gt;</title>" in text
    assert 'alert("x")' not in text


def test_the_title_follows_the_scene() -> None:
    called = ["one"]
    with served(title=lambda: called[0]) as room:
        first = http_client.get(room.url)
        assert "<title>one</title>" in first.text
        with open_socket(f"{room.url}ws/input") as socket:
            called[0] = "two & more"
            until(lambda: title_in(socket) == "two & more")
        again = http_client.get(room.url, headers={"If-None-Match": first.headers["ETag"]})
        assert "<title>two &amp; more</title>" in again.text
        assert http_client.get(f"{room.url}healthz").json()["scene"] == "two & more"


def title_in(socket: Connection) -> str:
    """Return the scene's title in the next message; "" if it has none."""
    return str(json.loads(socket.recv(timeout=LIMIT_S)).get("title", ""))


def test_the_page_may_talk_to_nobody_but_us(room: Room) -> None:
    policy = http_client.get(room.url).headers["Content-Security-Policy"]
    host = room.url.removeprefix("http://").rstrip("/")
    assert f"connect-src 'self' data: blob: ws://{host} wss://{host};" in policy
    assert "https:" not in policy


def test_a_page_that_is_known_is_not_sent_again(room: Room) -> None:
    tag = http_client.get(room.url).headers["ETag"]
    again = http_client.get(room.url, headers={"If-None-Match": tag})
    assert again.status_code == 304
    assert again.content == b""


@pytest.mark.parametrize("name", [name for name in FILES if not name.endswith(".html")])
def test_each_file_is_served_as_what_it_is(room: Room, name: str) -> None:
    answer = http_client.get(f"{room.url}web/{name}")
    kinds = {"js": "text/javascript", "css": "text/css", "woff2": "font/woff2"}
    assert answer.status_code == 200
    assert answer.headers["Content-Type"].startswith(kinds[name.rpartition(".")[2]])
    assert answer.content == (web_folder() / name).read_bytes()


def test_all_styles_of_the_page_are_one_file(room: Room) -> None:
    first = http_client.get(f"{room.url}web/styles/all.css")
    assert first.headers["Content-Type"].startswith("text/css")
    assert first.text == "\n".join((web_folder() / each).read_text() for each in STYLES)
    known = {"If-None-Match": first.headers["ETag"]}
    assert http_client.get(first.url, headers=known).status_code == 304


def test_a_file_that_is_known_is_not_sent_again(room: Room) -> None:
    first = http_client.get(f"{room.url}web/page/main.js")
    again = http_client.get(
        f"{room.url}web/page/main.js", headers={"If-None-Match": first.headers["ETag"]}
    )
    assert (again.status_code, again.content) == (304, b"")


@pytest.mark.parametrize("name", ["page/main.js", "styles/all.css"])
def test_a_file_is_sent_packed_to_whoever_reads_that(room: Room, name: str) -> None:
    packed, plain = (
        http_client.get(f"{room.url}web/{name}", headers={"Accept-Encoding": offered})
        for offered in ("gzip, br", "identity")
    )
    assert packed.headers["Content-Encoding"] == "gzip"
    assert "Content-Encoding" not in plain.headers
    assert packed.content == plain.content
    assert int(packed.headers["Content-Length"]) < len(plain.content) / 2
    assert packed.headers["ETag"] != plain.headers["ETag"]


@pytest.mark.parametrize("name", ["page/main.js", "styles/all.css"])
def test_a_browser_keeps_what_has_the_present_version(room: Room, name: str) -> None:
    kept = http_client.get(f"{room.url}web-{WebFiles().version}/{name}")
    assert "immutable" in kept.headers["Cache-Control"]
    for path in ("web", "web-another"):
        other = http_client.get(f"{room.url}{path}/{name}")
        assert other.content == kept.content
        assert other.headers["Cache-Control"] == "no-cache"


def test_another_file_and_another_content_are_another_version(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ai4u_edu.page.server.web_files.web_folder", lambda: tmp_path)
    files = WebFiles(clock=count().__next__)
    versions = [files.version, files.version]
    for name, text in (("a.js", "1"), ("a.js", "22"), ("b/c.js", "22")):
        path = tmp_path / "page" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        os.utime(path, ns=(len(versions), len(versions)))  # clocks of files are slow
        versions.append(files.version)
    assert versions[0] == versions[1]
    assert len(set(versions)) == 4


def test_each_module_that_a_module_imports_is_preloaded() -> None:
    with served(panel=PlainTextResponse("not asked here")) as room:
        text = http_client.get(room.url).text
    preloaded = re.findall(r'rel="modulepreload" href="./web-\w+/(.+?)"', text)
    assert {"page/main.js", "panel/panel.js"} <= set(preloaded)
    for name in preloaded:
        text = re.sub(r"/\*.*?\*/", "", (web_folder() / name).read_text(), flags=re.DOTALL)
        imported = re.findall(r'(?:from|import) "(.+?\.js)"', text)
        paths = {os.path.normpath(Path(name).parent / path) for path in imported}
        assert paths <= set(preloaded), name


@pytest.mark.parametrize("name", [name for name in FILES if not name.endswith(".woff2")])
def test_no_file_asks_for_anything_elsewhere_or_makes_html_of_text(name: str) -> None:
    text = (web_folder() / name).read_text().replace(SVG_NAMESPACE, "")
    found = re.findall(
        r"https?://|@import [\"'u]|innerHTML|outerHTML|insertAdjacent|document\.write|eval\(", text
    )
    assert found == []


@pytest.mark.parametrize(
    "path",
    [
        "web/",
        "web/nothing.js",
        "web/..",
        "web/../pyproject.toml",
        "web/%2e%2e/pyproject.toml",
        "web/..%2fpyproject.toml",
        "web/..%5cpyproject.toml",
        "web/%2fetc%2fpasswd",
        "web//etc/passwd",
        "web/main.js",
        "web/page",
        "web/page/",
        "web/page/../../pyproject.toml",
        "web/page/..%2f..%2fpyproject.toml",
        "web/page//main.js",
        "web/page/main.js%00",
        "web/pages/token.html",
        "web/.",
        "web/page/MAIN.JS",
        "web/....//pyproject.toml",
    ],
)
def test_paths_outside_the_web_folder_are_refused(room: Room, path: str) -> None:
    status, text = raw_answer(room.url + path, "Host: localhost")
    assert status in (404, 400)
    assert "[project]" not in text
    assert "root:" not in text
