"""The rules for scripts that ``ai4u-edu play`` takes."""

from typing import Any

import pytest
from typer.testing import CliRunner

from ai4u_edu import room
from ai4u_edu.base.errors import SetupError
from ai4u_edu.cli.main import app
from ai4u_edu.page.server import Rules


class Told(Exception):
    """The rules of the room that would be served."""


def rules_of(monkeypatch: pytest.MonkeyPatch, *arguments: str) -> Rules:
    """The rules with which a command would serve its room."""

    def tell(settings: room.RoomSettings, *_: object) -> None:
        raise Told(settings.rules)

    monkeypatch.setattr(room, "Room", tell)
    result = CliRunner().invoke(app, ["play", "sumo", "--no-open", "--no-autosave", *arguments])
    error = result.exception
    if not isinstance(error, Told):
        raise error or AssertionError(result.output)
    (found,) = error.args
    assert isinstance(found, Rules)
    return found


def test_a_room_has_the_rules_that_it_is_given(monkeypatch: pytest.MonkeyPatch) -> None:
    rules = rules_of(monkeypatch)
    assert rules == Rules(lockstep=True, seeded_resets=True)
    wanted = "--lockstep --on-missing coast --grace 45.5 --receive-timeout 60000 --seeded-resets"
    assert rules_of(monkeypatch, *wanted.split()) == Rules(
        lockstep=True, on_missing="coast", grace=45.5, receive_timeout=60_000, seeded_resets=True
    )
    assert rules_of(monkeypatch, "--no-lockstep").lockstep is False
    assert rules_of(monkeypatch, "--no-seeded-resets").seeded_resets is False


@pytest.mark.parametrize(
    "arguments", [("--host", "192.168.7.7"), ("--allow-host", "hub.school.org")]
)
def test_where_others_may_come_scripts_of_several_agents_do_not_hold_up_the_world(
    arguments: tuple[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    rules = rules_of(monkeypatch, *arguments)
    assert (rules.lockstep, rules.seeded_resets) == (None, False)
    assert rules_of(monkeypatch, *arguments, "--lockstep").lockstep is True


@pytest.mark.parametrize(
    "arguments",
    [
        ("--grace", "-1"),
        ("--grace", "601"),
        ("--receive-timeout", "199"),
        ("--receive-timeout", "600001"),
        ("--receive-timeout", "1.5"),
        ("--on-missing", "hodl"),
    ],
)
def test_what_is_out_of_range_is_refused(
    arguments: tuple[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(SystemExit) as ended:
        rules_of(monkeypatch, *arguments)
    assert ended.value.code == 2


@pytest.mark.parametrize(
    ("fields", "complaint"),
    [
        ({"grace": float("nan")}, "grace: expected a number of seconds from 0 to 600, got nan"),
        ({"grace": float("inf")}, "grace: expected a number of seconds from 0 to 600, got inf"),
        ({"receive_timeout": 0}, "receive_timeout: expected a number of milliseconds from 200 to"),
    ],
)
def test_rules_are_checked_wherever_they_come_from(fields: Any, complaint: str) -> None:
    with pytest.raises(SetupError, match=complaint):
        Rules(**fields)
