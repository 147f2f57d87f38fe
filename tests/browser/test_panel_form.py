"""The form builder and the card of the panel, as the tabs use them."""

from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser.panel_page import PanelPage, panel_page, panel_room

pytestmark = pytest.mark.browser

MAKE = """async (fields) => {
  const { Form } = await import("./web/panel/widgets/form.js");
  document.querySelector("#made")?.remove();
  window.sent = [];
  window.answer = { ok: true, text: "", problems: [] };
  window.form = new Form({ onChange: async (values) => (window.sent.push(values), window.answer) });
  const root = document.createElement("div");
  root.id = "made";
  root.append(form.element);
  document.querySelector(".ai4u-panel-body").prepend(root);
  form.update(fields);
}"""
REFUSE = """problems => (window.answer = { ok: false, text: "no", problems })"""


@pytest.fixture(scope="module")
def warm(chromium: Browser) -> Iterator[PanelPage]:
    with panel_room() as room, panel_page(chromium, room) as page:
        yield page


def field(name: str, kind: str, value: Any, **more: Any) -> dict[str, Any]:
    shown = "" if value is None else str(value)
    return {"name": name, "label": name, "kind": kind, "value": value, "shown": shown} | more


FIELDS = [
    field("rows", "whole", 4, hint="How many rows.", unit="rays"),
    field("noise", "number", 0.5),
    field("flat", "switch", False),
    field("target", "choice", "box", choices=["box", "ball"]),
    field("skip", "whole", 0, is_common=True),
]


@pytest.fixture
def page(warm: PanelPage) -> Page:
    warm.reset()
    warm.page.evaluate(MAKE, FIELDS)
    return warm.page


def entry(page: Page, name: str) -> Locator:
    return page.locator("#made").get_by_label(name, exact=True)


def sent(page: Page) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = page.evaluate("sent")
    return found


def test_three_fields_stand_before_more(page: Page) -> None:
    assert page.locator("#made .ai4u-form-first .ai4u-field > label").all_inner_texts() == [
        "rows",
        "noise",
        "flat",
    ]
    expect(entry(page, "target")).to_be_hidden()
    expect(entry(page, "skip")).to_be_hidden()


def test_the_fields_that_the_server_marks_stand_before_more(page: Page) -> None:
    marked = [row | {"is_first": row["name"] in {"target", "flat"}} for row in FIELDS]
    page.evaluate("fields => form.update(fields)", marked)
    assert page.locator("#made .ai4u-form-first .ai4u-field > label").all_inner_texts() == [
        "flat",
        "target",
    ]


def test_a_text_is_sent_on_enter_and_a_switch_at_once(page: Page) -> None:
    entry(page, "rows").fill("6")
    assert sent(page) == []
    entry(page, "rows").press("Enter")
    expect(page.locator("body")).to_be_focused()
    page.wait_for_function("sent.length == 1")
    entry(page, "flat").check()
    page.wait_for_function("sent.length == 2")
    page.get_by_text("More").click()
    entry(page, "target").select_option("ball")
    page.wait_for_function("sent.length == 3")
    assert sent(page) == [{"rows": "6"}, {"flat": True}, {"target": "ball"}]


def test_escape_restores_a_field_and_sends_nothing(page: Page) -> None:
    entry(page, "rows").fill("60")
    entry(page, "rows").press("Escape")
    expect(entry(page, "rows")).to_have_value("4")
    entry(page, "noise").click()
    assert sent(page) == []


def test_a_problem_stands_below_its_field_and_the_entry_stays(page: Page) -> None:
    page.evaluate(REFUSE, [{"path": ["rows"], "text": "expected at most 64, got 999"}])
    entry(page, "rows").fill("999")
    entry(page, "rows").press("Enter")
    problem = page.locator("#made .ai4u-field", has_text="rows").locator("[role=alert]")
    expect(problem).to_have_text("expected at most 64, got 999")
    expect(entry(page, "rows")).to_have_attribute("aria-invalid", "true")
    page.evaluate("fields => form.update(fields)", FIELDS)
    expect(entry(page, "rows")).to_have_value("999")
    page.evaluate("window.answer = { ok: true, text: '', problems: [] }")
    entry(page, "noise").fill("0.1")
    entry(page, "noise").press("Enter")
    page.wait_for_function("sent.length == 2")
    assert sent(page)[1] == {"rows": "999", "noise": "0.1"}
    expect(problem).to_be_empty()
    expect(entry(page, "rows")).not_to_have_attribute("aria-invalid", "true")


def test_problems_of_hidden_fields_open_more_and_others_stand_below_the_form(page: Page) -> None:
    problems = [{"path": ["skip"], "text": "too many"}, {"path": [], "text": "no room"}]
    page.evaluate("problems => form.showProblems(problems)", problems)
    expect(entry(page, "skip")).to_be_visible()
    expect(page.locator("#made").get_by_text("too many")).to_be_visible()
    expect(page.locator("#made").get_by_text("no room")).to_be_visible()


def test_new_values_leave_alone_what_is_being_typed(page: Page) -> None:
    entry(page, "rows").fill("12")
    changed = [FIELDS[0] | {"value": 5, "shown": "5"}, *FIELDS[1:]]
    page.evaluate("fields => form.update(fields)", changed)
    expect(entry(page, "rows")).to_have_value("12")
    entry(page, "rows").press("Escape")
    expect(entry(page, "rows")).to_have_value("5")


def test_a_card_opens_and_its_actions_keep_their_focus(page: Page) -> None:
    page.evaluate("""async () => {
      const { Card } = await import("./web/panel/widgets/card.js");
      window.done = [];
      const words = { title: "Rays", type: "RaySensor" };
      const card = new Card({ onToggle: (isOpen) => card.update({ ...words, isOpen }) });
      card.body.append("inside");
      card.update({ ...words, reads: "0.5 m" });
      window.actions = (on) => card.actions([
        { icon: "power", label: "Turn off", isEnabled: on, onClick: () => done.push("off") },
        { icon: "trash", label: "Delete", isDanger: true, onClick: () => done.push("delete") },
      ]);
      actions(true);
      document.querySelector("#made").replaceChildren(card.element);
    }""")
    head = page.locator("#made").get_by_role("button", name="Rays")
    expect(head).to_have_attribute("aria-expanded", "false")
    head.click()
    expect(page.get_by_text("inside")).to_be_visible()
    expect(page.get_by_text("RaySensor")).to_be_hidden()
    delete = page.locator("#made").get_by_role("button", name="Delete")
    delete.focus()
    page.evaluate("actions(false)")
    expect(delete).to_be_focused()
    expect(page.get_by_role("button", name="Turn off")).to_be_disabled()
    delete.click()
    assert page.evaluate("done") == ["delete"]
