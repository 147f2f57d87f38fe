"""The check of a whole scene."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gymnasium.spaces import Box
from typer.testing import CliRunner

from ai4u_edu import Scene, Sensor, VelocitySensor, check_scene, check_sensor
from ai4u_edu.base.errors import SceneError
from ai4u_edu.check import Outcome
from ai4u_edu.check.rollout import standard_scene
from ai4u_edu.cli.main import app

SCENE = """
name: tiny
title: Tiny
goal: None.
controls: None.
rewards: None.
bodies:
  - name: robot
    shape: {type: circle}
  - name: box
    shape: {type: box}
    position: [3, 0]
agents:
  - body: robot
    sensors: [{type: SENSOR}]
    actuators: [{type: RBMoveActuator}]
    rewards: [{type: TouchRewardFunc, target: box, reward: 1}]
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""


def test_what_can_never_be_found_or_never_ends_is_told() -> None:
    rays = "LinearRayCastingSensor, group_code: {floor: 1, bxo: 2}"
    text = SCENE.replace("shape: {type: box}", "shape: {type: box}\n    tags: [box]")
    text = text.replace("reward: 1", "cause_episode_to_end: true").replace("SENSOR", rays)
    findings = {each.check: each for each in check_scene(Scene.loads(text), decisions=2).findings}
    groups, ends = findings["groups"], findings["ends"]
    assert (groups.outcome, ends.outcome) == (Outcome.WARNING, Outcome.WARNING)
    assert groups.text == (
        "agent '0', LinearRayCastingSensor 'linear_ray_casting': group_code: nothing that it could "
        "find carries the tag 'bxo'; did you mean 'box'?"
    )
    assert ends.text.startswith(
        "agent '0', TouchRewardFunc 'touch': expected an amount other than 0 in reward, got 0"
    )


class Leaving(Sensor):
    """Leaves its space after a while."""

    def space(self) -> Box:
        return Box(0.0, 3.0, (1,))

    def on_reset(self, agent: Any, view: Any) -> None:
        self.count = -1

    def read(self, body: Any, view: Any) -> float:
        self.count += 1
        return self.count


class Vanishing(Leaving):
    """Is not a number after a while."""

    def write(self, out: Any, body: Any, view: Any) -> None:
        self.count += 1
        out[0] = self.count if self.count < 3 else np.nan


class Still(Leaving):
    """Always reads 1."""

    def read(self, body: Any, view: Any) -> float:
        return 1.0


class Keeping(Leaving):
    """Forgets nothing."""

    def on_setup(self, agent: Any, view: Any) -> None:
        self.count = -1

    def on_reset(self, agent: Any, view: Any) -> None:
        pass

    def read(self, body: Any, view: Any) -> float:
        self.count += 1
        return self.count / 100


def found(sensor: str, **fields: Any) -> dict[str, tuple[str, str]]:
    scene = Scene.loads(SCENE.replace("SENSOR", sensor))
    report = check_scene(scene, decisions=10, **fields)
    return {each.check: (each.outcome.value, each.text) for each in report.findings}


def test_a_good_scene() -> None:
    report = found("VelocitySensor")
    assert {outcome for outcome, _ in report.values()} == {"passed", "warning"}
    assert report["pays"] == (
        "warning",
        "expected every reward to be paid at some time, got nothing from 'touch' of agent '0'; a "
        "random drive may just not have got there",
    )


@pytest.mark.parametrize(
    ("sensor", "check", "expected"),
    [
        (
            "Leaving",
            "in its space",
            (
                "FAILED",
                "expected readings as the sensors' spaces say: agent '0', 'leaving': numbers from "
                "0 to 3, got [4.0]",
            ),
        ),
        (
            "Vanishing",
            "in its space",
            (
                "FAILED",
                "expected readings as the sensors' spaces say: agent '0', 'vanishing': finite "
                "numbers, got [nan]",
            ),
        ),
        (
            "Still",
            "changes",
            (
                "warning",
                "expected readings that change, got always the same from 'still' of agent '0'",
            ),
        ),
    ],
)
def test_bad_sensors_are_found(sensor: str, check: str, expected: tuple[str, str]) -> None:
    assert found(sensor)[check] == expected


def test_a_scene_that_does_not_forget() -> None:
    report = found("Keeping")
    assert {name for name, (outcome, _) in report.items() if outcome == "FAILED"} == {"forgets"}
    assert report["forgets"][1].startswith("expected the same world again after a reset, got (")


def test_a_scene_without_words_is_a_warning() -> None:
    scene = Scene.loads(
        SCENE.replace("SENSOR", "VelocitySensor").replace("goal: None.\ncontrols: None.\n", "")
    )
    (finding,) = (
        each for each in check_scene(scene, decisions=2).findings if each.check == "documented"
    )
    assert (finding.outcome, finding.text) == (
        Outcome.WARNING,
        "expected a title, a goal, controls and rewards in words, got no goal, no controls",
    )


