"""The things in the world and the scene itself, changed through the panel's socket."""

import base64
import io
import math
import re
from collections.abc import Iterator
from pathlib import Path
from uuid import uuid4

import numpy as np
import pytest
from PIL import Image

from ai4u_edu import Scene
from ai4u_edu.page.editing.scene_store import SceneStore
from ai4u_edu.page.editing.unsaved import Unsaved
from tests.page.panel.rooms import Message, PanelPage, PanelRoom, panel_room, picture
from tests.waiting import until


@pytest.fixture
def room() -> Iterator[PanelRoom]:
    with panel_room() as room:
        yield room


@pytest.fixture
def page(room: PanelRoom) -> Iterator[PanelPage]:
    with room.page() as page:
        page.show("0", "world")
        page.part("world")
        yield page


def things(part: Message) -> dict[str, Message]:
    return {thing["name"]: thing for thing in part["bodies"]}


def test_everything_in_the_scene_is_listed(page: PanelPage) -> None:
    listed = things(page.part("world"))
    assert listed["robot"]["kind"] == "agent"
    assert listed["box"]["kind"] == "body"
    assert {thing["kind"] for thing in listed.values()} == {"agent", "body", "floor"}
    # an actuator chooses where the robot starts
    assert [name for name, thing in listed.items() if thing["is_random"]] == ["robot"]


@pytest.mark.parametrize("template", ["wall", "box", "ball", "target", "lamp", "area", "floor"])
def test_things_are_added_and_deleted(page: PanelPage, room: PanelRoom, template: str) -> None:
    before = things(page.part("world"))
    done = page.done("add_body", template=template)
    (name,) = done["bodies"]
    assert name not in before
    assert done["text"].startswith(f"Added {name}.")
    part = page.part("world", lambda m: m["form"] and m["form"]["name"] == name)
    assert things(part)[name]["kind"] in {template, "body"}
    page.done("remove_bodies", names=[name])
    page.part("world", lambda m: things(m).keys() == before.keys())


def test_the_palette_has_a_picture_of_each_thing(page: PanelPage) -> None:
    items = {item["name"]: item for item in page.done("palette")["items"]}
    assert list(items) == ["wall", "box", "ball", "target", "lamp", "area", "floor", "agent"]
    assert len({item["url"] for item in items.values()}) == len(items)
    for item in items.values():
        data = base64.b64decode(item["url"].removeprefix("data:image/png;base64,"))
        picture = Image.open(io.BytesIO(data))
        opacity = np.asarray(picture)[..., 3]
        assert opacity[0].max() == 0 < opacity[48, 48]
    assert items["box"]["side_m"] == pytest.approx(0.8 * math.sqrt(2), rel=0.07)


@pytest.mark.parametrize("template", ["ball", "wall", "area"])
def test_a_thing_is_added_where_a_person_puts_it(page: PanelPage, template: str) -> None:
    done = page.done("add_body", template=template, x=-3, y=3.5)
    assert done["text"] == f"Added {template}."
    listed = things(page.part("world", lambda m: template in things(m)))[template]
    assert (listed["x"], listed["y"]) == (-3, 3.5)


def test_a_thing_whose_place_is_taken_is_put_beside_it(page: PanelPage) -> None:
    page.done("move_body", name="box", x=2, y=0)
    done = page.done("add_body", template="ball", x=2, y=0)
    assert "There was no room right there" in done["text"]
    listed = things(page.part("world", lambda m: "ball" in things(m)))["ball"]
    assert 0.8 < math.dist((listed["x"], listed["y"]), (2, 0)) < 2
    # neither can move, so they may overlap, as walls do at a corner
    for _ in range(2):
        assert "no room" not in page.done("add_body", template="wall", x=-3, y=3)["text"]


def test_a_thing_is_refused_where_it_would_fall(page: PanelPage) -> None:
    failed = page.failed("add_body", template="box", x=50, y=0)
    assert failed["text"] == "there is no floor: put it on a floor, or add a floor first"
    page.done("add_body", template="floor", x=50, y=0)
    page.done("add_body", template="box", x=50, y=0)
    page.failed("add_body", template="box", x=1e5, y=0)


def test_the_map_to_the_ground_needs_a_picture(room: PanelRoom, page: PanelPage) -> None:
    assert "not there yet" in page.failed("ground")["text"]
    page_id = uuid4().hex
    with room.page(f"?page={page_id}") as other, picture(room, page_id) as client:
        until(lambda: "matrix" in other.do("ground"))
        until(lambda: client.camera == "arena")
        matrix = np.reshape(other.done("ground")["matrix"], (3, 3))
        x, y, w = matrix @ (0.5, 0.5, 1)
        assert (x / w, y / w) == pytest.approx(client.ground_center, abs=0.01)


