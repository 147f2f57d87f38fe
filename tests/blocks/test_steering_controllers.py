"""Scripted drivers: their target points and their variation."""

import math
from typing import Any

import pytest

from ai4u_edu import (
    CircleShape,
    Controller,
    ControlRequestor,
    FleeController,
    HeadingSensor,
    KeeperController,
    LinearRayCastingSensor,
    LocalBrain,
    PositionSensor,
    PushOutController,
    RBMoveActuator,
    StrikerController,
    World,
)
from ai4u_edu.base.errors import BlockError
from ai4u_edu.blocks.brains.controllers.steering import steer
from tests.builders import small_sim

Place = tuple[float, float]


def position(key: str, target: str, *, normalized: bool = False) -> PositionSensor:
    return PositionSensor(perception_key=key, target=target, frame="local", normalized=normalized)


def driven(
    controller: Controller, sensors: list[Any], places: dict[str, Place], heading_deg: float = 0
) -> ControlRequestor:
    """Return a sim with a robot that the controller drives, and bodies at given positions."""
    world = World()
    robot = places.pop("robot", (0.0, 0.0))
    world.add_body("robot", CircleShape(radius=0.4), position=robot, heading_deg=heading_deg)
    for name, place in places.items():
        world.add_body(name, CircleShape(radius=0.3), position=place)
    return small_sim(
        sensors,
        world=world,
        actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
        brains=[LocalBrain(controller=controller)],
    )


def wish(
    controller: Any, sensors: list[Any], places: dict[str, Place], **fields: Any
) -> tuple[float, float]:
    """Return its target point, world frame; the robot is at the origin and faces +x."""
    sim = driven(controller, sensors, places, **fields)
    forward, left = controller.target_point(sim.agents[0].percept)
    return round(forward, 2), round(left, 2)


@pytest.mark.parametrize("angle_deg", range(-180, 181, 30))
def test_steering_turns_the_shorter_way_and_drives_when_it_is_ahead(angle_deg: int) -> None:
    angle = math.radians(angle_deg)
    forward, turn, jump, leap = steer(3 * math.cos(angle), 3 * math.sin(angle), speed=0.5)
    assert forward == pytest.approx(0.5 * max(0.0, math.cos(angle)), abs=1e-6)
    if abs(angle_deg) < 180:
        assert math.copysign(1, turn) == -math.copysign(1, angle) or turn == 0 == angle
    assert (abs(turn) <= 1, jump, leap) == (True, 0.0, 0.0)


# -- the wrestler --------------------------------------------------------------------------------


def wrestler(robot: Place, other: Place, heading_deg: float = 0) -> tuple[float, float]:
    sensors = [position("opponent", "other"), PositionSensor(), HeadingSensor()]
    places = {"robot": robot, "other": other}
    return wish(PushOutController(), sensors, places, heading_deg=heading_deg)


def test_the_wrestler_goes_for_the_other_one() -> None:
    assert wrestler((1, 0), (3, 1)) == (2, 1)
    assert wrestler((0, 0), (0, 2), heading_deg=90) == (2, 0)


def test_near_the_edge_it_turns_back_unless_the_other_one_stands_outside() -> None:
    assert wrestler((3, 0), (2, 1)) == (-3, 0)  # the middle
    assert wrestler((0, 3), (1, 2), heading_deg=90) == (-3, 0)
    assert wrestler((3, 0), (3.8, 0)) == (0.8, 0)  # the other one


def test_it_does_not_follow_one_that_falls() -> None:
    controller = PushOutController()
    sensors = [position("opponent", "other"), PositionSensor(), HeadingSensor()]
    sim = driven(controller, sensors, {"robot": (2, 0), "other": (3, 0)})
    sim.world["other"].move_to(3, 0, z=-0.5)
    sim.step()
    forward, left = controller.target_point(sim.agents[0].percept)
    assert (forward, left) == pytest.approx((-2, 0), abs=0.3)


# -- the runner ----------------------------------------------------------------------------------


def runner(places: dict[str, Place], **fields: Any) -> tuple[float, float]:
    rays = LinearRayCastingSensor(
        perception_key="rays",
        number_of_rays=15,
        field_of_view=360,
        vision_max_distance=8,
        return_distance=True,
    )
    controller = FleeController(**fields)
    return wish(controller, [position("pursuer", "chaser"), rays], places)


def test_the_runner_runs_away_from_its_pursuer() -> None:
    assert runner({"chaser": (-2, 0)}) == (1, 0)
    _, y = runner({"chaser": (0, 2)})
    assert y < -0.6


def test_it_runs_where_there_is_room() -> None:
    wall = {f"wall {i}": (1.0, 0.7 * i) for i in range(-2, 3)}
    _, y = runner({"chaser": (-2, 0), **wall})
    assert abs(y) > 0.9


def test_it_strolls_while_the_pursuer_is_far_away() -> None:
    rays = LinearRayCastingSensor(perception_key="rays", return_distance=True)
    controller, speeds = FleeController(whim=0.0), []
    sim = driven(controller, [position("pursuer", "chaser"), rays], {"chaser": (-9, 0)})
    for distance in (3, 4.5, 5.5, 8):
        sim.world["chaser"].move_to(-distance, 0)
        sim.world["robot"].move_to(0, 0, heading=0.0)
        sim.step()
        speeds.append(controller.speed_share(sim.agents[0].percept, (1.0, 0.0)))
    assert speeds == [1.0, 1.0, 0.3, 0.3]


