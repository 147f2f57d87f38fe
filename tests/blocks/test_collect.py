"""CollectActuator: touched bodies leave, change variables, are paid for, and come back."""

from typing import Any

import pytest

from ai4u_edu import (
    BoxShape,
    CircleShape,
    CollectActuator,
    CollisionWithRewardFunc,
    ControlRequestor,
    GoneReward,
    HomeostaticReward,
    HomeostaticSensor,
    HomeostaticVariable,
    LinearRayCastingSensor,
    OrRewardFunc,
    RBMoveActuator,
    TouchRewardFunc,
    World,
)
from ai4u_edu.base.errors import BlockError
from ai4u_edu.snapshot import capture_snapshot
from tests.builders import small_sim

AHEAD, BACK, STAY = (1, 0, 0, 0), (-1, 0, 0, 0), (0, 0, 0, 0)


def orchard(*places: tuple[float, float], **fields: Any) -> World:
    """A robot at the origin that faces +x, and apples."""
    world = World()
    world.add_body("robot", CircleShape(radius=0.5), mass=5)
    for number, place in enumerate(places, start=1):
        world.add_body(
            f"apple {number}",
            CircleShape(radius=0.3),
            **{"kind": "static", "position": place, "tags": ("apple",)} | fields,
        )
    return world


def variable(name: str, **fields: Any) -> HomeostaticVariable:
    ends = {"range_max": 100, "comfort_min": 50, "comfort_max": 100, "value": 10}
    return HomeostaticVariable(name=name, **(ends | fields))


class Drive:
    """Repeats the last action that it was given."""

    def __init__(self, action: tuple[float, ...]) -> None:
        self.action = action

    def __call__(self, _percept: Any) -> dict[str, Any]:
        return {"move": self.action}


def sim_with(
    world: World, *collectors: CollectActuator, drive: Any = None, **fields: Any
) -> ControlRequestor:
    fields.setdefault("rewards", [])
    return small_sim(
        fields.pop("sensors", []),
        actuators=[RBMoveActuator(move_amount=3), *collectors],
        world=world,
        controller=drive or Drive(AHEAD),
        **fields,
    )


def gone(world: World, name: str) -> bool:
    return world[name].fallen


def at(world: World, name: str) -> tuple[float, float]:
    return world[name].position


def there(world: World) -> list[str]:
    return [name for name, body in world.bodies.items() if "apple" in name and not body.fallen]


def test_what_is_touched_is_gone_and_nothing_holds_the_agent_up() -> None:
    world = orchard((1.5, 0), (3.5, 0), (0, 3))
    collector = CollectActuator(group="apple")
    sim = sim_with(world, collector)
    while world["robot"].position[0] < 0.65:
        sim.step()
    assert there(world) == ["apple 1", "apple 2", "apple 3"]
    for _ in range(10):
        sim.step()
    assert there(world) == ["apple 2", "apple 3"]
    for _ in range(110):
        sim.step()
    assert there(world) == ["apple 3"]
    assert world["robot"].position[0] > 5.5
    assert collector.count == 2
    assert capture_snapshot(sim).agents[0].collects == 2
    sim.reset()
    assert collector.count == 0


def test_no_ray_meets_it_and_nothing_touches_it() -> None:
    world = orchard((1.5, 0))
    eyes = LinearRayCastingSensor(number_of_rays=1, group_code={"apple": 1}, vision_max_distance=9)
    drive = Drive(AHEAD)
    sim = sim_with(world, CollectActuator(group="apple"), drive=drive, sensors=[eyes])
    assert sim.agents[0].percept["linear_ray_casting"] == 1
    for _ in range(20):
        sim.step()
    assert world["robot"].position[0] < 1.2
    assert sim.agents[0].percept["linear_ray_casting"] == 0
    assert sim.agents[0].view.contacts(sim.agents[0].body) == ()


def test_only_its_group_is_collected() -> None:
    world = orchard((1.5, 0), tags=("stone",))
    world.add_body("apple far away", CircleShape(), position=(0, 9), tags=("apple",))
    sim = sim_with(world, CollectActuator(group="apple"))
    for _ in range(60):
        sim.step()
    assert not gone(world, "apple 1")
    assert world["robot"].position[0] < 0.8


