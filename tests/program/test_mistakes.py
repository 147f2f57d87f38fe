"""Each beginner's mistake has a sentence and a line."""

import json
import time
from typing import Any

import pytest

from ai4u_edu.program import Program, ProgramError, host
from ai4u_edu.program.program import Outputs

OUTPUTS: Outputs = {"move": ([-1.0, -1.0], [1.0, 1.0]), "respawn": ([], [])}
PERCEPT = {"eyes": [0.0, 0.5, 1.0], "speed": 0.25}

IN_DECIDE = [
    # the body of decide(percept), the mistake's line, kind and text
    (
        "return percept.speeed",
        2,
        "attribute",
        'a reading is taken with brackets and quotes: percept["speed"]',
    ),
    ("return percept('eyes')", 2, "error", "a reading is taken with square brackets"),
    (
        "return percept[eyes]",
        2,
        "unknown-name",
        "nothing is called 'eyes'; did you mean \"eyes\", in quotes?",
    ),
    ("return {move: [1, 0]}", 2, "unknown-name", 'did you mean "move", in quotes?'),
    (
        "return {'move': percept['eys'][:2]}",
        2,
        "wrong-key",
        "there is no sensor called 'eys'; did you mean 'eyes'?",
    ),
    (
        "return percept.eyes",
        2,
        "attribute",
        'a reading is taken with brackets and quotes: percept["eyes"]',
    ),
    (
        "return {'move': percept['eyes'].maxx()}",
        2,
        "attribute",
        "a reading has no 'maxx'; did you mean 'max'?",
    ),
    (
        "if percept['speed'] > 1:\n        return {'move': [1, 0]}",
        2,
        "no-return",
        "Your function returned nothing (None). Is `return` missing?",
    ),
    ("action = [1, 0]\n    {'move': action}", 3, "no-return", "returned nothing (None)"),
    ("return [1, 0]", 2, "action", 'expected an action like {"move": [1, 0]}, got [1, 0]'),
    (
        "return {'mov': [1, 0]}",
        2,
        "actuator",
        "the robot can't do 'mov'; did you mean 'move'?",
    ),
    (
        "return {'move': [1]}",
        2,
        "length",
        "action 'move': expected 2 numbers, got 1: [1]; write, say, {\"move\": [1, 0]}",
    ),
    ("return {'move': 1}", 2, "length", "action 'move': expected 2 numbers, got 1: 1"),
    (
        "return {'move': [1, '0']}",
        2,
        "not-a-number",
        "got '0' in [1, '0']; '0' is a text: write 0 without quotes",
    ),
    ("return {'move': [1, 'left']}", 2, "not-a-number", "'left' is a text, and a number has no"),
    ("return {'move': [[1], 0]}", 2, "not-a-number", 'in [[1], 0]; write, say, {"move": [1, 0]}'),
    (
        "return {'move': [1, None]}",
        2,
        "not-a-number",
        "None means that a function returned nothing",
    ),
    (
        "return {'forward': 1}",
        2,
        "actuator",
        "the robot can't do 'forward'; known are 'move'; write, say, {\"move\": [1, 0]}",
    ),
    ("return {'move': [1, 1e999]}", 2, "not-finite", "expected finite numbers, got [1, inf]"),
    (
        "spede = 1\n    return {'move': [sped, 0]}",
        3,
        "unknown-name",
        "nothing is called 'sped'; did you mean 'spede'?",
    ),
    ("return {'move': [zzqx, 0]}", 2, "unknown-name", "nothing is called 'zzqx'; a name gets"),
    ("left = left + 1", 2, "unknown-name", "write `global left` as the function's first line"),
    (
        "return {'move': [1 / 0, 0]}",
        2,
        "error",
        "Your code stopped with ZeroDivisionError: division by zero.",
    ),
    (
        "if percept['eyes'] > 0.4:\n        pass",
        2,
        "error",
        "a reading of 3 numbers is neither true nor false",
    ),
    (
        "return {'move': [percept['eyes'][3], 0]}",
        2,
        "error",
        "the reading has 3 numbers, from [0] to [2]; there is no [3].",
    ),
    ("percept['eyes'][0] = 1", 2, "error", "a reading can't be changed"),
    ("return decide(percept)", 2, "recursion", "calls itself again and again"),
    ("exit()", 2, "error", "ended the program"),
    ("return {'move': [input('?'), 0]}", 2, "error", "only knows what the robot senses"),
    (
        "while True:\n        pass",
        2,
        "endless",
        "Your code has been running for 0.2 s without an answer. The robot asks it again at each "
        "decision: use `if`, not `while`.",
    ),
    (
        "while True:\n        try:\n            x = 1\n        except:\n            pass",
        2,
        "endless",
        "without an answer",
    ),
    ("for x in iter(int, 1):\n        pass", 2, "endless", "never ends, or takes very long."),
    (
        "ways = [1]\n    for way in ways:\n        if way:\n            ways.append(way)",
        3,
        "endless",
        "The loop never ends: it adds to `ways` while it goes through it.",
    ),
    ("import numpy as np", 2, "numpy", "numpy is not there in the page"),
    ("import scipy", 2, "import", "scipy is not there in the page"),
]
AT_LOAD = [
    ("def decide(percept)\n    return {}", 1, "syntax", "A colon (:) is missing"),
    ("def decide(percept):\nreturn {}", 2, "indentation",
     "is inside the function definition in line 1. Put four spaces in front of it"),
    ("x = 1\n  y = 2", 2, "indentation", "begins with more spaces than the line before it"),
    ("def f():\n    x = 1\n  y = 2", 3, "indentation", "a number of spaces that no line above has"),
    ("x = (1 + 2\n", 1, "syntax", "The bracket ( in this line is never closed."),
    ("x = 1)\n", 1, "syntax", "a bracket ) in this line that was never opened"),
    ("x = [1)\n", 1, "syntax", "The bracket [ is closed by )"),
    ("x = 'left\n", 1, "syntax", "A text begins in this line and does not end"),
    ("if x = 1:\n    pass", 1, "syntax", "One = stores a value, and two compare"),
    ("if x[0] = 1:\n    pass", 1, "syntax", "One = stores a value, and two compare"),
    ("f(x[0]=1)", 1, "syntax", "One = stores a value, and two compare"),
    ("for f(x) in y:\n    pass", 1, "syntax", "Only a name can get a value"),
    ("f(x) += 1", 1, "syntax", "Only a name can get a value"),
    ("break", 1, "syntax", "`break` stands outside of a loop"),
    ("x =\u00a01", 1, "syntax", "type the line again"),
    ("x = 5m", 1, "syntax", "A number is followed by a letter"),
    ("x = 05", 1, "syntax", "write 5 in place of 05"),
    ("x = 1 \\ 2", 1, "syntax", "does not belong there"),
    ("x = [1 2]", 1, "syntax", "perhaps a comma"),
    ("return 1", 1, "syntax", "`return` stands outside of a function"),
    ("print 1", 1, "syntax", "`print` needs brackets"),
    ("x = “left”", 1, "syntax", "Python does not know the character “"),
    ("x = 1 +", 1, "syntax", "Python can't read this line"),
    ("x = '\0'", 0, "error", "null byte"),
    ("x = 1", 0, "entry",
     "there is no function 'decide'; expected a function: def decide(percept):"),
    ("x = 1\ndef decid(percept):\n    return {}", 2, "entry",
     "the function must be called decide, exactly so; you wrote decid"),
    ("def Decide(percept):\n    return {}", 1, "entry",
     "the function must be called decide, exactly so; you wrote Decide"),
    ("decide = 1", 1, "entry", "'decide' is no function"),
    ("def decide():\n    return {}", 1, "parameters",
     "decide must take one value, the percept: def decide(percept):"),
    ("class A:\n    def get_action(percept):\n        return {}", 2, "parameters",
     "get_action must take self and the percept: def get_action(self, percept):"),
    ("class A:\n    def __init__(self, x):\n        pass\n    def get_action(self, p):\n"
     "        pass", 0, "parameters", "missing 1 required positional argument"),
    ("while True:\n    x = 1", 1, "endless", "The loop never ends: its condition stays true."),
    ("1 / 0", 1, "error", "Your code stopped with ZeroDivisionError: division by zero."),
    ("from ai4u_edu import Scene", 1, "import", "of ai4u_edu it has Controller and Percept"),
    ("x = " + "-" * 100_000 + "1", 0, "", ""),
    ("#" * 300_000, 0, "error", "expected a program of at most 200,000 characters"),
]  # fmt: skip


