"""Touch and ground sensors."""

from typing import Any

import pytest

from ai4u_edu import (
    BoxShape,
    CircleShape,
    ControlRequestor,
    EventSensor,
    FloatArrayCompositeSensor,
    GroundStatusSensor,
    GroupTouchSensor,
    Sensor,
    TouchSensor,
    World,
)
from ai4u_edu.base.errors import BlockError
from tests.builders import small_sim, small_world


def ahead(_percept: Any) -> dict[str, Any]:
    return {"move": [1, 0, 0, 0]}


def felt(sim: ControlRequestor, key: str, steps: int) -> list[float]:
    return [float(sim.step()[key][0]) for _ in range(steps)]


def test_touch_is_plus_one_from_the_tick_of_contact_on() -> None:
    sim = small_sim([TouchSensor(target="box")], controller=ahead)
    assert sim.agents[0].percept["touch"].tolist() == [-1.0]
    found = felt(sim, "touch", 100)
    first = found.index(1.0)
    assert first == pytest.approx(90, abs=2)  # 3 m at 2 m/s, 60 ticks a second
    assert set(found[:first]) == {-1.0}
    assert set(found[first:]) == {1.0}


def test_touch_ends_when_they_part() -> None:
    way = iter([1.0] * 100 + [-1.0] * 100)
    sim = small_sim(
        [TouchSensor(target="box")], controller=lambda percept: {"move": [next(way), 0, 0, 0]}
    )
    assert felt(sim, "touch", 100)[-1] == 1.0
    assert felt(sim, "touch", 20)[-1] == -1.0


def test_a_reset_clears_the_touch() -> None:
    sim = small_sim([TouchSensor(target="box")], controller=ahead)
    assert felt(sim, "touch", 100)[-1] == 1.0
    sim.reset()
    assert sim.agents[0].percept["touch"].tolist() == [-1.0]


def test_an_area_is_touched_with_the_centre() -> None:
    world = small_world()
    world.add_area("goal", CircleShape(radius=1), position=(2, 0))
    sim = small_sim([TouchSensor(target="goal")], world=world, controller=ahead)
    found = felt(sim, "touch", 60)
    assert found.index(1.0) == pytest.approx(30, abs=1)  # 1 m at 2 m/s


def test_a_touch_between_two_decisions_is_not_felt() -> None:
    world = World(damping=1.0)
    world.add_body("robot", CircleShape(radius=0.5), elasticity=1.0, velocity=(8, 0))
    wall = BoxShape(size=(1, 4))
    world.add_body("box", wall, position=(4, 0), kind="static", elasticity=1.0)
    sim = small_sim([TouchSensor(target="box")], actuators=[], world=world, skip_frame=59)
    assert sim.step()["touch"].tolist() == [-1.0]
    assert sim.agents[0].body.velocity[0] < 0  # it bounced off


def test_group_touch_feels_any_body_of_the_group_and_no_other() -> None:
    world = small_world()
    world.add_body("wall", BoxShape(size=(1, 9)), position=(7, 0), kind="static", tags=("wall",))
    sensors = [
        GroupTouchSensor(group="target", perception_key="target"),
        GroupTouchSensor(group="wall", perception_key="wall"),
    ]
    sim = small_sim(sensors, world=world, controller=ahead)
    for _ in range(100):
        percept = sim.step()
    assert (percept["target"][0], percept["wall"][0]) == (1.0, -1.0)
    world.remove("box")
    for _ in range(100):
        percept = sim.step()
    assert (percept["target"][0], percept["wall"][0]) == (-1.0, 1.0)


def test_ground_status_is_minus_one_in_the_air() -> None:
    jumps = iter([1.0] + [0.0] * 99)
    sim = small_sim(
        [GroundStatusSensor()], controller=lambda percept: {"move": [0, 0, next(jumps), 0]}
    )
    assert sim.agents[0].percept["ground_status"].tolist() == [1.0]
    found = felt(sim, "ground_status", 30)
    # up and down again at 1 m/s take 2 / 9.81 s
    assert found.count(-1.0) == pytest.approx(60 * 2 / 9.81, abs=1)
    assert found[0] == -1.0
    assert found[-1] == 1.0


def test_ground_status_of_what_fell_out_of_the_world() -> None:
    sim = small_sim([GroundStatusSensor()], world=small_world(plate=2), controller=ahead)
    while not sim.agents[0].done:
        percept = sim.step()
    assert sim.agents[0].body.fallen
    assert percept["ground_status"].tolist() == [-1.0]


@pytest.mark.parametrize(
    ("sensor", "text"),
    [
        (
            TouchSensor(target="bxo"),
            "agent '0', TouchSensor 'touch': no body or area is named 'bxo'; did you mean 'box'?",
        ),
        (
            GroupTouchSensor(group="targte"),
            "agent '0', GroupTouchSensor 'group_touch': no body carries the tag 'targte'; "
            "did you mean 'target'?",
        ),
    ],
)
def test_unknown_targets(sensor: Sensor, text: str) -> None:
    with pytest.raises(BlockError) as caught:
        small_sim([sensor])
    assert str(caught.value) == text


