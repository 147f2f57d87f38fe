"""A world as it stands at one moment, as data: so any thread can build a copy of it."""

from dataclasses import dataclass
from typing import Self

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.agent.state import SimState
from ai4u_edu.base.errors import NameNotFoundError, suggest
from ai4u_edu.blocks import Brain
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording.scene_export import export_scene, without_unknown_brains
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.snapshot import Snapshot


@dataclass(frozen=True)
class Moment:
    """A world at one moment, for one of its agents."""

    scene: SceneDescription
    """The world and its agents; brains that no file can hold are left out."""
    state: SimState
    """Everything that has changed in it since it was built."""
    agent: str
    """Id of the agent."""
    brain: Brain
    """The agent's brain, which has the interval of decisions."""

    @classmethod
    def of_sim(cls, sim: ControlRequestor, agent: str | None = None) -> Self:
        """Return a built world as it stands now; only for the thread that runs it.

        Args:
            sim: the world.
            agent: id of the agent; by default the one that acts first.
        """
        agent = agent or sim.agents[0].id
        return cls(
            without_unknown_brains(export_scene(sim)),
            sim.get_state(),
            agent,
            sim.agent(agent).brain,
        )

    @classmethod
    def of_snapshot(
        cls, snapshot: Snapshot, scene: SceneDescription, agent: str, brain: Brain
    ) -> Self:
        """Return a world as a snapshot shows it.

        Args:
            snapshot: of the present or the past.
            scene: the world in which it was taken.
            agent: id of the agent.
            brain: the agent's.

        Raises:
            NameNotFoundError: there is no such agent in the scene.
        """
        ids = [str(each.get("id", "0")) for each in scene.agents]
        if agent not in ids:
            raise NameNotFoundError(
                _(
                    "no agent has the id {agent}; {hint}",
                    agent=repr(agent),
                    hint=suggest(agent, ids),
                )
            )
        world = snapshot.state.world._replace(motions={body.name: body for body in snapshot.bodies})
        return cls(scene, snapshot.state._replace(world=world), agent, brain)
