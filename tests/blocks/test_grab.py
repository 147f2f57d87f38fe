"""GrabActuator: grabbing, carrying, releasing."""

import math
from typing import Any

import pytest

from ai4u_edu import (
    BoxShape,
    CircleShape,
    ControlRequestor,
    GrabActuator,
    RBMoveActuator,
    World,
)
from ai4u_edu.base.errors import WorldError
from tests.builders import small_sim


def room(**box: Any) -> World:
    world = World()
    world.add_body("robot", CircleShape(radius=0.5), mass=5)
    world.add_body("box", BoxShape(size=(1, 1)), **{"position": (1.2, 0)} | box)
    return world


class Pilot:
    """Repeats the last action that it was given."""

    def __init__(self) -> None:
        self.action: dict[str, Any] = {}

    def __call__(self, _percept: Any) -> dict[str, Any]:
        return self.action


def with_hand(world: World, **fields: Any) -> tuple[ControlRequestor, Pilot]:
    pilot = Pilot()
    actuators = [GrabActuator(**fields), RBMoveActuator(move_amount=2, turn_amount=2, jump_power=4)]
    sim = small_sim(actuators=actuators, world=world, controller=pilot)
    return sim, pilot


def do(sim: ControlRequestor, pilot: Pilot, ticks: int, move: Any, grab: float | None) -> None:
    pilot.action = {"move": move} | ({} if grab is None else {"grab": [grab]})
    for _ in range(ticks):
        sim.step()


def holding(world: World) -> str:
    held = world["robot"].held
    return held.name if held else ""


STAY, AHEAD, BACK, TURN = [0, 0, 0, 0], [1, 0, 0, 0], [-1, 0, 0, 0], [0, 1, 0, 0]


def grabbed(**box: Any) -> tuple[ControlRequestor, Pilot, World]:
    world = room(**box)
    sim, pilot = with_hand(world)
    do(sim, pilot, 30, AHEAD, 1.0)
    assert holding(world) == "box"
    return sim, pilot, world


def test_it_holds_what_it_touches_and_not_before() -> None:
    world = room(position=(2, 0))
    sim, pilot = with_hand(world)
    do(sim, pilot, 20, AHEAD, 1.0)
    assert holding(world) == ""
    do(sim, pilot, 30, AHEAD, 1.0)
    assert holding(world) == "box"


@pytest.mark.parametrize(("grip", "expected"), [(0.5, ""), (0.51, "box")])
def test_above_a_half_it_closes(grip: float, expected: str) -> None:
    world = room()
    sim, pilot = with_hand(world)
    do(sim, pilot, 30, AHEAD, grip)
    assert holding(world) == expected


def test_what_it_holds_moves_as_if_glued_on() -> None:
    sim, pilot, world = grabbed()
    robot, box = world["robot"], world["box"]
    before = *robot.to_local(*box.position), box.heading - robot.heading
    start = robot.position
    for way in (BACK, TURN, [-1, -0.5, 0, 0]):
        do(sim, pilot, 60, way, 1.0)
        after = *robot.to_local(*box.position), box.heading - robot.heading
        turn = (after[2] - before[2] + math.pi) % (2 * math.pi) - math.pi
        assert after[:2] == pytest.approx(before[:2], abs=0.03)
        assert turn == pytest.approx(0, abs=0.03)
    assert math.dist(start, robot.position) > 1


def test_let_go_it_stays_behind() -> None:
    sim, pilot, world = grabbed()
    do(sim, pilot, 60, BACK, 1.0)
    do(sim, pilot, 30, STAY, 0.0)
    assert holding(world) == ""
    place = world["box"].position
    do(sim, pilot, 60, BACK, 0.0)
    assert math.dist(place, world["box"].position) < 0.05
    assert world["robot"].distance(world["box"]) > 2


def test_a_decision_that_says_nothing_of_it_leaves_it_closed() -> None:
    sim, pilot, world = grabbed()
    distance = world["robot"].distance(world["box"])
    do(sim, pilot, 60, BACK, None)
    assert holding(world) == "box"
    assert world["robot"].distance(world["box"]) == pytest.approx(distance, abs=0.03)


@pytest.mark.parametrize("mass", [0.1, 50.0])
def test_a_light_load_and_a_heavy_one_come_along(mass: float) -> None:
    sim, pilot, world = grabbed(mass=mass)
    distance = world["robot"].distance(world["box"])
    start = world["box"].position[0]
    do(sim, pilot, 60, BACK, 1.0)
    assert start - world["box"].position[0] == pytest.approx(2, abs=0.1)
    assert world["robot"].distance(world["box"]) == pytest.approx(distance, abs=0.1)


def test_it_does_not_drag_its_load_through_a_wall() -> None:
    world = room()
    world.add_body("wall", BoxShape(size=(1, 8)), position=(-3, 1.5), kind="static")
    sim, pilot = with_hand(world)
    do(sim, pilot, 30, AHEAD, 1.0)
    do(sim, pilot, 90, TURN, 1.0)
    do(sim, pilot, 240, BACK, 1.0)
    do(sim, pilot, 300, [1, 0.3, 0, 0], 1.0)
    assert holding(world) == "box"
    for name in ("robot", "box"):
        x, y = world[name].position
        assert not (-3.4 < x < -2.6 and -2.4 < y < 5.4), (name, x, y)


