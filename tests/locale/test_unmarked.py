"""The collector of sentences that nobody marked finds them where they reach a reader."""

import typer
from starlette.exceptions import HTTPException

from ai4u_edu.base.errors import SetupError
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import translate
from tests.unmarked import unmarked


def test_sentences_without_a_mark_are_found() -> None:
    with unmarked() as found:
        SetupError("no error is marked")
        translate("no text is marked")
        translate(_("a scene has {hint}", hint="no value that is marked"))
        typer.echo("no line is marked")
        HTTPException(400, "no refusal is marked")
    assert found == {
        "no error is marked": "error",
        "no text is marked": "translated",
        "no value that is marked": "value",
        "no line is marked": "command line",
        "no refusal is marked": "refusal",
    }


def test_marked_sentences_names_and_data_are_not() -> None:
    with unmarked() as found:
        SetupError(_("no body is called {name!r}", name="the box"))
        typer.echo(translate(_("{n} of them are in {folder}", n=1, folder="here")))
        HTTPException(404, translate(_("there is no such page")))
        typer.echo("maze.yaml: 3 kB")
    assert found == {}
    SetupError("this one is after the end")
    assert found == {}
