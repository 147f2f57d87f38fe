"""Pictures of blocks at work, drawn by the package: what a sensor reads, how an actuator moves."""

import io
from collections.abc import Sequence
from typing import Any

import numpy as np
from gymnasium import spaces
from PIL import Image, ImageDraw, ImageFont

from ai4u_edu import Actuator, BasicAgent, BoxShape, CircleShape, LocalBrain, Sensor, World
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.blocks import ChannelLegend, Legend
from ai4u_edu.check.rollout import fresh
from ai4u_edu.lessons.pictures import picture
from ai4u_edu.snapshot import capture_snapshot, theme
from ai4u_edu.snapshot.block_info import SensorInfo, block_info_of
from ai4u_edu.snapshot.raster import draw_snapshot
from ai4u_edu.snapshot.reading_cells import GREYS, shaded, split_stack

WORLD_PX, PANEL_PX, GAP_PX = 360, 300, 16
"""Longer side of the world's picture, width of the reading's, space between them."""
ROW_PX, MAX_ROWS = 24, 9
"""Height of a bar, and the most bars that are drawn."""
TRAIL_PX, MAX_TRAILS = 220, 5
TRAIL_DECISIONS = 12
PLATE_M, START_M = (6.0, 5.0), (-1.0, 0.0)
"""The plate on which an actuator moves a body, and where that begins, looking along +x."""
PAPER, INK, BAR = (255, 255, 255), (27, 37, 48), (0, 114, 178)
TRACK = (226, 230, 235)
COLOURS = 128


def png(image: Image.Image) -> bytes:
    """Return a picture as PNG."""
    out = io.BytesIO()
    image.convert("RGB").quantize(COLOURS).save(out, format="PNG", optimize=True)
    return out.getvalue()


def sensor_picture(sim: ControlRequestor, sensor: Sensor) -> bytes:
    """Draw the world, with what a sensor of the first agent looks at, and its reading beside it.

    Args:
        sim: a world that was reset.
        sensor: one of its first agent's; the agent's other sensors are not drawn.
    """
    agent = sim.agents[0]
    world = Image.fromarray(draw_snapshot(capture_snapshot(sim), longest=WORLD_PX))
    info = next(i for i in block_info_of(agent).sensor_infos if i.key == sensor.perception_key)
    panel = _reading(agent.percept[sensor.perception_key], info, sim)
    sheet = Image.new(
        "RGB", (world.width + GAP_PX + panel.width, max(world.height, panel.height)), PAPER
    )
    sheet.paste(world, (0, 0))
    sheet.paste(panel, (world.width + GAP_PX, 0))
    return png(sheet)


def _reading(reading: Any, info: SensorInfo, sim: ControlRequestor) -> Image.Image:
    if isinstance(reading, str | tuple):
        return _lines([repr(reading)])
    array = np.asarray(reading)
    if info.legend is not None:
        return _cells(array, info, info.legend, sim)
    numbers = array.reshape(-1)[-info.low.size :].astype(float)
    return _bars(numbers.tolist(), info)


