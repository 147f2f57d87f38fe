"""How changes are carried out, one after the other, and taken back."""

import math
from collections.abc import Callable
from concurrent.futures import Future

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.base.parameters import Problem
from ai4u_edu.editing import bodies
from ai4u_edu.editing.apply import Live
from ai4u_edu.editing.blocks import BlockPath
from ai4u_edu.editing.change_result import ChangeResult, When
from ai4u_edu.editing.drivers import DriverRegistry
from ai4u_edu.editing.dry_run import THOROUGHLY, tried
from ai4u_edu.editing.errors import ChangeError
from ai4u_edu.editing.history import History, Step
from ai4u_edu.editing.move_warnings import note_on
from ai4u_edu.editing.permissions import Trust
from ai4u_edu.editing.state import EditState
from ai4u_edu.recording.scene_export import export_scene
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes.serialization import PlainDataError
from ai4u_edu.world import Pose

Made = tuple[EditState, str, BlockPath]
"""What is wanted, what is done to get there, and the place in the scene that it is about."""


class Bench:
    """The state that is wanted, what it was before, and the world that is made to fit it.

    All but :meth:`do` belongs to the runner's thread.

    Args:
        runner: whose world it is.
        state: what that world was built from.
        drivers: make the brains that are in no description.
    """

    def __init__(self, runner: Runner, state: EditState, drivers: DriverRegistry) -> None:
        self._runner = runner
        self._drivers = drivers
        self._live = Live(runner, state, drivers)
        self._held: dict[str, Pose] = {}
        self.trust = Trust(state.description.agents)
        self.history = History()
        self.listeners: list[Callable[[EditState], object]] = []
        """Called with the state after each change."""
        self.state = state
        self.opened = state
        """What was opened last, before any change."""
        self.version = 0

    @property
    def waits_for_reset(self) -> bool:
        """Whether something comes with the next reset only."""
        return self._live.is_due

    def do(
        self,
        make: Callable[[], Made],
        *,
        places: dict[str, Pose] | None = None,
        whole: bool = False,
        drives: str = "",
    ) -> "Future[ChangeResult]":
        """Has a change made, between two decisions.

        Args:
            make: works out what is wanted from what is then.
            places: where bodies are put, by name; filled by ``make``.
            whole: whether it is another scene, which runs at once in place of this one.
            drives: the agent whose driver is chosen, even if it is the one that it should have.
        """
        now = {} if places is None else places
        return self._runner.submit(lambda: self._do(make, now, whole, drives))

    def undo(self) -> ChangeResult:
        """Takes the last change back."""
        self._adopt()
        step = self.history.last
        if step is None:
            raise ChangeError([Problem((), "there is nothing to undo")])
        when = self._bring_about(step.before, step.was, step.whole)
        if step.whole and step.opened is not None:
            self.opened = step.opened
        self.history.back()
        self._became(step.before)
        return ChangeResult(when, f"undo: {step.label}")

    def redo(self) -> ChangeResult:
        """Makes it again."""
        self._adopt()
        step = self.history.next
        if step is None:
            raise ChangeError([Problem((), "there is nothing to do again")])
        when = self._bring_about(step.after, step.now, step.whole)
        if step.whole:
            self.opened = step.after
        self.history.forth()
        self._became(step.after)
        return ChangeResult(when, f"redo: {step.label}")

    def drag(self, name: str, x: float, y: float, heading_deg: float | None) -> None:
        """A hand holds a body there."""
        bodies.check_held(x, y, heading_deg)
        self._adopt()
        bodies.body_named(self.state, name)
        body, before = self._runner.sim.world[name], self.pose(name)
        heading = None if heading_deg is None else math.radians(heading_deg)
        body.move_to(x, y, heading=heading)
        self._held.setdefault(name, before)
        self._live.stir()

    def cancel_drag(self, name: str) -> None:
        """The hand puts it back where it was."""
        pose = self._held.pop(name, None)
        if pose is not None and name in self._runner.sim.world.bodies:
            self._runner.sim.world[name].move_to(pose[0], pose[1], heading=pose[2])
            self._live.stir()

    def pose(self, name: str) -> Pose:
        """Where a body is now."""
        x, y, _, heading = self._runner.sim.world[name].pose
        return x, y, heading

    def _do(
        self, make: Callable[[], Made], now: dict[str, Pose], whole: bool, drives: str
    ) -> ChangeResult:
        self._adopt()
        before = self.state
        try:
            after, label, where = _made(make)
            if after == before and drives:
                self._live.hand_back(drives)
                self._became(after)
                return ChangeResult("next decision", label)
            if after == before and not whole and not now:
                return ChangeResult("now", note="nothing is other than it was")
            self.trust.check(after.description.agents)
            moves = after.description.things != before.description.things
            tried(after, where, episodes=THOROUGHLY if moves else 1)
            was = {name: self._held.get(name) or self.pose(name) for name in now}
            when = self._bring_about(after, now, whole)
        except BaseException as error:
            for name in now:
                self.cancel_drag(name)
            if isinstance(error, PlainDataError):
                raise ChangeError(error.problems) from None
            raise
        self._held = {name: pose for name, pose in self._held.items() if name not in now}
        self.history.add(Step(label, before, after, was, now, whole, self.opened))
        if whole:
            self.opened = after
        self._became(after)
        notes = [note_on(after.description, now)]
        if before.description.success and not after.description.success and not whole:
            notes.append(f"nothing pays {before.description.success!r} any more: no goal is left")
        return ChangeResult(when, label, "; ".join(filter(None, notes)))

    def _bring_about(self, state: EditState, places: dict[str, Pose], whole: bool) -> When:
        if whole:
            self._held = {}
            self._live.build_anew(state)
            return "now"
        return self._live.bring_about(state, places)

    def _became(self, state: EditState) -> None:
        self.state = state
        self.version += 1
        for listener in self.listeners:
            listener(state)

    def _adopt(self) -> None:
        """Somebody else had another world run, such as one that goes on from a recording."""
        if self._live.is_ours:
            return
        before = self.state
        description = export_scene(self._runner.sim, before.description)
        state = EditState(description, before.folder, source=before.source)
        self._live = Live(self._runner, state, self._drivers)
        self._held = {}
        self.history.add(Step("go on in another world", before, state, {}, {}, whole=True))
        self._became(state)


def _made(make: Callable[[], Made]) -> Made:
    """Work out a change; whatever it was asked with, what is wrong is told in a sentence."""
    try:
        return make()
    except AI4UError:
        raise
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        text = f"expected values that can be used for it: {type(error).__name__}: {error}"
        raise ChangeError([Problem((), text)]) from error