def decision_of(source: str) -> dict[str, list[float]]:
    program = Program.load(source, outputs=OUTPUTS, limit_s=0.2)
    program.begin()
    return program.decide(PERCEPT)


def mistake(source: str) -> ProgramError:
    with pytest.raises(ProgramError) as caught:
        decision_of(source)
    return caught.value


@pytest.mark.parametrize(("body", "line", "kind", "text"), IN_DECIDE, ids=lambda x: str(x)[:40])
def test_in_a_decision(body: str, line: int, kind: str, text: str) -> None:
    found = mistake(f"def decide(percept):\n    {body}\n")
    assert text in found.text
    assert (found.line, found.kind) == (line, kind)


@pytest.mark.parametrize(("source", "line", "kind", "text"), AT_LOAD, ids=lambda x: str(x)[:40])
def test_at_load(source: str, line: int, kind: str, text: str) -> None:
    found = mistake(source)
    assert text in found.text
    if kind:
        assert (found.line, found.kind) == (line, kind)


def test_the_wall_clock_ends_a_loop_that_never_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    # real time: only the limit ends this loop, whenever the machine comes to it
    monkeypatch.setattr("ai4u_edu.program.tracing.time", time)
    found = mistake("def decide(percept):\n    while True:\n        pass\n")
    assert (found.line, found.kind) == (2, "endless")