# -- the ball players ----------------------------------------------------------------------------

PITCH = {"goal": (8.0, 0.0), "home": (-8.0, 0.0)}


def striker(robot: Place, ball: Place) -> tuple[float, float]:
    """Return its target point, world frame."""
    keys = ("ball", "goal", "home")
    sensors = [position(key, key) for key in keys]
    x, y = wish(StrikerController(), sensors, {"robot": robot, "ball": ball, **PITCH})
    return robot[0] + x, robot[1] + y


def test_the_striker_shoots_when_it_is_behind_the_ball() -> None:
    assert striker((-2, 0), (0, 0)) == pytest.approx((0.3, 0))


def test_beside_the_line_it_goes_behind_the_ball_first() -> None:
    assert striker((-1, 3), (0, 0)) == pytest.approx((-1.2, 0), abs=0.01)


def test_it_goes_round_a_ball_in_its_way_on_the_side_of_the_middle() -> None:
    for side in (1, -1):
        x, y = striker((2, 4 * side), (0, 4 * side))
        assert x < 0
        assert abs(y) < 4


def test_close_by_it_is_less_choosy_so_that_no_wall_keeps_the_ball() -> None:
    for distance, shoots in ((0.8, True), (2.8, False)):
        x, _ = striker((-0.9 * distance, 4 - 0.43 * distance), (0, 4))
        assert (x > 0) is shoots


def keeper(robot: Place, ball: Place) -> tuple[float, float]:
    sensors = [position(key, key) for key in ("ball", "home")]
    places = {"robot": robot, "ball": ball, "home": PITCH["home"]}
    x, y = wish(KeeperController(), sensors, places)
    return robot[0] + x, robot[1] + y


def test_the_keeper_stays_between_ball_and_goal() -> None:
    assert keeper((-6, 1), (5, 0)) == pytest.approx((-6, 0))
    x, y = keeper((-6, 1), (-4, 4))
    assert math.dist((x, y), PITCH["home"]) == pytest.approx(2, abs=0.02)
    assert y == pytest.approx(x + 8, abs=0.02)


def test_it_runs_at_a_ball_in_its_area_but_never_from_the_far_side() -> None:
    assert keeper((-7, 0), (-5, 0.5)) == pytest.approx((-5, 0.5))
    assert keeper((-4, 0), (-5, 0.5)) != pytest.approx((-5, 0.5))


# -- what they share -----------------------------------------------------------------------------


def answers(seed: int, decisions: int = 200, **fields: Any) -> list[Any]:
    controller = KeeperController(**fields)
    sensors = [position(key, key) for key in ("ball", "home")]
    sim = driven(controller, sensors, {"ball": (5.0, 1.0), "home": (-8.0, 0.0)})
    sim.reset(seed)
    found = []
    for _ in range(decisions):
        sim.step()
        found.append(sim.agents[0].last_action["move"])
    return found


def test_the_seed_gives_the_variation() -> None:
    assert answers(1) == answers(1)
    assert answers(1) != answers(2)
    assert answers(1, whim=0.0) == answers(2, whim=0.0)


def test_with_whim_it_now_and_then_backs_off() -> None:
    assert min(forward for forward, *_ in answers(1, whim=0.0)) >= 0
    backward = sum(forward < 0 for forward, *_ in answers(1, decisions=600, whim=1.0))
    assert 60 < backward < 400


def test_speed_is_the_most_it_drives() -> None:
    assert max(forward for forward, *_ in answers(1, speed=0.5, whim=0.0)) <= 0.5
    assert max(forward for forward, *_ in answers(1, whim=0.0)) > 0.8


def test_a_head_start_is_given_anew_in_each_episode() -> None:
    controller = StrikerController(head_start=5)
    sensors = [position(key, key) for key in ("ball", "goal", "home")]
    sim = driven(controller, sensors, {"ball": (4.0, 0.0), **PITCH})
    for _ in range(2):
        sim.reset(0)
        stood = 0
        while sim.step() and sim.agents[0].last_action["move"] == (0.0, 0.0, 0.0, 0.0):
            stood += 1
        assert stood == 5


def test_what_a_sensor_normalises_is_measured_in_metres_again() -> None:
    for normalized in (False, True):
        controller = KeeperController()
        sensors = [position(key, key, normalized=normalized) for key in ("ball", "home")]
        sim = driven(controller, sensors, {"ball": (5.0, 1.0), "home": (-8.0, 0.0)})
        assert controller.spot(sim.agents[0].percept, "ball") == pytest.approx((5, 1), abs=1e-5)


def test_a_sensor_that_is_not_there() -> None:
    sensors = [position("bal", "ball"), position("home", "home")]
    with pytest.raises(BlockError) as caught:
        driven(KeeperController(), sensors, {"ball": (5.0, 1.0), "home": (-8.0, 0.0)})
    assert str(caught.value) == (
        "agent '0', LocalBrain(KeeperController): ball: no sensor has the perception_key 'ball'; "
        "did you mean 'bal'?"
    )


def test_rays_without_distances_tell_the_runner_too_little() -> None:
    rays = LinearRayCastingSensor(perception_key="rays")
    with pytest.raises(BlockError, match=r"rays: expected a LinearRayCastingSensor with return_d"):
        driven(FleeController(), [position("pursuer", "ball"), rays], {"ball": (5.0, 1.0)})