def there_and_back(steps: int) -> Any:
    """Return a controller that drives ahead for some decisions, then back."""
    count = 0

    def drive(_percept: Any) -> dict[str, Any]:
        nonlocal count
        count += 1
        return {"move": [1.0 if count <= steps else -1.0, 0, 0, 0]}

    return drive


def test_an_event_is_read_once_when_a_touch_begins_and_once_when_it_ends() -> None:
    sensors = [
        TouchSensor(target="box"),
        EventSensor(target="box", perception_key="hit"),
        EventSensor(target="box", event="leave", perception_key="left"),
    ]
    sim = small_sim(sensors, controller=there_and_back(100))
    percepts = [sim.step() for _ in range(130)]
    touch, hit, left = (
        [float(percept[key][0]) for percept in percepts] for key in ("touch", "hit", "left")
    )
    assert set(hit) == set(left) == {0.0, 1.0}
    assert hit.index(1.0) == touch.index(1.0)
    assert left.index(1.0) == len(touch) - touch[::-1].index(1.0)
    assert (sum(hit), sum(left)) == (1.0, 1.0)


def test_entering_and_leaving_an_area_are_events() -> None:
    world = small_world()
    world.add_area("goal", CircleShape(radius=0.5), position=(1, 0))
    world.add_area("start", CircleShape(radius=0.5), position=(0, 0))
    sensors = [
        EventSensor(target="goal", perception_key="in"),
        EventSensor(target="goal", event="leave", perception_key="out"),
        EventSensor(target="start", perception_key="start"),
    ]
    sim = small_sim(sensors, world=world, controller=ahead)
    assert float(sim.agents[0].percept["start"][0]) == 0.0, "it began there"
    percepts = [sim.step() for _ in range(60)]
    entered, went = ([float(percept[key][0]) for percept in percepts] for key in ("in", "out"))
    assert entered.index(1.0) < went.index(1.0)
    assert (sum(entered), sum(went)) == (1.0, 1.0)
    assert sum(float(percept["start"][0]) for percept in percepts) == 0.0


def test_a_touch_between_two_decisions_is_an_event_and_no_touch() -> None:
    sensors = [TouchSensor(target="box"), EventSensor(target="box")]
    sim = small_sim(sensors, actuators=[], skip_frame=200)
    robot, contacts = sim.world["robot"], sim.world.contacts
    while not contacts.of("robot"):
        robot.set_velocity(2.0, 0.0)
        sim.tick()
    assert contacts.of("robot") == ("box",)
    robot.move_to(-3.0, 0.0)
    percept = sim.step()
    assert (float(percept["touch"][0]), float(percept["event"][0])) == (-1.0, 1.0)


def crossing(sensors: list[Sensor], ticks: int = 59) -> ControlRequestor:
    """Return a world whose robot drives through an area of 20 cm within one long decision."""
    world = small_world()
    world.add_area("line", CircleShape(radius=0.1), position=(1, 0))
    return small_sim(sensors, world=world, controller=ahead, skip_frame=ticks)


def line_sensors() -> list[Sensor]:
    return [
        TouchSensor(target="line"),
        EventSensor(target="line", perception_key="in"),
        EventSensor(target="line", event="leave", perception_key="out"),
    ]


def test_an_area_crossed_between_two_decisions_is_read_in_the_next_percept() -> None:
    sim = crossing(line_sensors())
    first, second = sim.step(), sim.step()
    read = [[float(each[key][0]) for key in ("touch", "in", "out")] for each in (first, second)]
    assert read == [[-1.0, 1.0, 1.0], [-1.0, 0.0, 0.0]]
    assert sim.world["robot"].position[0] > 2


def test_an_area_crossed_between_two_decisions_is_noted_inside_a_composite() -> None:
    sim = crossing([FloatArrayCompositeSensor(sensors=line_sensors())])
    assert sim.step()["array"].tolist() == [-1.0, 1.0, 1.0]
    assert sim.step()["array"].tolist() == [-1.0, 0.0, 0.0]


def test_a_copy_of_the_world_in_the_middle_of_a_decision_knows_of_the_area_crossed_in_it() -> None:
    sim, copy = (crossing(line_sensors()) for _ in range(2))
    for _ in range(40):  # past the area: that is after 27 to 33 ticks
        sim.tick()
    assert sim.is_deciding(sim.agents[0])
    copy.set_state(sim.get_state())
    assert copy.step().data == sim.step().data
    assert float(copy.agents[0].percept["in"][0]) == 1.0


def test_events_of_bodies_are_not_looked_for_at_each_tick() -> None:
    sensors = [EventSensor(target="box"), TouchSensor(target="box")]
    assert small_sim([*sensors]).agents[0].bound_blocks.tick_sensors == []


def test_a_new_episode_forgets_an_area_crossed_before_it() -> None:
    sim = crossing(line_sensors())
    for _ in range(40):
        sim.tick()
    sim.restart(sim.agents[0])
    assert float(sim.agents[0].percept["in"][0]) == 0.0
