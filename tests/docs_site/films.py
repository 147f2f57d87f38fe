"""A short film of each scene, driven by the program that solves it, drawn by the package."""

import io
from dataclasses import dataclass
from functools import cache

from PIL import Image

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.snapshot import Snapshot, capture_snapshot
from ai4u_edu.snapshot.raster import draw_snapshot
from tests.scenes.solvers import solver_of

SIDE_PX = 320
"""Longer side of a film, and of the picture in its place for anyone who wants no motion."""
FRAMES_PER_S, MAX_FILM_S = 12, 8
LAST_FRAME_MS = 1500
SEED = 1
MAX_BYTES = 150_000
PACKINGS = ((1, 50), (2, 40), (2, 20), (3, 15))
"""(frames between two that are kept, quality): tried in turn until a film is small enough."""


@dataclass(frozen=True)
class Film:
    """An animated WebP, and its first picture."""

    film: bytes
    still: bytes
    decisions: int
    seconds: float
    """World time of the episode."""
    speed: float
    """Speed of the film; 1 is real time."""


class UnsolvedError(Exception):
    """The solver did not reach the goal."""


@cache
def film_of(name: str) -> Film:
    """Let the solver of a scene drive, and film it.

    Raises:
        UnsolvedError: it does not reach the goal.
    """
    scene = Scene.load(name)
    sim = scene.build()
    agent = sim.agents[0]
    brain = agent.brain
    agent.use_brain(
        LocalBrain(
            controller=solver_of(name),
            skip_frame=brain.skip_frame,
            repeat_action=brain.repeat_action,
        )
    )
    sim.reset(SEED)
    shots = [capture_snapshot(sim)]
    while not agent.done:
        sim.step()
        shots.append(capture_snapshot(sim, shots[0].static_scene))
    if agent.ledger.episode_terms.get(str(scene.description.success), 0) <= 0:
        raise UnsolvedError(f"{name}: the solver does not reach the goal with seed {SEED}")
    seconds = max(shots[-1].time - shots[0].time, 1e-9)
    shown = _chosen(shots, seconds)
    length = len(shown) / FRAMES_PER_S
    frames = [Image.fromarray(draw_snapshot(each, longest=SIDE_PX)) for each in shown]
    return Film(_webp(frames), _still(frames[0]), agent.steps, seconds, seconds / length)


def _chosen(shots: list[Snapshot], seconds: float) -> list[Snapshot]:
    """Return snapshots at even times; a long episode is shown faster."""
    count = max(2, min(round(seconds * FRAMES_PER_S), FRAMES_PER_S * MAX_FILM_S))
    chosen, place = [], 0
    for number in range(count):
        due = shots[0].time + seconds * number / (count - 1)
        while place + 1 < len(shots) and shots[place + 1].time <= due + 1e-9:
            place += 1
        chosen.append(shots[place])
    return chosen


def _webp(frames: list[Image.Image]) -> bytes:
    """Return frames as an animated WebP, which is as large as allowed at most."""
    packed = b""
    for every, quality in PACKINGS:
        shown = [*frames[:-1:every], frames[-1]]
        out = io.BytesIO()
        shown[0].save(
            out,
            format="WEBP",
            save_all=True,
            append_images=shown[1:],
            duration=[round(1000 * every / FRAMES_PER_S)] * (len(shown) - 1) + [LAST_FRAME_MS],
            loop=0,
            quality=quality,
            method=4,
        )
        packed = out.getvalue()
        if len(packed) <= MAX_BYTES:
            break
    return packed


def _still(frame: Image.Image) -> bytes:
    out = io.BytesIO()
    frame.quantize(64).save(out, format="PNG", optimize=True)
    return out.getvalue()
