"""The frequent slips of beginners have their own sentences."""

import gc
import subprocess
import sys
import threading
from itertools import count
from typing import Any

import numpy as np
import pytest

from ai4u_edu.agent.block_frames import line_at
from ai4u_edu.lessons import check, film
from ai4u_edu.lessons.checking import judge
from ai4u_edu.lessons.course import lesson
from ai4u_edu.lessons.exercise import EXERCISES, Exercise, find
from ai4u_edu.lessons.notebook import Cell
from ai4u_edu.lessons.progress_file import ProgressFile
from ai4u_edu.lessons.time_limit import TimeLimit, TimeLimitError
from tests.lessons.workbook import run, tried
from tests.waiting import LIMIT_S

SLIPS: dict[str, tuple[str, str, str, str]] = {
    "no return": (
        "00.1",
        "def go(percept):\n    action = {'move': [1, 0, 0, 0]}",
        "no-return",
        "Your function returned nothing (None). Is `return` missing?",
    ),
    "no return of a number": (
        "18.1",
        "def seconds_of_comfort(level, loss):\n    (level - 40) / loss",
        "no-return",
        "Your function returned nothing (None). Is `return` missing?",
    ),
    "no return on one way": (
        "19.2",
        "class Calm(RewardFunc):\n    limit: float = 1.0\n    cost: float = 0.1\n\n"
        "    def on_update(self, body, view):\n"
        "        if abs(body.angular_velocity) > self.limit:\n            return -self.cost",
        "no-return",
        "Your function returned nothing (None). Is `return` missing?",
    ),
    "no parameter": (
        "00.1",
        "def go():\n    return {'move': [1, 0, 0, 0]}",
        "parameters",
        "`go` is called with other parameters than it has: go() takes 0 positional arguments but 1 "
        "was given. Its first line has to be `def go(percept):`.",
    ),
    "a parameter less": (
        "02.1",
        "def decisions_for(distance):\n    return distance",
        "parameters",
        "Its first line has to be `def decisions_for(distance, speed):`.",
    ),
    "no self": (
        "06.2",
        "class Patrol(Controller):\n    def get_action(percept):\n        return {}",
        "parameters",
        "Its first line has to be `def get_action(self, percept):`.",
    ),
    "no base": (
        "06.2",
        "class Patrol:\n    def get_action(self, percept):\n        return {}",
        "no-base",
        "`Patrol` has a `get_action`, and is no Controller yet: begin with "
        "`class Patrol(Controller):`.",
    ),
    "a call for a function": (
        "08.3",
        "def diary(agent):\n    notes = []\n"
        "    agent.begin_of_episode.connect(notes.append('begin'))\n    return notes",
        "called",
        "connect: expected a function that gets the agent, got None",
    ),
    "one reward without a list": (
        "09.2",
        "def my_rewards():\n    return TouchRewardFunc(target='box', reward=10)",
        "list",
        "Put it into a list: `return [...]`.",
    ),
    "a list for a number": (
        "18.1",
        "def seconds_of_comfort(level, loss):\n    return [(level - 40) / loss]",
        "list-for-number",
        "Expected a number, got a list with one number: `[5.0]`.",
    ),
    "text for a number": (
        "18.1",
        "def seconds_of_comfort(level, loss):\n    return 'five'",
        "not-a-number",
        "Expected a number, got `'five'`.",
    ),
    "no number": (
        "18.1",
        "def seconds_of_comfort(level, loss):\n    return float('nan')",
        "not-finite",
        "which is no number: perhaps 0 was divided by 0",
    ),
    "a number for a list": (
        "04.1",
        "def twin(x, y):\n    return x",
        "number-for-list",
        "For (3, 1) expected two numbers, got `3.0`.",
    ),
    "several numbers for one": (
        "01.4",
        "def count_near(distances):\n    return [each for each in distances if each < 2]",
        "list-for-number",
        "Expected a number, got a list:",
    ),
    "a table for a number": (
        "01.2",
        "def turn_for(side):\n    return {'left': -1, 'right': 1, 'ahead': 0}",
        "table-for-number",
        "Expected a number, got a dict:",
    ),
    "an end of the program": (
        "18.1",
        "import sys\ndef seconds_of_comfort(level, loss):\n    sys.exit()",
        "exit",
        "Your code called `exit`, which ends the program (line 3 of its cell: sys.exit()).",
    ),
    "an action that is no table": (
        "00.1",
        "def go(percept):\n    return [1, 0, 0, 0]",
        "action",
        "expected an action by actuator name, such as {'move': [0.0, 0.0, 0.0, 0.0]}, got",
    ),
    "a number too few": (
        "00.1",
        "def go(percept):\n    return {'move': [1, 0, 0]}",
        "set-up",
        "expected 4 numbers, got 3",
    ),
    "a name of no actuator": (
        "00.1",
        "def go(percept):\n    return {'mov': [1, 0, 0, 0]}",
        "action",
        "did you mean 'move'?",
    ),
}


