"""The part "scene": title, goal, legend and agents."""

from typing import Literal

from msgspec import UNSET, Struct, UnsetType

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.driving_keys import keys_of
from ai4u_edu.base.colors import hex_colour
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import join, library_text
from ai4u_edu.page.editing.goals import goal_sentence
from ai4u_edu.page.panel.context import PanelContext
from ai4u_edu.page.panel.parts.blocks import UndoLabel, undo_labels
from ai4u_edu.page.panel.parts.part import PanelPart
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


class LegendColour(Struct, frozen=True):
    """A colour of the legend."""

    name: str
    """Names of the groups that have it."""
    colour: str
    """The colour as CSS has it."""


class SceneAgent(Struct, frozen=True):
    """An agent of the scene."""

    id: str
    body: str
    """Name of its body."""
    title: str
    colour: str
    """Colour of its body as CSS has it."""
    driver: str
    """Title of what drives it; empty while another world is being opened."""
    is_person: bool
    """True if a person drives it by keys."""


class ScenePart(PanelPart, frozen=True, kw_only=True):
    """The scene's texts, the legend of its groups, and its agents."""

    name: Literal["scene"] = "scene"
    scene: str
    """Name of the scene that runs now; empty without an editor."""
    title: str
    """Title of the scene that is shown, which may be that of a recorded episode."""
    goal: str
    """Its goal in words."""
    key: str
    """A key of its task, under which a page keeps best times; empty without an editor."""
    can_edit_goal: bool
    controls: str
    """Its controls in words."""
    rewards: str
    """Its rewards in words."""
    stars: StarGoals | None
    """Goals for programs; null in a scene that has none."""
    legend: list[LegendColour]
    agents: list[SceneAgent]
    can_edit: bool
    """False if the world can only be watched and driven."""
    has_past: bool
    """True if episodes are recorded."""
    undo: UndoLabel | UnsetType = UNSET
    """The change that undo takes back; left out without an editor."""
    redo: UndoLabel | UnsetType = UNSET
    """The change that redo makes again; left out without an editor."""
    waits_for_reset: bool | UnsetType = UNSET
    """True if a change takes effect in the next episode; left out without an editor."""


def scene_part(context: PanelContext, snapshot: Snapshot) -> ScenePart:
    """Return the scene's texts, the legend of its groups, and its agents."""
    static_scene, editor = snapshot.static_scene, context.editor
    description = None if editor is None else editor.state.description
    other = _shown_scene(context, snapshot)
    if other is not None and description is not None and other.name == description.name:
        other = None
    texts = other or description
    undo, redo = (UNSET, UNSET) if editor is None else undo_labels(editor)
    return ScenePart(
        scene="" if description is None else description.name,
        title="" if texts is None else library_text(texts.title or texts.name),
        goal=library_text(static_scene.goal) if texts is None else _goal(texts),
        key="" if editor is None else editor.state.task_key,
        can_edit_goal=editor is not None and other is None,
        controls="" if description is None else library_text(description.controls),
        rewards="" if description is None else library_text(description.rewards),
        stars=None if editor is None else _stars(editor.state.star_goals),
        legend=_legend(static_scene),
        agents=_agents(context, static_scene),
        can_edit=editor is not None,
        has_past=context.runner.recorder is not None,
        undo=undo,
        redo=redo,
        waits_for_reset=UNSET if editor is None else editor.waits_for_reset,
    )


def _goal(scene: SceneDescription) -> str:
    """Return a scene's goal; of one that follows from its rewards, the sentence made of them."""
    made = goal_sentence(scene)
    return made if made == scene.goal else library_text(scene.goal)


def _shown_scene(context: PanelContext, snapshot: Snapshot) -> SceneDescription | None:
    """Return the scene of the recorded episode that pages see; None while they see the present."""
    frame_cache = context.player.frame_cache
    return frame_cache.episode.scene if snapshot.past and frame_cache is not None else None


def _stars(goals: StarGoals | None) -> StarGoals | None:
    """Return the goals for programs; None in a scene that has none."""
    return goals if goals is not None and goals.count else None


def _legend(static_scene: StaticScene) -> list[LegendColour]:
    groups = dict(tuple(group_colours(static_scene).items())[:MAX_LEGEND_GROUPS])
    groups |= {_("other"): UNKNOWN_GROUP, _("nothing"): RAY_MISS}
    names: dict[Rgb, list[str]] = {}
    for group, colour in groups.items():
        names.setdefault(colour, []).append(group)
    return [LegendColour(join(alike, ", "), hex_colour(colour)) for colour, alike in names.items()]


def _agents(context: PanelContext, static_scene: StaticScene) -> list[SceneAgent]:
    bodies = {body.name: body for body in static_scene.bodies}
    running = {agent.id: agent for agent in context.runner.sim.agents}
    return [
        SceneAgent(
            id=agent_id,
            body=body,
            title=title(agent_id, body),
            colour=hex_colour(body_colour(bodies[body], is_agent=True)),
            driver=_driver(agent := running.get(agent_id)),
            is_person=agent is not None and bool(keys_of(agent)),
        )
        for body, agent_id in static_scene.agent_of.items()
        if body in bodies
    ]


def _driver(agent: BasicAgent | None) -> str:
    if agent is None:  # the runner has another world already
        return ""
    return _("You") if keys_of(agent) else driver_title(agent.brain)
