"""RespawnActuator: poses at a reset."""

import math
from typing import Any

import pytest

from ai4u_edu import HeadingSensor, PositionSensor, RespawnActuator
from ai4u_edu.base.errors import ParameterError
from tests.builders import small_sim

POSES: Any = [(1, 2, 0), (-3, 1, 90), (0, -2, -45)]


def begun(sim: Any) -> tuple[float, ...]:
    x, y, _, heading = sim.agents[0].body.pose
    return round(x, 9), round(y, 9), round(math.degrees(heading), 6)


def test_it_begins_at_one_of_the_poses_at_rest_by_the_seed() -> None:
    actuator = RespawnActuator(poses=POSES)
    sim = small_sim(actuators=[actuator])
    places = []
    for seed in range(40):
        sim.agents[0].body.set_velocity(3, 3)
        sim.reset(seed)
        places.append(begun(sim))
        assert not any(sim.agents[0].body.velocity)
        assert begun(sim) == POSES[actuator.last_selected]
    assert set(places) == set(POSES)
    again = small_sim(actuators=[RespawnActuator(poses=POSES)])
    for seed in range(40):
        again.reset(seed)
        assert begun(again) == places[seed]


@pytest.mark.parametrize(("early", "first"), [(True, [1, 2]), (False, [0, 0])])
def test_early_is_before_the_first_reading_late_is_after(early: bool, first: list[float]) -> None:
    actuator = RespawnActuator(poses=[(1, 2, 0)], early=early)
    sim = small_sim([PositionSensor(normalized=False)], actuators=[actuator])
    for _ in range(2):
        assert sim.agents[0].percept["position"][:2].tolist() == first
        assert begun(sim) == (1, 2, 0)
        assert sim.step()["position"][:2].tolist() == [1, 2]
        sim.reset()


def test_late_is_at_begin_of_episode_and_only_once() -> None:
    actuator = RespawnActuator(poses=POSES, early=False)
    sim = small_sim(actuators=[actuator])
    agent = sim.agents[0]
    agent.setup(sim.world)  # a second setup connects no second time
    assert len(agent.begin_of_episode.handlers) == 1
    agent.actuators.remove(actuator)
    sim.reset()
    assert begun(sim) == (0, 0, 0)  # off the agent, it moves nothing any more


def test_the_heading_is_drawn_from_all_there_are() -> None:
    actuator = RespawnActuator(poses=[(1, 2, 30)], randomise_heading=True)
    sim = small_sim([HeadingSensor()], actuators=[actuator])
    angles = []
    for seed in range(200):
        sim.reset(seed)
        x, y, angle = begun(sim)
        assert (x, y) == (1, 2)
        angles.append(angle)
        sine, _ = sim.agents[0].percept["heading"]
        assert sine == pytest.approx(math.sin(math.radians(angle)), abs=1e-6)
    quarters = [
        sum(1 for angle in angles if low <= angle < low + 90) for low in range(-180, 180, 90)
    ]
    assert min(quarters) > 30
    assert sum(quarters) == 200


def test_a_drawn_heading_leaves_the_choice_of_the_place_as_it_is() -> None:
    plain, turned = (
        RespawnActuator(poses=POSES),
        RespawnActuator(poses=POSES, randomise_heading=True),
    )
    for seed in range(20):
        for actuator in (plain, turned):
            small_sim(actuators=[actuator]).reset(seed)
        assert plain.last_selected == turned.last_selected


@pytest.mark.parametrize(
    ("poses", "says"),
    [
        (
            [[1, 2]] * 8,
            "poses: expected x, y, heading in degrees of each pose, as in [1, 2, 90], got [1, 2] "
            "as pose 0, and 7 more like it",
        ),
        (
            [[1, 2, 3], [1, 2, 3, 4]],
            "poses: expected x, y, heading in degrees of each pose, as in [1, 2, 90], "
            "got [1, 2, 3, 4] as pose 1",
        ),
        ([[1, 2, "a"]], "poses[0][2]: expected a number, got 'a'"),
        ([], "poses: expected at least 1 entries, got []"),
        (5, "poses: expected a list, got 5"),
    ],
)
def test_what_a_pose_is_is_said_once(poses: Any, says: str) -> None:
    with pytest.raises(ParameterError) as problem:
        RespawnActuator(poses=poses)
    assert str(problem.value) == f"RespawnActuator: {says}"
