"""The running world that is brought from one state to another."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import cached_property
from typing import Any, TypeVar, cast

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.rebind import Blocks, rebind, sense_again
from ai4u_edu.base.errors import AI4UError, WorldError
from ai4u_edu.base.parameters import default_of
from ai4u_edu.blocks import Actuator, Block, Brain, RemoteBrain, RewardFunc, Sensor
from ai4u_edu.blocks.brains.network import files_in
from ai4u_edu.page.editing.change_result import When
from ai4u_edu.page.editing.drivers import DriverRegistry
from ai4u_edu.page.editing.plain import Plain
from ai4u_edu.page.editing.settings import RUNTIME_PARAMETERS
from ai4u_edu.page.editing.state import EditState
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.scenes.serialization import from_plain
from ai4u_edu.world import (
    AreaDescription,
    BodyDescription,
    FloorDescription,
    Pose,
    World,
    edit_body,
    insert_body,
    put_region,
    reorder,
    sampled_region,
)

B = TypeVar("B", bound=Block)
_Region = FloorDescription | AreaDescription


class RunningScene:
    """The running world and the state that it shows. Only the runner's thread calls it.

    Args:
        runner: runs the world.
        state: the state that the world was built from.
        drivers: makes the brains that are in no scene description.
    """

    def __init__(self, runner: Runner, state: EditState, drivers: DriverRegistry) -> None:
        self._runner = runner
        self._drivers = drivers
        self.shown = state
        """The state that the running world has."""
        self.wanted = state
        """The state that it has after the next reset."""
        self._follow_sim()

    @property
    def waits_for_reset(self) -> bool:
        """True if some change takes effect at the next reset only."""
        return self.shown != self.wanted

    @property
    def is_current(self) -> bool:
        """True unless somebody else had the runner run another world meanwhile."""
        return self._runner.sim is self._sim

    def apply(self, state: EditState, poses: Mapping[str, Pose]) -> When:
        """Apply as much of a state as a running world can take; the next reset applies the rest.

        Args:
            state: the wanted state.
            poses: of bodies that are moved; other bodies go where the state says.

        Raises:
            AI4UError: it is not possible; everything was rolled back.
        """
        difference = _StateDifference(self.shown, state)
        applied = difference.applicable_now
        if difference.has_changed or poses:
            try:
                self._apply_now(applied, poses)
            except AI4UError:
                self._describe(self.shown.description)
                if applied == state and difference.concerns_one_thing:
                    raise
                # it may depend on the part that comes with the reset, or things change places
                applied = self.shown
        self.shown, self.wanted = applied, state
        self._describe(self.shown.description)
        if applied != state:
            return "next reset"
        return "now" if difference.concerns_no_agent else "next decision"

    def rebuild(self, state: EditState, seed: int | None = None) -> None:
        """Build a new world from a state and run it in place of the present one."""
        sim = state.scene.build()
        for agent in sim.agents:
            if agent.id in state.drivers:
                driver = self._drivers.brain(state.drivers[agent.id], agent.id, agent.brain)
                agent.use_brain(driver)
        if self._runner.recorder is not None:
            self._runner.recorder.scene = state.description
        self._runner.replace_sim_now(sim, seed=seed)
        self.shown = self.wanted = state
        self._follow_sim()

    def restore_driver(self, agent_id: str) -> None:
        """Hand an agent back from a person or a script to the driver that the state names."""
        self._edits(self._sim.agent(agent_id)).restore_driver(self.shown)

    def mark_edited(self, *, sense: bool = True) -> None:
        """End the recorded episode, and have all agents sense the changed world again."""
        if self._runner.recorder is not None:
            self._runner.recorder.finish()
        for agent in self._sim.agents if sense else ():
            sense_again(agent)

    def _apply_now(self, state: EditState, poses: Mapping[str, Pose]) -> None:
        sim, before = self._sim, self.shown
        things = _ThingEdits(sim.world)
        is_unstarted = self._is_unstarted()
        world_changed = things.apply(before.description, state.description, poses)
        done: list[tuple[BasicAgent, Blocks]] = []
        try:
            for agent in sim.agents:
                blocks = Blocks.of(agent)
                if self._edits(agent).apply(before, state, world_changed=world_changed):
                    done.append((agent, blocks))
        except BaseException:
            things.undo()
            for agent in sim.agents:
                _set_runtime_parameters(agent, before.agent(agent.id))
            for agent, blocks in done:
                rebind(agent, sim.world, blocks)
            raise
        if not world_changed and _without_brains(before) == _without_brains(state):
            return  # a recording does not depend on which brain drives
        if is_unstarted:
            self._describe(state.description)  # the episode that begins is recorded with it
            sim.reset(sim.world.seeds.seed)
            things.restore_poses(poses)
        if not is_unstarted or things.has_moved_back:
            self.mark_edited(sense=world_changed)

    def _edits(self, agent: BasicAgent) -> "_AgentEdits":
        return _AgentEdits(agent, self._sim.world, self._drivers)

    def _is_unstarted(self) -> bool:
        """Return True if nothing has happened yet, so that the episode may just begin again."""
        agents = self._sim.agents
        return self._sim.world.ticks == 0 and not any(
            agent.steps or isinstance(agent.brain, RemoteBrain) for agent in agents
        )

    def _describe(self, scene: SceneDescription) -> None:
        """Pass the scene's name, goal and start on to whoever shows or records it."""
        self._sim.goal = scene.goal
        self._sim.success = scene.success or ""
        self._sim.wait_for_key = scene.wait_for_key
        if self._runner.recorder is not None:
            self._runner.recorder.scene = scene

    def _follow_sim(self) -> None:
        self._sim = self._runner.sim
        self._episode = self._sim.episode
        self._sim.agents[0].begin_of_episode.connect(self._on_episode_begin)

    def _on_episode_begin(self, _agent: BasicAgent) -> None:
        sim = self._sim
        if sim.episode == self._episode:
            return  # this agent alone began again, not the world
        self._episode = sim.episode
        if self.waits_for_reset and self.is_current:
            seed = sim.world.seeds.seed
            # later: the reset that raised this event is still under way
            self._runner.submit(lambda: self._rebuild_if_due(seed))

    def _rebuild_if_due(self, seed: int) -> None:
        if self.waits_for_reset and self.is_current:
            self.rebuild(self.wanted, seed)


