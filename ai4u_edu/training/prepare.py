"""The scene in which an agent learns: the one of the file, and what the settings say of it."""

from copy import deepcopy
from typing import Any

from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.scenes import Scene
from ai4u_edu.training.settings import Settings


def prepare(scene: Scene, settings: Settings, *, learning: bool = True) -> Scene:
    """A scene whose agent observes, and decides as often, as the settings say.

    Args:
        scene: stays as it is.
        settings: how it is learned.
        learning: whether episodes are cut off as in a training, or as the scene says.

    Raises:
        SetupError: the settings name an agent or a sensor that the scene doesn't have.
    """
    agents = [_plain(agent) for agent in scene.description.agents]
    agent = agents[index_of_learner(scene, settings)]
    if settings.observe:
        _observe(agent, settings, scene)
    if settings.skip_frame is not None:
        for brain in agent.get("brains", []):
            brain["skip_frame"] = settings.skip_frame
    if learning and settings.max_steps is not None:
        agent["max_steps_per_episode"] = settings.max_steps
    described = scene.description.model_copy(update={"agents": tuple(agents)})
    return Scene(described, scene.folder)


def index_of_learner(scene: Scene, settings: Settings) -> int:
    """Which of a scene's agents learns, counted as in the file."""
    ids = [str(agent.get("id", "0")) for agent in scene.description.agents]
    name = settings.agent or scene.build().agents[0].id
    if name not in ids:
        raise SetupError(f"agent: the scene has none with the id {name!r}; {suggest(name, ids)}")
    return ids.index(name)


def _plain(agent: Any) -> dict[str, Any]:
    """A copy of an agent as data, to be changed."""
    return deepcopy(dict(agent))


def _observe(agent: dict[str, Any], settings: Settings, scene: Scene) -> None:
    """Makes the sensors that are asked for inputs, and the others none."""
    built = scene.build().agent(str(agent.get("id", "0")))
    keys = [sensor.perception_key for sensor in built.sensors]
    for key in settings.observe:
        if key not in keys:
            raise SetupError(f"observe: no sensor has the key {key!r}; {suggest(key, keys)}")
    for key, sensor in zip(keys, agent["sensors"], strict=True):
        sensor["is_input"] = key in settings.observe
