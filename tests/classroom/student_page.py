"""A student's page without a browser: its picture, and the Python code that it shows."""

import json
import re

from websockets.sync.client import ClientConnection

from tests.classroom.served_class import Student
from tests.load.clients import CAMERA, VISER
from tests.page.server.rooms import open_socket
from tests.waiting import Deadline


def open_picture(student: Student, query: str = "") -> ClientConnection:
    """Open the socket of a page's picture."""
    return open_socket(
        student.address + query,
        subprotocols=[VISER],
        additional_headers=student.cookies,
        max_size=None,
    )


def script_address(student: Student) -> str:
    """Return the address for scripts that the student's page shows."""
    address: str = re.findall(r"http://[^\s'\"]+", python_lines(student))[0]
    return address


def python_lines(student: Student) -> str:
    """Return the Python code that the page shows, as its panel gets it."""
    page = "?page=" + "a" * 16
    panel = open_socket(student.address + "ws/panel" + page, additional_headers=student.cookies)
    with open_picture(student, page) as drawn, panel as told:
        drawn.send(CAMERA)
        told.send(json.dumps({"type": "show", "agent": "0", "tabs": ["agent"]}))
        deadline = Deadline()
        while True:
            part = json.loads(told.recv(deadline.left()))
            if part.get("name") == "python" and student.address in str(part["lines"]):
                return str(part["lines"])
