"""A JupyterHub's API as far as a class uses it, and a class that is its service."""

import contextlib
import json
import re
import subprocess
import sys
import threading
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs

import httpx

from ai4u_edu.classroom.hub.sign_in import COOKIE
from tests.classroom.reserved_port import reserved_port
from tests.classroom.served_class import MODULE, environment
from tests.page.server import http_client
from tests.waiting import LIMIT_S

NAME = "ai4u-class"
PREFIX = f"/services/{NAME}/"
ACCESS, READ = f"access:services!service={NAME}", f"read:services!service={NAME}"
"""Scopes that docs/jupyterhub.md has for students' servers."""
SECRET = "the service's token"


@dataclass
class FakeHub:
    """Users by their tokens, and the codes of sign-ins."""

    users: dict[str, dict[str, Any]] = field(default_factory=dict)
    codes: dict[str, str] = field(default_factory=dict)
    """Token by the code that a browser brings."""
    forms: list[dict[str, str]] = field(default_factory=list)
    """Requests for tokens."""
    asked: list[str] = field(default_factory=list)
    """Paths of requests to the API."""
    is_down: bool = False
    class_url: str = ""
    api_url: str = ""

    def add(
        self, name: str, *groups: str, admin: bool = False, scopes: tuple[str, ...] = (ACCESS, READ)
    ) -> str:
        """Add a user, and return a token of it."""
        token = f"token-of-{name}"
        self.users[token] = {
            "kind": "user",
            "name": name,
            "admin": admin,
            "groups": list(groups),
            "scopes": list(scopes),
        }
        return token


@dataclass
class HubClass:
    """A running ``ai4u-edu class --hub``."""

    hub: FakeHub
    process: subprocess.Popen[str]
    url: str
    """Address of the service, with its prefix."""
    folder: Path

    def client(self, token: str = "") -> httpx.Client:
        """Return a browser; with a token, one that has signed in."""
        cookies = {COOKIE: token} if token else None
        return http_client.Client(base_url=self.url, cookies=cookies, trust_env=False)

    def state(self, token: str) -> dict[str, Any]:
        """Return what the teacher's page shows."""
        with self.client(token) as teacher:
            answer = teacher.get("teacher/state")
        assert answer.status_code == 200, answer.text
        found: dict[str, Any] = answer.json()
        return found

    def seat(self, token: str) -> httpx.Response:
        """Ask for a seat, as a notebook does."""
        headers = {"Authorization": f"token {token}"}
        return http_client.post(f"{self.url}api/hub-seat", headers=headers, trust_env=False)

    def variables(self, token: str, name: str) -> dict[str, str]:
        """Return the variables that the hub sets for a student's server."""
        return {
            "JUPYTERHUB_API_TOKEN": token,
            "JUPYTERHUB_API_URL": self.hub.api_url,
            "JUPYTERHUB_BASE_URL": "/",
            "JUPYTERHUB_SERVICE_PREFIX": f"/user/{name}/",
        }


@contextlib.contextmanager
def fake_hub() -> Iterator[FakeHub]:
    """Serve the API of a hub without users."""
    hub = FakeHub()

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            hub.asked.append(self.path)
            user = hub.users.get(self.headers.get("Authorization", "").removeprefix("token "))
            if hub.is_down:
                self._answer(503, {})
            elif user is None:
                self._answer(403, {"message": "Missing or invalid credentials."})
            elif self.path == "/hub/api/user":
                self._answer(200, user)
            elif self.path == f"/hub/api/services/{NAME}" and READ in user["scopes"]:
                self._answer(200, {"name": NAME, "url": hub.class_url, "prefix": PREFIX})
            else:
                self._answer(404, {"message": "No such service."})

        def do_POST(self) -> None:
            body = self.rfile.read(int(self.headers["Content-Length"])).decode()
            form = {name: values[0] for name, values in parse_qs(body).items()}
            hub.forms.append(form)
            token = hub.codes.pop(form.get("code", ""), "")
            is_fine = token and form.get("client_secret") == SECRET
            self._answer(200 if is_fine else 400, {"access_token": token} if is_fine else {})

        def _answer(self, status: int, body: dict[str, Any]) -> None:
            data = json.dumps(body).encode()
            self.send_response(status)
            self.send_header("Content-Length", str(len(data)))
            self.end_headers()
            self.wfile.write(data)

        def log_message(self, *args: object) -> None:
            pass

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    hub.api_url = f"http://127.0.0.1:{server.server_port}/hub/api"
    thread = threading.Thread(target=server.serve_forever)
    thread.start()
    try:
        yield hub
    finally:
        server.shutdown()
        thread.join()
        server.server_close()


@contextlib.contextmanager
def hub_class(folder: Path, hub: FakeHub, *options: str) -> Iterator[HubClass]:
    """Serve a class as a service of a hub, until the end."""
    with reserved_port() as port:
        hub.class_url = f"http://127.0.0.1:{port}"
        with _hub_class(folder, hub, options) as school:
            yield school


@contextlib.contextmanager
def _hub_class(folder: Path, hub: FakeHub, options: Sequence[str]) -> Iterator[HubClass]:
    variables = {
        "JUPYTERHUB_API_TOKEN": SECRET,
        "JUPYTERHUB_API_URL": hub.api_url,
        "JUPYTERHUB_BASE_URL": "/",
        "JUPYTERHUB_CLIENT_ID": f"service-{NAME}",
        "JUPYTERHUB_SERVICE_NAME": NAME,
        "JUPYTERHUB_SERVICE_PREFIX": PREFIX,
        "JUPYTERHUB_SERVICE_URL": hub.class_url,
        "JUPYTERHUB_OAUTH_CALLBACK_URL": f"{PREFIX}oauth_callback",
    }
    command = [sys.executable, "-m", MODULE, "--hub", "--folder", str(folder)]
    with subprocess.Popen(
        [*command, *options],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env=environment() | variables,
    ) as process:
        assert process.stdout is not None
        told = []
        for line in process.stdout:
            told.append(line)
            if re.search(r"http://\S+/services/", line):
                break
        assert process.poll() is None, "".join(told)
        listener = threading.Thread(target=lambda: told.extend(process.stdout or ()))
        listener.start()
        try:
            yield HubClass(hub, process, f"{hub.class_url}{PREFIX}", folder)
        finally:
            process.terminate()
            listener.join(LIMIT_S)
