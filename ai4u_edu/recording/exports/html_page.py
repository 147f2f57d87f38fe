"""Export of an episode as one HTML file that plays it, without a server or other files."""

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.colors import hex_colour
from ai4u_edu.blocks import Percept
from ai4u_edu.locale import catalogue, library_text, ngettext, translate
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording.replay import Replay
from ai4u_edu.snapshot import Snapshot, StaticScene, theme
from ai4u_edu.world import BodyDescription, CircleShape, RegionDescription, RingShape

TEMPLATE = Path(__file__).parent / "player.html"
PLACEHOLDER = "/*EPISODE*/null"
LANGUAGE = "/*LANGUAGE*/en"
TEXTS: Mapping[str, str] = {
    "world": _("The world from above"),
    "play": _("Play"),
    "pause": _("Pause"),
    "time": _("Time"),
    "speed": _("Speed"),
    "the_agent": _("The agent"),
    "agent": _("Agent"),
    "action": _("Action"),
    "reward": _("Reward"),
    "sensed": _("What it sensed"),
    "so_far": _("so far"),
    "about": _("seed {seed}, {seconds} s"),
    "about_success": _("seed {seed}, {seconds} s, the goal was reached"),
    "about_no_success": _("seed {seed}, {seconds} s, the goal was not reached"),
    "shown_up_to": _("Shown up to {seconds} s: {why}"),
    "seconds": _("{seconds} seconds"),
    "no_decision": _("No decision yet"),
    "decision": _("Decision {n} of {last}"),
    "terminated": _("Decision {n} of {last}, terminated"),
    "truncated": _("Decision {n} of {last}, truncated"),
}
"""Texts of the page's script, which puts their values into them."""
MAX_POSES_PER_S = 30
"""Poses per second; the page interpolates between them."""
MAX_READING_NUMBERS = 300
"""Numbers of a reading that is shown; larger ones would make the file too large."""


def write_html(replay: Replay, path: Path) -> Path:
    """Write an episode as an HTML page, and return the path.

    Args:
        replay: of the episode; it is shown as far as it is exact.
        path: of the file.
    """
    write_atomically(path, html_of(replay))
    return path


def html_of(replay: Replay) -> str:
    """Return an episode as an HTML page."""
    text = json.dumps(_data(replay), ensure_ascii=True, separators=(",", ":"), allow_nan=False)
    # escaped so that no text in the data can end the script element
    for risky in "<>&":
        text = text.replace(risky, f"\\u{ord(risky):04x}")
    page = TEMPLATE.read_text(encoding="utf-8")
    language = catalogue().language.replace("_", "-")
    return page.replace(LANGUAGE, language).replace(PLACEHOLDER, text)


def _data(replay: Replay) -> dict[str, Any]:
    episode = replay.episode
    scene = episode.scene
    every = max(1, round(scene.world.ticks_per_second / MAX_POSES_PER_S))
    frames = list(replay.snapshots(every))
    static_scene = frames[0].static_scene
    moving = [body.name for body in static_scene.bodies if body.kind != "static"]
    verdict = replay.verdict
    return {
        "texts": {name: translate(text) for name, text in TEXTS.items()},
        "title": translate(library_text(scene.title or scene.name)),
        "goal": translate(library_text(scene.goal)),
        "seed": str(episode.seed),  # too large for a JavaScript number
        "success": episode.success,
        "exact": verdict.exact,
        "why": translate(verdict.why),
        "dt": 1 / scene.world.ticks_per_second,
        "bounds": static_scene.bounds,
        "void": hex_colour(theme.VOID),
        "ground": None if static_scene.floors else hex_colour(theme.FLOOR),
        "regions": _regions(static_scene),
        "bodies": [
            _body(body, static_scene, frames[0])
            for body in sorted(static_scene.bodies, key=lambda b: b.kind != "static")
        ],
        "moving": moving,
        "ticks": [frame.tick for frame in frames],
        "poses": [_poses(frame, moving) for frame in frames],
        "agents": [_agent(replay, agent) for agent in episode.ids],
    }


