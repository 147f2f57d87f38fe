"""A page in its browser's language; several pages of one world, each in its own."""

import json
import re
from collections.abc import Collection, Iterator, Mapping

import httpx
import pytest

from ai4u_edu.locale import LIBRARY, PSEUDO, VARIABLE, Catalogue, gettext, library_text
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.panel.block_words import OWN_BLOCKS
from ai4u_edu.page.panel.field_hints import FIELD_HINTS
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import Scene
from tests.page.panel.rooms import PanelPage, PanelRoom, panel_room
from tests.page.server import http_client
from tests.page.server.rooms import Room, served


@pytest.fixture(scope="module")
def room() -> Iterator[Room]:
    scene = Scene.load("box_chase")
    with served(editor=SceneEditor(Runner(scene.build(), seed=1), scene)) as room:
        yield room


@pytest.fixture(autouse=True)
def _no_option(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(VARIABLE, raising=False)
    monkeypatch.setenv("LANGUAGE", "en")


def page(room: Room, path: str, language: str) -> httpx.Response:
    return http_client.get(room.url + path, headers={"Accept-Language": language})


@pytest.mark.parametrize("path", ["", "start"])
@pytest.mark.parametrize(
    ("accepted", "language"), [("pt-BR,pt;q=0.9", "pt-BR"), ("en", "en"), ("la", "en")]
)
def test_a_page_says_its_language_and_holds_its_texts(
    room: Room, path: str, accepted: str, language: str
) -> None:
    answer = page(room, path, accepted)
    assert f'<html lang="{language}">' in answer.text
    (texts,) = re.findall(
        r'<script type="application/json" id="ai4u-texts">(.*?)</script>', answer.text
    )
    assert json.loads(texts)["language"] == language.replace("-", "_")
    assert "Accept-Language" in answer.headers["vary"]


def test_a_browser_that_has_a_page_gets_it_in_another_language(room: Room) -> None:
    etag = page(room, "", "en").headers["etag"]
    headers = {"Accept-Language": "pt-BR", "If-None-Match": etag}
    assert http_client.get(room.url, headers=headers).status_code == 200


def test_html_is_translated(room: Room) -> None:
    assert "Passo a passo" in page(room, "start", "pt-BR").text
    assert "Step by step" in page(room, "start", "en").text
    accented = page(room, "start", "en-XA").text
    assert "Step by step" not in accented
    assert "<code>ai4u-edu lessons</code>" in accented


def test_a_scenes_title_is_translated(room: Room) -> None:
    titles = [page(room, "api/scene", language).json()["title"] for language in ("en", "pt-BR")]
    assert titles == ["Box chase", "Caça à caixa"]


def test_two_pages_of_one_world_hear_two_languages() -> None:
    header = {"Accept-Language": "en-XA"}
    with (
        panel_room() as room,
        room.page() as english,
        PanelPage(room.url + "ws/panel", additional_headers=header) as accented,
    ):
        texts = [
            each.done("add_block", **{"class": "GrabActuator", "parent": ["actuators"]})["text"]
            for each in (english, accented)
        ]
    works = gettext("It works right away.")
    assert texts[0].endswith(works)
    assert texts[1].endswith(Catalogue(PSEUDO).translate(works))


def accented_page(room: PanelRoom) -> PanelPage:
    return PanelPage(room.url + "ws/panel", additional_headers={"Accept-Language": "en-XA"})


def untranslated(message: object, keys: Collection[str]) -> set[str]:
    """Return the texts under some keys of a message that have a letter without its accent."""
    if isinstance(message, Mapping):
        here = {
            text
            for key in keys & message.keys()
            for text in (message[key] if isinstance(message[key], list) else [message[key]])
            if isinstance(text, str) and re.search("[aeiou]", text)
        }
        return here.union(*(untranslated(each, keys) for each in message.values()))
    if isinstance(message, list):
        return set().union(*(untranslated(each, keys) for each in message))
    return set()


def test_blocks_and_their_forms_are_translated() -> None:
    keys = {"title", "question", "summary", "label", "hint", "reason"}
    with panel_room() as room, accented_page(room) as page:
        page.done("add_block", **{"class": "OrientationSensor", "parent": ["sensors"]})
        page.show("0", "blocks", block=["sensors", 1])
        part = page.part("blocks", lambda part: part["form"])
        items = page.done("gallery", kind="rewards")["items"]
        page.done("undo")
        redo = page.part("blocks", lambda part: part["redo"]["label"])["redo"]
    accented = Catalogue(PSEUDO).translate
    # blocks of other tests' own in this process keep the words that their author wrote
    ours = [item for item in items if item["question"] != accented(OWN_BLOCKS)]
    assert untranslated([part["form"], part["settings"], part["undo"], ours], keys) == set()
    fields = {field["name"]: field for field in part["form"]["fields"]}
    assert fields["target"]["hint"] == accented(FIELD_HINTS["target"])
    assert redo["label"] == accented(
        gettext("add {block}", block=gettext("Direction and distance"))
    )
    # names of parameters and values of a file stay as they are
    assert fields["target"]["detail"].startswith("target. ")
    assert fields["info"]["choices"] == ["both", "angle", "distance"]


def test_things_and_their_forms_are_translated() -> None:
    keys = {"title", "label", "hint", "words"}
    with panel_room() as room, accented_page(room) as page:
        said = page.done("nudge", names=["box"], dx=0.1)["text"]
        page.done("change_field", values={"type": "maze"})
        page.show("0", "world", body="box")
        part = page.part("world", lambda part: part["form"] and len(part["field"]) > 1)
        fields = {field["name"]: field for field in part["form"]["fields"]}
        palette = page.done("palette")["items"]
    assert untranslated([part["form"], palette], keys) == set()
    assert untranslated([part["settings"], part["field"]], keys - {"words"}) == set()
    assert fields["kind"]["choices"][1] == fields["kind"]["shown"] == "can be pushed"
    assert fields["kind"]["words"][1] == Catalogue(PSEUDO).translate(gettext("can be pushed"))
    assert said.startswith("Móvéd box tó x ")


def test_texts_of_the_library_are_translated() -> None:
    maze = Scene.load("maze").description
    accented = Catalogue(PSEUDO, LIBRARY)
    with (
        panel_room("maze") as room,
        PanelPage(room.url + "ws/panel", additional_headers={"Accept-Language": "en-XA"}) as page,
    ):
        part = page.part("scene")
    assert (part["title"], part["goal"]) == (
        accented.message(maze.title),
        accented.message(maze.goal),
    )


def test_what_somebody_wrote_is_shown_as_it_is_written() -> None:
    assert Catalogue("pt_BR").translate(library_text("Find my treasure")) == "Find my treasure"
    # a word of the page, but no text of the library
    assert Catalogue("pt_BR").translate(library_text("Open")) == "Open"
