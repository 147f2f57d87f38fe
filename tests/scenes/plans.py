"""Plans of a newcomer at the keyboard for each scene: what its goal says, and no more."""

import math
from collections import deque
from collections.abc import Iterable

from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.seeding import Seeds
from ai4u_edu.world import RescueField
from tests.scenes.newcomer import (
    REACTION_S,
    STRAIGHT_RAD,
    Keys,
    Plan,
    Planner,
    Point,
    Sight,
    direction,
    towards,
)
from tests.scenes.printed_track import route
from tests.world.rescue_reading import Reading

NONE: Keys = frozenset()
AHEAD: Keys = frozenset({"KeyW"})


TURN_RAD_PER_S = 2.4
"""Turning speed of platform's robot, which a person knows after a try."""


def nearest(here: Point, goals: Iterable[Point]) -> Point | None:
    """Return the nearest of several points."""
    return min(goals, key=lambda goal: math.dist(here, goal), default=None)


def go_to(name: str) -> Planner:
    """Drive at a body."""
    return lambda _sim: lambda sight: towards(sight, sight.at[name])


def follow(route: list[Point]) -> Planner:
    """Drive from point to point of a closed route, beginning with the nearest one ahead."""

    def planner(sim: ControlRequestor) -> Plan:
        body = sim.agents[0].body
        index = min(
            range(len(route)),
            key=lambda each: (
                math.dist(body.position, route[each])
                - math.cos(direction(body.position, route[each]) - body.heading)
            ),
        )

        def plan(sight: Sight) -> Keys:
            nonlocal index
            if math.dist(sight.own, route[index]) < 0.5:
                index = (index + 1) % len(route)
            return towards(sight, route[index])

        return plan

    return planner


def through_maze(sim: ControlRequestor) -> Plan:
    """Follow the shortest way through the cells of 2 m to the exit, seen from above."""
    bodies = sim.world.bodies
    walls = [body for name, body in bodies.items() if name.startswith("wall")]

    def is_open(one: Point, other: Point) -> bool:
        x, y = (one[0] + other[0]) / 2, (one[1] + other[1]) / 2
        return not any(
            wall.sampled.shape.contains(x - wall.position[0], y - wall.position[1])
            for wall in walls
        )

    way_on: dict[Point, Point] = {}  # from each cell to the next one
    border = deque([cell_of(bodies["exit"].position)])
    while border:
        cell = border.popleft()
        for dx, dy in ((2, 0), (-2, 0), (0, 2), (0, -2)):
            other = (cell[0] + dx, cell[1] + dy)
            if other not in way_on and is_open(cell, other):
                way_on[other] = cell
                border.append(other)
    heading_for = cell_of(sim.agents[0].body.position)

    def plan(sight: Sight) -> Keys:
        nonlocal heading_for
        if math.dist(sight.own, heading_for) < 0.5:
            heading_for = way_on[heading_for]
        return towards(sight, heading_for)

    return plan


def cell_of(place: Point) -> Point:
    """Return the centre of the maze's cell around a point."""
    return 2.0 * round((place[0] - 1) / 2) + 1, 2.0 * round(place[1] / 2)


def ring(_sim: ControlRequestor) -> Plan:
    """Drive round the middle of the donut, a bit ahead of where it is."""

    def plan(sight: Sight) -> Keys:
        angle = math.atan2(sight.own[1], sight.own[0]) + 0.35
        return towards(sight, (5.75 * math.cos(angle), 5.75 * math.sin(angle)))

    return plan


def jump_wall(_sim: ControlRequestor) -> Plan:
    """Drive at the cube, and jump in front of the wall."""

    def plan(sight: Sight) -> Keys:
        keys = towards(sight, sight.at["cube"])
        at_wall = -1.6 < sight.own[0] < 0 and "KeyW" in keys
        return keys | {"Space"} if at_wall else keys

    return plan


def push_out(_sim: ControlRequestor) -> Plan:
    """Drive at the opponent; turn back near the edge."""

    def plan(sight: Sight) -> Keys:
        other = sight.at.get("orange", (0.0, 0.0))
        mine, its = math.hypot(*sight.own), math.hypot(*other)
        return towards(sight, (0.0, 0.0) if mine > 2.9 and its < mine else other)

    return plan


def push_block(sim: ControlRequestor) -> Plan:
    """Go behind the block, and push it into the field."""
    field = sim.world.areas["field"].description.position

    def plan(sight: Sight) -> Keys:
        block = sight.at.get("block", (0.0, 0.0))
        far = math.dist(block, field)
        way = ((field[0] - block[0]) / far, (field[1] - block[1]) / far)
        return behind(sight, block, way, 1.8)

    return plan