def _cells(array: Any, info: SensorInfo, legend: Legend, sim: ControlRequestor) -> Image.Image:
    """Draw a reading that is a picture: each cell in its group's colour, distances as greys."""
    latest = split_stack(array, legend, info.stack)[-1]
    known = theme.group_colours(capture_snapshot(sim).static_scene)
    colours = [theme.VOID, *(known.get(each, theme.UNKNOWN_GROUP) for each in legend.groups)]
    pictures = [np.array(colours, np.uint8)[legend.groups_in(latest)]]
    if not isinstance(legend, ChannelLegend) and legend.planes > 1:
        distances = np.asarray(latest).reshape(-1, *legend.shape)[1]
        pictures.append(np.array([theme.VOID, *GREYS], np.uint8)[shaded(distances)])
    images = []
    for each in pictures:
        side = max(1, PANEL_PX // max(each.shape[:2]))
        image = Image.fromarray(each)
        size = image.width * side, image.height * side
        images.append(image.resize(size, Image.Resampling.NEAREST))
    keys = _keys([("nothing", theme.VOID), *zip(legend.groups, colours[1:], strict=True)])
    return _column([*images, keys])


def _keys(colours: Sequence[tuple[str, theme.Rgb]]) -> Image.Image:
    sheet = Image.new("RGB", (PANEL_PX, ROW_PX * len(colours)), PAPER)
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(14)
    for row, (name, colour) in enumerate(colours):
        top = row * ROW_PX
        pen.rectangle((0, top + 5, 14, top + 19), fill=colour, outline=INK)
        pen.text((24, top + ROW_PX / 2), name, INK, font, anchor="lm")
    return sheet


def _column(images: Sequence[Image.Image]) -> Image.Image:
    height = sum(each.height for each in images) + GAP_PX * (len(images) - 1)
    sheet = Image.new("RGB", (max(PANEL_PX, *(each.width for each in images)), height), PAPER)
    top = 0
    for each in images:
        sheet.paste(each, (0, top))
        top += each.height + GAP_PX
    return sheet


def _bars(numbers: Sequence[float], info: SensorInfo) -> Image.Image:
    """Draw each number of a reading as a bar from 0 within its range."""
    shown = min(len(numbers), MAX_ROWS)
    more = len(numbers) - shown
    sheet = Image.new("RGB", (PANEL_PX, ROW_PX * (shown + bool(more)) * 2), PAPER)
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(14)
    for row, number in enumerate(numbers[:shown]):
        low, high = float(info.low[row]), float(info.high[row])
        name = info.slots[row] if info.slots else f"{row}" if len(numbers) > 1 else info.key
        top = 2 * row * ROW_PX
        unit = f" {units_of(info)[row]}"
        pen.text((0, top + ROW_PX / 2), name, INK, font, anchor="lm")
        pen.text((PANEL_PX, top + ROW_PX / 2), f"{number:.3g}{unit}", INK, font, anchor="rm")
        left, right = _span(number, low, high)
        track = (0, top + ROW_PX, PANEL_PX - 1, top + ROW_PX + 12)
        pen.rectangle(track, fill=TRACK)
        pen.rectangle((left, track[1], max(left + 2, right), track[3]), fill=BAR)
    if more:
        text = f"and {more} more numbers"
        pen.text((0, 2 * shown * ROW_PX + ROW_PX / 2), text, INK, font, anchor="lm")
    return sheet


def units_of(info: SensorInfo) -> list[str]:
    """Return the unit of each number: a sensor declares one for all, or one for each."""
    each = info.unit.split(", ")
    return each if len(each) == info.low.size else [info.unit] * info.low.size


def _span(number: float, low: float, high: float) -> tuple[float, float]:
    """Return the ends of a bar from 0 (or the range's nearest end) to a number, pixels."""
    if not np.isfinite([low, high]).all() or high <= low:
        return 0.0, 0.0
    zero = min(max(0.0, low), high)
    ends = sorted((each - low) / (high - low) * (PANEL_PX - 1) for each in (zero, number))
    return ends[0], ends[1]


def _lines(texts: Sequence[str]) -> Image.Image:
    sheet = Image.new("RGB", (PANEL_PX, ROW_PX * len(texts)), PAPER)
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(14)
    for row, text in enumerate(texts):
        pen.text((0, (row + 0.5) * ROW_PX), text, INK, font, anchor="lm")
    return sheet


def actuator_picture(actuator: Actuator) -> bytes | None:
    """Draw the way of a body for each number of an action, alone at its highest value.

    Returns:
        a PNG; None if the actuator takes no action.
    """
    actions = _actions(actuator)[:MAX_TRAILS]
    if not actions:
        return None
    images = [(name, _trail(actuator, action)) for name, action in actions]
    width = sum(image.width + GAP_PX for _, image in images) - GAP_PX
    sheet = Image.new("RGB", (width, ROW_PX + max(image.height for _, image in images)), PAPER)
    pen, font, left = ImageDraw.Draw(sheet), ImageFont.load_default(14), 0
    for name, image in images:
        pen.text((left, ROW_PX / 2), name, INK, font, anchor="lm")
        sheet.paste(image, (left, ROW_PX))
        left += image.width + GAP_PX
    return png(sheet)


def _actions(actuator: Actuator) -> list[tuple[str, Any]]:
    """Return the actions that are drawn, each with a caption."""
    space, (_, high) = actuator.space(), actuator.limits()
    if isinstance(space, spaces.Discrete):
        first = int(space.start)
        return [(f"{each}", each) for each in range(first, first + int(space.n)) if each]
    if len(high) < 2:
        return []  # a hand, or nothing: it does not move the body
    names = actuator.slots() or tuple(map(str, range(len(high))))
    alone = np.diag(high)
    actions = [
        (f"{name} = {top:g}", row.tolist())
        for name, top, row in zip(names, high, alone, strict=True)
    ]
    return actions + ([("both", high)] if len(high) == 2 else [])


def _trail(actuator: Actuator, action: Any) -> Image.Image:
    world, own = World(), fresh(actuator)
    world.add_floor("plate", BoxShape(size=PLATE_M))
    world.add_body("robot", CircleShape(radius=0.5), position=START_M)
    brain = LocalBrain(controller=lambda percept: {own.action_name: action})
    agent = BasicAgent(body="robot", actuators=[own], brains=[brain])
    sim = ControlRequestor(world, [agent])
    sim.reset(1)
    places = [agent.body.position]
    for _ in range(TRAIL_DECISIONS):
        if agent.done:
            break
        sim.step()
        places.append(agent.body.position)
    trail = picture(capture_snapshot(sim), places, longest=TRAIL_PX)
    return Image.open(io.BytesIO(trail)).convert("RGB")
