"""Fields by seed: each can be solved, keeps its bounds, and is new with each start."""

import math
from collections import deque
from collections.abc import Iterable

import numpy as np
import pytest

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.base.errors import ParameterError, SceneError, WorldError
from ai4u_edu.recording import Recorder, Replay
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.world import (
    AreaDescription,
    BodyDescription,
    BoxShape,
    CircleShape,
    LineField,
    MazeField,
    Region,
    RescueField,
    World,
)
from ai4u_edu.world.fields import GAP_SHARE, AnyField, GeneratedField
from tests.scenes.solvers import solver_of
from tests.scenes.test_solvers import successes

SEEDS = pytest.mark.parametrize(
    "seeds", [range(50), pytest.param(range(50, 1000), marks=pytest.mark.nightly)], ids=str
)
MAZES = (
    MazeField(),
    MazeField(width=2, height=2, difficulty=0.1),
    MazeField(width=9, height=4, loops=6, difficulty=0.5, position=(3, -2)),
    MazeField(width=20, height=20),
)
LINES = (
    LineField(),
    LineField(width=8, height=6, length=20, crossings=1, gaps=1, marks=("a", "b", "c")),
    LineField(width=10, height=8, length=36, curves=0.8, crossings=3, gaps=3),
    LineField(width=9, height=9, length=40, curves=0.1, position=(2, 1)),
    LineField(width=8, height=8, length=30, curves=1.0, gaps=1),
)
RESCUES = (
    RescueField(),
    RescueField(width=8, height=6, length=16, crossings=2, marks=("a", "b", "c")),
    RescueField(width=10, height=8, length=30, crossings=3, gaps=2, obstacles=2, room_size=3),
    RescueField(width=5, height=5, length=9, crossings=0, gaps=1, obstacles=0, position=(3, -2)),
    RescueField(width=9, height=7, length=24, curves=1.0, crossings=2, gaps=2, difficulty=0.5),
)
SCENES = pytest.mark.parametrize("name", ["endless_maze", "endless_line", "endless_rescue"])
RASTER_M = 0.1


def generated(field: AnyField, seed: int) -> GeneratedField:
    return field.generate(np.random.default_rng(seed))


def rectangle(body: BodyDescription) -> tuple[float, float, float, float]:
    assert isinstance(body.shape, BoxShape)
    (x, y), (a, b) = body.position, body.shape.size
    return x - a / 2, y - b / 2, x + a / 2, y + b / 2


def way_through(field: MazeField, made: GeneratedField) -> int:
    """Return the steps from start to goal, found between the walls as they stand; -1 for none."""
    walls = [rectangle(each) for each in made.pieces if isinstance(each, BodyDescription)]

    def is_open(one: tuple[float, float], other: tuple[float, float]) -> bool:
        x, y = (one[0] + other[0]) / 2, (one[1] + other[1]) / 2
        return not any(a <= x <= c and b <= y <= d for a, b, c, d in walls)

    start, goal = made.places[field.start][0], made.places[field.goal][0]
    far, queue = {start: 0}, deque([start])
    while queue:
        here = queue.popleft()
        for dx, dy in ((field.cell, 0), (-field.cell, 0), (0, field.cell), (0, -field.cell)):
            there = (round(here[0] + dx, 9), round(here[1] + dy, 9))
            if there not in far and is_open(here, there):
                far[there] = far[here] + 1
                queue.append(there)
    return next((steps for place, steps in far.items() if math.dist(place, goal) < 1e-6), -1)