def _regions(static_scene: StaticScene) -> list[dict[str, Any]]:
    floors = [
        _region(floor, theme.floor_colour(floor), theme.FLOOR_EDGE)
        for floor in sorted(static_scene.floors, key=lambda floor: floor.top)
    ]
    areas = [
        _region(area, theme.area_fill(area), theme.area_colour(area))
        | ({"picture": area.picture} if area.picture is not None else {})
        for area in sorted(static_scene.areas, key=lambda area: area.picture is None)
    ]
    return floors + areas


def _region(region: RegionDescription, fill: theme.Rgb, edge: theme.Rgb) -> dict[str, Any]:
    hole = region.shape.hole() if isinstance(region.shape, RingShape) else []
    x, y = region.position
    return {
        "points": _points(region.shape.outline()),
        "hole": _points(hole),
        "pose": [_short(x), _short(y), 0, _short(math.radians(region.heading_deg))],
        "fill": hex_colour(fill),
        "edge": hex_colour(edge),
        "label": region.label,
    }


def _body(body: BodyDescription, static_scene: StaticScene, first: Snapshot) -> dict[str, Any]:
    colour = theme.body_colour(body, body.name in static_scene.agent_of)
    shape = body.shape
    reach = shape.radius if isinstance(shape, CircleShape) else shape.reach * 0.7
    (state,) = [each for each in first.bodies if each.name == body.name]
    return {
        "name": body.name,
        "label": body.label,
        "points": _points(shape.outline()),
        "fill": hex_colour(colour),
        "edge": hex_colour(theme.mix_colours(colour, (0, 0, 0), 0.45)),
        "front": _short(reach) if body.name in static_scene.agent_of else 0,
        "agent": static_scene.agent_of.get(body.name, ""),
        "pose": None
        if state.fallen
        else [_short(state.x), _short(state.y), _short(state.z), _short(state.heading)],
    }


def _poses(picture: Snapshot, moving: list[str]) -> list[float | None]:
    """Return x, y, z and heading of each moving body, one after another."""
    states = {state.name: state for state in picture.bodies}
    row: list[float | None] = []
    for name in moving:
        state = states.get(name)
        if state is None or state.fallen:
            row += [None, None, None, None]
        else:
            row += [_short(state.x), _short(state.y), _short(state.z), _short(state.heading)]
    return row


def _agent(replay: Replay, agent: str) -> dict[str, Any]:
    moments = list(replay.moments(agent))
    return {
        "id": agent,
        "begin": [moment.decision.begin for moment in moments],
        "end": [moment.decision.end for moment in moments],
        "actions": [
            {
                name: [_digits(each) for each in numbers]
                for name, numbers in m.decision.action.items()
            }
            for m in moments
        ],
        "terms": [
            {name: _digits(amount) for name, amount in m.decision.reward_terms.items()}
            for m in moments
        ],
        "readings": [_readings(moment.percept) for moment in moments],
        "over": [
            "terminated" if m.decision.terminated else "truncated" if m.decision.truncated else ""
            for m in moments
        ],
    }


def _readings(percept: Percept) -> dict[str, Any]:
    shown: dict[str, Any] = {}
    for name, reading in percept.items():
        if not isinstance(reading, np.ndarray):
            shown[name] = _digits(reading) if isinstance(reading, float) else reading
        elif reading.size <= MAX_READING_NUMBERS:
            shown[name] = [_digits(float(each)) for each in reading.ravel()]
        else:
            shown[name] = translate(ngettext("{n} number", "{n} numbers", int(reading.size)))
    return shown


def _points(points: Any) -> list[list[float]]:
    return [[_short(x), _short(y)] for x, y in points]


def _short(value: float) -> float:
    """Round a length to millimetres."""
    return round(float(value), 3)


def _digits(value: float) -> float:
    return float(f"{value:.4g}")