def test_an_agent_is_added_like_the_one_that_is_shown(page: PanelPage, room: PanelRoom) -> None:
    done = page.done("add_body", template="agent")
    page.part("scene", lambda m: len(m["agents"]) == 2)
    added = room.runner.sim.agents[1]
    assert [type(each) for each in added.sensors] == [
        type(each) for each in room.runner.sim.agents[0].sensors
    ]
    page.done("remove_bodies", names=done["bodies"])
    page.part("scene", lambda m: len(m["agents"]) == 1)
    assert "the only agent" in page.failed("remove_bodies", names=["robot"])["text"]


def test_a_thing_is_moved_nudged_and_copied(page: PanelPage, room: PanelRoom) -> None:
    assert page.done("move_body", name="box", x=2, y=-1)["text"].startswith("Moved box.")
    page.part("world", lambda m: (things(m)["box"]["x"], things(m)["box"]["y"]) == (2, -1))
    for number in range(100, 104):
        page.send({"type": "do", "id": number, "command": "nudge", "names": ["box"], "dx": 0.5})
    page.receive(lambda m: m.get("id") == 103)
    box = room.editor.state.description.bodies[-1]
    assert room.runner.sim.world["box"].pose[0] == pytest.approx(4.0)
    (copy,) = page.done("duplicate", names=["box"])["bodies"]
    assert copy == "box 2"
    assert things(page.part("world", lambda m: copy in things(m)))[copy]["shape"] == box.shape.type
    page.part("scene", undo={"label": "add box 2"})  # whichever tab is open
    page.done("undo")
    page.part("world", lambda m: copy not in things(m))


def test_several_things_are_one_step_of_undo(page: PanelPage, room: PanelRoom) -> None:
    page.done("add_body", template="wall", x=-4, y=3)
    page.done("add_body", template="ball", x=4, y=-3)
    names = ["ball", "wall"]

    def places(part: Message) -> dict[str, tuple[float, float]]:
        listed = things(part)
        return {name: (listed[name]["x"], listed[name]["y"]) for name in listed}

    before = places(page.part("world", lambda m: "ball" in things(m)))
    for command, arguments, label in (
        ("nudge", {"dx": 0.5, "turn_deg": 15.0}, "move 2 things"),
        ("align", {"how": "row"}, "move 2 things"),
        ("align", {"how": "column"}, "move 2 things"),
        ("duplicate", {}, "add 2 things"),
        ("remove_bodies", {}, "remove 2 things"),
    ):
        page.done(command, names=names, **arguments)
        assert room.editor.undo_label == label
        page.part("world", undo={"label": label})
        page.done("undo")
        page.part("world", lambda m: places(m) == before)
    assert page.done("align", names=names, how="row")["text"] == "Aligned 2 things."
    page.part("world", lambda m: things(m)["ball"]["y"] == things(m)["wall"]["y"] == 0)
    assert room.runner.sim.world["ball"].position == (4, 0)  # at once


def test_copies_keep_their_distances_and_find_room(page: PanelPage, room: PanelRoom) -> None:
    page.done("add_body", template="ball", x=-3, y=3)
    page.done("add_body", template="box", x=-2, y=3)
    first = page.done("duplicate", names=["ball", "box 2"])["bodies"]
    listed = things(page.part("world", lambda m: set(first) <= things(m).keys()))
    ball, box = (listed[name] for name in first)
    assert (box["x"] - ball["x"], box["y"] - ball["y"]) == (1, 0)
    assert page.failed("paste")["text"].startswith("nothing was copied yet")
    page.done("copy", names=["ball", "box 2"])
    pasted = page.done("paste", x=3, y=-3)["bodies"]
    listed = things(page.part("world", lambda m: set(pasted) <= things(m).keys()))
    assert [listed[name]["x"] for name in pasted] == [2.5, 3.5]
    page.done("open_scene", name="maze")
    assert len(page.done("paste", x=0, y=0)["bodies"]) == 2  # into another scene


def test_a_copied_agent_brings_its_blocks(page: PanelPage, room: PanelRoom) -> None:
    page.done("copy", names=["robot"])
    page.done("paste", x=3, y=3)
    page.part("scene", lambda m: len(m["agents"]) == 2)
    first, second = room.runner.sim.agents
    assert [type(each) for each in second.rewards] == [type(each) for each in first.rewards]
    assert "only agent" in page.failed("remove_bodies", names=["robot", "robot 2"])["text"]


