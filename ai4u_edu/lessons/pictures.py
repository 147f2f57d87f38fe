"""Still and moving pictures of a world, as bytes that a notebook can hold."""

import io
from collections import deque
from collections.abc import Iterable, Sequence

from PIL import Image, ImageDraw

from ai4u_edu.base.colors import rgb
from ai4u_edu.recording import Episode, Replay
from ai4u_edu.snapshot import Snapshot
from ai4u_edu.snapshot.raster import MARGIN_M, draw_snapshot

SIDE = 320
"""Pixels of a picture's longer side."""
RATE = 10
"""Pictures a second in an animation."""
SECONDS = 12
"""What an animation shows of a long episode: its end."""


def picture(
    snapshot: Snapshot, trail: Sequence[tuple[float, float]] = (), *, longest: int = SIDE
) -> bytes:
    """A world from above, as PNG.

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


def animation(episode: Episode, *, longest: int = SIDE) -> bytes:
    """The end of an episode as an animated GIF, at the pace of the world's time."""
    every = max(1, round(episode.scene.world.ticks_per_second / RATE))
    last = deque(Replay(episode).snapshots(every), maxlen=RATE * SECONDS)
    return moving(last, longest=longest)


def moving(snapshots: Iterable[Snapshot], *, longest: int = SIDE) -> bytes:
    """Pictures one after another as an animated GIF, :data:`RATE` a second."""
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
        duration=[*([round(1000 / RATE)] * (len(frames) - 1)), 1500],  # the end can be seen
        loop=0,
    )
    return out.getvalue()
