"""Warnings to show after a body was moved by hand."""

from collections.abc import Iterable

from ai4u_edu.scenes import SceneDescription


def move_warnings(description: SceneDescription, moved: Iterable[str]) -> str:
    """Return why moved bodies will not stay where they are at the next reset; mostly empty."""
    bodies = {body.name: body for body in description.bodies}
    warnings = []
    for name in moved:
        random = bodies[name].random
        if random is not None and (random.x or random.y or random.places):
            warnings.append(f"chance finds another place for {name!r} at each reset")
        for agent in description.agents:
            if agent.get("body") != name:
                continue
            if any(each.get("type") == "RespawnActuator" for each in agent.get("actuators", ())):
                warnings.append(f"its RespawnActuator puts {name!r} elsewhere at each reset")
    return "; ".join(warnings)
