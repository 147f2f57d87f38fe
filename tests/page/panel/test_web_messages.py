"""The page's types of its messages are those of the structs."""

from tests.web_messages import FILE, source


def test_the_pages_types_are_up_to_date() -> None:
    text = FILE.read_text(encoding="utf-8")
    assert text == source(), "run: python -m tests.web_messages --write"
