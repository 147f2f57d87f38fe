"""The scene of a training: the file's scene, changed as the settings say."""

import sys
from copy import deepcopy
from typing import Any

from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.learn.training.settings import Settings
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene


def prepare(scene: Scene, settings: Settings, *, learning: bool = True) -> Scene:
    """Return a scene whose agent observes and decides as the settings say.

    Args:
        scene: stays as it is.
        settings: the training's settings.
        learning: True truncates episodes as in a training, False as the scene says.

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


def with_learner(scene: Scene, settings: Settings, *, quiet: bool = True) -> Settings:
    """Return settings that name the agent that learns, if the scene has several.

    Args:
        scene: the scene.
        settings: may name the agent.
        quiet: False says on stderr which one was chosen.
    """
    if settings.agent or len(scene.description.agents) == 1:
        return settings
    first, *others = (agent.id for agent in scene.build().agents)
    if not quiet:
        sys.stderr.write(
            _(
                "{first!r} learns, the first of several agents ({value}); to choose another "
                "one, say --agent ID, or agent: ID in a settings file\n",
                first=first,
                value=", ".join([first, *others]),
            )
        )
    return settings.model_copy(update={"agent": first})


def index_of_learner(scene: Scene, settings: Settings) -> int:
    """Return the learning agent's index, as in the file."""
    ids = [str(agent.get("id", "0")) for agent in scene.description.agents]
    name = settings.agent or scene.build().agents[0].id
    if name not in ids:
        raise SetupError(
            _(
                "agent: the scene has none with the id {name!r}; {hint}",
                name=name,
                hint=suggest(name, ids),
            )
        )
    return ids.index(name)


def _plain(agent: Any) -> dict[str, Any]:
    """Return a copy of an agent as data, to be changed."""
    return deepcopy(dict(agent))


def _observe(agent: dict[str, Any], settings: Settings, scene: Scene) -> None:
    """Make the requested sensors inputs, and no others."""
    built = scene.build().agent(str(agent.get("id", "0")))
    keys = [sensor.perception_key for sensor in built.sensors]
    for key in settings.observe:
        if key not in keys:
            raise SetupError(
                _(
                    "observe: no sensor has the key {key!r}; {hint}",
                    key=key,
                    hint=suggest(key, keys),
                )
            )
    for key, sensor in zip(keys, agent["sensors"], strict=True):
        sensor["is_input"] = key in settings.observe