@pytest.mark.parametrize(
    ("degrees", "angle", "expected"),
    [
        (0, 90, "box"),
        (40, 90, "box"),
        (50, 90, ""),
        (50, 110, "box"),
        (180, 90, ""),
        (180, 360, "box"),
    ],
)
def test_in_front_is_as_wide_as_it_says(degrees: float, angle: float, expected: str) -> None:
    world = World()
    turn = math.radians(degrees)
    world.add_body("robot", CircleShape(radius=0.5))
    place = (0.9 * math.cos(turn), 0.9 * math.sin(turn))
    world.add_body(
        "box", CircleShape(radius=0.4), position=place, velocity=(-math.cos(turn), -math.sin(turn))
    )
    sim, pilot = with_hand(world, angle=angle)
    do(sim, pilot, 5, STAY, 1.0)
    assert "box" in sim.agents[0].view.contacts(world["robot"])
    assert holding(world) == expected


def test_of_several_it_takes_the_one_nearest_to_its_heading() -> None:
    for sign in (1, -1):
        world = World()
        world.add_body("robot", CircleShape(radius=0.5))
        for name, degrees in (("near", 15 * sign), ("far", -40 * sign)):
            turn = math.radians(degrees)
            place = (0.8 * math.cos(turn), 0.8 * math.sin(turn))
            speed = (-math.cos(turn), -math.sin(turn))
            world.add_body(name, CircleShape(radius=0.3), position=place, velocity=speed)
        sim, pilot = with_hand(world)
        do(sim, pilot, 3, STAY, 0.0)
        assert len(sim.agents[0].view.contacts(world["robot"])) == 2
        do(sim, pilot, 1, STAY, 1.0)
        assert holding(world) == "near"


@pytest.mark.parametrize("kind", ["static", "kinematic"])
def test_what_does_not_move_is_not_taken(kind: str) -> None:
    world = room(kind=kind)
    sim, pilot = with_hand(world)
    do(sim, pilot, 30, AHEAD, 1.0)
    assert "box" in sim.agents[0].view.contacts(world["robot"])
    assert holding(world) == ""


def test_a_reset_empties_the_hand_and_the_next_episode_is_the_same() -> None:
    sim, pilot, world = grabbed()
    do(sim, pilot, 30, TURN, 1.0)
    place = world["box"].pose
    for _ in range(2):
        sim.reset(seed=0)
        assert holding(world) == ""
        assert world["box"].position == pytest.approx((1.2, 0), abs=0)
        do(sim, pilot, 30, AHEAD, 1.0)
        do(sim, pilot, 30, TURN, 1.0)
        assert world["box"].pose == place


@pytest.mark.parametrize("who", ["robot", "box"])
def test_it_opens_when_one_of_the_two_is_put_somewhere_else(who: str) -> None:
    sim, pilot, world = grabbed()
    world[who].move_to(7, 7)
    assert holding(world) == ""
    do(sim, pilot, 30, STAY, None)
    assert world[who].position == pytest.approx((7, 7), abs=0.01)


@pytest.mark.parametrize("grip", [1.0, None])
def test_it_opens_when_the_load_falls_out_of_the_world(grip: float | None) -> None:
    world = room()
    world.add_floor("plate", BoxShape(size=(3.4, 3)))
    sim, pilot = with_hand(world)
    do(sim, pilot, 20, AHEAD, 1.0)
    assert holding(world) == "box"
    do(sim, pilot, 20, AHEAD, grip)
    do(sim, pilot, 100, STAY, grip)  # the box is over the edge, the robot is not
    assert world["box"].fallen
    assert not world["robot"].fallen
    assert holding(world) == ""
    do(sim, pilot, 60, BACK, 1.0)
    assert world["robot"].position[0] < 0


def test_it_opens_when_the_holder_falls_out_of_the_world() -> None:
    world = room()
    world.add_floor("plate", BoxShape(size=(3.4, 3)), position=(1, 0))
    sim, pilot = with_hand(world)
    do(sim, pilot, 10, AHEAD, 1.0)
    assert holding(world) == "box"
    while not world["robot"].fallen:
        do(sim, pilot, 1, BACK, 1.0)
    assert holding(world) == ""
    assert not world["box"].fallen


def test_it_opens_in_a_high_jump() -> None:
    sim, pilot, world = grabbed(height=0.3)
    do(sim, pilot, 1, [0, 0, 1, 0], 1.0)
    assert holding(world) == "box"
    do(sim, pilot, 15, STAY, 1.0)
    assert world["robot"].z > 0.3
    assert holding(world) == ""


def test_a_body_that_is_removed_is_no_longer_held() -> None:
    sim, pilot, world = grabbed()
    world.remove("box")
    assert holding(world) == ""
    do(sim, pilot, 5, TURN, 1.0)


def test_what_a_body_can_not_hold() -> None:
    world = room()
    world.add_body("wall", BoxShape(size=(1, 1)), position=(0, 5), kind="static")
    world.add_body("ball", CircleShape(radius=0.2), position=(0, -5))
    robot = world["robot"]
    for other in ("wall", "robot"):
        with pytest.raises(WorldError) as caught:
            robot.hold(world[other])
        assert str(caught.value) == (
            f"body 'robot' can't hold {other!r}: expected another body, one that can move and has "
            "not fallen"
        )
    robot.hold(world["ball"])
    with pytest.raises(WorldError) as caught:
        robot.hold(world["box"])
    assert str(caught.value) == (
        "body 'robot' can't hold 'box': it holds 'ball'; release that first"
    )
    robot.release()
    robot.release()
    assert robot.held is None
