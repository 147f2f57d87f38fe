"""The page's types of its messages are those of the structs."""

import subprocess
import sys

import pytest

from tests.web_messages import comment


@pytest.mark.slow
def test_the_pages_types_are_up_to_date() -> None:
    # in a process of its own, in which no other test has defined a struct
    command = [sys.executable, "-m", "tests.web_messages"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_docstrings_become_comments() -> None:
    doc = "Id of the agent, as\n    in ``agents``."
    assert comment(doc) == "/** Id of the agent, as in `agents`. */\n"
    assert comment("") == ""
