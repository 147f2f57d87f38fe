"""Pictures (PNG) and animations (GIF) of a world, as bytes for a notebook."""

import io
from collections import deque
from collections.abc import Iterable, Sequence

from PIL import Image, ImageDraw

from ai4u_edu.base.colors import rgb
from ai4u_edu.recording import Episode, Replay
from ai4u_edu.snapshot import Snapshot
from ai4u_edu.snapshot.raster import MARGIN_M, draw_snapshot

PICTURE_SIZE_PX = 320
"""Longer side of a picture, pixels."""
FRAMES_PER_S = 10
"""Frame rate of an animation."""
MAX_ANIMATION_S = 12
"""Length of an animation; of a longer episode it shows the end."""


def picture(
    snapshot: Snapshot, trail: Sequence[tuple[float, float]] = (), *, longest: int = PICTURE_SIZE_PX
) -> bytes:
    """Return a world from above, as PNG.

    Args:
        snapshot: what is drawn.
        trail: a way through it, metres; its beginning is a ring.
        longest: pixels of the longer side.
    """
    image = Image.fromarray(draw_snapshot(snapshot, longest=longest))
    (left, low), (right, high) = snapshot.static_scene.bounds
    scale = longest / (max(right - left, high - low) + 2 * MARGIN_M)
    way = [((x - left + MARGIN_M) * scale, (high + MARGIN_M - y) * scale) for x, y in trail]
    if way:
        pen, ink = ImageDraw.Draw(image), rgb("vermillion")
        pen.line(way, fill=ink, width=2, joint="curve")
        (x, y), radius = way[0], 5
        pen.ellipse((x - radius, y - radius, x + radius, y + radius), outline=ink, width=2)
    out = io.BytesIO()
    image.quantize(64).save(out, format="PNG", optimize=True)
    return out.getvalue()


def animation(episode: Episode, *, longest: int = PICTURE_SIZE_PX) -> bytes:
    """Return the end of an episode as an animated GIF, in real time."""
    every = max(1, round(episode.scene.world.ticks_per_second / FRAMES_PER_S))
    last = deque(Replay(episode).snapshots(every), maxlen=FRAMES_PER_S * MAX_ANIMATION_S)
    return moving(last, longest=longest)


def moving(snapshots: Iterable[Snapshot], *, longest: int = PICTURE_SIZE_PX) -> bytes:
    """Pictures one after another as an animated GIF, :data:`FRAMES_PER_S` a second."""
    frames = [
        # the same few colours in all pictures: they pack better, and nothing flickers
        Image.fromarray(draw_snapshot(each, longest=longest)).quantize(
            64, Image.Quantize.FASTOCTREE
        )
        for each in snapshots
    ]
    out = io.BytesIO()
    frames[0].save(
        out,
        format="GIF",
        save_all=True,
        append_images=frames[1:],
        duration=[*([round(1000 / FRAMES_PER_S)] * (len(frames) - 1)), 1500],  # the end can be seen
        loop=0,
    )
    return out.getvalue()
