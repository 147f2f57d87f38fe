"""The Python that blocks mean: what stands in it, and what it does."""

import json
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Page

from ai4u_edu.program import Program
from tests.browser.blocks import State, act, block, compare, near, number, program, stack
from tests.browser.fake_panel import PARTS
from tests.browser.tab_page import TabPage
from tests.waiting import LIMIT_S

pytestmark = pytest.mark.browser

OUTPUTS = {"move": ([-1.0, -1.0, 0.0], [1.0, 1.0, 1.0])}
PERCEPT = {"box": [0.5, 2.0], "rays": [0.5, 0.1, 0.5, 0.2, 0.5, 0.3, 0, 0, 1, 0.4, 0.5, 0.9]}
DECISION = block("on_decision")
COUNT = {"VAR": {"id": "a"}}


@pytest.fixture(scope="module")
def page(chromium: Browser) -> Iterator[Page]:
    tab = TabPage(chromium, "panel/past/tab", "PastTab", "past")
    yield tab.page
    tab.close()


def python_of(page: Page, state: State, part: dict[str, Any] = PARTS["python"]) -> str:
    return translated(page, state, part)[0]


def translated(
    page: Page, state: State, part: dict[str, Any] = PARTS["python"]
) -> tuple[str, list[str]]:
    """Return the Python of blocks, and the ids of the blocks by line."""
    script = """async ([state, part]) => {
      const { agentBlocks } = await import("./web/blocks/agent.js");
      const { pythonOf } = await import("./web/blocks/python.js");
      const { text, blocks } = pythonOf(state, agentBlocks(part));
      return [text, blocks];
    }"""
    text, blocks = page.evaluate(script, [state, part])
    return text, blocks


def decided(text: str, *percepts: dict[str, Any]) -> list[list[float]]:
    """Return what a program does for percepts of an episode."""
    loaded = Program.load(text, outputs=OUTPUTS, limit_s=LIMIT_S)
    loaded.begin()
    return [loaded.decide({**PERCEPT, **percept})["move"] for percept in percepts]


def value(page: Page, state: State) -> float:
    """Return the value of a block of numbers."""
    (move,) = decided(python_of(page, program(stack(DECISION, act(0, state)))), {})
    return move[0]


def test_a_program_reads_as_a_beginner_writes_it(page: Page) -> None:
    turns = block(
        "if_else",
        IF=compare(near("ahead"), "LT", 0.85),
        DO=act(1, -1),
        ELSE=stack(act(0, 0.5), act(1, near("right"))),
    )
    text, blocks = translated(page, program(stack(DECISION, turns)))
    assert text == (
        "def decide(percept):\n"
        "    forward = turn = 0\n"
        '    if 10 * nearest(percept["rays"][5:8:2], 1) < 0.85:\n'
        "        turn = -1\n"
        "    else:\n"
        "        forward = 0.5\n"
        '        turn = 10 * nearest(percept["rays"][1:4:2], 1)\n'
        '    return {"move": [forward, turn, 0]}\n'
        "\n"
        "\n"
        "def nearest(distances, reach):\n"
        "    # 0 stands for a ray that hits nothing\n"
        "    return min(each or reach for each in distances)\n"
    )
    assert blocks[:8] == [
        *["on_decision"] * 2,
        *["if_else", "act:move:1", "if_else"],
        *["act:move:0", "act:move:1", "on_decision"],
    ]
    assert decided(text, {}) == [[0.5, 1.0, 0.0]]


def test_an_else_with_one_if_becomes_elif(page: Page) -> None:
    inner = block("if", IF=compare(near("left"), "GTE", 1), DO=act(1, 1))
    outer = block("if_else", IF=block("true_false", {"BOOL": "FALSE"}), ELSE=inner)
    text = python_of(page, program(stack(DECISION, outer)))
    assert "    if False:\n        pass\n    elif 10 * nearest(" in text
    assert decided(text, {}) == [[0.0, 1.0, 0.0]]


def test_values(page: Page) -> None:
    minus = block("arithmetic", {"OP": "MINUS"}, A=3, B=1)
    plus = block("arithmetic", {"OP": "ADD"}, A=0.5, B=minus)
    assert value(page, block("arithmetic", {"OP": "MINUS"}, A=1, B=minus)) == -1
    assert value(page, block("arithmetic", {"OP": "MULTIPLY"}, A=plus, B=number(-2))) == -5
    assert value(page, block("arithmetic", {"OP": "DIVIDE"}, A=1, B=plus)) == 0.4
    assert value(page, block("of_two", {"OP": "min"}, A=plus, B=2)) == 2
    assert value(page, block("absolute", A=-3)) == 3
    assert 2 <= value(page, block("random", A=2, B=3)) <= 3
    assert value(page, block("sense:box", {"SLOT": "1"})) == 2
    assert value(page, block("near:rays", {"SIDE": "around"})) == 1
    assert value(page, block("near:rays", {"SIDE": "left"})) == 4
    assert value(page, block("angle:rays", {"GROUP": "target"})) == -45


