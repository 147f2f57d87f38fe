"""The parts of the panel that a page needs now, as JSON."""

from collections.abc import Iterator
from contextlib import suppress
from typing import Literal

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.page.panel.context import PanelContext
from ai4u_edu.page.panel.page_view import CameraMode, Opening, PageView
from ai4u_edu.page.panel.parts.agent import agent_part, curve_part, python_part, shown_sensors
from ai4u_edu.page.panel.parts.blocks import blocks_part
from ai4u_edu.page.panel.parts.part import PanelPart
from ai4u_edu.page.panel.parts.past import past_part
from ai4u_edu.page.panel.parts.run import run_part
from ai4u_edu.page.panel.parts.scene import scene_part
from ai4u_edu.page.panel.parts.training import training_part
from ai4u_edu.page.panel.parts.world import world_part

Parts = Iterator[tuple[str, bytes]]


class ViewPart(PanelPart, frozen=True, kw_only=True):
    """The choices for the page's picture."""

    name: Literal["view"] = "view"
    camera: CameraMode
    """Position of the camera."""
    has_trail: bool
    """True if the trail of the agent that is shown is drawn."""
    opening: Opening
    """State of the short tilt of the camera with which the page opens."""


def due_parts(context: PanelContext, view: PageView) -> Parts:
    """Yield the name and the JSON of each part that a page looks at."""
    snapshot, cache = context.runner.latest, context.cache
    agent_id = view.agent
    # while the world stands still or a block does not return, time passes without snapshots
    stall = context.runner.stall
    run_key = "run", agent_id, None if stall is None else str(stall)
    yield "run", cache.of_snapshot(snapshot, run_key, lambda: run_part(context, snapshot, agent_id))
    yield "scene", cache.of_snapshot(snapshot, "scene", lambda: scene_part(context, snapshot))
    yield "view", _view_json(context, view)
    progress = context.runner.training
    if progress is not None:
        yield "training", cache.by_key(("training", progress), lambda: training_part(progress))
    if "agent" in view.show.tabs:
        yield from _agent_parts(context, view)
    if "past" in view.show.tabs and context.runner.recorder is not None:
        player, ghosts = context.player, context.ghosts
        past_key = "past", player.step, player.is_playing, player.number, ghosts.name
        yield "past", cache.of_snapshot(snapshot, past_key, lambda: past_part(context, snapshot))
    if context.editor is not None:
        with suppress(AI4UError):  # the editor has another scene already
            yield from _editor_parts(context, context.editor, view)


def _view_json(context: PanelContext, view: PageView) -> bytes:
    agents = context.runner.latest.agents
    is_driven = any(each.is_driven_by_keys for each in agents if each.id == view.agent)
    has_trail = view.trails.get(view.agent, not is_driven)
    camera, opening = view.camera, view.opening
    return context.cache.by_key(
        ("view", camera, has_trail, opening),
        lambda: ViewPart(camera=camera, has_trail=has_trail, opening=opening),
    )


def _agent_parts(context: PanelContext, view: PageView) -> Parts:
    snapshot, cache = context.runner.latest, context.cache
    agent = next((each for each in snapshot.agents if each.id == view.agent), None)
    if agent is None:
        return
    shown = shown_sensors(agent, view.sensors)
    key = "agent", agent.id, shown
    yield (
        "agent",
        cache.of_snapshot(snapshot, key, lambda: agent_part(context, snapshot, agent, shown)),
    )
    if view.is_curve_due():
        yield "curve", cache.of_snapshot(snapshot, ("curve", agent.id), lambda: curve_part(agent))
    address = view.address
    yield (
        "python",
        cache.by_key(
            ("python", agent.id, address, agent.actuator_infos, agent.sensor_infos),
            lambda: python_part(context, agent, address),
        ),
    )


def _editor_parts(context: PanelContext, editor: SceneEditor, view: PageView) -> Parts:
    tabs, agent_id, show = view.show.tabs, view.agent, view.show
    if "blocks" in tabs:
        path = None if show.block is None else tuple(show.block)
        driver = editor.driver_of(agent_id)
        key = ("blocks", editor.version, agent_id, driver, path, editor.waits_for_reset)
        yield (
            "blocks",
            context.cache.by_key(key, lambda: blocks_part(editor, agent_id, driver, path)),
        )
    if "world" in tabs:
        autosave, recovery = editor.recovery.autosave, editor.recovery
        world_key = (
            *("world", editor.version, show.body, editor.waits_for_reset, editor.is_dragging),
            *(view.is_move_mode, view.snap_m, recovery.unsaved),
            "" if autosave is None else autosave.problem,
        )
        yield "world", context.cache.by_key(world_key, lambda: world_part(editor, view))