def test_a_frame_and_a_click_find_things(page: PanelPage) -> None:
    page.done("add_body", template="area", x=-3, y=3)
    page.done("move_body", name="box", x=2, y=1)
    page.part("world", lambda m: things(m)["box"]["x"] == 2)
    frame = [[-4, 4], [3, 4], [3, 0.5], [-4, 0.5]]
    assert page.done("find_things", corners=frame)["names"] == ["box", "area"]
    for x, y, names in ((2.3, 1.3, ["box"]), (-3.5, 3, ["area"]), (50, 0, [])):
        assert page.done("find_things", corners=[[x, y]])["names"] == names
    assert page.done("find_things", corners=[[0, -4.5]])["names"] != []  # the plate
    page.failed("find_things", corners=[])
    page.failed("find_things", corners=[[0, 0]] * 9)


def test_names_of_several_things_are_checked(page: PanelPage) -> None:
    for command in ("nudge", "duplicate", "copy", "remove_bodies"):
        assert "did you mean 'box'" in page.failed(command, names=["bxo"])["text"]
        page.failed(command, names=[])
        page.failed(command, names=["box"] * 101)


def test_the_form_of_a_thing(page: PanelPage) -> None:
    page.show("0", "world", body="box")
    form = page.part("world", lambda m: m["form"])["form"]
    fields = {field["name"]: field for field in form["fields"]}
    assert fields["x"]["unit"] == "m"
    assert fields["kind"]["choices"][1] == "can be pushed"
    page.done("change_body", name="box", values={"length": "2,5", "kind": "stands still"})
    part = page.part("world", lambda m: not things(m)["box"]["movable"])
    assert next(f for f in part["form"]["fields"] if f["name"] == "length")["value"] == 2.5
    failed = page.failed("change_body", name="box", values={"width": -1})
    assert failed["problems"][0]["path"] == ["width"]
    failed = page.failed("change_body", name="box", values={"y": "up"})
    assert failed["problems"] == [{"path": ["y"], "text": "expected a number, got 'up'"}]


def test_easy_starts_of_a_thing(room: PanelRoom, page: PanelPage) -> None:
    room.editor.open(Scene.load("push_block")).result()
    page.show("0", "world", body="block")
    form = page.part("world", lambda m: m["form"] and m["form"]["name"] == "block")["form"]
    fields = {field["name"]: field for field in form["fields"]}
    assert fields["easy_x"]["shown"] == "-0.4, 0.4"
    assert "easy_scale" not in fields  # its size is the same at all starts
    page.done("change_body", name="block", values={"easy_x": "-1, 1", "easy_heading_deg": ""})
    assert "curriculum:\n      x: [-1.0, 1.0]\n      y: [-0.4, 0.4]\n    mass" in room.editor.text()
    for wrong in ("1", "-9, 9", "1, -1"):
        failed = page.failed("change_body", name="block", values={"easy_x": wrong})
        assert failed["problems"][0]["path"][-1] == "easy_x", failed
    page.done("change_body", name="block", values={"easy_x": "", "easy_y": ""})
    assert "curriculum" not in room.editor.text()


def test_settings_of_the_scene(page: PanelPage) -> None:
    page.done("change_settings", values={"goal": "Push it.", "gravity": "3"})
    page.part("scene", goal="Push it.")
    page.part("world", waits_for_reset=True)


def test_scenes_are_listed_opened_and_downloaded(page: PanelPage) -> None:
    items = {each["name"]: each for each in page.done("scenes")["items"]}
    assert re.fullmatch(r"api/scenes/maze.png\?v=\w{16}", items["maze"]["picture"])
    assert page.done("open_scene", name="maze")["text"] == "Opened Maze."
    page.part("scene", title="Maze")
    done = page.done("download")
    assert done["file"] == "maze.yaml"
    assert Scene.loads(done["content"]).description.name == "maze"
    assert "is called 'amze'" in page.failed("open_scene", name="amze")["text"]
    page.failed("open_scene", name="../maze", is_saved=True)


