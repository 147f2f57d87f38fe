"""HTML from templates: texts are escaped, and no value may be missing."""

import pytest
from jinja2 import UndefinedError

from ai4u_edu.base.html_template import render_html

VALUES: dict[str, object] = {
    "seats": [],
    "exercises": ["<script>alert(1)</script>"],
    "entries": {},
    "words": {},
    "stars": [("<b>", "'\"", "{{ 1 + 1 }}")],
    "mistakes": [],
    "missions": [],
    "program_mistakes": [],
    "races": [("<i>", [])],
    "tournaments": [],
}


def test_values_are_text() -> None:
    page = render_html("classroom/results.html", **VALUES)
    assert not {"<script", "<b>", "<i>"} & {*page.replace(">", "> ").split()}
    assert "&lt;script&gt;" in page
    assert "<h2>Race: &lt;i&gt;</h2>" in page
    assert "<td>{{ 1 + 1 }}</td>" in page


def test_a_missing_value_is_an_error() -> None:
    values = {each: value for each, value in VALUES.items() if each != "races"}
    with pytest.raises(UndefinedError, match="races"):
        render_html("classroom/results.html", **values)
