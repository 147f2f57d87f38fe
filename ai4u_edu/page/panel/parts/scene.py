"""The part "scene": title, goal, legend and agents."""

from dataclasses import asdict
from typing import Any

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.driving_keys import keys_of
from ai4u_edu.page.panel.context import PanelContext
from ai4u_edu.page.panel.parts.blocks import changes_json
from ai4u_edu.page.panel.parts.colours import hex_colour
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.scenes.star_goals import StarGoals
from ai4u_edu.snapshot import Snapshot, StaticScene
from ai4u_edu.snapshot.agent_words import driver_title, title
from ai4u_edu.snapshot.theme import (
    RAY_MISS,
    UNKNOWN_GROUP,
    Rgb,
    body_colour,
    group_colours,
)

MAX_LEGEND_GROUPS = 12
"""Most groups in the legend."""


def scene_part(context: PanelContext, snapshot: Snapshot) -> dict[str, Any]:
    """Return the scene's texts, the legend of its groups, and its agents."""
    static_scene, editor = snapshot.static_scene, context.editor
    description = None if editor is None else editor.state.description
    other = _shown_scene(context, snapshot)
    if other is not None and description is not None and other.name == description.name:
        other = None
    texts = other or description
    return {
        "type": "part",
        "name": "scene",
        "scene": "" if description is None else description.name,
        "title": "" if texts is None else texts.title or texts.name,
        "goal": static_scene.goal if texts is None else texts.goal,
        "key": "" if editor is None else editor.state.task_key,
        "can_edit_goal": editor is not None and other is None,
        "controls": "" if description is None else description.controls,
        "rewards": "" if description is None else description.rewards,
        "stars": None if editor is None else _stars(editor.state.star_goals),
        "legend": _legend(static_scene),
        "agents": _agents(context, static_scene),
        "can_edit": editor is not None,
        "has_past": context.runner.recorder is not None,
        **({} if editor is None else changes_json(editor)),
    }


def _shown_scene(context: PanelContext, snapshot: Snapshot) -> SceneDescription | None:
    """Return the scene of the recorded episode that pages see; None while they see the present."""
    frame_cache = context.player.frame_cache
    return frame_cache.episode.scene if snapshot.past and frame_cache is not None else None


def _stars(goals: StarGoals | None) -> dict[str, Any] | None:
    """Return the goals for programs; None in a scene that has none."""
    return asdict(goals) if goals is not None and goals.count else None


def _legend(static_scene: StaticScene) -> list[dict[str, str]]:
    groups = dict(tuple(group_colours(static_scene).items())[:MAX_LEGEND_GROUPS])
    groups |= {"other": UNKNOWN_GROUP, "nothing": RAY_MISS}
    names: dict[Rgb, list[str]] = {}
    for group, colour in groups.items():
        names.setdefault(colour, []).append(group)
    return [
        {"name": ", ".join(alike), "colour": hex_colour(colour)} for colour, alike in names.items()
    ]


def _agents(context: PanelContext, static_scene: StaticScene) -> list[dict[str, Any]]:
    bodies = {body.name: body for body in static_scene.bodies}
    running = {agent.id: agent for agent in context.runner.sim.agents}
    return [
        {
            "id": agent_id,
            "body": body,
            "title": title(agent_id, body),
            "colour": hex_colour(body_colour(bodies[body], is_agent=True)),
            **_driver(running.get(agent_id)),
        }
        for body, agent_id in static_scene.agent_of.items()
        if body in bodies
    ]


def _driver(agent: BasicAgent | None) -> dict[str, Any]:
    if agent is None:  # the runner has another world already
        return {"driver": "", "is_person": False}
    is_person = bool(keys_of(agent))
    return {
        "driver": "You" if is_person else driver_title(agent.brain),
        "is_person": is_person,
    }