def behind(sight: Sight, thing: Point, way: Point, room: float) -> Keys:
    """Return the keys that push a thing along a way, or that lead to ``room`` metres behind it."""
    dx, dy = sight.own[0] - thing[0], sight.own[1] - thing[1]
    along, left = dx * way[0] + dy * way[1], dy * way[0] - dx * way[1]
    side = 1.0 if left >= 0 else -1.0
    if along < -0.4 and abs(left) < 0.35:
        ahead, aside = 0.5, 0.0
    elif along < -0.4 * room:
        ahead, aside = -room, 0.0
    else:
        ahead, aside = -room, side * room
    goal = thing[0] + ahead * way[0] - aside * way[1], thing[1] + ahead * way[1] + aside * way[0]
    return towards(sight, goal)


def shoot(_sim: ControlRequestor) -> Plan:
    """Go behind the ball, and push it into the orange goal."""

    def plan(sight: Sight) -> Keys:
        ball = sight.at["ball"]
        far = math.dist(ball, (7.5, 0.0))
        return behind(sight, ball, ((7.5 - ball[0]) / far, -ball[1] / far), 1.2)

    return plan


def catch(_sim: ControlRequestor) -> Plan:
    """Drive at the nearest runner."""

    def plan(sight: Sight) -> Keys:
        runners = [at for name, at in sight.at.items() if name.startswith("runner")]
        goal = nearest(sight.own, runners)
        return NONE if goal is None else towards(sight, goal)

    return plan


def forage(sim: ControlRequestor) -> Plan:
    """Fetch what is lower, once it is below the middle of the green zone."""
    agent = sim.agents[0]

    def plan(sight: Sight) -> Keys:
        energy, water = agent.percept["inside"]
        if min(energy, water) > 0.55:
            return NONE
        kind = "food" if energy < water else "water"
        goal = nearest(sight.own, [at for name, at in sight.at.items() if name.startswith(kind)])
        return NONE if goal is None else towards(sight, goal)

    return plan


def jump_blocks(_sim: ControlRequestor) -> Plan:
    """Drive along the middle line, and jump forward near the end of a block."""

    def plan(sight: Sight) -> Keys:
        x = sight.own[0]
        keys = towards(sight, (x + 3.0, 0.0))
        at_edge = 3.0 < (x + 2) % 7 < 4.0 and "KeyW" in keys
        return keys | {"KeyJ"} if at_edge else keys

    return plan


def park(sim: ControlRequestor) -> Plan:
    """Back up along the lane until there is room for a quarter circle, then steer into the bay."""
    bay = sim.world.areas["bay"].description.position
    up = math.copysign(1.0, bay[1])
    backing = True

    def steer(error: float) -> Keys:
        if abs(error) < math.radians(6):
            return NONE
        return frozenset({"KeyA" if error > 0 else "KeyD"})

    def plan(sight: Sight) -> Keys:
        nonlocal backing
        (x, y), heading = sight.own, sight.heading
        rear = x - 0.4 * math.cos(heading)
        backing = backing and bay[0] - rear < 2.9
        if backing:
            return frozenset({"KeyS"}) | steer(math.remainder(heading, 2 * math.pi))
        across = bay[0] - rear
        deep = up * (bay[1] - y)
        if deep < 0.15:
            return NONE
        on_circle = math.acos(min(1.0, max(0.0, 1 - abs(across) / 2.6)))
        aim = up * (math.pi / 2 - math.copysign(min(on_circle, 1.2 * abs(across)), across))
        return AHEAD | steer(math.remainder(aim - heading, 2 * math.pi))

    return plan


STEP_KEYS: dict[Point, str] = {(1, 0): "KeyD", (-1, 0): "KeyA", (0, 1): "KeyW", (0, -1): "KeyS"}
"""Keys for a step to a neighbouring cell: to the right, to the left, up and down."""


