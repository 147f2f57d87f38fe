"""Labels in the scene, with the state of remote scripts."""

import math
from dataclasses import replace
from typing import Any

import pytest

from ai4u_edu.blocks import RemoteStatus
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.page.viewer.scene.labels import Labels
from ai4u_edu.page.viewer.scene.view import Mode
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.snapshot import Snapshot
from ai4u_edu.snapshot.agent_words import script_problem
from tests.page.viewer.pages import page, part_of


def with_script(snapshot: Snapshot, state: Any) -> Snapshot:
    status = RemoteStatus(state, "", 0, 0, 0, 0, 0)
    return replace(snapshot, agents=(snapshot.agents[0]._replace(remote=status),))


def written(viewer: Viewer) -> list[str]:
    handles: Any = part_of(viewer, Labels).labels
    return [label.handle.text for label in handles]


@pytest.mark.parametrize(
    ("how", "words"),
    [("waiting", "waits for its script"), ("late", "decides too late"), ("lost", "script is lost")],
)
def test_the_state_of_a_script_stands_at_its_agent_in_words(
    viewer: Viewer, runner: Runner, how: str, words: str
) -> None:
    assert written(viewer)[0] == "robot"
    part = part_of(viewer, Labels)
    troubled = with_script(runner.latest, how)
    part.draw(troubled)
    assert written(viewer)[0].startswith("robot ")
    assert words in written(viewer)[0]
    assert words not in "".join(written(viewer)[1:])
    part.draw(with_script(runner.latest, "connected"))
    assert written(viewer)[0] == "robot"


def test_a_script_whose_actions_have_no_effect_is_named_at_its_agent(
    viewer: Viewer, runner: Runner
) -> None:
    agent = runner.latest.agents[0]
    status = RemoteStatus("connected", "", 0, 0, 0, 1, 0, 1, "agent '0' has no actuator 'mvoe'")
    part_of(viewer, Labels).draw(replace(runner.latest, agents=(agent._replace(remote=status),)))
    assert "its script sends what has no effect" in written(viewer)[0]


def test_agent_without_a_script_has_no_script_problem(runner: Runner) -> None:
    assert script_problem(runner.latest.agents[0]) == ""


def test_the_label_of_a_driven_agent_is_hidden(viewer: Viewer, runner: Runner) -> None:
    part, snapshot = part_of(viewer, Labels), runner.latest
    handles: Any = part.labels

    def shows(held: str, time: float, state: str = "connected") -> bool:
        held_keys = frozenset(held.split())
        now = with_script(replace(snapshot, time=time), state)
        part.draw(replace(now, agents=(now.agents[0]._replace(held_keys=held_keys),)))
        assert handles[1].handle.visible  # the box
        return bool(handles[0].handle.visible)

    assert shows("", 3.0)
    assert not shows("KeyW", 3.1)
    assert shows("KeyW", 3.2, state="lost")
    assert not shows("", 3.5)
    assert shows("", 4.5)
    assert not shows("KeyW", 4.6)
    assert shows("", 0.0)  # after a reset


def test_the_label_is_behind_the_agent_where_the_camera_turns_with_it(
    viewer: Viewer, runner: Runner
) -> None:
    part, snapshot = part_of(viewer, Labels), runner.latest
    robot, *others = snapshot.bodies
    south = robot._replace(heading=-math.pi / 2)  # its face is where shared labels are
    turned = replace(snapshot, bodies=(south, *others))

    def label_y() -> float:
        viewer.viewer_clients.refresh()
        part.draw(turned)
        labels: Any = part.turned.get(number, part.labels)
        return float(labels[0].handle.position[1])

    with page(viewer):
        viewer.viewer_clients.refresh()
        ((number, shown),) = viewer.viewer_clients.items()
        assert label_y() < south.y
        shown.view.choose(Mode.TURN)
        assert label_y() > south.y
        assert part.turned[number][0].handle.name == part.labels[0].handle.name
        shown.view.choose(Mode.ARENA)
        assert label_y() < south.y


def test_a_label_that_would_cover_a_more_important_one_is_hidden(
    viewer: Viewer, runner: Runner
) -> None:
    part, snapshot = part_of(viewer, Labels), runner.latest
    robot, box, *others = snapshot.bodies

    def shows(x: float, y: float) -> tuple[bool, bool]:
        """Return whether robot and box have their label while the box is there, as the robot's."""
        bodies = (robot, box._replace(x=robot.x + x, y=robot.y + y), *others)
        part.draw(replace(snapshot, bodies=bodies))
        return part.labels[0].handle.visible, part.labels[1].handle.visible

    assert shows(5.0, 0.0) == (True, True)
    assert shows(0.1, 0.1) == (True, False)
    assert shows(5.0, 0.0) == (True, True)


def test_a_thing_in_an_area_hides_the_area_s_label(viewer: Viewer, runner: Runner) -> None:
    part, snapshot = part_of(viewer, Labels), runner.latest
    (area,) = part.areas
    robot, *others = snapshot.bodies

    def shows(dx: float) -> bool:
        there = robot._replace(x=area.place[0] + dx, y=area.place[1])
        part.draw(replace(snapshot, bodies=(there, *others)))
        return bool(area.handle.visible)

    assert shows(-4.0)
    assert not shows(0.0)
    assert shows(-4.0)
