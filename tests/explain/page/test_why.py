"""The part "why": off by default, per page, and as the planted policy says."""

from typing import Any

import pytest

from ai4u_edu import trained_brain
from ai4u_edu.explain.live import MIN_MEAN_PERCEPTS
from tests.page.panel.rooms import Message, panel_room
from tests.waiting import LIMIT_S


def test_it_comes_when_it_is_asked_for() -> None:
    with panel_room("maze") as room, room.page() as page, room.page() as other:
        agent = room.runner.sim.agents[0]
        room.runner.submit(lambda: agent.use_brain(trained_brain("zoo:maze"))).result(LIMIT_S)
        for each in (page, other):
            each.show("0", "agent")
            each.part("agent")
        assert "why" not in page.parts
        page.done("why", on=True)
        part = page.part("why", problem="")
        assert part["agent"] == "0"
        assert part["components"] == ["forward", "turn", "jump", "forward jump"]
        assert [slot["name"] for slot in part["slots"]][:2] == ["ray 1", "ray 2"]
        assert {slot["key"] for slot in part["slots"]} == {"vision", "heading", "last_action"}
        assert part["sentence"].startswith(("It ", "No single slot"))
        assert "Two numbers that say the same" in part["limits"]
        shares = [slot["share"] for slot in part["top"]]
        assert shares == sorted(shares, reverse=True)
        page.done("why", on=False)
        page.parts.clear()
        page.done("why", on=True)  # the world stands still, so it is as before
        assert page.part("why")["sentence"] == part["sentence"]
        other.done("gallery", kind="sensors")  # now it has read what was sent before
        assert "why" not in other.parts


def test_a_person_needs_no_explanation() -> None:
    with panel_room() as room, room.page() as page:
        page.show("0", "agent")
        page.done("why", on=True)
        assert page.part("why")["problem"].startswith("You are driving.")
        assert page.part("why")["slots"] == []


def test_what_if_a_number_were_another_one() -> None:
    with panel_room() as room, room.page() as page:
        agent = room.runner.sim.agents[0]

        def steer(percept: Any) -> Any:
            return {"move": [1, percept["orientation"][0] / 2, 0, 0]}

        room.runner.submit(lambda: agent.use_brain(steer)).result(LIMIT_S)
        page.show("0", "agent")
        told = page.done("what_if", changes=[])
        (dial,) = [each for each in told["dials"] if each["name"] == "orientation: ahead?"]
        assert (dial["key"], dial["index"], dial["low"], dial["high"]) == ("orientation", 0, -1, 1)
        assert dial["value"] == pytest.approx(agent.percept["orientation"][0], abs=1e-6)
        forward, turn = told["action"][:2]
        assert (forward["name"], forward["now"], forward["then"]) == ("forward", 1, 1)
        assert turn["now"] == turn["then"] == pytest.approx(dial["value"] / 2, abs=1e-4)
        change = {"key": "orientation", "index": 0, "value": -0.5}
        told = page.done("what_if", changes=[change])
        assert told["action"][1]["then"] == -0.25
        assert told["action"][1]["now"] == turn["now"]
        # numbers stay in the sensor's range, and the world stays as it is
        told = page.done("what_if", changes=[change | {"value": -7.0}])
        assert told["action"][1]["then"] == -0.5
        assert agent.percept["orientation"][0] == pytest.approx(dial["value"])
        text = page.failed("what_if", changes=[change | {"index": 2}])["text"]
        assert "expected a number from 0 to 1, got 2" in text
        text = page.failed("what_if", changes=[change | {"key": "orientatoin"}])["text"]
        assert "did you mean 'orientation'" in text


def test_in_a_recorded_episode_the_baseline_is_its_mean() -> None:
    with panel_room() as room, room.page() as page:
        agent = room.runner.sim.agents[0]

        def steer(percept: Any) -> Any:
            return {"move": [0, percept["orientation"][0] / 2 + 0.5, 0, 0]}

        room.runner.submit(lambda: agent.use_brain(steer)).result(LIMIT_S)
        page.show("0", "agent", "past")
        page.done("why", on=True)
        assert page.part("why", problem="")["baseline"] == "the middle of its range"
        seen = []
        for _ in range(MIN_MEAN_PERCEPTS):
            seen.append(agent.percept["orientation"][0])
            page.done("decision")
        page.done("new_start")
        number = page.part("past", lambda m: m["episodes"])["episodes"][0]["number"]
        page.done("episode", number=number)
        page.done("step", step=20)
        words = f"the mean of 50 percepts of episode {number}"
        moved = seen[20] - sum(seen) / len(seen)

        def explains_the_step(part: Message) -> bool:
            """Return True for the decision that was chosen; the first one was shown before."""
            (slot,) = [each for each in part["slots"] if each["name"] == "orientation: ahead?"]
            return bool(slot["shares"][1] == pytest.approx(moved / 2 / 2, abs=1e-3))

        page.part("why", explains_the_step, baseline=words)
        page.done("back_to_live")
        assert "episode" not in page.part("why", lambda m: m["baseline"] != words)["baseline"]
