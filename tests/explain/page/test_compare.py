"""Two drivers on a recorded episode, as a page asks for them."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ai4u_edu import trained_brain
from ai4u_edu.page.editing.drivers import DriverRegistry
from tests.explain.planted import linear_network
from tests.page.panel.rooms import panel_room
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.needs("train")


def test_where_two_drivers_first_disagree(tmp_path: Path) -> None:
    ahead = {"orientation": np.zeros((2, 4))}
    # from a distance on, the later one drives backwards
    # and its jumps, which have no effect here, are others
    late = {"orientation": np.array([[0, 0, 0, 0], [-1.0, 0, 5.0, 0]])}
    linear_network(tmp_path / "checkpoint-000001000.onnx", ahead, offset=[0.1, 0, 0, 0])
    linear_network(tmp_path / "checkpoint-000002000.onnx", late, offset=[0.7, 0, 0, 0])
    with panel_room() as room, room.page() as page:
        room.editor._drivers = DriverRegistry([tmp_path])
        agent = room.runner.sim.agents[0]
        brain = trained_brain(str(tmp_path / "checkpoint-000001000.onnx"))
        room.runner.submit(lambda: agent.use_brain(brain)).result(LIMIT_S)
        page.show("0", "past")
        assert "choose an episode first" in page.failed("compare", first="", second="x")["text"]
        before = len(page.part("past")["episodes"])
        percepts: list[Any] = []
        for _ in range(4):
            percepts.append(agent.percept["orientation"][1])
            page.done("decision")
        page.done("new_start")
        part = page.part("past", lambda m: len(m["episodes"]) > before)
        page.done("episode", number=part["episodes"][0]["number"])
        until(lambda: room.context.player.frame_cache)
        rivals = page.done("rivals")["rivals"]
        found = {each["value"]: each["steps"] for each in rivals}
        assert found["network:checkpoint-000001000.onnx"] == 1000
        assert found["network:checkpoint-000002000.onnx"] == 2000
        assert found["network:zoo:box_chase"] is None
        assert not any("Keyboard" in each["text"] for each in rivals)
        assert rivals[0] == {"value": "what-it-did", "text": "What it did", "steps": None}
        texts = [each["text"] for each in rivals]
        assert texts[1] == "The driver that it has now"
        assert "Network zoo:box_chase" in texts
        # what decides by more than the percept can't be asked
        assert not any(text.startswith("Program: BreadthFirst") for text in texts)

        told = page.done("compare", first="", second="network:checkpoint-000002000.onnx")
        assert (told["step"], told["count"]) == (0, 4)
        far = [abs(0.7 - far - 0.1) for far in percepts]
        assert told["distance"] == pytest.approx(far, abs=1e-3)
        forward = told["action"][0]
        assert (forward["name"], forward["now"]) == ("forward", pytest.approx(0.1, abs=1e-3))
        assert forward["then"] == pytest.approx(0.7 - percepts[0], abs=1e-3)
        assert told["first"]
        assert told["second"]
        did = page.done("compare", first="what-it-did", second="")
        assert (did["step"], did["largest"]) == (None, pytest.approx(0, abs=1e-6))
        other = "network:checkpoint-000002000.onnx"
        did = page.done("compare", first="what-it-did", second=other)
        assert did["distance"] == pytest.approx(far, abs=1e-3)
        assert did["first"] == ""
        assert did["second"] == told["second"]
        same = page.done("compare", first="", second="network:checkpoint-000001000.onnx")
        assert same["step"] is None
        assert same["largest"] == 0
        text = page.failed("compare", first="network:none.onnx", second="")["text"]
        assert "none.onnx" in text


def test_what_i_did_is_a_driver_and_my_keys_are_none() -> None:
    with panel_room() as room, room.page() as page:
        page.show("0", "past")
        for _ in range(4):
            page.done("decision")
        page.done("new_start")
        number = page.part("past", lambda m: m["episodes"])["episodes"][0]["number"]
        page.done("episode", number=number)
        until(lambda: room.context.player.frame_cache)
        rivals = page.done("rivals")["rivals"]
        assert rivals[0]["text"] == "What I did"
        assert "The driver that it has now" not in [each["text"] for each in rivals]
        told = page.done("compare", first="what-it-did", second="network:zoo:box_chase")
        assert told["count"] == 4
        assert told["step"] == 0
        assert told["action"][0]["now"] == 0  # no key was pressed
        assert told["first"] == ""
