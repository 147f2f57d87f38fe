"""The part "why": off by default, per page, and as the planted policy says."""

from ai4u_edu import trained_brain
from tests.panel.rooms import panel_room
from tests.server.rooms import until


def test_it_comes_when_it_is_asked_for() -> None:
    with panel_room("maze") as room, room.page() as page, room.page() as other:
        agent = room.runner.sim.agents[0]
        room.runner.submit(lambda: agent.use_brain(trained_brain("zoo:maze"))).result(10)
        for each in (page, other):
            each.show("0", "agent")
            each.part("agent")
        assert "why" not in page.parts
        page.done("why", on=True)
        part = page.part("why")
        until(lambda: not page.part("why")["problem"])
        part = page.part("why")
        assert part["agent"] == "0"
        assert part["components"] == ["forward", "turn", "jump", "forward jump"]
        assert [slot["name"] for slot in part["slots"]][:2] == ["ray 1", "ray 2"]
        assert {slot["key"] for slot in part["slots"]} == {"vision", "heading", "last_action"}
        assert part["sentence"].startswith(("It ", "No single slot"))
        assert "Two slots that say the same" in part["limits"]
        shares = [slot["share"] for slot in part["top"]]
        assert shares == sorted(shares, reverse=True)
        assert "why" not in other.parts


def test_a_person_needs_no_explanation() -> None:
    with panel_room() as room, room.page() as page:
        page.show("0", "agent")
        page.done("why", on=True)
        assert page.part("why")["problem"].startswith("A person drives")
        assert page.part("why")["slots"] == []