@pytest.mark.parametrize(
    ("state", "is_true"),
    [
        (block("sees:rays", {"GROUP": "target", "SIDE": "left"}), True),
        (block("sees:rays", {"GROUP": "target", "SIDE": "right"}), False),
        (block("not", A=block("sees:rays", {"GROUP": "wall", "SIDE": "around"})), False),
        (compare(2, "EQ", block("arithmetic", {"OP": "ADD"}, A=1, B=1)), True),
    ],
)
def test_conditions(page: Page, state: State, is_true: bool) -> None:
    both = block("and_or", {"OP": "and"}, A=block("true_false", {"BOOL": "TRUE"}), B=state)
    one = block("and_or", {"OP": "or"}, A=both, B=block("true_false", {"BOOL": "FALSE"}))
    text = python_of(page, program(stack(DECISION, block("if", IF=one, DO=act(0, 1)))))
    assert decided(text, {}) == [[float(is_true), 0.0, 0.0]]


def test_variables_last_for_an_episode(page: Page) -> None:
    counts = stack(
        DECISION,
        block("math_change", COUNT, DELTA=1),
        act(0, block("variables_get", COUNT)),
    )
    begin = stack(block("on_begin"), block("variables_set", COUNT, VALUE=5))
    text = python_of(page, program(counts, begin, variables={"a": "my count", "b": "unused"}))
    assert text == (
        "class Program:\n"
        "    def reset(self):\n"
        "        self.my_count = 0\n"
        "        self.my_count = 5\n"
        "\n"
        "    def get_action(self, percept):\n"
        "        forward = turn = 0\n"
        "        self.my_count = self.my_count + 1\n"
        "        forward = self.my_count\n"
        '        return {"move": [forward, turn, 0]}\n'
    )
    assert [move[0] for move in decided(text, {}, {})] == [6, 7]


def test_a_beginning_that_acts_is_a_decision(page: Page) -> None:
    begin = stack(block("on_begin"), act(0, 0.25))
    text = python_of(page, program(stack(DECISION, act(1, 1)), begin))
    assert decided(text, {}, {}) == [[0.25, 1.0, 0.0], [0.0, 1.0, 0.0]]


def test_an_event_happens_once(page: Page) -> None:
    event = block("on_becomes", IF=compare(block("sense:box", {"SLOT": "1"}), "LT", 1))
    text = python_of(page, program(stack(DECISION, act(0, 1)), stack(event, act(0, -1))))
    near_box, far_box = {"box": [0.5, 0.5]}, {"box": [0.5, 3.0]}
    moves = decided(text, far_box, near_box, near_box, far_box, near_box)
    assert [move[0] for move in moves] == [1, -1, 1, 1, -1]


def test_a_touch_is_an_event(page: Page) -> None:
    bumper = {"key": "bumper", "class": "TouchSensor", "kind": "number", "unit": "", "shape": [1]}
    part = {**PARTS["python"], "sensors": [{**bumper, "stack": 1, "slots": [], "rays": None}]}
    touched = stack(block("on_touch", {"KEY": "bumper"}), block("rest"))
    text = python_of(page, program(stack(DECISION, act(0, 1)), touched), part)
    moves = decided(text, {"bumper": [-1]}, {"bumper": [1]}, {"bumper": [1]})
    assert [move[0] for move in moves] == [1, 0, 1]


def test_names_and_texts_of_all_kinds(page: Page) -> None:
    variables = {"a": "class", "b": "2 beäns!", "c": "class", "d": "was 1"}
    lines = [
        block("print", {"TEXT": 'a "b" \\ \n'}, VALUE=block("variables_get", {"VAR": {"id": key}}))
        for key in variables
    ]
    event = stack(block("on_becomes", IF=None), block("repeat", {"TIMES": 2}, DO=stack(*lines)))
    text = python_of(page, program(DECISION, event, variables=variables))
    compile(text, "program.py", "exec")
    for name in ("class_ = 0", "x_2_beäns = 0", "class__2 = 0", "was_1_2 = 0"):
        assert f"self.{name}\n" in text
    assert decided(text, {}) == [[0.0, 0.0, 0.0]]


def test_blocks_of_another_robot_are_told_by_run(page: Page) -> None:
    strange = stack(DECISION, block("act:wings:0", VALUE=1))
    text = python_of(page, program(strange))
    assert "pass  # this robot has no wings:0" in text
    sensed = python_of(page, program(stack(DECISION, act(0, block("sense:nose", {"SLOT": "0"})))))
    with pytest.raises(Exception, match="nose"):
        decided(sensed, {})


def test_the_text_of_a_program_holds_its_blocks(page: Page) -> None:
    script = """async ([python, blocks]) => {
      const { joinProgram, splitProgram } = await import("./web/blocks/text.js");
      const text = joinProgram(python, blocks, true);
      const others = ["x = 1\\n" + text, text + "y = 1", joinProgram(python, blocks, false),
        python + "\\n# blocks: {}"];
      return [text, ...[text, ...others].map(splitProgram)];
    }"""
    python, blocks = "def decide(percept):\n    return {}\n", program(DECISION)
    text, same, changed, longer, left, wrong = page.evaluate(script, [python, blocks])
    assert same == {"python": python, "blocks": blocks, "isOfBlocks": True}
    assert changed["blocks"] == left["blocks"] == json.loads(json.dumps(blocks))
    assert not changed["isOfBlocks"]
    assert not left["isOfBlocks"]
    assert longer["blocks"] is wrong["blocks"] is None
    assert text.startswith(python)
    assert Program.load(text, outputs=OUTPUTS, limit_s=LIMIT_S).file == "program.py"
