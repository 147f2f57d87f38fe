"""The page of the protocol shows a real exchange, byte by byte."""

import re

import pytest

from ai4u_edu.wire import native
from ai4u_edu.wire.json_form import JsonForm
from tests.remote import protocol_exchange

pytestmark = pytest.mark.slow


def test_the_exchange_in_the_page_is_what_script_and_world_say() -> None:
    rendered = protocol_exchange.rendered(protocol_exchange.exchange())
    shown = protocol_exchange.in_page().strip("\n")
    how = "write it again: python -m tests.remote.protocol_exchange"
    assert shown == rendered.strip("\n"), how


def test_the_bytes_in_the_page_are_the_messages_in_json() -> None:
    """The page alone is enough for somebody who writes a client."""
    page = protocol_exchange.in_page()
    dumps = re.findall(r"```text\n(.*?)```", page, re.DOTALL)
    texts = re.findall(r"```json\n(.*?)\n```", page, re.DOTALL)
    assert len(dumps) == len(texts) > 8
    width, form = 3 * protocol_exchange.BYTES_A_LINE, JsonForm()
    for dump, text in zip(dumps, texts, strict=True):
        frame = bytes.fromhex("".join(line[:width] for line in dump.splitlines()))
        assert form.text_of(frame) == text
        said = native.decode(form.frame_of(text.encode()), native.MAX_WORLD_FRAME_BYTES)
        assert native.encode(said) == frame


def test_the_page_lists_the_codes_of_a_close() -> None:
    page = " ".join(protocol_exchange.PAGE.read_text(encoding="utf-8").split())
    for name, code in native.PROBLEMS.items():
        assert f"{code} {name}" in page