class _StateDifference:
    """Difference between the state of a running world and the wanted one.

    Args:
        old: the state that the world has.
        new: the wanted state.
    """

    def __init__(self, old: EditState, new: EditState) -> None:
        self._old, self._new = old, new

    @property
    def has_changed(self) -> bool:
        """True if some of it can be applied now."""
        return self.applicable_now != self._old

    @property
    def concerns_no_agent(self) -> bool:
        """True if only bodies, floors, areas and texts differ."""
        same = self._old.description.agents == self._new.description.agents
        return same and self._old.drivers == self._new.drivers

    @cached_property
    def applicable_now(self) -> EditState:
        """The state that the world can have before its next reset: the new one, or part of it."""
        new = self._new.description
        of_page = ("name", "title", "goal", "controls", "rewards", "wait_for_key")
        fields = {name: getattr(new, name) for name in of_page}
        state = self._old.describing(**fields)
        state = state.describing(floors=new.floors, areas=new.areas, bodies=new.bodies)
        if self._has_same_agents():
            state = state.describing(agents=new.agents, success=new.success)
            state = replace(self._new, description=state.description)
        return state

    @property
    def concerns_one_thing(self) -> bool:
        """True if at most one body, floor or area was added, removed or changed."""
        old = {thing.name: thing for thing in self._old.description.things}
        new = {thing.name: thing for thing in self._new.description.things}
        names = dict.fromkeys((*old, *new))
        return sum(old.get(name) != new.get(name) for name in names) <= 1

    def _has_same_agents(self) -> bool:
        """Return True if no parameter differs that needs a new agent."""

        def fixed(state: EditState) -> list[dict[str, object]]:
            changeable = {*RUNTIME_PARAMETERS, "sensors", "actuators", "rewards", "brains"}
            agents = state.description.agents
            return [{k: v for k, v in agent.items() if k not in changeable} for agent in agents]

        return fixed(self._old) == fixed(self._new)


