"""Ten thousand casts in random worlds, each ray compared with the reference implementation.

A case is one cast of a fan (8 rays) or a grid (4 rows of 4 rays) at a random place in a random
world of up to 20 bodies and 6 floors.
"""

import math
import random

import pytest

from ai4u_edu.world import CircleShape, RayFan, RayGrid, SegmentShape, World
from tests.world.exact_rays import MARGIN, Ray, code_of, meets
from tests.world.random_worlds import make_world, shuffle

CASES_A_WORLD = 40
NEAR_ENOUGH = 1e-6
ANY = 0xFFFFFFFF


class Tally:
    """Counts of all rays' results."""

    def __init__(self) -> None:
        self.cases = self.rays = self.on_edge = self.hits = 0
        self.wrong: list[str] = []


def casters(world: World, rng: random.Random) -> tuple[RayFan, RayGrid, int, bool]:
    reach = rng.uniform(2.0, 15.0)
    eye = (0.0, 0.0, rng.uniform(0.05, 1.0))
    if rng.random() < 0.5:
        eye = (rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-0.5, 1.5))
    mask = rng.choice((ANY, 1, 2))
    exclude = rng.random() < 0.7
    angles = [rng.uniform(-math.pi, math.pi) for _ in range(8)]
    pitches = [0.0, *(rng.uniform(-spread, spread) for spread in (0.3, 1.0, 1.57))]
    fan = RayFan(world, angles, reach, code_of, eye=eye, mask=mask, exclude_self=exclude)
    grid = RayGrid(
        world, angles[:4], pitches, reach, code_of, eye=eye, mask=mask, exclude_self=exclude
    )
    return fan, grid, mask, exclude


def compare(world: World, caster: RayFan | RayGrid, mask: int, exclude: bool, out: Tally) -> None:
    body = world["eye"]
    caster.cast(body)
    out.cases += 1
    x, y, z, heading = body.pose
    forward, left, up = caster.eye
    cos, sin = math.cos(heading), math.sin(heading)
    start = x + cos * forward - sin * left, y + sin * forward + cos * left, z + up
    pitches = caster.pitches.tolist() if isinstance(caster, RayGrid) else [0.0]
    size = len(caster.angles)
    codes, distances = caster.codes.reshape(-1, size), caster.distances.reshape(-1, size)
    for row, pitch in enumerate(pitches):
        for column, angle in enumerate(caster.angles.tolist()):
            out.rays += 1
            flat, turned = math.cos(pitch), heading + angle
            step = flat * math.cos(turned), flat * math.sin(turned), math.sin(pitch)
            met = meets(world, Ray(start, step), caster.reach, "eye" if exclude else "", mask)
            if met is None:
                out.on_edge += 1
                continue
            out.hits += met.distance > MARGIN
            code, distance = float(codes[row, column]), float(distances[row, column])
            if code not in met.codes or abs(distance - met.distance) > NEAR_ENOUGH:
                kind = type(caster).__name__
                out.wrong.append(f"case {out.cases}, {kind}: {code}, {distance} for {met}")


def run(seed: int, cases: int, *, sticks: bool) -> Tally:
    rng, tally = random.Random(seed), Tally()
    while tally.cases < cases:
        world = make_world(rng, sticks=sticks)
        fan, grid, mask, exclude = casters(world, rng)
        for _ in range(CASES_A_WORLD // 2):
            for caster in (fan, grid):
                shuffle(world, rng)
                compare(world, caster, mask, exclude, tally)
    return tally


def check(tally: Tally, cases: int) -> None:
    assert tally.cases == cases
    assert not tally.wrong, f"{len(tally.wrong)} of {tally.rays} rays: {tally.wrong[:5]}"
    assert tally.on_edge < 0.01 * tally.rays
    assert tally.hits > 0.2 * tally.rays, "enough of them met something"


@pytest.mark.slow
@pytest.mark.parametrize(
    "seed", [0, *(pytest.param(seed, marks=pytest.mark.nightly) for seed in range(1, 5))]
)
def test_rays_meet_what_they_should(seed: int) -> None:
    cases = 800 if seed == 0 else 2000
    check(run(seed, cases, sticks=False), cases)


@pytest.mark.slow
def test_rays_meet_sticks_where_they_should() -> None:
    check(run(99, 800, sticks=True), 800)


@pytest.mark.slow
def test_rays_meet_walls_that_they_are_in_line_with() -> None:
    """Walls and eyes on whole metres, as in a scene that somebody wrote down."""
    rng, tally = random.Random(8), Tally()
    angles = [math.pi * i / 4 for i in range(8)] + [0.02, -0.01, math.pi + 0.03]
    for _ in range(40):
        world = World()
        eye = world.add_body("eye", CircleShape(radius=0.3), kind="kinematic", tags=("n1",))
        for i in range(2, 8):
            end = rng.choice(((3.0, 0.0), (0.0, 3.0), (1.0, 0.0), (2.0, 2.0)))
            wall = SegmentShape(a=(0.0, 0.0), b=end)
            place = rng.randint(-5, 5), rng.randint(-5, 5)
            world.add_body(f"wall {i}", wall, kind="static", position=place, tags=(f"n{i}",))
        fan = RayFan(world, angles, 20.0, code_of)
        for _ in range(25):
            eye.move_to(rng.randint(-12, 12) / 2, rng.randint(-12, 12) / 2, heading=0.0)
            compare(world, fan, ANY, True, tally)
    check(tally, 1000)