def test_a_mistake_in_a_helper_is_at_its_line() -> None:
    found = mistake(
        "def half(x):\n    return x / nul\n\ndef decide(percept):\n    return half(1)\n"
    )
    assert (found.line, found.kind) == (2, "unknown-name")


def test_a_mistake_in_reset() -> None:
    source = (
        "class A:\n    def reset(self):\n        self.x = y\n"
        "    def get_action(self, percept):\n        return {}\n"
    )
    found = mistake(source)
    assert (found.line, found.kind) == (3, "unknown-name")


def loaded(source: str) -> dict[str, Any]:
    said = {"source": source, "outputs": OUTPUTS, "readings": ["eyes"]}
    answer: dict[str, Any] = json.loads(host.load(json.dumps(said)))
    return answer


def asked(percept: dict[str, Any]) -> dict[str, Any]:
    answer: dict[str, Any] = json.loads(
        host.decide(json.dumps({"percept": percept, "decision": 1}))
    )
    return answer


def test_the_worker_tells_mistakes() -> None:
    told = loaded("def decide(percept):\n    print('here')\n    x = 1\n    return x / 0\n")
    assert told["ok"], told
    assert asked(PERCEPT) == {
        "ok": False,
        "text": "Your code stopped with ZeroDivisionError: division by zero.",
        "line": 4,
        "kind": "error",
        "printed": "here\n",
        "lines": [2, 3, 4],
        "variables": {"x": "1"},
    }
    told = loaded("def decide(percept)")
    assert (told["ok"], told["line"], told["kind"]) == (False, 1, "syntax")
    told = asked(PERCEPT)
    assert (told["ok"], told["text"]) == (False, "no program is loaded; load one first")