def clean(sim: ControlRequestor) -> Plan:
    """Tap from cell to cell to the nearest dirty place, round walls, enemies and the person."""
    bodies = sim.world.bodies
    closed = [body for name, body in bodies.items() if not name.startswith(("robot", "dirt"))]
    here, is_pressed = sim.agents[0].body.position, False

    def is_open(cell: Point) -> bool:
        return not any(
            body.sampled.shape.contains(cell[0] - body.position[0], cell[1] - body.position[1])
            for body in closed
        )

    def first_step(goals: set[Point]) -> Point | None:
        border: deque[tuple[Point, Point]] = deque([(here, (0.0, 0.0))])
        seen = {here}
        while border:
            cell, first = border.popleft()
            if cell in goals:
                return first
            for dx, dy in STEP_KEYS:
                other = (cell[0] + dx, cell[1] + dy)
                if other not in seen and is_open(other):
                    seen.add(other)
                    border.append((other, first if any(first) else (dx, dy)))
        return None

    def plan(sight: Sight) -> Keys:
        nonlocal here, is_pressed
        goals = {at for name, at in sight.at.items() if name.startswith("dirt")} - {here}
        step = None if is_pressed else first_step(goals)
        is_pressed = step is not None
        if step is None:
            return NONE
        here = here[0] + step[0], here[1] + step[1]
        return frozenset({STEP_KEYS[step]})

    return plan


EDGES = ((3.5, 1.0), (13.0, 1.0), (22.5, -1.0))
"""Eastern edges of platform's platforms, and a y at which there is ground on both sides."""


def cross_platforms(sim: ControlRequestor) -> Plan:
    """Eat the fruit, jump from platform to platform, and go round the spike to the exit.

    One key at a time: it turns for as long as it takes, and then looks.
    """
    agent = sim.agents[0]
    decision_s = (agent.brain.skip_frame + 1) / sim.world.settings.ticks_per_second
    pause_s = REACTION_S + 0.1
    turning, left_s, pause_left_s = NONE, 0.0, 0.0

    def goal_of(sight: Sight) -> tuple[Point, bool]:
        """Return where to go, and whether to jump."""
        (x, y), fruit, spike = sight.own, sight.at.get("fruit"), sight.at.get("spike")
        ahead = next((edge for edge in EDGES if x < edge[0]), None)
        if fruit and (ahead is None or fruit[0] < ahead[0]):
            return fruit, False
        if ahead is not None:
            edge, level = ahead
            is_in_lane = abs(y - level) < 0.7
            return (
                ((edge + 3.0, level), x > edge - 1.5)
                if is_in_lane
                else ((edge - 2.5, level), False)
            )
        if spike and x < spike[0] + 0.8:
            return (spike[0] + 0.8, spike[1] + (2.0 if spike[1] < -1.5 else -2.0)), False
        return (31.0, -2.0), False

    def plan(sight: Sight) -> Keys:
        nonlocal turning, left_s, pause_left_s
        left_s -= decision_s
        if left_s > 0:
            return turning
        pause_left_s -= decision_s
        if pause_left_s > 0:
            return NONE
        goal, is_jump = goal_of(sight)
        error = math.remainder(direction(sight.own, goal) - sight.heading, 2 * math.pi)
        if abs(error) < STRAIGHT_RAD:
            return frozenset({"Space"}) if is_jump else AHEAD
        turning = frozenset({"KeyA" if error > 0 else "KeyD"})
        left_s, pause_left_s = abs(error) / TURN_RAD_PER_S, pause_s
        return turning

    return plan


def fetch(_sim: ControlRequestor) -> Plan:
    """Drive to the food, which a person sees from above, and from there to the nest."""
    has_food = False

    def plan(sight: Sight) -> Keys:
        nonlocal has_food
        has_food = has_food or math.dist(sight.own, sight.at["food"]) < 0.95
        return towards(sight, sight.at["nest"] if has_food else sight.at["food"])

    return plan


HOUSE: list[Point] = [(-2, -2), (2, -2), (2, 1), (0, 3), (-2, 1)]


def draw_house(_sim: ControlRequestor) -> Plan:
    """Drive to the nearest corner of the house, and from there round it with the pen down."""
    corner: int | None = None
    passed = 0

    def plan(sight: Sight) -> Keys:
        nonlocal corner, passed
        if corner is None:
            corner = min(range(len(HOUSE)), key=lambda each: math.dist(sight.own, HOUSE[each]))
        if math.dist(sight.own, HOUSE[corner]) < 0.35:
            corner, passed = (corner + 1) % len(HOUSE), passed + 1
        pen: Keys = frozenset({"Space"}) if passed else NONE
        return towards(sight, HOUSE[corner]) | pen

    return plan