class _ThingEdits:
    """One transaction of changes to the things in a world; :meth:`undo` rolls it back.

    Args:
        world: the world of the things.
    """

    def __init__(self, world: World) -> None:
        self._world = world
        self._undo_steps: list[Callable[[], object]] = []
        self.has_moved_back = False
        """True if :meth:`restore_poses` had to move a body."""

    def apply(
        self, old: SceneDescription, new: SceneDescription, poses: Mapping[str, Pose]
    ) -> bool:
        """Turn the things of one scene into those of another, and return True if any changed.

        Raises:
            WorldError: it is not possible; everything was rolled back.
        """
        before = {body.name: body for body in old.bodies}
        after = {body.name: body for body in new.bodies}
        try:
            self._apply_regions(old, new)
            for name in before:
                if name not in after:
                    self._remove(name)
            self._put_all(
                {
                    name: (before.get(name), body, poses.get(name))
                    for name, body in after.items()
                    if body != before.get(name) or name in poses
                }
            )
        except BaseException:
            self.undo()
            raise
        if self._undo_steps:
            reorder(self._world, [thing.name for thing in new.things])
        return bool(self._undo_steps)

    def _put_all(
        self, changes: Mapping[str, tuple[BodyDescription | None, BodyDescription, Pose | None]]
    ) -> None:
        """Add and change bodies: the description before, if any, that after, and a new pose.

        One that is in the way of another may move itself, so those that found no room try again.
        """
        while changes:
            blocked: dict[str, WorldError] = {}
            for name, (old, new, pose) in changes.items():
                try:
                    if old is None:
                        self._add(new, pose)
                    else:
                        self._change(old, new, pose)
                except WorldError as error:
                    blocked[name] = error
            if len(blocked) == len(changes):
                raise next(iter(blocked.values()))
            changes = {name: changes[name] for name in blocked}

    def undo(self) -> None:
        """Roll back all changes."""
        steps, self._undo_steps = self._undo_steps, []
        for step in reversed(steps):
            step()
        self._undo_steps = []  # undoing an edit adds an undo step of its own

    def restore_poses(self, poses: Mapping[str, Pose]) -> None:
        """Move bodies back to where a person put them, if the reset moved them.

        Randomization or an actuator may have done that.
        """
        for name, pose in poses.items():
            if name in self._world.bodies and math.dist(self._pose(name)[:2], pose[:2]) > 1e-6:  # m
                edit_body(self._world, self._world[name].description, pose)
                self.has_moved_back = True

    def _apply_regions(self, old: SceneDescription, new: SceneDescription) -> None:
        before, after = _regions(old), _regions(new)
        for name in dict.fromkeys((*before, *after)):
            if before.get(name) != after.get(name):
                self._change_region(name, before.get(name), after.get(name))

    def _change_region(self, name: str, old: _Region | None, new: _Region | None) -> None:
        """Add, change or remove a floor or an area; None stands for one that is not there."""
        world = self._world
        sampled_before = None if old is None else sampled_region(world, name)
        sampled = new
        if old is not None and new is not None and sampled_before is not None:
            here = (old.position, old.heading_deg, old.shape)
            if here == (new.position, new.heading_deg, new.shape):  # it stays where chance put it
                kept = ("position", "heading_deg", "shape")
                sampled = new.model_copy(update={k: getattr(sampled_before, k) for k in kept})
        put_region(world, name, new, sampled)
        self._undo_steps.append(lambda: put_region(world, name, old, sampled_before))

    def _pose(self, name: str) -> Pose:
        x, y, _, heading = self._world[name].pose
        return x, y, heading

    def _add(self, body: BodyDescription, pose: Pose | None) -> None:
        if pose is None:
            insert_body(self._world, body)
        else:
            here = {"position": pose[:2], "heading_deg": math.degrees(pose[2]), "random": None}
            insert_body(self._world, body.model_copy(update=here))
            edit_body(self._world, body, pose)
        self._undo_steps.append(lambda: self._world.remove(body.name))

    def _remove(self, name: str) -> None:
        body, pose = self._world[name].description, self._pose(name)
        self._world.remove(name)
        self._undo_steps.append(lambda: self._add(body, pose))

    def _change(self, old: BodyDescription, new: BodyDescription, pose: Pose | None) -> None:
        pose_before = self._pose(new.name)
        place_before = (old.position, old.heading_deg, old.z)
        if pose is None and place_before != (new.position, new.heading_deg, new.z):
            pose = (*new.position, math.radians(new.heading_deg))
        edit_body(self._world, new, pose)
        self._undo_steps.append(lambda: edit_body(self._world, old, pose_before))


def _regions(scene: SceneDescription) -> dict[str, _Region]:
    """Return a scene's floors and areas by name."""
    regions: tuple[_Region, ...] = (*scene.floors, *scene.areas)
    return {region.name: region for region in regions}


