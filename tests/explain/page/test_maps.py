"""Maps over the floor and poses that are tried, as a page asks for them."""

from typing import Any
from uuid import uuid4

import pytest

from ai4u_edu import trained_brain
from ai4u_edu.explain import map_maker
from ai4u_edu.explain.page.choice import choice_of
from tests.page.panel.rooms import PanelRoom, panel_room, picture
from tests.waiting import LIMIT_S, until


def drive(room: PanelRoom, brain: Any) -> None:
    agent = room.runner.sim.agents[0]
    room.runner.submit(lambda: agent.use_brain(brain)).result(LIMIT_S)


def is_complete(part: dict[str, Any]) -> bool:
    told = part["field"] or part["values"]
    return bool(told) and told["done"] == told["count"]


def test_each_page_has_its_own_maps(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(map_maker, "CELLS", 16)
    monkeypatch.setattr(map_maker, "ROLLOUT_CELLS", 4)
    page_id = uuid4().hex
    with (
        panel_room() as room,
        room.page(f"?page={page_id}") as page,
        room.page() as other,
        picture(room, page_id) as client,
    ):
        drive(room, trained_brain("zoo:box_chase"))
        for each in (page, other):
            each.show("0", "agent")
            each.part("agent")
        page.done("maps", field=True, values=False, facing="box")
        part = page.part("maps", is_complete)
        assert (part["agent"], part["problem"], part["faced"]) == ("0", "", ["box"])
        assert part["field"] == {"done": 16, "count": 16, "seconds": 0.0}
        assert part["values"] is None
        until(lambda: choice_of(client).maps == (True, False, "box"))
        other.done("maps", field=False, values=True)
        values = other.part("maps", is_complete)["values"]
        assert values["low"] < values["high"] <= 100
        assert values["words"].startswith("The colours are the points of one try from there")
        assert len(values["colours"]) == 13
        assert choice_of(client).maps == (True, False, "box")
        page.done("maps", field=True, values=False, facing="bax")
        assert "did you mean 'box'" in page.part("maps", lambda part: part["problem"])["problem"]
        page.done("maps", field=False, values=False)
        until(lambda: choice_of(client).maps == (False, False, ""))


def test_a_person_is_no_policy() -> None:
    with panel_room() as room, room.page() as page:
        page.show("0", "agent")
        page.done("maps", field=True, values=False)
        part = page.part("maps", lambda part: part["problem"])
        assert part["problem"].startswith("You are driving.")
        assert part["field"] is None
        page.parts.clear()
        page.done("maps", field=True, values=True)
        # the page has cleared both and waits, though nothing is other than it was
        assert page.part("maps")["problem"] == part["problem"]
        assert page.failed("elsewhere")["text"].startswith("You are driving.")


def test_if_it_stood_elsewhere() -> None:
    page_id = uuid4().hex
    with (
        panel_room() as room,
        room.page(f"?page={page_id}") as page,
        picture(room, page_id) as client,
    ):

        def steer(percept: Any) -> Any:
            return {"move": [1, percept["orientation"][0] / 2, 0, 0]}

        drive(room, steer)
        page.show("0", "agent")
        robot = room.runner.sim.agents[0].body
        before = robot.pose
        here = page.done("elsewhere")
        assert (here["x"], here["y"]) == pytest.approx(robot.position, abs=1e-3)
        assert here["can_stand"]
        turn = here["action"][1]
        assert (turn["name"], turn["now"]) == ("turn", pytest.approx(turn["then"], abs=1e-3))
        there = page.done("elsewhere", x=0, y=0, heading_deg=180)
        assert there["action"][1]["then"] == pytest.approx(0.5, abs=1e-3)  # it faces the box
        assert there["action"][1]["now"] == turn["now"]
        assert not page.done("elsewhere", x=40, y=0, heading_deg=0)["can_stand"]
        assert robot.pose == before
        until(lambda: (tried := choice_of(client).elsewhere) is not None and tried.pose.x == 40)
        # dragged in the picture: the page is told, and asks
        assert client.panel is not None
        client.panel.send({"type": "stand_in", "x": 1.0, "y": 2.0, "heading_deg": 28.6})
        told = page.receive(lambda message: message["type"] == "stand_in")
        assert (told["x"], told["y"], told["heading_deg"]) == (1.0, 2.0, 28.6)
        page.done("hide_elsewhere")
        until(lambda: choice_of(client).elsewhere is None)
        assert "expected" in page.failed("elsewhere", x="left", y=0, heading_deg=0)["text"]


def test_at_a_moment_of_the_past() -> None:
    page_id = uuid4().hex
    with (
        panel_room() as room,
        room.page(f"?page={page_id}") as page,
        picture(room, page_id) as client,
    ):
        drive(room, trained_brain("zoo:box_chase"))
        page.show("0", "agent", "past")
        before = page.done("elsewhere")
        for _ in range(5):
            page.done("decision")
        page.done("new_start")
        part = page.part("past", lambda m: m["episodes"])
        page.done("episode", number=part["episodes"][0]["number"])
        page.done("step", step=3)
        page.part("past", lambda m: m["is_showing"])
        until(lambda: room.runner.latest.past)
        there = page.done("elsewhere")
        shown = room.runner.latest.bodies[0]
        assert (there["x"], there["y"]) == (
            pytest.approx(shown.x, abs=1e-3),
            pytest.approx(shown.y, abs=1e-3),
        )
        assert (there["x"], there["y"]) != (before["x"], before["y"])
        assert there["can_stand"]
        page.done("maps", field=True, values=False)
        told = page.part("maps", is_complete)
        assert told["field"]["seconds"] == pytest.approx(room.runner.latest.time, abs=0.01)
        until(lambda: choice_of(client).elsewhere is not None)
