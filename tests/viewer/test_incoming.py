"""Checks of what pages send, before viser and our callbacks get it; no proxy before viser."""

import gc
from collections.abc import Iterator
from typing import Any

import pytest
from viser import GuiEvent

from ai4u_edu.base.errors import SetupError
from ai4u_edu.viewer import Viewer
from ai4u_edu.viewer.backend.incoming import MAX_PRESSES_AT_ONCE
from ai4u_edu.viewer.backend.local_server import LocalServer
from ai4u_edu.viewer.backend.widget_values import MAX_TEXT_CHARS, ValueRefusedError, checked_value
from ai4u_edu.viewer.panel import uploads
from ai4u_edu.viewer.panel.uploads import limit_uploads
from tests.viewer.pages import Page, page, until


@pytest.fixture
def here(viewer: Viewer) -> Iterator[Page]:
    with page(viewer) as here:
        yield here


@pytest.fixture
def told(here: Page, viewer: Viewer, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Record the texts of the page's notifications."""
    texts: list[str] = []
    (client,) = viewer.server.get_clients().values()
    monkeypatch.setattr(client, "add_notification", lambda _, text, **__: texts.append(text))
    return texts


def test_what_goes_wrong_in_a_callback_is_told_to_its_page_and_written_once(
    here: Page,
    viewer: Viewer,
    told: list[str],
    monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
    capfd: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr("ai4u_edu.viewer.backend.incoming.NOTIFICATION_PERIOD_S", 0.0)

    async def fail(_event: GuiEvent[Any]) -> None:
        raise ValueError("this is no path")

    async def refuse(_event: GuiEvent[Any]) -> None:
        raise SetupError("there is no such block")

    gui = viewer.server.gui
    button, other, form = gui.add_button("Up"), gui.add_button("Add"), gui.add_form(None)
    button.on_click(fail)
    other.on_click(refuse)
    form.on_submit(fail)
    here.press(button)
    here.press(button)
    here.press(other)
    here.submit(form)
    until(lambda: len(told) == 4)
    assert told == 2 * ["ValueError: this is no path"] + [
        "there is no such block",
        "ValueError: this is no path",
    ]
    gc.collect()
    assert caplog.records == []
    assert "".join(capfd.readouterr()).count("Traceback") == 1


def test_a_page_that_presses_without_end_does_not_keep_the_world_busy_for_long(
    here: Page, viewer: Viewer
) -> None:
    heard: list[str] = []

    async def hear(event: GuiEvent[Any]) -> None:
        heard.append(str(event.target.value))

    gui = viewer.server.gui
    button, text = gui.add_button("Reset"), gui.add_text("Text", "")
    button.on_click(hear)
    text.on_update(hear)
    for _ in range(1000):
        here.press(button)
    for number in range(1000):
        here.change(text, f"{number}")
    until(lambda: "999" in heard)
    assert MAX_PRESSES_AT_ONCE <= heard.count("True") < MAX_PRESSES_AT_ONCE + 200
    assert len(heard) - heard.count("True") == 1000  # who types is not held up


def test_a_page_that_types_what_can_not_be_is_told_and_shown_what_is(
    here: Page, viewer: Viewer, told: list[str]
) -> None:
    box = viewer.server.gui.add_number("Height", 1.5, min=0.5, max=2.0)
    here.change(box, 7)
    until(lambda: told)
    assert told == ["Height: expected a number from 0.5 to 2, got 7"]
    assert box.value == 1.5
    here.change(box, 2)
    until(lambda: box.value == 2)
    assert type(box.value) is float


@pytest.mark.parametrize("low", [None, 0])
def test_every_number_is_within_what_a_browser_counts(low: int | None) -> None:
    server = LocalServer("AI4U Edu")
    try:
        box = server.gui.add_number("Number", 3, min=low)
        assert checked_value(box, 2.0**53 - 1) == 2**53 - 1
        for odd in (2**53, 1e300, -(2**53), 0.5, float("nan"), float("-inf"), True, "3", None):
            with pytest.raises(ValueRefusedError):
                checked_value(box, odd)
        text = server.gui.add_text("Text", "")
        assert checked_value(text, "x" * MAX_TEXT_CHARS)
        with pytest.raises(ValueRefusedError, match="Text: expected at most 20000 characters"):
            checked_value(text, "x" * (MAX_TEXT_CHARS + 1))
        with pytest.raises(ValueRefusedError, match="takes no value"):
            checked_value(server.gui.add_rgb("Colour", (0, 0, 0)), [1, 2, 3])
    finally:
        server.stop()


def test_a_file_that_is_not_finished_is_dropped(
    here: Page, viewer: Viewer, told: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(uploads, "UPLOAD_IDLE_S", 0.05)
    (client,) = viewer.server.get_clients().values()
    button = client.gui.add_upload_button("Open")
    limit_uploads(client, 1000)
    start(here, button, parts=2, size=10)
    until(lambda: told)
    assert told == ["the rest of it did not come"]
    assert not client.gui._current_file_upload_states


@pytest.mark.parametrize(
    ("parts", "size", "why"),
    [
        (1, 1001, "expected at most 0 MB"),
        (1001, 10, "expected at most 1000 parts"),
        (0, 10, "it is smaller than it said"),
        (1, 10, "it is smaller than it said"),
        (1, 2, "it is larger than it said"),
    ],
)
def test_a_file_is_what_it_said(
    here: Page, viewer: Viewer, told: list[str], parts: int, size: int, why: str
) -> None:
    (client,) = viewer.server.get_clients().values()
    button = client.gui.add_upload_button("Open")
    limit_uploads(client, 1000)
    start(here, button, parts=parts, size=size)
    here.say(
        "FileTransferPart",
        source_component_uuid=button._impl.uuid,
        transfer_uuid="1",
        part_index=0,
        content=b"abc",
    )
    until(lambda: told)
    assert told == [why]
    assert not client.gui._current_file_upload_states


def start(here: Page, button: Any, *, parts: int, size: int) -> None:
    here.say(
        "FileTransferStartUpload",
        source_component_uuid=button._impl.uuid,
        transfer_uuid="1",
        filename="file",
        mime_type="",
        part_count=parts,
        size_bytes=size,
    )


def test_a_window_without_a_size_has_a_picture(viewer: Viewer) -> None:
    with page(viewer) as here:
        here.report_camera(size=(0, 0))
        (client,) = viewer.server.get_clients().values()
        until(lambda: client.camera.image_width == 0)
        viewer.viewer_clients.refresh()
        (viewer_client,) = viewer.viewer_clients.values()
        viewer_client.view.update(viewer.runner.latest, viewer_client.agent)