def test_it_feeds_the_variables() -> None:
    world = orchard((1.5, 0))
    keeper = HomeostaticReward(variables=[variable("energy"), variable("warmth", value=60)])
    collect = CollectActuator(group="apple", adds={"energy": 30, "warmth": -15})
    sim = sim_with(world, collect, rewards=[keeper], sensors=[HomeostaticSensor()])
    for _ in range(30):
        sim.step()
    assert sim.agents[0].percept["homeostatic"].tolist() == pytest.approx([0.4, 0.45])


def test_the_meal_is_paid_in_the_decision_in_which_it_is_eaten() -> None:
    world = orchard((1.5, 0))
    keeper = HomeostaticReward(variables=[variable("energy")], reward=10)
    rewards = [
        keeper,
        GoneReward(group="apple", reward=7),
        TouchRewardFunc(target="apple 1", reward=1),
    ]
    collect = CollectActuator(group="apple", adds={"energy": 30})
    sim = sim_with(world, collect, rewards=rewards, skip_frame=4)
    agent = sim.agents[0]
    while not gone(world, "apple 1"):
        assert not any(agent.reward_terms.values())
        sim.step()
    assert agent.reward_terms == pytest.approx({"homeostatic": 3, "gone": 7, "touch": 1})


def test_it_comes_back_where_it_was() -> None:
    world = orchard((1.5, 0))
    drive = Drive(AHEAD)
    sim = sim_with(world, CollectActuator(group="apple", comes_back_after=0.5), drive=drive)
    while not gone(world, "apple 1"):
        sim.step()
    gone_at, drive.action = world.ticks, BACK
    while gone(world, "apple 1"):
        sim.step()
    assert world.ticks - gone_at == 30
    assert at(world, "apple 1") == (1.5, 0)
    drive.action = AHEAD
    again = [sim.step() and gone(world, "apple 1") for _ in range(60)]
    assert any(again), "it can be collected again"


def test_it_comes_back_elsewhere_if_its_place_is_random() -> None:
    world = orchard((1.5, 0))
    vary = {"places": [(1.5, y) for y in (0, 2, 4, 6, 8)]}
    world.add_body("apple 2", CircleShape(radius=0.3), kind="static", tags=("apple",), random=vary)
    places: dict[int, list[tuple[float, float]]] = {}
    for seed in (1, 2, 1):
        sim = sim_with(world, CollectActuator(group="apple", comes_back_after=0))
        sim.reset(seed)
        apple = world["apple 2"]
        found = [apple.position]
        for _ in range(12):
            x, y = apple.position
            sim.agents[0].body.move_to(x - 0.75, y)
            sim.step()
            sim.step()
            found.append(apple.position)
        assert len(set(found)) > 2
        assert places.setdefault(seed, found) == found
    assert places[1] != places[2]


def test_it_waits_while_there_is_no_room() -> None:
    world = orchard((9, 0))
    world.add_body(
        "apple 2",
        CircleShape(radius=0.3),
        kind="static",
        tags=("apple",),
        random={"places": [(1.5, 0)]},
    )
    drive = Drive(AHEAD)
    sim = sim_with(world, CollectActuator(group="apple", comes_back_after=0.2), drive=drive)
    while not gone(world, "apple 2"):
        sim.step()
    drive.action = STAY
    world["robot"].move_to(1.5, 0)
    for _ in range(60):
        sim.step()
    assert gone(world, "apple 2")
    world["robot"].move_to(-3, 0)
    for _ in range(60):
        sim.step()
    assert at(world, "apple 2") == (1.5, 0)
    assert not gone(world, "apple 2")


def test_what_needs_something_is_an_obstacle_to_who_has_it_not() -> None:
    world = orchard((1.5, 0))
    keeper = HomeostaticReward(variables=[variable("power", value=0, comfort_min=0)])
    collect = CollectActuator(group="apple", needs={"power": 50}, adds={"power": -40})
    died = OrRewardFunc(name="died", children=[CollisionWithRewardFunc(group="apple")], reward=-9)
    drive = Drive(AHEAD)
    sim = sim_with(world, collect, rewards=[keeper, died], drive=drive)
    for _ in range(60):
        sim.step()
    assert not gone(world, "apple 1")
    assert sim.agents[0].reward_terms["died"] == -9
    keeper.variable("power").add_value(50)
    sim.step()
    assert gone(world, "apple 1")
    assert keeper.variable("power").level == 10
    assert sim.agents[0].reward_terms["died"] == 0, "what is collected hurts nobody"


