"""The report of ``ai4u-edu doctor``: true, and without names of people, folders and hosts."""

import getpass
import os
import socket
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import pytest

from ai4u_edu.base.version import __version__
from ai4u_edu.cli import doctor


def states(port: int = 0) -> dict[str, str]:
    return {each.subject: each.state for each in doctor.examine(port)}


def test_it_says_what_a_bug_report_needs() -> None:
    found = states()
    assert __version__ in found["AI4U Edu"]
    assert found["Python"].startswith(".".join(map(str, sys.version_info[:3])))
    assert f"pymunk {metadata.version('pymunk')}" in found["versions"]
    assert found["packages"] == "all that are needed are installed"
    assert found["port 0"] == "free"
    assert {f"[{extra}]" for extra in doctor.USES} <= found.keys()


def test_every_extra_for_users_has_its_use() -> None:
    extras = set(metadata.metadata(doctor.PACKAGE).get_all("Provides-Extra") or ())
    assert extras - {"dev", "docs", "fuzz", "test"} == doctor.USES.keys()


def test_extras_that_others_include_are_followed() -> None:
    assert "torch" in doctor.requirements("train")
    assert "torch" in doctor.requirements("sweep")
    assert {"numpy", "onnxruntime"} <= {*doctor.requirements()}
    assert "torch" not in doctor.requirements()


def test_what_is_missing_is_named_with_the_way_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    # all others of the extra are there, also where none of them is
    monkeypatch.setattr(doctor, "_version", lambda n: "" if n in {"rich", "torch"} else "1.0")
    found = {each.subject: each for each in doctor.examine(0)}
    assert found["packages"].state == "missing: rich"
    assert "torch" in found["[train]"].state
    assert found["[train]"].advice == 'complete it with: pip install "ai4u-edu[train]"'


def test_a_taken_port_is_told() -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        assert states(port)[f"port {port}"] == "taken"


def test_the_block_names_no_folder_user_or_host() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "ai4u_edu", "doctor", "--port", "0"],
        env={**os.environ, "AI4U_COMPILED": "0"},
        capture_output=True,
        text=True,
        check=True,
    )
    opening, *block = done.stdout.partition("\n```\n")[0].splitlines()
    assert opening == "```"
    assert "compiled part:  switched off" in block
    report = "\n".join(block)
    for private in (str(Path.home()), str(Path.cwd()), sys.prefix, socket.gethostname()):
        assert private not in report
    if getpass.getuser() != "root":
        assert getpass.getuser() not in report
