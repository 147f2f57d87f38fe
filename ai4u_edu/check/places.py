"""A check of the positions in a scene: agents can move, and nothing starts in a wrong place."""

import math
from collections.abc import Iterator

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import RespawnActuator
from ai4u_edu.world.overlap import find_overlap


def implausible_places(sim: ControlRequestor, seed: int) -> list[str]:
    """Return a sentence for each position that is probably a mistake.

    These are: an agent with actuators on a body that can't move; a body that starts over the void;
    a respawn pose over the void or inside another body.

    Args:
        sim: will be reset, and its bodies moved.
        seed: for the reset.
    """
    sim.reset(seed)
    return [*_immovable(sim), *_over_the_void(sim), *_respawn_poses(sim)]


def _immovable(sim: ControlRequestor) -> Iterator[str]:
    for agent in sim.agents:
        driven = [name for name, each in agent.bound_blocks.actuators.items() if each.is_output]
        if driven and not agent.body.moves:
            yield (
                f"agent {agent.id!r} is on body {agent.body_name!r}, which can't move (its kind is "
                f"{agent.body.description.kind!r}), and has the actuator {driven[0]!r}"
            )


def _over_the_void(sim: ControlRequestor) -> Iterator[str]:
    for body in sim.world.bodies.values():
        if body.moves and not body.fallen and sim.world.ground(*body.position) is None:
            x, y = body.position
            yield f"body {body.name!r} begins over the void, at ({x:g}, {y:g}), and falls"


def _respawn_poses(sim: ControlRequestor) -> Iterator[str]:
    for agent in sim.agents:
        for actuator in agent.bound_blocks.actuators.values():
            if isinstance(actuator, RespawnActuator):
                yield from _poses_of(sim, agent, actuator)


def _poses_of(sim: ControlRequestor, agent: BasicAgent, actuator: RespawnActuator) -> Iterator[str]:
    body = agent.body
    for number, (x, y, heading_deg) in enumerate(actuator.poses):
        where = f"pose {number} of {actuator.action_name!r} of agent {agent.id!r}, ({x:g}, {y:g}),"
        if sim.world.ground(x, y) is None:
            yield f"{where} lies over the void"
            continue
        body.move_to(x, y, heading=math.radians(heading_deg))
        other = find_overlap(sim.world, body)
        if other is not None:
            yield f"{where} lies in body {other.name!r}"
