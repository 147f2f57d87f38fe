"""The parts on the wire have the keys and types of the structs that the page's types come from."""

import json
from pathlib import Path
from typing import Any

import msgspec
import pytest

from ai4u_edu.page.messages import to_json
from ai4u_edu.page.panel.parts.part import PanelPart
from ai4u_edu.page.panel.parts.training import TrainingPart, training_part
from ai4u_edu.runtime.training_progress import CurvePoint, TrainingProgress
from tests.page.panel.rooms import panel_room

TYPES = {
    str(kind.__struct_defaults__[0]): kind
    for kind in PanelPart.__subclasses__()
    if kind.__module__.startswith(PanelPart.__module__.rpartition(".")[0])
}
"""Structs by the name of their part, without those of options."""
OF_BROWSER_TESTS = Path(__file__).parents[2] / "browser" / "panel_parts.json"
EDITED = {"blocks", "world"}
"""Parts of a world that can be changed."""


@pytest.mark.parametrize(
    ("scene", "can_edit"),
    [("box_chase", True), ("forage", True), ("grid_world", False), ("soccer", False)],
)
def test_all_parts_of_a_world(scene: str, can_edit: bool) -> None:
    with panel_room(scene, can_edit=can_edit) as room, room.page() as page:
        agent = room.runner.sim.agents[0]
        tabs = "agent", "blocks", "world", "past"
        page.show(agent.id, *tabs, block=["sensors", 0], body=agent.body_name)
        page.done("decision")
        page.done("new_start")  # keeps the first episode
        page.done("episode", number=1)
        page.part("past", lambda message: message["playing"])
        names = TYPES.keys() - {"training"} - (set() if can_edit else EDITED)
        for name in names:
            check(page.part(name), TYPES[name])


def test_the_part_of_a_training() -> None:
    curve = (
        CurvePoint(decisions=10, reward=0.5, success=None),
        CurvePoint(decisions=20, reward=1.0, success=0.5),
    )
    progress = TrainingProgress(decisions=20, total=100, is_over=False, curve=curve)
    check(plain(training_part(progress)), TrainingPart)


def check(message: Any, kind: type[PanelPart]) -> None:
    # a key that the struct does not know would get lost
    assert plain(msgspec.convert(message, kind)) == message


def plain(part: PanelPart) -> Any:
    return msgspec.json.decode(to_json(part))


def test_the_parts_that_browser_tests_show_are_such() -> None:
    for name, part in json.loads(OF_BROWSER_TESTS.read_text(encoding="utf-8")).items():
        msgspec.convert(part, TYPES[name])
