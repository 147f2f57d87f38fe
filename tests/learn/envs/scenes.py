"""Names of the scenes with one agent and of those with several."""

from ai4u_edu import Scene
from ai4u_edu.scenes import SceneDescription

SCENES = Scene.names()
MULTI_AGENT = [name for name in SCENES if len(Scene.load(name).description.agents) > 1]


def first_agent(scene: str) -> str:
    """Return the id of the agent that acts first."""
    return Scene.load(scene).build().agents[0].id


def without_blocks(kind: str) -> Scene:
    """box_chase without its sensors, or without its actuators."""
    plain = {**Scene.load("box_chase").plain(), "success": None}
    agent = dict(plain["agents"][0], rewards=[])
    if kind == "actuators":
        agent["sensors"] = [agent["sensors"][1]]
    agent[kind] = []
    plain["agents"] = [agent]
    return Scene(SceneDescription.model_validate(plain))
