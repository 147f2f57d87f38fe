"""The view of one page: an agent's readings, and its own picture."""

import base64
from collections.abc import Iterator
from dataclasses import replace
from uuid import uuid4

import pytest

from ai4u_edu.blocks import RemoteStatus
from ai4u_edu.page.panel.parts.agent import ScriptState, agent_part
from ai4u_edu.page.viewer.scene.view import Mode
from ai4u_edu.runtime.frame_budget import FrameBudget
from tests.page.panel.rooms import PanelRoom, panel_room, picture
from tests.waiting import until


@pytest.fixture(scope="module")
def room() -> Iterator[PanelRoom]:
    with panel_room() as room:
        yield room


@pytest.fixture(scope="module")
def several() -> Iterator[PanelRoom]:
    with panel_room("tag") as room:
        yield room


def test_parts_come_for_open_tabs_only(room: PanelRoom) -> None:
    with room.page() as page:
        for _ in range(2):  # all parts of the first moment come before those of the second
            before = page.part("run")["time_s"]
            page.done("tick")
            page.part("run", lambda m: m["time_s"] > before)  # noqa: B023
        assert "agent" not in page.parts
        page.show("0", "agent")
        assert page.part("agent")["title"] == "Agent 0: robot"


def test_readings_action_and_rewards() -> None:
    with panel_room("maze") as room, room.page() as page:
        page.show("0", "agent")
        page.done("decision")
        agent = page.part("agent")
        sensors = {sensor["class"]: sensor for sensor in agent["sensors"]}
        rays = sensors["LinearRayCastingSensor"]
        assert rays["is_drawable"]
        assert rays["is_shown"]
        assert rays["title"] == "Ray sensor"
        strips = rays["strips"]
        assert [strip["caption"].partition(" ")[0] for strip in strips] == ["what", "distance"]
        assert all(0 <= share <= 1 for strip in strips for share in strip["shares"])
        assert [each["actuator"] for each in agent["action"]] == ["move"] * len(agent["action"])
        assert agent["phases"]["now"] in {"sense", "reward"}
        python = page.part("python")
        assert "connect(" in python["lines"]
        (move,) = python["actuators"]
        assert (move["name"], move["is_choice"]) == ("move", False)
        forward = {"name": "forward", "low": -1.0, "high": 1.0, "has_effect": True}
        assert move["components"][0] == forward
        vision, heading, *_ = python["sensors"]
        assert (vision["key"], vision["slots"], vision["shape"]) == ("vision", [], [26])
        assert vision["rays"]["angles_deg"] == list(range(-90, 91, 15))
        assert vision["rays"]["codes"] == [["wall", 0.5], ["target", 1.0]]
        assert (vision["rays"]["reach"], vision["rays"]["reach_m"]) == (1.0, 12.0)
        cosine = {"name": "cosine", "unit": "", "low": -1.0, "high": 1.0}
        assert heading["slots"][1] == cosine


def test_a_program_knows_the_numbers_that_sensors_read() -> None:
    with panel_room("box_chase") as room, room.page() as page:
        page.show("0", "agent")
        sensors = {sensor["key"]: sensor for sensor in page.part("python")["sensors"]}
        assert (sensors["vision"]["stack"], sensors["vision"]["slots"]) == (4, [])
        assert [slot["name"] for slot in sensors["orientation"]["slots"]] == ["cosine", "distance"]
        assert [sensors[key]["kind"] for key in ("done", "id")] == ["bool", "text"]


def test_sensors_of_a_kind_can_be_told_apart() -> None:
    with panel_room("soccer") as room, room.page() as page:
        page.show("blue_striker", "agent")
        titles = [sensor["title"] for sensor in page.part("agent")["sensors"]]
        assert titles[:3] == ["Position: ball", "Position: goal", "Position: home"]
        assert len(set(titles)) == len(titles)


def test_a_sensor_is_hidden() -> None:
    with panel_room("maze") as room, room.page() as page:
        page.show("0", "agent")
        key = next(each["key"] for each in page.part("agent")["sensors"] if each["is_shown"])
        page.done("sensor", key=key, on=False)
        page.part(
            "agent",
            lambda m: not any(each["is_shown"] for each in m["sensors"] if each["key"] == key),
        )


def test_the_script_that_drives_an_agent(room: PanelRoom) -> None:
    snapshot = room.runner.latest
    remote = RemoteStatus("late", "no answer for 2 s", 7, 0, 0, 0, 3)
    counts = {"decisions": 7, "clipped": 3}
    for status, script in (
        (None, None),
        (remote, ScriptState("late", "no answer for 2 s", warning="", counts=counts)),
    ):
        agent = snapshot.agents[0]._replace(remote=status)
        assert agent_part(room.context, snapshot, agent, ()).script == script


def test_pages_of_one_world_look_at_the_same_moments_and_those_of_others_at_other_ones(
    room: PanelRoom,
) -> None:
    now = 0.0
    one, other = (replace(room.context, clock=lambda: now, began=began) for began in (0.0, 0.1))
    for now in (7.25, 7.35):
        assert now + one.until_next_look(0.4) == pytest.approx(7.6)
        assert now + other.until_next_look(0.4) == pytest.approx(7.3 if now < 7.3 else 7.7)