class _AgentEdits:
    """Brings one running agent from one state to another, in the runner's thread.

    Args:
        agent: the agent to change.
        world: the agent's world.
        drivers: makes the brains that are in no scene description (guests).
    """

    def __init__(self, agent: BasicAgent, world: World, drivers: DriverRegistry) -> None:
        self._agent = agent
        self._world = world
        self._drivers = drivers

    def apply(self, before: EditState, after: EditState, *, world_changed: bool) -> bool:
        """Change the agent, and return True if its blocks or brains were replaced.

        Raises:
            AI4UError: some block can't be made or bound; its brains are as before.
        """
        agent = self._agent
        old, new = before.agent(agent.id), after.agent(agent.id)
        _set_runtime_parameters(agent, new)
        blocks_changed = any(
            old.get(kind, ()) != new.get(kind, ()) for kind in ("sensors", "actuators", "rewards")
        )
        driver_changed = before.drivers.get(agent.id) != after.drivers.get(agent.id)
        brain_changed = driver_changed or old.get("brains", ()) != new.get("brains", ())
        if not (world_changed or blocks_changed or brain_changed):
            return False
        with files_in(after.folder), _restoring_enabled(agent):
            brains = self._brains(old, new, brain_changed, blocks_changed)
            if brain_changed and agent.id in after.drivers:
                brains = self._with_guest(after, brains)
            if world_changed or blocks_changed:
                blocks = Blocks(
                    _reuse_or_make(Sensor, agent.sensors, old, new, "sensors"),
                    _reuse_or_make(Actuator, agent.actuators, old, new, "actuators"),
                    _reuse_or_make(RewardFunc, agent.rewards, old, new, "rewards"),
                    brains,
                )
                rebind(agent, self._world, blocks, keep_brain=not blocks_changed)
            else:
                _replace_brains(agent, brains)
        return True

    def restore_driver(self, state: EditState) -> None:
        """Hand control back from a person or a script to the driver that the state names."""
        agent, described = self._agent, state.agent(self._agent.id)["brains"]
        brains: Sequence[Brain] = agent.brains[: len(described)]
        with files_in(state.folder), _restoring_enabled(agent):
            for brain, plain in zip(brains, described, strict=True):
                brain.enabled = bool(plain.get("enabled", True))
            if agent.id in state.drivers:
                brains = self._with_guest(state, brains)
            _replace_brains(agent, brains)

    def _brains(
        self, old: Plain, new: Plain, brain_changed: bool, blocks_changed: bool
    ) -> list[Brain]:
        agent = self._agent
        described = agent.brains[: len(old.get("brains", ()))]
        brains = _reuse_or_make(Brain, described, old, new, "brains")
        driving = agent.brain
        is_guest = not any(driving is brain for brain in described)
        # a script that connected by itself got the blocks of before, so it must reconnect
        is_outdated = blocks_changed and isinstance(driving, RemoteBrain) and driving.has_own_link
        if is_guest and not brain_changed and not is_outdated:
            return [*brains, driving]
        if not brain_changed and any(driving is brain for brain in brains):
            return brains  # a person may have taken over: the enabled brain stays as it is
        for brain, plain in zip(brains, new.get("brains", ()), strict=True):
            brain.enabled = bool(plain.get("enabled", True))
        return brains

    def _with_guest(self, state: EditState, brains: Sequence[Brain]) -> list[Brain]:
        """Add the driver that a state names, and disable the brain that was enabled."""
        like = next(brain for brain in brains if brain.enabled)
        guest = self._drivers.brain(state.drivers[self._agent.id], self._agent.id, like)
        like.enabled = False
        return [*brains, guest]


def _set_runtime_parameters(agent: BasicAgent, plain: Plain) -> None:
    """Set those parameters of an agent, besides its blocks, that can change at run time."""
    for name in RUNTIME_PARAMETERS:
        default = default_of(BasicAgent.parameters()[name])
        setattr(agent, name, plain.get(name, default))


@contextmanager
def _restoring_enabled(agent: BasicAgent) -> Iterator[None]:
    """Restore which brain is enabled if the block raises."""
    before = [(brain, brain.enabled) for brain in agent.brains]
    try:
        yield
    except BaseException:
        for brain, enabled in before:
            brain.enabled = enabled
        raise


def _replace_brains(agent: BasicAgent, brains: Sequence[Brain]) -> None:
    """Give an agent other brains without rebinding its other blocks."""
    before = agent.brain
    wanted = next(brain for brain in brains if brain.enabled)
    try:
        if wanted is not before:
            agent.use_brain(wanted)
        agent.brains = list(brains)
    finally:
        for brain in (*brains, before):
            brain.enabled = brain is agent.brain


def _reuse_or_make(
    kind: type[B], blocks: Sequence[B], old: Plain, new: Plain, name: str
) -> list[B]:
    """Return the wanted blocks of a kind; existing blocks with the same parameters are reused."""
    existing = list(zip(old.get(name, ()), blocks, strict=False))
    wanted: list[B] = []
    for plain in new.get(name, ()):
        for index, (known, block) in enumerate(existing):
            if _is_same_but_enabled(known, plain):
                wanted.append(block)
                del existing[index]
                break
        else:
            wanted.append(cast(B, from_plain(kind, plain)))
    return wanted


def _is_same_but_enabled(one: Plain, other: Mapping[str, object]) -> bool:
    return {**one, "enabled": None} == {**other, "enabled": None}


def _without_brains(state: EditState) -> list[dict[str, Any]]:
    agents = state.description.agents
    return [{name: each for name, each in agent.items() if name != "brains"} for agent in agents]
