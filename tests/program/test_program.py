"""Programs: memory, episodes, what they print, and what is traced of them."""

import json
from typing import Any

import numpy as np
import pytest

from ai4u_edu import EventSensor
from ai4u_edu.program import PrintedOutput, Program, Reading, host, obstacle_in, readings_of
from ai4u_edu.program.output import MAX_DECISION_CHARS, MAX_TOTAL_CHARS
from ai4u_edu.program.tracing import MAX_MOMENTS
from tests.builders import small_sim

COUNTER = """
count = 0

def decide(percept):
    global count
    count += 1
    return {"move": [count]}
"""
PATROL = """
class Patrol:
    def __init__(self):
        self.decisions = self.episodes = 0

    def reset(self):
        self.episodes += 1
        self.decisions = 0

    def get_action(self, percept):
        self.decisions += 1
        return {"move": [self.episodes, self.decisions]}
"""


def moves(program: Program, count: int) -> list[list[float]]:
    return [program.decide({})["move"] for _ in range(count)]


def test_global_variables_live_until_the_next_load() -> None:
    program = Program.load(COUNTER)
    program.begin()
    assert moves(program, 2) == [[1.0], [2.0]]
    program.begin()
    assert moves(program, 1) == [[3.0]]
    assert moves(Program.load(COUNTER), 1) == [[1.0]]


def test_a_class_is_reset_at_each_episode() -> None:
    program = Program.load(PATROL)
    for episode in (1.0, 2.0):
        program.begin()
        assert moves(program, 2) == [[episode, 1.0], [episode, 2.0]]


def test_a_controller_has_the_hooks_of_a_real_one() -> None:
    program = Program.load(
        "from ai4u_edu import Controller, Percept\n"
        "class Steps(Controller):\n"
        "    size: float = 0.5\n"
        "    seen: list = []\n"
        "    def on_setup(self, agent, view):\n        self.told = ['setup']\n"
        "    def on_reset(self, agent, view):\n        self.told.append('reset')\n"
        "    def new_state_event(self, percept):\n        self.told.append('percept')\n"
        "    def get_action(self, percept: Percept):\n"
        "        return {'move': [self.size, len(self.told)]}\n"
        "mine = Steps(size=2)\n",
        entry="mine",
    )
    program.begin()
    assert moves(program, 2) == [[2.0, 3.0], [2.0, 4.0]]


@pytest.mark.parametrize("entry", ["decide", "other", "Patrol", "patrol", ""])
def test_entries(entry: str) -> None:
    source = "other = decide = lambda percept: {'move': [7]}\n"
    source += f"{PATROL}\npatrol = Patrol()\npatrol.reset()\n"
    program = Program.load(source, entry=entry)
    assert moves(program, 1) in ([[7.0]], [[1.0, 1.0]], [[0.0, 1.0]])


def test_numbers_are_rounded() -> None:
    program = Program.load("def decide(percept):\n    return {'move': [0.1 + 0.2, 1/3, True]}")
    assert moves(program, 1) == [[0.3, 0.333333333, 1.0]]


def test_sums_are_the_same_in_each_version_of_python() -> None:
    program = Program.load("x = sum([0.1] * 10)\ndef decide(percept):\n    return {}")
    program.decide({})
    assert program.variables()["x"] == "0.9999999999999999"


def test_names_of_the_program_are_its_own() -> None:
    Program.load("sum = print = 1\nimport math\nmath.mine = 1\ndef decide(percept):\n    return {}")
    assert sum([1]) == 1


