"""An agent's blocks, driver and settings, changed through the panel's socket."""

import re
from collections.abc import Iterator

import pytest

from tests.page.panel.rooms import Message, PanelPage, PanelRoom, panel_room


@pytest.fixture
def room() -> Iterator[PanelRoom]:
    with panel_room() as room:
        yield room


@pytest.fixture
def page(room: PanelRoom) -> Iterator[PanelPage]:
    with room.page() as page:
        page.show("0", "blocks")
        yield page


def titles(part: Message, kind: str) -> list[str]:
    return [block["title"] for block in part["kinds"][kind]]


def test_the_blocks_of_an_agent(page: PanelPage) -> None:
    part = page.part("blocks")
    assert set(part["kinds"]) == {"sensors", "actuators", "rewards", "brains"}
    first = part["kinds"]["sensors"][0]
    assert first["path"] == ["sensors", 0]
    assert first["title"] == "Ray picture"
    assert not first["can_up"]
    assert first["can_down"]
    brain = part["kinds"]["brains"][0]
    assert brain["children"][0]["title"] == "Keys W, A, S, D"
    assert not brain["children"][0]["can_remove"]
    assert part["form"] is None
    assert part["undo"] == {"label": ""}


def test_a_block_is_added_changed_moved_and_deleted(page: PanelPage, room: PanelRoom) -> None:
    before = titles(page.part("blocks"), "actuators")
    done = page.done("add_block", **{"class": "GrabActuator", "parent": ["actuators"]})
    assert done["text"] == "Grab things added. It works right away."
    path = done["path"]
    assert path == ["actuators", len(before)]
    page.show("0", "blocks", block=path)
    form = page.part("blocks", lambda m: m["form"])["form"]
    assert form["title"] == "Grab things"
    field = next(each for each in form["fields"] if each["kind"] == "number")
    low = field["low"]
    failed = page.failed("change_block", path=path, values={field["name"]: "-1e9"})
    assert failed["problems"][0]["path"] == [field["name"]], low
    assert page.done("change_block", path=path, values={field["name"]: "1,5"})["text"].startswith(
        "Grab things changed."
    )
    moved = page.done("move_block", path=path, by=-1)
    assert moved["path"] == ["actuators", len(before) - 1]
    assert page.done("remove_block", path=moved["path"])["text"].startswith("Grab things deleted.")
    page.part("blocks", lambda m: titles(m, "actuators") == before)


def test_undo_and_redo_say_what_they_do(page: PanelPage) -> None:
    page.done("remove_block", path=["sensors", 0])
    part = page.part("blocks", lambda m: m["undo"]["label"])
    assert part["undo"]["label"] == "remove Ray picture"
    assert page.done("undo")["text"] == "Undone: remove Ray picture."
    page.part("blocks", lambda m: m["redo"]["label"])
    assert page.done("redo")["text"] == "Done again: remove Ray picture."
    page.done("undo")
    assert page.failed("undo")["text"] == "there is nothing to undo"


def test_a_block_is_switched_off_and_duplicated(page: PanelPage, room: PanelRoom) -> None:
    answer = page.done("switch_block", path=["sensors", 0], on=False)
    assert answer["text"].startswith("Ray picture turned off.")
    page.part("blocks", lambda m: not m["kinds"]["sensors"][0]["is_on"])
    done = page.done("duplicate_block", path=["sensors", 0])
    assert done["path"] == ["sensors", 1]
    sensors = room.editor.state.agent("0")["sensors"]
    assert sensors[0]["type"] == sensors[1]["type"]
    names = [sensor.perception_key for sensor in room.runner.sim.agents[0].sensors]
    assert len(set(names)) == len(names)
    assert (
        "stands alone" in page.failed("duplicate_block", path=["brains", 0, "controller"])["text"]
    )


def test_the_gallery_has_reasons_against_blocks(page: PanelPage) -> None:
    items = {each["class"]: each for each in page.done("gallery", kind="sensors")["items"]}
    assert items["BearingSensor"]["reason"] == ""
    assert items["LineSensor"]["reason"].startswith("It needs an area.")
    assert items["BearingSensor"]["question"] == "Where is ...?"


def test_the_driver(page: PanelPage) -> None:
    items = {each["name"]: each for each in page.done("drivers")["items"]}
    assert items["brain:0"]["is_chosen"]
    assert items["keys:StrikerController"]["reason"]
    answer = page.done("driver", name="network:zoo:box_chase")
    assert answer["text"] == "robot is now driven by the trained network."
    page.part("blocks", lambda m: m["driver"] != "brain:0")
    page.part("scene", lambda m: not m["agents"][0]["is_person"])
    assert "nobody is called" in page.failed("driver", name="script of mine")["text"]


def test_settings_of_the_agent(page: PanelPage) -> None:
    names = [field["name"] for field in page.part("blocks")["settings"]]
    assert "max_steps_per_episode" in names
    page.done("change_agent", values={"max_steps_per_episode": 77})
    failed = page.failed("change_agent", values={"skip_frame": "-4"})
    assert failed["problems"][0]["path"] == ["skip_frame"]
    failed = page.failed("change_agent", values={"skip_frmae": 4})
    assert "did you mean 'skip_frame'" in failed["text"]


@pytest.mark.parametrize(
    "path", [["sensors", 99], ["nothing", 0], ["sensors", "0"], [0], ["brains", 0, "controller"]]
)
def test_paths_that_lead_nowhere(page: PanelPage, path: list[object]) -> None:
    page.failed("remove_block", path=path)
    page.failed("add_block", **{"class": "TouchSensor", "parent": path})


def test_a_world_without_an_editor() -> None:
    with panel_room(can_edit=False) as room, room.page() as page:
        page.show("0", "agent", "blocks", "world")
        assert not page.part("scene")["can_edit"]
        text = page.failed("add_block", **{"class": "TouchSensor", "parent": ["sensors"]})["text"]
        assert text == "this world can be watched and driven here, but not changed"
        assert "blocks" not in page.parts


def test_a_block_that_holds_others_tells_what_can_be_added(page: PanelPage) -> None:
    added = page.done("add_block", **{"class": "OrRewardFunc"}, parent=["rewards"])
    part = page.part("blocks", lambda m: "Any of these" in titles(m, "rewards"))
    (both,) = [each for each in part["kinds"]["rewards"] if each["class"] == "OrRewardFunc"]
    (what,) = both["adds"]
    assert what == {
        "title": "Reward",
        "kind": "rewards",
        "parent": [*added["path"], "children"],
    }
    count = len(both["children"])
    page.done("add_block", **{"class": "TouchRewardFunc"}, parent=what["parent"])
    page.part("blocks", lambda m: len(m["kinds"]["rewards"][-1]["children"]) == count + 1)
    assert part["kinds"]["sensors"][0]["adds"] == []


def test_hints_are_plain_and_details_tell_names_and_ranges(room: PanelRoom) -> None:
    with room.page() as page:
        page.show("0", "blocks", block=["sensors", 0])
        form = page.part("blocks", lambda part: part["form"])["form"]
        fields = {each["name"]: each for each in form["fields"]}
    assert form["class"] == "RayCastingSensor"
    assert form["summary"] == "A small picture of what is ahead, made of rays."
    assert form["detail"].startswith("Codes and distances")
    assert fields["rows"]["hint"] == "How many rows."
    assert fields["rows"]["detail"] == "rows. Rows of rays. at least 1, at most 256"
    for field in fields.values():
        assert not re.search(r"[a-z]_[a-z]|[a-z][A-Z]|^True", field["hint"]), field["hint"]
