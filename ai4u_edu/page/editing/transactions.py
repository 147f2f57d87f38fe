"""Changes that are checked, applied and recorded one after another, and undone."""

import math
from collections.abc import Callable
from concurrent.futures import Future

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.base.parameters import Problem
from ai4u_edu.page.editing import things
from ai4u_edu.page.editing.apply import RunningScene
from ai4u_edu.page.editing.change_result import ChangeResult, When
from ai4u_edu.page.editing.drivers import DriverRegistry
from ai4u_edu.page.editing.dry_run import dry_run
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.goals import with_goal
from ai4u_edu.page.editing.history import History, Step
from ai4u_edu.page.editing.move_warnings import move_warnings
from ai4u_edu.page.editing.permissions import Permissions
from ai4u_edu.page.editing.proposals import Poses, Proposal
from ai4u_edu.page.editing.state import EditState
from ai4u_edu.recording.scene_export import export_scene
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes.scene import RANDOM_RESETS
from ai4u_edu.scenes.serialization import PlainDataError
from ai4u_edu.world import Pose


class Transactions:
    """The wanted state, its history, and the running scene that follows it.

    :meth:`submit` may be called from any thread; everything else belongs to the runner's thread.

    Args:
        runner: runs the world.
        state: the state that the world was built from.
        drivers: makes the brains that are in no scene description.
    """

    def __init__(self, runner: Runner, state: EditState, drivers: DriverRegistry) -> None:
        self._runner = runner
        self._drivers = drivers
        self._running = RunningScene(runner, state, drivers)
        self._dragged: dict[str, Pose] = {}
        self.permissions = Permissions(state.description.agents)
        self.history = History()
        self.listeners: list[Callable[[EditState], object]] = []
        """Called with the state after each change."""
        self.state = state
        self.opened = state
        """The state that was opened last, before any change."""
        self.version = 0

    @property
    def waits_for_reset(self) -> bool:
        """True if some change takes effect at the next reset only."""
        return self._running.waits_for_reset

    @property
    def is_dragging(self) -> bool:
        """True while some body is dragged."""
        return bool(self._dragged)

    def submit(
        self, propose: Callable[[], Proposal], *, whole: bool = False, driver_of: str = ""
    ) -> "Future[ChangeResult]":
        """Make a change between two decisions.

        Args:
            propose: works out the wanted state from the state at that time.
            whole: True if another scene is opened, which replaces the world at once.
            driver_of: the agent whose driver was chosen; it takes control again even if it was
                chosen before.
        """
        return self._runner.submit(lambda: self._carry_out(propose, whole, driver_of))

    def undo(self) -> ChangeResult:
        """Take back the last change."""
        self._adopt_other_world()
        step = self.history.last
        if step is None:
            raise ChangeError([Problem((), "there is nothing to undo")])
        when = self._apply(
            step.before, step.poses_before, step.replaces_world, self._seed(step.opens)
        )
        if step.opened_before is not None:
            self.opened = step.opened_before
        self.history.move_back()
        self._set_state(step.before)
        return ChangeResult(when, f"undo: {step.label}")

    def redo(self) -> ChangeResult:
        """Make the change again that was undone last."""
        self._adopt_other_world()
        step = self.history.next
        if step is None:
            raise ChangeError([Problem((), "there is nothing to do again")])
        when = self._apply(
            step.after, step.poses_after, step.replaces_world, self._seed(step.opens)
        )
        if step.opens:
            self.opened = step.after
        self.history.move_forward()
        self._set_state(step.after)
        return ChangeResult(when, f"redo: {step.label}")

    def drag(self, name: str, x: float, y: float, heading_deg: float | None) -> None:
        """Move a body without recording a change, and remember where the drag began."""
        things.check_dragged(x, y, heading_deg)
        self._adopt_other_world()
        things.body_named(self.state, name)
        body, before = self._runner.sim.world[name], self.pose(name)
        heading = None if heading_deg is None else math.radians(heading_deg)
        body.move_to(x, y, heading=heading)
        self._dragged.setdefault(name, before)
        self._running.mark_edited()

    def cancel_drag(self, name: str) -> None:
        """Put a dragged body back where the drag began."""
        pose = self._dragged.pop(name, None)
        if pose is not None and name in self._runner.sim.world.bodies:
            self._runner.sim.world[name].move_to(pose[0], pose[1], heading=pose[2])
            self._running.mark_edited()

    def pose(self, name: str) -> Pose:
        """Return the present pose of a body."""
        x, y, _, heading = self._runner.sim.world[name].pose
        return x, y, heading

    def _carry_out(
        self, propose: Callable[[], Proposal], whole: bool, driver_of: str
    ) -> ChangeResult:
        self._adopt_other_world()
        before = self.state
        poses: Poses = {}
        try:
            proposal = _checked(propose)
            after, poses = proposal.state, proposal.poses
            if not whole:
                after = with_goal(before, after)
            rebuilds = whole or proposal.restarts
            if after == before and driver_of:
                self._running.restore_driver(driver_of)
                self._set_state(after)
                return ChangeResult("next decision", proposal.label)
            if after == before and not whole and not poses:
                return ChangeResult("now", note="nothing is other than it was")
            self.permissions.check(after.description.agents)
            has_moved = after.description.things != before.description.things
            dry_run(after, proposal.path, resets=RANDOM_RESETS if has_moved else 1)
            poses_before = {name: self._dragged.get(name) or self.pose(name) for name in poses}
            when = self._apply(after, poses, rebuilds, self._seed(whole))
        except BaseException as error:
            for name in poses:
                self.cancel_drag(name)
            if isinstance(error, PlainDataError):
                raise ChangeError(error.problems) from None
            raise
        self._dragged = {name: pose for name, pose in self._dragged.items() if name not in poses}
        opened_before = self.opened if whole else None
        step = Step(
            proposal.label,
            before,
            after,
            poses_before,
            poses,
            rebuilds,
            opened_before,
            proposal.merge_key,
        )
        self.history.add(step)
        if whole:
            self.opened = after
            self._runner.resume()  # who opens a scene does not think of a pause in another one
        self._set_state(after)
        return ChangeResult(when, proposal.label, _warnings(step))

    def _seed(self, opens: bool) -> int | None:
        """Return the seed of a rebuilt world: another one if a scene is opened."""
        return None if opens else self._runner.sim.world.seeds.seed

    def _apply(self, state: EditState, poses: Poses, rebuilds: bool, seed: int | None) -> When:
        if rebuilds:
            self._dragged = {}
            self._running.rebuild(state, seed)
            return "now"
        return self._running.apply(state, poses)

    def _set_state(self, state: EditState) -> None:
        self.state = state
        self.version += 1
        for listener in self.listeners:
            listener(state)

    def _adopt_other_world(self) -> None:
        """Follow the runner if it runs another world, such as one continued from a recording."""
        if self._running.is_current:
            return
        before = self.state
        description = export_scene(self._runner.sim, before.description)
        state = EditState(description, before.folder, source=before.source)
        self._running = RunningScene(self._runner, state, self._drivers)
        self._dragged = {}
        self.history.add(Step("go on in another world", before, state, {}, {}, True))
        self._set_state(state)


def _checked(propose: Callable[[], Proposal]) -> Proposal:
    """Return a proposal; errors of unusable arguments become a ChangeError with a sentence."""
    try:
        return propose()
    except AI4UError:
        raise
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        text = f"expected values that can be used for it: {type(error).__name__}: {error}"
        raise ChangeError([Problem((), text)]) from error


def _warnings(step: Step) -> str:
    before, after = step.before.description, step.after.description
    warnings = [move_warnings(after, step.poses_after)]
    if before.success and not after.success and not step.replaces_world:
        warnings.append(f"nothing pays {before.success!r} any more: no goal is left")
    if not step.replaces_world and not before.floors and after.floors:
        warnings.append("the ground was endless; now there is ground on the floors only")
    if not step.replaces_world and before.floors and not after.floors:
        warnings.append("without a floor the ground is endless")
    return "; ".join(filter(None, warnings))
