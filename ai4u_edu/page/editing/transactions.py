"""Changes that are checked, applied and recorded one after another, and undone."""

import math
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future
from dataclasses import dataclass, replace

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.base.parameters import ParameterProblem
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join
from ai4u_edu.page.editing import things
from ai4u_edu.page.editing.change_result import ChangeResult, When
from ai4u_edu.page.editing.drivers import DriverRegistry
from ai4u_edu.page.editing.dry_run import dry_run
from ai4u_edu.page.editing.errors import ChangeError
from ai4u_edu.page.editing.goals import with_goal
from ai4u_edu.page.editing.permissions import Permissions
from ai4u_edu.page.editing.proposals import Poses, Proposal
from ai4u_edu.page.editing.running_scene import RunningScene
from ai4u_edu.page.editing.state import EditState
from ai4u_edu.recording.scene_export import export_scene
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.scenes.scene import RANDOM_RESETS
from ai4u_edu.scenes.serialization import PlainDataError
from ai4u_edu.world import Pose, Region

MAX_UNDO_STEPS = 200
"""Changes that can be undone."""
MERGE_S = 1.0
"""Time within which a nudge is joined to the one before it."""


@dataclass(frozen=True)
class _Step:
    """One change that was made."""

    label: str
    before: EditState
    after: EditState
    poses_before: Poses
    """Earlier poses of the bodies that the change moved, by name."""
    poses_after: Poses
    """Poses to which the change moved them."""
    replaces_world: bool = False
    """True if the change opened another scene, or other agents made a new world necessary."""
    opened_before: EditState | None = None
    """The state that had been opened last, if the change opened another scene."""
    merge_key: str = ""
    """Key of :class:`~ai4u_edu.page.editing.proposals.Proposal`; empty for none."""

    @property
    def opens(self) -> bool:
        """True if the change opened another scene."""
        return self.opened_before is not None


class _History:
    """Changes that can be undone, and undone changes that can be redone."""

    def __init__(self) -> None:
        self._merge_until = 0.0
        self._done: list[_Step] = []
        self._undone: list[_Step] = []

    @property
    def last(self) -> _Step | None:
        """The change that undo takes back; None if there is none."""
        return self._done[-1] if self._done else None

    @property
    def next(self) -> _Step | None:
        """The change that redo makes again; None if there is none."""
        return self._undone[-1] if self._undone else None

    def add(self, step: _Step) -> None:
        """Add a new change, or join it to the last one; forget all undone ones."""
        now, last = time.monotonic(), self.last
        is_same = last is not None and step.merge_key and step.merge_key == last.merge_key
        if last is not None and is_same and now < self._merge_until:
            step = replace(step, before=last.before, poses_before=last.poses_before)
            self._done.pop()
        self._done = [*self._done, step][-MAX_UNDO_STEPS:]
        self._undone, self._merge_until = [], now + MERGE_S

    def move_back(self) -> None:
        """Mark the last change as undone."""
        self._merge_until = 0.0
        self._undone.append(self._done.pop())

    def move_forward(self) -> None:
        """Mark the change that was undone last as done again."""
        self._done.append(self._undone.pop())


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
        self._history = _History()
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

    @property
    def undo_label(self) -> str:
        """A few words about the change that undo takes back; empty if there is none."""
        step = self._history.last
        return step.label if step else ""

    @property
    def redo_label(self) -> str:
        """A few words about the change that redo makes again; empty if there is none."""
        step = self._history.next
        return step.label if step else ""

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
        step = self._history.last
        if step is None:
            raise ChangeError([ParameterProblem((), _("there is nothing to undo"))])
        when = self._apply(
            step.before, step.poses_before, step.replaces_world, self._seed(step.opens)
        )
        if step.opened_before is not None:
            self.opened = step.opened_before
        self._history.move_back()
        self._set_state(step.before)
        return ChangeResult(when, step.label)

    def redo(self) -> ChangeResult:
        """Make the change again that was undone last."""
        self._adopt_other_world()
        step = self._history.next
        if step is None:
            raise ChangeError([ParameterProblem((), _("there is nothing to do again"))])
        when = self._apply(
            step.after, step.poses_after, step.replaces_world, self._seed(step.opens)
        )
        if step.opens:
            self.opened = step.after
        self._history.move_forward()
        self._set_state(step.after)
        return ChangeResult(when, step.label)

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
                return ChangeResult("now", note=_("nothing is other than it was"))
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
        step = _Step(
            proposal.label,
            before,
            after,
            poses_before,
            poses,
            rebuilds,
            opened_before,
            proposal.merge_key,
        )
        self._history.add(step)
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
        before, recorder, sim = self.state, self._runner.recorder, self._runner.sim
        scene = before.description if recorder is None else recorder.scene or before.description
        goal = {"goal": sim.goal, "success": sim.success or None}
        description = export_scene(sim, scene.model_copy(update=goal))
        state = EditState(description, before.folder, source=before.source)
        self._running = RunningScene(self._runner, state, self._drivers)
        self._dragged = {}
        self._history.add(_Step(_("go on in another world"), before, state, {}, {}, True))
        self._set_state(state)


def _checked(propose: Callable[[], Proposal]) -> Proposal:
    """Return a proposal; errors of unusable arguments become a ChangeError with a sentence."""
    try:
        return propose()
    except AI4UError:
        raise
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        text = _(
            "expected values that can be used for it: {error}: {problem}",
            error=type(error).__name__,
            problem=str(error),
        )
        raise ChangeError([ParameterProblem((), text)]) from error


def _warnings(step: _Step) -> str:
    """Return what a person may not expect of a change; usually empty."""
    before, after = step.before.description, step.after.description
    warnings = [*_warnings_of_moved(after, step.poses_after)]
    if before.success and not after.success and not step.replaces_world:
        warnings.append(
            _("nothing pays {reward!r} any more: no goal is left", reward=before.success)
        )
    if not step.replaces_world and not before.floors and after.floors:
        warnings.append(_("the ground was endless; now there is ground on the floors only"))
    if not step.replaces_world and before.floors and not after.floors:
        warnings.append(_("without a floor the ground is endless"))
    if after.generate != before.generate and _is_beyond_floor(after):
        warnings.append(
            _("the field reaches beyond the floor: make it smaller, or the floor larger")
        )
    return join(warnings, "; ") if warnings else ""


def _is_beyond_floor(description: SceneDescription) -> bool:
    """Return True if a corner of the generated field has no floor."""
    if description.generate is None or not description.floors:
        return False
    (left, low), (right, high) = description.generate.bounds()
    floors = [Region(floor) for floor in description.floors]
    return not all(
        any(floor.contains(x, y) for floor in floors) for x in (left, right) for y in (low, high)
    )


def _warnings_of_moved(description: SceneDescription, names: Iterable[str]) -> Iterator[str]:
    """Yield why moved bodies will not stay where they are at the next reset."""
    bodies = {body.name: body for body in description.bodies}
    for name in names:
        random = bodies[name].random
        if random is not None and (random.x or random.y or random.places):
            yield _("chance finds another place for {name!r} at each reset", name=name)
        for agent in description.agents:
            actuators = agent.get("actuators", ()) if agent.get("body") == name else ()
            if any(actuator.get("type") == "RespawnActuator" for actuator in actuators):
                yield _("its RespawnActuator puts {name!r} elsewhere at each reset", name=name)