def test_a_reset_brings_all_back_and_forgets_what_was_due() -> None:
    world = orchard((1.5, 0))
    drive = Drive(AHEAD)
    sim = sim_with(world, CollectActuator(group="apple", comes_back_after=1), drive=drive)
    while not gone(world, "apple 1"):
        sim.step()
    sim.reset()
    assert there(world) == ["apple 1"]
    drive.action = STAY
    world["apple 1"].move_to(5, 5)
    for _ in range(90):
        sim.step()
    assert at(world, "apple 1") == (5, 5), "nothing of the last episode is due"


def test_what_an_agent_took_comes_back_though_it_begins_alone() -> None:
    world = orchard((1.5, 0))
    drive = Drive(AHEAD)
    sim = sim_with(world, CollectActuator(group="apple", comes_back_after=1), drive=drive)
    while not gone(world, "apple 1"):
        sim.step()
    sim.restart(sim.agents[0])
    drive.action = STAY
    assert there(world) == []
    for _ in range(61):
        sim.step()
    assert there(world) == ["apple 1"]


def test_what_somebody_removed_does_not_come_back() -> None:
    world = orchard((1.5, 0))
    sim = sim_with(world, CollectActuator(group="apple", comes_back_after=0.5))
    while not gone(world, "apple 1"):
        sim.step()
    world.remove("apple 1")
    for _ in range(60):
        sim.step()
    assert there(world) == []


@pytest.mark.parametrize(
    ("fields", "text"),
    [
        ({"group": "aple"}, "no body carries the tag 'aple'; did you mean 'apple'?"),
        (
            {"group": "apple", "adds": {"enrgy": 1}},
            "no variable is named 'enrgy'; did you mean 'energy'?",
        ),
        (
            {"group": "apple", "needs": {"power": 1}},
            "no variable is named 'power'; known are 'energy'",
        ),
        (
            {"group": "apple", "adds": {"energy": 1}, "source": "inside"},
            "no HomeostaticReward is called 'inside'; known are 'homeostatic'",
        ),
    ],
)
def test_unknown_names(fields: dict[str, Any], text: str) -> None:
    keeper = HomeostaticReward(variables=[variable("energy")])
    with pytest.raises(BlockError) as caught:
        sim_with(orchard((3, 3)), CollectActuator(**fields), rewards=[keeper])
    assert str(caught.value) == f"agent '0', CollectActuator 'collect': {text}"


def gone_sim(**fields: Any) -> tuple[ControlRequestor, World]:
    world = orchard((9, 0), (9, 3), (9, 6))
    sim = sim_with(world, drive=Drive(STAY), rewards=[GoneReward(group="apple", **fields)])
    return sim, world


def rewards_of(sim: ControlRequestor, world: World, *leaving: str) -> float:
    for name in leaving:
        world[name].leave()
    sim.step()
    return sim.agents[0].reward


def test_each_one_that_goes_is_paid_for() -> None:
    sim, world = gone_sim(reward=2)
    assert rewards_of(sim, world) == 0
    assert rewards_of(sim, world, "apple 1", "apple 3") == 4
    assert rewards_of(sim, world) == 0
    world["apple 3"].come_back()
    assert rewards_of(sim, world) == 0
    assert rewards_of(sim, world, "apple 3") == 2
    sim.reset()
    assert rewards_of(sim, world) == 0


def test_only_the_last_one_is_paid_for() -> None:
    sim, world = gone_sim(reward=2, only_last=True, cause_episode_to_end=True)
    assert rewards_of(sim, world, "apple 1", "apple 3") == 0
    assert not sim.agents[0].done
    assert rewards_of(sim, world, "apple 2") == 2
    assert sim.agents[0].terminated
    sim.reset()
    assert rewards_of(sim, world) == 0
    assert rewards_of(sim, world, "apple 1", "apple 2", "apple 3") == 2


def test_the_last_one_is_paid_for_once() -> None:
    sim, world = gone_sim(only_last=True)
    assert rewards_of(sim, world, "apple 1", "apple 2", "apple 3") == 1
    assert rewards_of(sim, world) == 0


def test_what_falls_over_an_edge_is_gone_too() -> None:
    world = World()
    world.add_floor("plate", BoxShape(size=(4, 4)))
    world.add_body("robot", CircleShape(radius=0.5))
    world.add_body("apple", CircleShape(radius=0.3), position=(3, 0), tags=("apple",))
    sim = sim_with(world, drive=Drive(STAY), rewards=[GoneReward(group="apple")])
    total = 0.0
    for _ in range(60):
        sim.step()
        total += sim.agents[0].reward
    assert total == 1
