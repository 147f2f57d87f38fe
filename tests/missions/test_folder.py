"""A teacher's folder of missions: read again when it changes, and its mistakes named."""

import json
import re
import textwrap
from pathlib import Path

import httpx
import jsonschema
import pytest

from ai4u_edu.base.errors import SceneError
from ai4u_edu.missions import mission_map, mission_schema
from ai4u_edu.missions.check import Check
from ai4u_edu.missions.mission import (
    CONTROLS,
    MAX_FILES,
    Mission,
    MissionFolder,
    Step,
    library_missions,
    read_mission,
)
from ai4u_edu.scenes.yaml.file import YamlFile
from tests.missions.test_run import TEXT
from tests.page.panel.rooms import PanelPage
from tests.playing import played
from tests.waiting import LIMIT_S


class Clock:
    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        self.now += 10.0
        return self.now


def test_a_saved_file_is_read_again(tmp_path: Path) -> None:
    folder, file = MissionFolder(tmp_path, Clock()), tmp_path / "mine.yaml"
    assert folder.missions() == library_missions()
    file.write_text(TEXT)
    assert folder.missions().get("mine").title == "Test"
    assert folder.missions().get("mine") is folder.missions().get("mine")
    file.write_text(TEXT.replace("title: Test", "title: Another test"))
    missions = folder.missions()
    assert missions.get("mine").title == "Another test"
    assert missions.get("mine").island == "My class"
    assert [*missions.by_name][-1] == "mine"
    file.unlink()
    assert folder.missions() == library_missions()


def test_a_mistake_names_file_line_and_a_suggestion(tmp_path: Path) -> None:
    (tmp_path / "good.yaml").write_text(TEXT)
    (tmp_path / "bad.yaml").write_text(TEXT.replace("    hints:", "    hinst:"))
    (tmp_path / "drive-1.yaml").write_text(TEXT)
    (tmp_path / "next.yaml").write_text(f"{TEXT}next: god\n")
    missions = MissionFolder(tmp_path, Clock()).missions()
    assert "good" in missions.by_name
    assert missions.problems == (
        "bad.yaml, line 8: steps[0].hinst: unknown parameter; did you mean 'hints'?",
        "drive-1.yaml: a mission of this name exists; rename the file",
        "next.yaml: next: no mission is called 'god'; did you mean 'good'?",
    )
    assert mission_map(tmp_path)().problems == list(missions.problems)


def test_a_folder_has_limits(tmp_path: Path) -> None:
    assert "found none" in MissionFolder(tmp_path / "none", Clock()).missions().problems[0]
    for number in range(MAX_FILES + 1):
        (tmp_path / f"m{number:03}.yaml").write_text("x")
    problems = MissionFolder(tmp_path, Clock()).missions().problems
    assert f"expected at most {MAX_FILES} files, got {MAX_FILES + 1}" in problems[0]
    assert len(problems) == 1 + MAX_FILES
    (tmp_path / "m000.yaml").write_text("#" * 70_000)
    (tmp_path / "m001.yaml").write_bytes(b"\xff")
    problems = MissionFolder(tmp_path, Clock()).missions().problems
    assert "expected at most 65536 bytes" in problems[1]
    assert "expected UTF-8 text" in problems[2]


@pytest.mark.parametrize(
    ("before", "after", "text"),
    [
        ("scene: maze", "scene: maize", "no scene is called 'maize'; did you mean 'maze'?"),
        ("type: drives", "type: drivs", "unknown type 'drivs'; did you mean 'drives'?"),
        ("metres: 2", "metres: far", "steps[0].check.metres: expected a number, got 'far'"),
        ("    by: keys", "    light: [Rum]", "no control is called 'Rum'; did you mean 'Run'?"),
        (
            "{type: drives, metres: 2}",
            '{type: holds, ranges: [{what: "hedding[0]", above: 1}]}',
            "the robot senses no 'hedding[0]'; did you mean 'heading'?",
        ),
        (
            "{type: drives, metres: 2}",
            "{type: is_paid, reward: exitt}",
            "the robot gets no reward 'exitt'; did you mean 'exit'?",
        ),
        (
            "{type: drives, metres: 2}",
            "{type: is_paid, block: TouchRewrdFunc}",
            "the robot gets no reward 'TouchRewrdFunc'; did you mean 'TouchRewardFunc'?",
        ),
        (
            "{type: drives, metres: 2}",
            "{type: holds, ranges: [{what: heading, above: 1}]}",
            "write heading[0] to heading[1]",
        ),
    ],
)
def test_wrong_files_are_refused_with_a_line(before: str, after: str, text: str) -> None:
    assert before in TEXT
    with pytest.raises(SceneError, match=r"^a\.yaml, line [0-9]+: ") as error:
        read_mission(TEXT.replace(before, after, 1), "a.yaml")
    assert text in str(error.value)


def test_the_schema_lists_all_kinds_of_checks() -> None:
    schema = mission_schema()
    json.dumps(schema)
    kinds = {each.model_fields["type"].default for each in Check.__subclasses__()}
    named = {
        definition["properties"]["type"]["const"]
        for definition in schema["$defs"].values()
        if "type" in definition["properties"]
    }
    assert named == kinds
    validator = jsonschema.Draft202012Validator(schema)
    validator.validate(YamlFile(TEXT, "a.yaml").data)
    assert not validator.is_valid(YamlFile(TEXT.replace("hints:", "hinst:"), "a.yaml").data)


HOW_TO = Path(__file__).parents[2] / "docs" / "how-to" / "write-a-mission.md"


def test_the_how_to_has_a_mission_that_works_and_all_kinds_of_checks() -> None:
    text = HOW_TO.read_text(encoding="utf-8")
    example = textwrap.dedent(text.partition("   ```yaml\n")[2].partition("   ```\n")[0])
    mission = read_mission(example, "stop-early.yaml")
    assert len(mission.steps) == 2
    rows = re.findall(r"^\| `(\w+)` \|", text.partition("## Checks")[2], re.MULTILINE)
    assert rows == [each.model_fields["type"].default for each in Check.__subclasses__()]
    for name in Mission.model_fields | Step.model_fields:
        assert f"`{name}`" in text


@pytest.mark.slow
def test_play_shows_a_teachers_missions_and_warns_of_wrong_ones(tmp_path: Path) -> None:
    (tmp_path / "mine.yaml").write_text(TEXT)
    (tmp_path / "bad.yaml").write_text("title: Bad\n")
    with played("maze", "--missions", str(tmp_path)) as world:
        view = httpx.get(f"{world.url}api/missions", timeout=LIMIT_S).json()
        assert view["missions"][-1] | {"name": "mine", "island": "My class"} == view["missions"][-1]
        assert "bad.yaml, line 1: scene: is missing and has no default" in view["problems"][0]
        with PanelPage(world.url + "ws/panel") as page:
            page.done("mission_open", mission="mine")
            page.part("mission", title="Test", is_here=True)


def test_the_how_to_names_all_controls() -> None:
    text = (Path(__file__).parents[2] / "docs/how-to/write-a-mission.md").read_text("utf-8")
    assert [name for name in CONTROLS if f"`{name}`" not in text] == []