def test_the_trail_is_switched_on(room: PanelRoom, page_id: str) -> None:
    with room.page(f"?page={page_id}") as page, picture(room, page_id) as client:
        page.part("view", has_trail=False)  # a person drives
        page.done("trail", on=True)
        page.part("view", has_trail=True)
        until(lambda: client.shows_trail("0", is_default=False))


def test_a_picture_is_sent_as_png() -> None:
    with panel_room("grid_world") as room, room.page() as page:
        page.show("0", "agent")
        pictures = [p for each in page.part("agent")["sensors"] for p in each.get("pictures", ())]
        data = base64.b64decode(pictures[0]["cells"].partition(",")[2])
        assert data.startswith(b"\x89PNG")


@pytest.fixture
def page_id() -> str:
    return uuid4().hex


def test_choices_reach_the_picture_of_the_same_page(room: PanelRoom, page_id: str) -> None:
    with room.page(f"?page={page_id}") as page:
        page.done("camera", mode="follow")  # before viser's connection
        with picture(room, page_id) as client:
            until(lambda: client.view.mode is Mode.FOLLOW)
            page.done("camera", mode="turn")
            assert client.view.mode is Mode.TURN
            page.done("dark", on=True)
            assert client.is_dark
        until(lambda: room.viewer.viewer_clients.find(page_id) is None)
        with picture(room, page_id) as again:  # as after a lost connection
            until(lambda: again.view.mode is Mode.TURN and again.is_dark)


def test_a_panel_knows_what_its_picture_shows(room: PanelRoom, page_id: str) -> None:
    with picture(room, page_id) as client:
        with room.page(f"?page={page_id}") as page:
            page.part("view", camera="arena", has_trail=False)
            until(lambda: client.panel is not None)
            page.done("camera", mode="follow")
            page.done("trail", on=True)
            page.part("view", camera="follow", has_trail=True)
        with room.page(f"?page={page_id}") as page:  # as after a lost connection
            page.part("view", camera="follow", has_trail=True)
            assert client.view.mode is Mode.FOLLOW
    with room.page(f"?page={uuid4().hex}") as page:  # as after a reload
        page.part("view", camera="arena", has_trail=False)


def test_nothing_pulses_while_a_page_prefers_less_motion(room: PanelRoom, page_id: str) -> None:
    pages = room.viewer.viewer_clients
    with room.page(f"?page={page_id}") as page, picture(room, page_id):
        for is_on in (False, True, False):
            page.done("reduce_motion", on=is_on)
            until(lambda: pages.is_motion_reduced == is_on)  # noqa: B023


def test_other_pages_keep_their_view(room: PanelRoom, page_id: str) -> None:
    with (
        room.page(f"?page={page_id}") as page,
        picture(room, page_id) as mine,
        picture(room, uuid4().hex) as other,
    ):
        page.done("camera", mode="eyes")
        until(lambda: mine.view.mode is Mode.EYES)
        assert other.view.mode is Mode.ARENA


def test_a_click_in_the_picture_chooses_an_agent(several: PanelRoom, page_id: str) -> None:
    with several.page(f"?page={page_id}") as page, picture(several, page_id) as client:
        page.show("0", "agent")
        until(lambda: client.panel is not None)
        body, agent = next(
            (body, agent)
            for body, agent in several.runner.latest.static_scene.agent_of.items()
            if agent != "0"
        )
        client.panel.on_selected(body)  # type: ignore[union-attr]
        selected = page.receive(lambda m: m["type"] == "selected")
        assert selected == {"type": "selected", "body": body, "agent": agent}
        page.part("agent", id=agent)
        assert client.agent == agent


def test_a_page_asks_for_an_agent(several: PanelRoom) -> None:
    ids = [agent.id for agent in several.runner.sim.agents]
    with several.page(f"?agent={ids[-1]}") as page:
        page.part("run")
        page.show("nobody", "agent")  # it keeps its own
        page.part("agent", id=ids[-1])
    with several.page("?agent=nobody") as page:
        page.part("run")


def test_odd_page_ids_are_refused(room: PanelRoom) -> None:
    with room.page("?page=../../x") as page:
        assert page.end()[0] == 1008


def test_a_page_opens_with_a_tilt_once(room: PanelRoom, page_id: str) -> None:
    with room.page(f"?page={page_id}") as page:
        page.part("view", opening="none")
        page.done("opening", on=True)  # before viser's connection
        with picture(room, page_id) as client:
            until(lambda: client.opening != "none")
            page.done("opening", on=False)
            page.part("view", opening="over")
            page.done("opening", on=True)
            page.done("camera", mode="follow")
            page.part("view", camera="follow", opening="over")


def test_a_page_with_few_pictures_does_not_open_with_a_tilt(page_id: str) -> None:
    with (
        panel_room(frames=FrameBudget(15.5, 15.0)) as room,
        room.page(f"?page={page_id}") as page,
        picture(room, page_id),
    ):
        page.done("opening", on=True)
        page.part("view", opening="over")
