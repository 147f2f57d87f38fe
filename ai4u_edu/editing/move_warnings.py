"""What else a person has to know who moved something."""

from collections.abc import Iterable

from ai4u_edu.scenes import SceneDescription


def note_on(description: SceneDescription, moved: Iterable[str]) -> str:
    """What becomes of bodies that were moved by hand, when the next episode begins."""
    bodies = {body.name: body for body in description.bodies}
    notes = []
    for name in moved:
        chance = bodies[name].random
        if chance is not None and (chance.x or chance.y or chance.places):
            notes.append(f"chance finds another place for {name!r} at each reset")
        for agent in description.agents:
            if agent.get("body") != name:
                continue
            places = [each.get("type") for each in agent.get("actuators", ())]
            if "RespawnActuator" in places:
                notes.append(f"its RespawnActuator puts {name!r} elsewhere at each reset")
    return "; ".join(notes)
