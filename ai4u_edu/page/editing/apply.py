"""The running world that is brought from one state to another."""

from collections.abc import Mapping
from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.rebind import Blocks, rebind, sense_again
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks import RemoteBrain
from ai4u_edu.page.editing.agent_edits import AgentEdits, set_runtime_parameters
from ai4u_edu.page.editing.change_result import When
from ai4u_edu.page.editing.drivers import DriverRegistry
from ai4u_edu.page.editing.state import EditState
from ai4u_edu.page.editing.state_difference import StateDifference
from ai4u_edu.page.editing.thing_edits import ThingEdits
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.world import Pose


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
        difference = StateDifference(self.shown, state)
        applied = difference.applicable_now
        if difference.has_changed or poses:
            try:
                self._apply_now(applied, poses)
            except AI4UError:
                self._describe(self.shown.description)
                if applied == state:
                    raise
                applied = self.shown  # it may depend on the part that comes with the reset
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
        things = ThingEdits(sim.world)
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
                set_runtime_parameters(agent, before.agent(agent.id))
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

    def _edits(self, agent: BasicAgent) -> AgentEdits:
        return AgentEdits(agent, self._sim.world, self._drivers)

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


def _without_brains(state: EditState) -> list[dict[str, Any]]:
    agents = state.description.agents
    return [{name: each for name, each in agent.items() if name != "brains"} for agent in agents]