def test_an_unknown_scene() -> None:
    with pytest.raises(SceneError, match="no scene is called 'box_chse'; did you mean"):
        check_scene("box_chse")


def test_the_standard_world_is_in_order() -> None:
    assert check_scene(standard_scene()).ok


def test_blocks_can_be_checked_in_a_scene_of_ones_own() -> None:
    scene = Scene.loads(SCENE.replace("SENSOR", "Still"))
    assert check_sensor(VelocitySensor(), scene=scene, decisions=10).ok
    assert check_sensor(VelocitySensor(), scene="box_chase", decisions=10).ok


def test_two_agents_are_driven() -> None:
    second = """
  - id: "1"
    body: box
    sensors: [{type: Still}]
    brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""
    scene = Scene.loads(SCENE.replace("SENSOR", "VelocitySensor").rstrip("\n") + second)
    text = next(
        each.text for each in check_scene(scene, decisions=5).findings if each.check == "changes"
    )
    assert text == "expected readings that change, got always the same from 'still' of agent '1'"


def places(text: str) -> str:
    report = check_scene(Scene.loads(text), decisions=2)
    assert report.ok  # it is a warning at most
    return next(each.text for each in report.findings if each.check == "places")


def with_sensor(text: str) -> str:
    return text.replace("SENSOR", "VelocitySensor")


def test_places_that_nobody_means() -> None:
    text = with_sensor(SCENE)
    assert places(text) == ""
    fixed = text.replace("{type: circle}", "{type: circle}\n    kind: static")
    assert "agent '0' is on body 'robot', which can't move (its kind is 'static')" in places(fixed)
    plate = "floors:\n  - {name: plate, shape: {type: box, size: [4, 4]}}\nbodies:"
    falling = text.replace("bodies:", plate)
    assert "body 'box' begins over the void, at (3, 0), and falls" in places(falling)
    pose = "actuators: [{type: RespawnActuator, poses: [[0, 0, 0], [3.2, 0, 0]]}, "
    respawns = text.replace("actuators: [", pose)
    assert "pose 1 of 'respawn' of agent '0', (3.2, 0), lies in body 'box'" in places(respawns)
    assert "pose 1 of 'respawn' of agent '0', (3.2, 0), lies over the void" in places(
        respawns.replace("bodies:", plate)
    )


def senses_and_acts(text: str) -> tuple[str, str]:
    report = check_scene(Scene.loads(text), decisions=2)
    found = next(each for each in report.findings if each.check == "senses and acts")
    return found.outcome.value, found.text


def test_an_agent_senses_and_acts() -> None:
    text = with_sensor(SCENE)
    assert senses_and_acts(text) == ("passed", "")
    nothing = text.replace("sensors: [{type: VelocitySensor}]", "sensors: []")
    outcome, told = senses_and_acts(nothing)
    assert outcome == "warning"
    assert told.startswith("agent '0' has no sensor, so its brain knows nothing of the world")
    off = text.replace("{type: VelocitySensor}", "{type: VelocitySensor, is_active: false}")
    assert "agent '0' has no sensor" in senses_and_acts(off)[1]
    still = text.replace("[{type: RBMoveActuator}]", "[]")
    outcome, told = senses_and_acts(still)
    assert outcome == "warning"
    assert told.startswith("agent '0' has no actuator, so nothing that its brain decides has an")
    respawning = text.replace(
        "{type: RBMoveActuator}", "{type: RespawnActuator, poses: [[0, 0, 0]]}"
    )
    assert "agent '0' has no actuator" in senses_and_acts(respawning)[1]


@pytest.mark.parametrize(
    ("was", "becomes", "says"),
    [
        ("{type: circle}", "{type: circle}\n    kind: static", "which can't move"),
        (
            "bodies:",
            "floors: [{name: far, shape: {type: box, size: [1, 1]}, position: [9, 9]}]\nbodies:",
            "body 'robot' begins over the void",
        ),
        ("sensors: [{type: VelocitySensor}]", "sensors: []", "has no sensor"),
        ("actuators: [{type: RBMoveActuator}]", "actuators: []", "has no actuator"),
    ],
)
def test_the_command_gives_the_same_report(
    tmp_path: Path, was: str, becomes: str, says: str
) -> None:
    text = with_sensor(SCENE).replace(was, becomes)
    file = tmp_path / "tiny.yaml"
    file.write_text(text)
    result = CliRunner().invoke(app, ["check", str(file)])
    assert result.exit_code == 0
    assert says in result.output
    assert str(check_scene(Scene.loads(text))) in result.output


def test_the_command_fails_where_the_function_does(tmp_path: Path) -> None:
    file = tmp_path / "tiny.yaml"
    text = SCENE.replace("SENSOR", "Leaving")
    file.write_text(text)
    result = CliRunner().invoke(app, ["check", str(file)])
    report = check_scene(Scene.loads(text))
    assert (result.exit_code, report.ok) == (1, False)
    assert str(report) in result.output
