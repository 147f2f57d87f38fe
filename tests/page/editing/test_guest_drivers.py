"""Drivers that are in no scene file, and what happens to them when blocks are changed."""

from typing import Any

import pytest

from ai4u_edu import Controller, LocalBrain
from ai4u_edu.base.errors import AI4UError, BlockError
from ai4u_edu.blocks import RemoteBrain
from ai4u_edu.blocks.brains.links.link import LinkState
from tests.page.editing.harness import EditorHarness


class Line:
    """A connection over which nobody says anything; remembers what it was told."""

    state = LinkState.CONNECTED
    reason = ""
    ignored = 0
    time_asked_at = 0.0
    expects_reply = False
    will_notify = False

    def __init__(self) -> None:
        self.opened: list[Any] = []
        self.closed: list[str] = []

    def open(self, offer: Any) -> None:
        self.opened.append(offer)

    def ask(self, situation: Any, timeout: float) -> None:
        return None

    def tell(self, situation: Any) -> None: ...

    def note(self, warning: str) -> None:
        """Nobody is told."""

    def refuse(self, answered: Any, reason: str) -> bool:
        return False

    def idle(self) -> None: ...

    def close(self, reason: str) -> None:
        self.closed.append(reason)


class Picky(Controller):
    """Wants an actuator that is called "move"."""

    def on_setup(self, agent: Any, view: Any) -> None:
        if all(each.action_name != "move" for each in agent.actuators):
            raise BlockError("where is my move")

    def get_action(self, percept: Any) -> Any:
        return {}


@pytest.fixture
def harness() -> EditorHarness:
    harness = EditorHarness()
    harness.tick(3)
    return harness


def test_a_function_drives_on_whatever_is_changed(harness: EditorHarness) -> None:
    brain = LocalBrain(controller=lambda percept: {"move": [0, 0.5, 0, 0]}, skip_frame=0)
    harness.agent.use_brain(brain)
    harness.done(harness.editor.add_block("0", "sensors", {"type": "HeadingSensor"}))
    harness.done(harness.editor.move_body("wall", -4, 1))
    harness.tick(2)
    assert harness.agent.brain is brain
    assert harness.agent.last_action == {"move": (0, 0.5, 0, 0)}
    assert harness.editor.driver_of("0") == ""
    harness.done(harness.editor.set_driver("0", "brain:0"))
    assert harness.agent.brain is not brain
    assert harness.editor.driver_of("0") == "brain:0"


def test_a_body_that_does_not_fit_the_brain_is_not_given_to_it(harness: EditorHarness) -> None:
    """The brain's setup, the last step, fails: everything is rolled back, flags too."""
    harness.done(harness.editor.set_driver("0", "keys:Picky"))
    with pytest.raises(AI4UError, match="where is my move"):
        harness.done(harness.editor.change_block("0", ("actuators", 0), {"action_name": "go"}))
    assert [brain.enabled for brain in harness.agent.brains] == [False, True]
    assert list(harness.agent.bound_blocks.actuators) == ["move"]
    harness.tick(2)
    harness.done(harness.editor.undo())
    harness.tick(2)


def test_edits_keep_a_brain_that_took_over(harness: EditorHarness) -> None:
    harness.done(harness.editor.set_driver("0", "keys:WASDRBMoveController"))
    first = harness.agent.brains[0]
    harness.agent.use_brain(first)  # as a page does when somebody lets go
    harness.done(harness.editor.add_block("0", "sensors", {"type": "HeadingSensor"}))
    assert harness.agent.brain is first
    assert [brain.enabled for brain in harness.agent.brains] == [True, False]


def test_a_script_that_was_told_what_it_senses_has_to_come_again(harness: EditorHarness) -> None:
    line = Line()
    brain = RemoteBrain.with_link(line, mode="realtime")
    harness.agent.use_brain(brain)
    harness.tick(2)
    harness.done(harness.editor.move_body("wall", -4, 1))  # that changes nothing for it
    assert harness.agent.brain is brain
    assert line.closed == ["the agent is set up again"] * 0
    harness.done(harness.editor.add_block("0", "sensors", {"type": "HeadingSensor"}))
    assert harness.agent.brain is harness.agent.brains[0]
    assert all(each is not brain for each in harness.agent.brains)
    (told,) = line.closed
    assert told.startswith("the agent's blocks were changed; connect again")
    harness.tick(2)


def test_a_change_that_fails_leaves_the_driver_in_its_place(harness: EditorHarness) -> None:
    line = Line()
    brain = RemoteBrain.with_link(line, mode="realtime")
    harness.agent.use_brain(brain)
    fitting = harness.agent.bound_blocks
    with pytest.raises(Exception, match="perception_key"):
        harness.done(
            harness.editor.add_block("0", "sensors", {"type": "BearingSensor", "target": "wall"})
        )
    assert (harness.agent.brain, harness.agent.bound_blocks, line.closed) == (brain, fitting, [])
    harness.tick(2)
