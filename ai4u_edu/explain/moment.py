"""A world as it stands at one moment, as data: so any thread can build a copy of it."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, Self

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import NameNotFoundError, suggest
from ai4u_edu.blocks import Brain
from ai4u_edu.recording.scene_export import export_scene, without_unknown_brains
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.snapshot import Snapshot


class Place(NamedTuple):
    """Pose of one body: metres and radians; fallen bodies are out of the world."""

    x: float
    y: float
    z: float
    heading: float
    is_fallen: bool


@dataclass(frozen=True)
class Moment:
    """A world at one moment, for one of its agents."""

    scene: SceneDescription
    """The world and its agents; brains that no file can hold are left out."""
    seed: int
    """Seed of the episode: what is random in the world was drawn from it."""
    places: Mapping[str, Place]
    """The bodies' poses by name."""
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
            sim.world.seeds.seed,
            places_in(sim),
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
            raise NameNotFoundError(f"no agent has the id {agent!r}; {suggest(agent, ids)}")
        places = {
            each.name: Place(
                each.x,
                each.y,
                each.z,
                each.heading,
                each.fallen or not math.isfinite(each.x + each.y + each.z),
            )
            for each in snapshot.bodies
        }
        return cls(scene, snapshot.seed, places, agent, brain)


def places_in(sim: ControlRequestor) -> dict[str, Place]:
    """Return the poses of a world's bodies by name."""
    return {name: _place(body) for name, body in sim.world.bodies.items()}


def _place(body: Any) -> Place:
    x, y, z, heading = body.pose
    is_fallen = body.fallen or not math.isfinite(x + y + z)
    return Place(x, y, z, heading, is_fallen)