def test_what_is_printed_is_bounded() -> None:
    output = PrintedOutput()
    source = (
        "def decide(percept):\n    print(percept['n'], 'x' * percept['count'])\n    return {}\n"
    )
    program = Program.load(source, output=output)
    program.decide({"n": 1, "count": 3})
    assert output.take() == "1 xxx\n"
    program.decide({"n": 2, "count": 10_000_000})
    text = output.take()
    assert text.startswith("2 xxx")
    assert text.endswith("... (cut: a decision may print 2,000 characters)\n")
    assert len(text) < MAX_DECISION_CHARS + 100
    total = 0
    for number in range(2 * MAX_TOTAL_CHARS // MAX_DECISION_CHARS):
        program.decide({"n": number, "count": 10_000})
        total += len(output.take())
    assert total < 1.1 * MAX_TOTAL_CHARS
    program.decide({"n": 1, "count": 1})
    assert output.take() == ""


def test_a_million_prints() -> None:
    output = PrintedOutput()
    program = Program.load(
        "def decide(percept):\n    for i in range(100000):\n        print(i, sep='', end=';')\n"
        "    return {}",
        output=output,
        limit_s=60,
    )
    program.decide({})
    assert len(output.take()) < MAX_DECISION_CHARS + 100


def test_what_ran() -> None:
    source = (
        "gain = 2\n\n"
        "class A:\n"
        "    left = 0\n"
        "    def get_action(self, percept):\n"
        "        self.seen = 'y' * 10_000_000\n"
        "        turn = half(percept['eyes'].max())\n"
        "        if turn > 1:\n"
        "            turn = 1\n"
        "        return {'move': [turn]}\n\n"
        "def half(x):\n    return x / 2\n"
    )
    said = {"source": source, "outputs": {"move": [[-1], [1]]}, "readings": ["eyes"]}
    assert json.loads(host.load(json.dumps(said)))["ok"]
    told = json.loads(host.decide(json.dumps({"percept": {"eyes": [0.5, 1]}, "decision": 1})))
    assert told["lines"] == [6, 7, 13, 8, 10]
    seen = told["variables"].pop("self.seen")
    assert len(seen) < 200
    assert told["variables"] == {"turn": "0.5", "gain": "2"}


def test_moments_from_a_breakpoint_on() -> None:
    source = """
def sign(value):
    return 1 if value > 0 else -1

def decide(percept):
    far = percept["eyes"].max()
    side = sign(far - 1)
    return {"move": [far, side]}
"""
    said = {"source": source, "outputs": {"move": [[-1, -1], [1, 1]]}, "readings": ["eyes"]}
    assert json.loads(host.load(json.dumps(said)))["ok"]

    def moments(*stops: int) -> list[tuple[int, dict[str, str]]]:
        percept = {"percept": {"eyes": [0.5, 0.25]}, "decision": 1, "stops": stops}
        told = json.loads(host.decide(json.dumps(percept)))
        assert told["values"] == {"move": [0.5, -1]}
        return [(each["line"], each["variables"]) for each in told.get("moments", ())]

    assert moments() == []
    assert moments(99) == []
    # each line with the variables before it, those of a function that is called too
    assert moments(7) == [
        (7, {"far": "0.5"}),
        (3, {"value": "-0.5"}),
        (8, {"far": "0.5", "side": "-1"}),
    ]
    assert [line for line, _ in moments(0)] == [6, 7, 3, 8]  # the first line that runs
    loop = (
        "def decide(percept):\n    for i in range(1000):\n        pass\n    return {'move': [0, 0]}"
    )
    assert json.loads(host.load(json.dumps({**said, "source": loop})))["ok"]
    told = json.loads(host.decide(json.dumps({"percept": {}, "decision": 1, "stops": [3]})))
    assert len(told["moments"]) == MAX_MOMENTS


def test_a_trace_is_bounded_and_runs_no_code_of_the_program() -> None:
    source = (
        "class Loud:\n    def __repr__(self):\n        raise SystemExit\n"
        "def decide(percept):\n    loud = Loud()\n    many = list(range(10**6))\n"
        "    nested = []\n    nested.append(nested)\n    big = 10**5000\n"
        "    for i in range(10_000):\n        pass\n"
        "    for i in range(100):\n        globals()[f'x{i}'] = i\n    return {'move': [0]}\n"
    )
    program = Program.load(source, limit_s=60)
    program.decide({})
    variables = program.variables()
    assert len(program.trace.lines) == 500
    assert variables["loud"] == "<Loud>"
    assert variables["nested"] == "[[[[...]]]]"
    assert variables["big"] == "a very large number"
    assert len(variables) == 40
    assert max(map(len, variables.values())) <= 120


def test_obstacles() -> None:
    assert obstacle_in("import math, os.path\nfrom random import choice\n") is None
    assert obstacle_in("from ai4u_edu import Controller, Percept") is None
    assert obstacle_in("not python (") is None
    hook = "class A:\n    def on_reset(self, agent, view):\n        self.x = {}\n"
    assert obstacle_in(hook.format("0")) is None
    for source in (
        "def f():\n    from numpy.linalg import norm",
        "import numpy.random",
        "import torch",
        "from . import helper",
        "import ai4u_edu.blocks",
        "from ai4u_edu import Controller, Scene",
        hook.format("agent.id"),
    ):
        assert obstacle_in(source) is not None, source


def numbers(shape: tuple[int, ...]) -> Any:
    chance = np.random.default_rng(1)
    return chance.uniform(-1, 1, shape).astype(np.float32)


@pytest.mark.parametrize("shape", [(1,), (5,), (3, 4), (2, 3, 4)])
def test_a_reading_does_as_an_array(shape: tuple[int, ...]) -> None:
    array = numbers(shape)
    reading = readings_of({"x": array})["x"]
    wide = array.astype(float)
    assert reading.tolist() == wide.tolist()
    assert reading.shape == shape
    assert (reading.ndim, reading.size, len(reading)) == (wide.ndim, wide.size, len(wide))
    for name in ("min", "max", "argmin", "argmax", "any", "all"):
        assert getattr(reading, name)() == getattr(wide, name)(), name
    assert reading.mean() == pytest.approx(wide.mean())
    assert reading.sum() == pytest.approx(wide.sum())
    for ours, theirs in (
        (2 * reading - 1, 2 * wide - 1),
        (1 - reading / 3, 1 - wide / 3),
        (1 / (reading + 2), 1 / (wide + 2)),
        (reading > 0.25, wide > 0.25),
        (reading <= reading, wide <= wide),
        (reading == wide.tolist(), wide == wide),
        (abs(-reading), abs(-wide)),
        (reading[:2], wide[:2]),
        (reading[-1:], wide[-1:]),
        (reading.flatten(), wide.flatten()),
    ):
        assert ours.tolist() == theirs.tolist()


def test_parts_of_a_picture() -> None:
    picture, wide = Reading(numbers((4, 5, 3)).tolist()), numbers((4, 5, 3)).astype(float)
    assert picture[1, 2, 0] == wide[1, 2, 0]
    assert picture[1][2].tolist() == wide[1][2].tolist()
    assert picture[1, :, 0].tolist() == wide[1, :, 0].tolist()
    assert picture[1:3, 2].tolist() == wide[1:3, 2].tolist()


def test_readings_of_a_percept() -> None:
    found = readings_of(
        {"a": np.float32(0.1), "b": 3, "c": True, "d": "word", "e": ("a", "b"), "f": [1, 2]}
    )
    assert found == {
        "a": float(np.float32(0.1)), "b": 3, "c": True, "d": "word", "e": ("a", "b"),
        "f": found["f"],
    }  # fmt: skip
    assert found["f"].tolist() == [1, 2]
    assert "f" in found
    assert found.get("g") is None


def test_the_page_calls_functions_of_a_text_with_whole_numbers_and_readings() -> None:
    source = """
def double(value):
    return 2 * value

def left(percept):
    print(percept["bearing"][0])
    return {"it": percept["bearing"].max() > 0, "set": {1}, "far": 1e999}

def endless():
    while True:
        pass
"""
    said = {"source": source, "has_entry": False, "limit_s": 0.2}
    assert json.loads(host.load(json.dumps(said)))["ok"]
    assert called("double", "[1.0]")["value"] == "2.0"
    assert called("double", '[{"array": [1, 2]}]')["value"] == "[2, 4]"
    answer = called("left", '[{"percept": {"bearing": [0.5, 1]}}]')
    assert (answer["printed"], answer["lines"]) == ("0.5\n", [6, 7])
    shown = ["set", {"shown": "{1}"}]
    wanted = {"table": [["it", True], shown, ["far", {"number": "inf"}]]}
    assert json.loads(answer["value"]) == wanted
    for name, arguments, kind in (
        ("dubble", "[1]", "entry"),
        ("double", "[]", "parameters"),
        ("double", "[null]", "error"),
        ("endless", "[]", "endless"),
    ):
        answer = called(name, arguments)
        assert (answer["ok"], "value" in answer) == (False, False)
        assert kind in (answer["kind"], "error"), answer
    assert "did you mean 'double'?" in called("dubble", "[1]")["text"]


def called(name: str, arguments: str) -> dict[str, Any]:
    answer: dict[str, Any] = json.loads(
        host.call(json.dumps({"name": name, "arguments": arguments}))
    )
    return answer


def test_a_program_reacts_to_what_happened_to_the_body() -> None:
    program = Program.load(
        "is_back = False\n"
        "def decide(percept):\n"
        "    global is_back\n"
        "    if percept['hit'][0] > 0:\n"
        "        is_back = True\n"
        "    return {'move': [-1 if is_back else 1, 0, 0, 0]}\n"
    )
    hit = EventSensor(target="box", perception_key="hit")
    sim = small_sim([hit], controller=lambda percept: program.decide(readings_of(percept)))
    program.begin()
    for _ in range(120):
        sim.step()
    assert sim.world["robot"].velocity[0] < 0