@SEEDS
@pytest.mark.parametrize("maze", MAZES, ids=str)
def test_a_search_finds_the_way_through_each_maze(maze: MazeField, seeds: range) -> None:
    if maze.width == 20:
        seeds = range(seeds.start, seeds.start + len(seeds) // 10)
    for seed in seeds:
        assert way_through(maze, generated(maze, seed)) >= 1, seed


@SEEDS
@pytest.mark.parametrize("line", LINES, ids=str)
def test_a_search_finds_the_way_along_each_line(line: LineField, seeds: range) -> None:
    """From a painted point to any other one that a gap's length separates at most."""
    for seed in seeds:
        made = generated(line, seed)
        pieces = [Region(each) for each in made.pieces if isinstance(each, AreaDescription)]
        (left, low), (right, high) = line.bounds()
        xs, ys = np.meshgrid(np.arange(left, right, RASTER_M), np.arange(low, high, RASTER_M))
        painted = np.logical_or.reduce([piece.contains_each(xs, ys) for piece in pieces])
        start, goal = made.places[line.start][0], made.places[line.goal][0]
        assert any(piece.contains(*start) for piece in pieces), seed
        assert any(piece.contains(*goal) for piece in pieces), seed
        gap = GAP_SHARE * line.cell + 2 * RASTER_M if line.gaps else 1.5 * RASTER_M
        places = np.column_stack([xs[painted], ys[painted]])
        reached = np.hypot(*(places - start).T) <= 2 * RASTER_M
        border = reached.copy()
        while border.any():
            near = np.zeros_like(reached)
            for place in places[border]:
                near |= np.hypot(*(places - place).T) <= gap
            border = near & ~reached
            reached |= near
        assert (reached & (np.hypot(*(places - goal).T) <= 2 * RASTER_M)).any(), seed
        assert reached.all(), seed


@pytest.mark.parametrize("field", [*MAZES, *LINES, *RESCUES], ids=str)
def test_bounds_cover_all_seeds_and_no_world_gets_too_full(field: AnyField) -> None:
    (left, low), (right, high) = field.bounds()
    for seed in range(30):
        made = generated(field, seed)
        assert len(made.pieces) <= 480
        for piece in made.pieces:
            for x, y in Region(piece).outline():  # type: ignore[arg-type]  # a body has a place too
                assert left - 1e-6 <= x <= right + 1e-6
                assert low - 1e-6 <= y <= high + 1e-6


def test_crossings_and_gaps_are_as_many_as_said() -> None:
    plain = LineField(width=8, height=8, length=24, curves=0.5)
    for seed in range(20):
        for crossings in range(3):
            line = plain.model_copy(update={"crossings": crossings, "gaps": 2})
            made = generated(line, seed)
            turned = [Region(each) for each in made.pieces if isinstance(each, AreaDescription)]
            straight = [each for each in turned if each.description.shape.reach > line.cell / 2]
            crossed = sum(
                _cross(one, other)
                for index, one in enumerate(straight)
                for other in straight[index + 1 :]
            )
            assert crossed == crossings, (seed, crossings)


@pytest.mark.parametrize("gaps", [0, 1])
def test_no_corner_sticks_out_of_a_line_in_its_curves(gaps: int) -> None:
    line = LineField(width=8, height=6, length=20, curves=1.0, crossings=1, gaps=gaps)
    for seed in range(4):
        pieces = [
            each for each in generated(line, seed).pieces if isinstance(each, AreaDescription)
        ]
        outlines = [np.array(Region(piece).outline()) for piece in pieces]
        corners = [(number, x, y) for number, each in enumerate(outlines) for x, y in each]
        free = [
            (x, y)
            for number, x, y in corners
            if not any(
                other != number
                and (
                    Region(piece).contains(x, y)
                    or np.hypot(*(outlines[other] - (x, y)).T).min() < 1e-6
                )
                for other, piece in enumerate(pieces)
            )
        ]
        assert len(free) == 4 + 4 * gaps, seed  # two at each loose end


def _cross(one: Region, other: Region) -> bool:
    """Return True if the middle lines of two long boxes cross inside both."""

    def ends(piece: Region) -> tuple[complex, complex]:
        shape = piece.description.shape
        assert isinstance(shape, BoxShape)
        half = (shape.size[0] - shape.size[1]) / 2 * complex(piece.cos, piece.sin)
        return complex(piece.x, piece.y) - half, complex(piece.x, piece.y) + half

    (a, b), (c, d) = ends(one), ends(other)

    def side(p: complex, q: complex, r: complex) -> float:
        return ((q - p).conjugate() * (r - p)).imag

    return side(a, b, c) * side(a, b, d) < -1e-9 and side(c, d, a) * side(c, d, b) < -1e-9


@pytest.mark.parametrize("field", [LINES[1], RESCUES[1]])
def test_each_mark_is_at_a_place_of_its_own(field: LineField | RescueField) -> None:
    """One at a crossing would lie under the next one, if the line comes there once more."""
    for seed in range(300):
        places = generated(field, seed).places
        marked = [places[name][0] for name in (*field.marks, field.goal)]
        apart = min(math.dist(a, b) for n, a in enumerate(marked) for b in marked[:n])
        assert apart > 0.5 * field.cell, seed


@pytest.mark.parametrize(
    ("easy", "hard"),
    [
        (MazeField(difficulty=0.3), MazeField(difficulty=1.0)),
        (MazeField(width=4, height=4), MazeField(width=9, height=9)),
        (MazeField(width=9, height=9, loops=30), MazeField(width=9, height=9)),
    ],
)
def test_a_difficulty_makes_the_shortest_way_longer(easy: MazeField, hard: MazeField) -> None:
    means = [
        np.mean([way_through(each, generated(each, seed)) for seed in range(40)])
        for each in (easy, hard)
    ]
    assert means[1] > 1.3 * means[0]


def world_with(field: AnyField, **more: tuple[float, float]) -> World:
    world = World(seed=1)
    things: list[BodyDescription | AreaDescription] = [
        BodyDescription(name="robot", shape=CircleShape(radius=0.4)),
        AreaDescription(name=field.goal, shape=CircleShape(radius=0.5)),
    ]
    things += [
        BodyDescription(name=name, shape=CircleShape(radius=0.3), position=place)
        for name, place in more.items()
    ]
    world.add_all(things, field)
    return world


def walls_of(world: World) -> list[tuple[float, float]]:
    return [body.position for name, body in world.bodies.items() if name.startswith("field")]


def test_a_new_start_is_a_new_field_and_the_same_seed_the_same_one() -> None:
    world = world_with(MazeField())
    first = walls_of(world)
    world.reset(2)
    second = walls_of(world)
    world.reset(1)
    assert first == walls_of(world) != second
    assert [thing.name for thing in world.described] == ["robot", "exit"]


@pytest.mark.parametrize("field", [MazeField(loops=3), RescueField()], ids=str)
def test_things_that_can_move_never_stand_in_a_wall(field: MazeField | RescueField) -> None:
    world = world_with(field, one=(0.0, 0.05), two=(0.0, 0.0), three=(2.0, 1.0))
    for seed in range(50):
        world.reset(seed)
        for name in ("robot", "one", "two", "three"):
            assert world.find_overlap(world[name]) is None, (seed, name)


def test_a_restart_of_one_body_puts_it_back_to_where_the_field_has_it() -> None:
    world = world_with(MazeField())
    begin = world["robot"].pose
    world["robot"].move_to(begin[0] + 0.3, begin[1])
    world.put_back("robot")
    assert world["robot"].pose == begin


def test_without_a_field_its_walls_are_gone() -> None:
    world = world_with(MazeField())
    world.set_field(None)
    assert list(world.bodies) == ["robot"]
    assert world.field is None


def test_what_a_field_can_not_be() -> None:
    with pytest.raises(ParameterError, match="at most 28 cells in a field of 8 x 6"):
        LineField(width=8, height=6, length=40)
    with pytest.raises(ParameterError, match="at least 12 cells for 1 crossings and 1 gaps"):
        LineField(width=8, height=6, length=8, crossings=1, gaps=1)
    with pytest.raises(ParameterError, match="walls of at most half a cell"):
        MazeField(cell=1, wall=0.6)
    with pytest.raises(WorldError, match="goal: nothing is named 'exit'; known are 'robot'"):
        World().add_all([BodyDescription(name="robot")], MazeField())
    with pytest.raises(WorldError, match=r"reaches 3 m, and a cell has room for 0\.9 m"):
        World().add_all(
            [
                BodyDescription(name="robot", shape=CircleShape(radius=3)),
                BodyDescription(name="exit", position=(9, 9)),
            ],
            MazeField(),
        )


def test_a_scene_says_where_its_field_is_wrong() -> None:
    text = Scene.load("endless_maze").dumps()
    with pytest.raises(SceneError, match=r"line \d+: generate.loops: expected at least 0, got -1"):
        Scene.loads(text.replace("difficulty: 0.7", "loops: -1"))
    with pytest.raises(SceneError, match=r"line \d+: generate: goal: nothing is named 'exti'"):
        Scene.loads(text.replace("difficulty: 0.7", "goal: exti"))


@SCENES
def test_a_scene_is_saved_with_its_generator_and_without_its_walls(name: str) -> None:
    scene = Scene.load(name)
    text = Scene(scene.description).dumps()
    assert "generate:" in text
    assert "field wall" not in text
    assert "field line" not in text
    assert "field obstacle" not in text
    assert Scene.loads(text) == scene
    assert SceneDescription.model_validate(scene.plain()) == scene.description


@SCENES
def test_an_episode_is_replayed_continued_and_copied_in_its_own_field(name: str) -> None:
    scene = Scene.load(name)
    sim = scene.build()
    sim.agents[0].use_brain(LocalBrain(controller=solver_of(name)))
    recorder = Recorder(sim, scene=scene.description)
    for seed in (3, 4):
        sim.reset(seed)
        for _ in range(30):
            sim.step()
    recorder.finish()
    for episode in recorder.episodes:
        assert "field " not in str(Scene(episode.scene).plain())
        replay = Replay(episode)
        assert replay.verdict.exact
        going_on = replay.continue_from(20)
        assert walls_of(going_on.world) == walls_of(sim.world) or episode.seed == 3
    copy = scene.build()
    copy.set_state(sim.get_state())
    assert walls_of(copy.world) == walls_of(sim.world)
    assert [body.pose for body in copy.world.bodies.values()] == [
        body.pose for body in sim.world.bodies.values()
    ]


def test_an_option_of_a_reset_changes_the_field() -> None:
    sim = Scene.load("endless_maze").build()
    far = [
        _distance(sim, seeds=range(10), options={"generate.difficulty": share})
        for share in (0.1, 1)
    ]
    assert far[0] < far[1]
    sim.reset(1)
    assert sim.world.field == Scene.load("endless_maze").description.generate


def _distance(sim: object, seeds: Iterable[int], options: dict[str, float]) -> float:
    total = 0.0
    for seed in seeds:
        sim.reset(seed, options)  # type: ignore[attr-defined]
        world: World = sim.world  # type: ignore[attr-defined]
        total += math.dist(world["robot"].position, world["exit"].position)
    return total


@pytest.mark.nightly
@SCENES
def test_a_driver_solves_a_hundred_of_them(name: str) -> None:
    seeds = range(100)
    assert successes(name, lambda _agent, _seed: solver_of(name), seeds) == list(seeds)