@pytest.fixture(autouse=True)
def elsewhere(tmp_path: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("name", SLIPS)
def test_a_slip_is_told_in_a_sentence(name: str) -> None:
    exercise, code, diagnosis, text = SLIPS[name]
    verdict = tried(lesson(exercise[:2]), exercise, code)
    assert not verdict.passed
    assert text in verdict.text
    assert verdict.hint == diagnosis
    assert "has a fault" not in verdict.text


@pytest.mark.parametrize(
    "given", [5.0, np.float32(5), np.array(5.0), np.array([5.0]), np.array([[5.0]]), np.int64(5)]
)
def test_a_number_may_be_an_array_of_one(given: Any) -> None:
    verdict = judge(find("18.1"), lambda level, loss: given)
    assert "With a level of" in verdict.text  # that is, it was taken for a number


def test_what_is_set_in_init_is_there() -> None:
    code = (
        "class Patrol(Controller):\n    def __init__(self):\n        super().__init__()\n"
        "        self.goal = 'red'\n    def get_action(self, percept):\n"
        "        return {'move': [0, 0, 0, 0]} if self.goal == 'red' else None"
    )
    verdict = tried(lesson("06"), "06.2", code)
    assert "has no attribute" not in verdict.text
    assert verdict.hint != "no-return"


NUMBERS = count()


def function(code: str) -> Any:
    names: dict[str, Any] = {}
    # a name of its own, for the lines of a file are looked up by its name
    run(Cell(code), names, f"<cell {next(NUMBERS)}>")
    return names["go"]


WAITS = function("def go(percept):\n    action = {}\n    while percept['orientation'][1] > 0:\n"
                 "        action = {'move': [1, 0, 0, 0]}\n    return action")  # fmt: skip
SWALLOWS = function("def go(percept):\n    n = 0\n    while n != 0.5:\n        try:\n"
                    "            n = n + 1\n        except Exception: n = 0")  # fmt: skip


def quick(exercise_id: str) -> Exercise:
    """The exercise with a short limit, for tests."""
    known = find(exercise_id)
    return Exercise(known.id, known.title, known.judge, known.hints, 0.4)


@pytest.mark.parametrize(
    ("endless", "in_thread"),
    [
        pytest.param(SWALLOWS, False, id="main thread"),
        pytest.param(WAITS, True, id="another thread"),
        pytest.param(WAITS, False, marks=pytest.mark.nightly),
        pytest.param(SWALLOWS, True, marks=pytest.mark.nightly),
    ],
)
def test_an_endless_loop_ends_with_its_line(endless: Any, in_thread: bool) -> None:
    found: list[Any] = []

    def look() -> None:
        found.append(judge(quick("00.1"), endless))

    if in_thread:
        thread = threading.Thread(target=look)
        thread.start()
        thread.join()
    else:
        look()
    (verdict,) = found
    assert verdict.hint == "endless"
    assert "Your code did not answer for 0.4 s (line 3 of its cell: while " in verdict.text
    assert verdict.text.endswith("use `if`, not `while`.")


GROWS = function("def go(ways):\n    for way in ways:\n        if way:\n            ways.append(1)")
IN_A_HELPER = function(
    "def go(ways):\n    while ways:\n        sizes(ways)\n"
    "def sizes(ways):\n    n = 0\n    for way in ways:\n        n += way"
)
LONG = function("def go(ways):\n    for n in range(10**12):\n        ways[0] = n")


@pytest.mark.parametrize(
    ("endless", "text"),
    [
        (GROWS, "(line 2 of its cell: for way in ways:). The loop never ends: it adds to `ways`"),
        (IN_A_HELPER, "(line 2 of its cell: while ways:). The loop never ends: its condition"),
        (LONG, "(line 2 of its cell: for n in range(10**12):). The loop never ends, or takes"),
    ],
)
def test_the_loop_that_never_ends_is_found_and_explained(endless: Any, text: str) -> None:
    # an error of the limit is ignored while a body of an earlier test is freed
    gc.collect()
    with TimeLimit(call_s=0.4) as limit, pytest.raises(TimeLimitError):
        endless([1])
    assert text in limit.text
    assert limit.diagnosis == "endless-loop"


def test_a_loop_is_found_wherever_it_is_looked_at() -> None:
    # Python gives some jumps back to a loop's head no line
    code = GROWS.__code__
    lines = [line_at(code, place) for place in range(0, len(code.co_code), 2)]
    assert None in {line for _, _, line in code.co_lines()}
    assert set(lines) <= {1, 2, 3, 4}
    assert lines == sorted(lines[:-2]) + lines[-2:]  # the end of the loop is at its head again


def test_a_film_of_code_that_ends_the_program_says_so(capsys: pytest.CaptureFixture[str]) -> None:
    film("box_chase", function("def go(percept):\n    raise SystemExit"))
    said = "Stopped. Your code called `exit`, which ends the program (line 2 of its cell: raise"
    assert said in capsys.readouterr().out


AFTER_A_CHECK = """
import subprocess
import sys
import threading
from ai4u_edu.lessons.time_limit import TimeLimit
from ai4u_edu.program import Program

def check():
    with TimeLimit():
        pass

checking = threading.Thread(target=check)
checking.start()
checking.join()
Program.load("def decide(percept):\\n    return {}")  # traced
"""


def test_traced_code_goes_on_after_a_check_in_a_thread() -> None:
    # in a process of its own, since Python's interpreter would hang where no timer ends it
    subprocess.run([sys.executable, "-c", AFTER_A_CHECK], check=True, timeout=LIMIT_S)


def test_many_slow_calls_end_too() -> None:
    slow = function("import time\ndef go(percept):\n    time.sleep(0.15)\n    return {}")
    with TimeLimit(call_s=LIMIT_S, total_s=1.5) as limit, pytest.raises(TimeLimitError):
        [slow(None) for _ in range(100)]
    assert limit.diagnosis == "slow"
    assert "Each of them is slow (line 3 of its cell: time.sleep(0.15))" in limit.text


def test_a_film_of_an_endless_loop_says_so(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("ai4u_edu.lessons.filming.TimeLimit", lambda: TimeLimit(0.4))
    film("box_chase", WAITS)
    assert "Stopped. Your code did not answer for 0.4 s" in capsys.readouterr().out


def test_an_interrupt_is_one_sentence_and_changes_no_progress(
    capsys: pytest.CaptureFixture[str],
) -> None:
    def go(percept: Any) -> Any:
        raise KeyboardInterrupt  # as the kernel's interrupt does

    check("00.1", go)
    assert capsys.readouterr().out.startswith("Stopped. You stopped the check (line ")
    assert ProgressFile().entries() == {}


def test_the_ids_of_diagnoses_are_unique() -> None:
    from ai4u_edu.lessons.diagnoses import COMMON, diagnosis_id

    ids = [diagnosis_id("00.1", name, {}) for name in COMMON]
    for each in EXERCISES.values():
        ids += [diagnosis_id(each.id, name, each.hints) for name in each.hints]
        assert not set(each.hints) & set(COMMON), each.id
        assert all(name.replace("-", "").isalnum() for name in each.hints), each.id
    assert len(set(ids)) == len(ids)