def test_a_scene_file_is_sent_in_parts(page: PanelPage) -> None:
    text = Scene.load("sumo").dumps().encode()
    page.socket.send(text[:100])
    page.socket.send(text[100:])
    done = page.done("load_text", name="mine.yaml", size=len(text))
    assert done["text"].startswith("Opened ")
    page.part("scene", scene="sumo")
    page.socket.send(text[:100])
    assert "got 100" in page.failed("load_text", name="mine.yaml", size=len(text))["text"]
    page.socket.send(b"\xff\xfe")
    assert "text file" in page.failed("load_text", name="mine.yaml", size=2)["text"]
    page.socket.send(b"agents: [")
    assert "mine.yaml" in page.failed("load_text", name="mine.yaml", size=9)["text"]


def mat(columns: int = 60, rows: int = 30) -> bytes:
    out = io.BytesIO()
    Image.new("RGB", (columns, rows), (200, 0, 0)).save(out, "PNG")
    return out.getvalue()


def lay(page: PanelPage, file: bytes, name: str = "My mat (2).png") -> Message:
    for start in range(0, len(file), 2**19):
        page.socket.send(file[start : start + 2**19])
    return page.do("lay_picture", name=name, size=len(file))


def test_a_picture_is_laid_scaled_moved_and_taken_away(page: PanelPage, room: PanelRoom) -> None:
    before = things(page.part("world"))
    answer = lay(page, mat())
    assert (answer["text"], answer["bodies"]) == ("Laid My mat 2.", ["My mat 2"])
    part = page.part("world", lambda m: m["form"] and m["form"]["name"] == "My mat 2")
    assert things(part)["My mat 2"]["kind"] == "picture"
    sides = {field["name"]: field["value"] for field in part["form"]["fields"]}
    assert list(sides) == ["x", "y", "heading_deg", "length", "width"]
    assert float(sides["length"]) == pytest.approx(2 * float(sides["width"]), abs=0.02)
    assert "data:image" not in str(part), "the panel needs no picture"
    page.done("change_body", name="My mat 2", values={"length": 4.0, "width": 2.0})
    page.done("move_body", name="My mat 2", x=1.0, y=-1.0, heading_deg=90.0)
    (laid,) = Scene.loads(page.done("download")["content"]).description.areas
    assert (laid.shape.outline()[0], laid.position) == ((2.0, 1.0), (1.0, -1.0))
    page.done("undo")
    page.done("undo")
    assert lay(page, mat())["bodies"] == ["My mat 3"]
    page.done("remove_bodies", names=["My mat 2", "My mat 3"])
    page.part("world", lambda m: things(m).keys() == before.keys())
    page.done("undo")
    page.part("world", lambda m: "My mat 2" in things(m))


def test_a_bad_picture_gets_a_sentence(page: PanelPage) -> None:
    for file, told in (
        (b"no picture", "mat.png: expected a PNG or JPEG file"),
        (mat()[:-40], "can't be read"),
        (mat(2001, 2000), "at most 4 megapixels, got 2001 x 2000"),
        (mat()[:8] + bytes(2**20), "at most 1 MB"),
    ):
        answer = lay(page, file, "mat.png")
        assert (answer["type"], told in answer["text"]) == ("failed", True), answer
    page.socket.send(mat())
    assert "send it again" in page.failed("lay_picture", name="mat.png", size=10)["text"]
    for _ in range(2):
        answer = lay(page, mat(1900, 1900), "???")
    assert "together at most 1 MB and 4 megapixels" in str(answer), answer


def test_a_scene_is_saved_and_replaced(page: PanelPage, room: PanelRoom, tmp_path: Path) -> None:
    assert "can't be saved" in page.failed("save_scene", name="mine")["text"]
    room.editor.scene_store = SceneStore(tmp_path)
    assert page.done("save_scene", name="mine")["saved_as"] == "mine"
    failed = page.failed("save_scene", name="mine")
    assert failed["code"] == "exists"
    page.done("save_scene", name="mine", over=True)
    assert [each["name"] for each in page.done("scenes")["items"] if each["is_saved"]] == ["mine"]
    page.done("open_scene", name="mine", is_saved=True)


def test_an_unsaved_scene_is_restored(page: PanelPage, room: PanelRoom, tmp_path: Path) -> None:
    text = Scene.load("maze").dumps()
    left = Unsaved(tmp_path / "x.unsaved", text, None, 1e9, "maze")
    room.editor.recovery.unsaved = left
    assert page.part("world", lambda m: m["unsaved"])["unsaved"]["name"] == "maze"
    assert page.done("restore")["text"] == "Restored Maze."
    assert page.part("world", title="Maze")["unsaved"] is None
    assert page.failed("restore")["text"] == "there is no unsaved scene"