def through_field(sim: ControlRequestor) -> Plan:
    """Follow the shortest way through a generated maze to its exit, seen from above."""
    field, bodies = sim.world.field, sim.world.bodies
    assert field is not None
    walls = [body for name, body in bodies.items() if name.startswith("field wall")]
    cells = [field.centre((x, y)) for y in range(field.height) for x in range(field.width)]

    def cell_at(place: Point) -> Point:
        return min(cells, key=lambda each: math.dist(each, place))

    def is_open(one: Point, other: Point) -> bool:
        x, y = (one[0] + other[0]) / 2, (one[1] + other[1]) / 2
        return not any(
            wall.sampled.shape.contains(x - wall.position[0], y - wall.position[1])
            for wall in walls
        )

    way_on: dict[Point, Point] = {}  # from each cell to the next one
    border = deque([cell_at(bodies["exit"].position)])
    while border:
        cell = border.popleft()
        for other in cells:
            is_near = 0 < math.dist(cell, other) < 1.1 * field.cell
            if is_near and other not in way_on and is_open(cell, other):
                way_on[other] = cell
                border.append(other)
    heading_for = cell_at(sim.agents[0].body.position)

    def plan(sight: Sight) -> Keys:
        nonlocal heading_for
        if math.dist(sight.own, heading_for) < 0.5:
            heading_for = way_on[heading_for]
        return towards(sight, heading_for)

    return plan


def along_line(sim: ControlRequestor) -> Plan:
    """Follow a generated line from piece to piece, in the order in which it is laid."""
    pieces = [area for name, area in sim.world.areas.items() if name.startswith("field line")]
    route: list[Point] = []
    for piece in pieces:
        length, width = piece.description.shape.outline()[0]
        half = length - width
        for share in (-1.0, -0.5, 0.0, 0.5, 1.0):
            at = share * half
            route.append((piece.x + piece.cos * at, piece.y + piece.sin * at))
    index = 0

    def plan(sight: Sight) -> Keys:
        nonlocal index
        while index < len(route) - 1 and math.dist(sight.own, route[index]) < 0.4:
            index += 1
        return towards(sight, route[index])

    return plan


def through_rescue(sim: ControlRequestor) -> Plan:
    """Follow a rescue line from tile to tile, around its obstacles, and go to the victim."""
    field = sim.world.field
    assert isinstance(field, RescueField)
    reading = Reading(field, field.generate(Seeds(sim.world.seeds.seed).child("field")))
    tiles = [field.centre(tile) for tile in reading.follow()]
    route: list[Point] = tiles[:1]
    for before, (x, y), after in zip(tiles, tiles[1:], [*tiles[2:], None], strict=False):
        is_blocked = any(x0 < x < x1 and y0 < y < y1 for x0, y0, x1, y1 in reading.solid)
        if is_blocked and after is not None:
            along = (x - before[0]) / 2, (y - before[1]) / 2
            aside = 1.2 * along[1], -1.2 * along[0]
            route += [
                (x + share * along[0] + aside[0], y + share * along[1] + aside[1])
                for share in (-1.0, 1.0)
            ]
        else:
            route.append((x, y))
    (ax, ay), (bx, by) = tiles[-2:]
    route += [(2 * bx - ax, 2 * by - ay), sim.world["victim"].position]
    index = 0

    def plan(sight: Sight) -> Keys:
        nonlocal index
        while index < len(route) - 1 and math.dist(sight.own, route[index]) < 0.4:
            index += 1
        return towards(sight, route[index])

    return plan


LINE: list[Point] = [
    (-4, -3.5), (-0.5, -3.5), (3, -3.5), (4.5, -2), (5, -1.2), (5, 0), (5, 1.5), (4.2, 2.4),
    (3.4, 3), (1.6, 3), (0.75, 2.25), (0, 1.5), (-1.4, 1.5), (-2.25, 2.25), (-3, 3),
    (-4.5, 3), (-5.5, 2), (-5.5, 0), (-5.5, -2), (-4.75, -2.75),
]  # fmt: skip

PLANS: dict[str, Planner] = {
    "ants": fetch,
    "box_chase": go_to("box"),
    "donut": ring,
    "draw_figure": draw_house,
    "endless_line": along_line,
    "endless_maze": through_field,
    "endless_rescue": through_rescue,
    "forage": forage,
    "grid_world": clean,
    "jumper": jump_blocks,
    "line_follow": follow(LINE),
    "maze": through_maze,
    "parking": park,
    "platform": cross_platforms,
    "printed_track": follow(route()[::6]),
    "push_block": push_block,
    "sample_scene": jump_wall,
    "soccer": shoot,
    "sumo": push_out,
    "tag": catch,
    "yardstick": go_to("target"),
}
"""A planner for each scene."""