def test_nudges_of_one_thing_are_undone_together(
    page: PanelPage, room: PanelRoom, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("ai4u_edu.page.editing.transactions.MERGE_S", math.inf)
    before = room.runner.latest.bodies
    for _ in range(3):
        page.done("nudge", names=["box"], dx=0.25, dy=0)
    moved = room.runner.latest.bodies
    page.done("nudge", names=["robot"], dx=0.25, dy=0)
    page.done("undo")
    assert room.runner.latest.bodies == moved != before
    page.done("undo")
    assert room.runner.latest.bodies == before
    assert room.editor.undo_label == ""
    page.done("redo")
    assert room.runner.latest.bodies == moved


def test_moving_with_the_mouse(room: PanelRoom) -> None:
    page_id = uuid4().hex
    with room.page(f"?page={page_id}") as page, picture(room, page_id) as client:
        page.show("0", "world")
        page.done("snap", distance=0.5)
        page.done("move_mode", on=True)
        until(lambda: client.is_move_mode and client.snap_m == 0.5)
        handles = next(
            part.part for part in room.viewer.parts if type(part.part).__name__ == "PageHandles"
        )
        until(lambda: handles.pages and next(iter(handles.pages.values())).node)  # type: ignore[attr-defined]
        assert client.panel is not None
        client.panel.on_selected("box")
        assert page.receive(lambda m: m["type"] == "selected")["body"] == "box"
        assert page.part("world", lambda m: m["form"])["form"]["name"] == "box"
        client.panel.on_dropped(room.editor.move_body("box", 3, 3))
        assert page.receive(lambda m: m["type"] == "note")["text"].startswith("Moved box.")


def field_of(part: Message) -> dict[str, Message]:
    return {field["name"]: field for field in part["field"]}


def test_a_field_by_chance_is_made_changed_drawn_again_and_undone(
    page: PanelPage, room: PanelRoom
) -> None:
    assert list(field_of(page.part("world"))) == ["type"]
    page.done("add_body", template="wall")
    drawn = things(page.part("world", lambda m: "wall" in str(list(things(m)))))
    done = page.done("change_field", values={"type": "maze"})
    assert done["text"].startswith("Here is the new field.")
    part = page.part("world", lambda m: len(m["field"]) > 1)
    fields = field_of(part)
    assert (fields["type"]["shown"], fields["width"]["low"], fields["width"]["high"]) == (
        "maze",
        2,
        20,
    )
    assert fields["width"]["hint"] == "Cells from left to right, 2 to 20."
    assert fields["goal"]["choices"][-1] == "exit"
    assert {*things(part)} == {*drawn, "exit"}, "what was drawn stays, and an exit is there"
    assert walls(room), "the field is there at once"

    page.done("change_field", values={"loops": "4"})
    text = room.editor.text()
    assert "generate:" in text
    assert "field wall" not in text
    before = walls(room)
    page.done("new_start")
    until(lambda: walls(room) != before)
    failed = page.failed("change_field", values={"width": "1"})
    assert failed["problems"] == [{"path": ["width"], "text": "expected at least 2, got 1"}]
    page.failed("change_field", values={"type": "lake"})

    page.done("undo")
    assert field_of(page.part("world", lambda m: field_of(m)["loops"]["value"] == 0))
    page.done("undo")
    part = page.part("world", lambda m: len(m["field"]) == 1)
    assert things(part) == drawn
    assert not walls(room)


def walls(room: PanelRoom) -> list[tuple[float, float]]:
    """Return where the walls of the generated field stand."""
    bodies = room.runner.sim.world.bodies
    return [body.position for name, body in bodies.items() if name.startswith("field wall")]


@pytest.mark.parametrize("kind", ["line", "rescue"])
def test_another_kind_of_field_keeps_the_size_and_says_what_is_impossible(
    page: PanelPage, room: PanelRoom, kind: str
) -> None:
    page.done("change_field", values={"type": "maze"})
    page.done("change_field", values={"width": "9", "height": "7"})
    page.done("change_field", values={"type": kind})
    part = page.part("world", lambda m: field_of(m).get("length"))
    assert field_of(part)["width"]["value"] == 9
    failed = page.failed("change_field", values={"length": "100"})
    assert "expected a length of at most" in failed["problems"][0]["text"]
    done = page.done("change_field", values={"width": "20", "height": "20"})
    assert "The field reaches beyond the floor" in done["text"]
    page.done("change_field", values={"type": "(none)"})
    assert room.editor.state.description.generate is None
