"""Events of touching bodies, and of entering and leaving areas."""

from typing import Any

import pytest

from ai4u_edu import (
    BasicAgent,
    BoxShape,
    CircleShape,
    ControlRequestor,
    EventRewardFunc,
    LocalBrain,
    OrRewardFunc,
    RBMoveActuator,
    RewardFunc,
    Scene,
    World,
)
from ai4u_edu.agent.events import CONTACT_EVENTS
from ai4u_edu.base.errors import BlockError
from ai4u_edu.check import check_scene
from ai4u_edu.recording import Recorder, Replay

SCENE = """
name: halves
areas:
  - {name: left_half, shape: {type: box, size: [4, 8]}, position: [-2.001, 0]}
  - {name: right_half, shape: {type: box, size: [4, 8]}, position: [2.001, 0]}
bodies:
  - {name: robot, shape: {type: circle, radius: 0.4}, position: [-1, 0]}
  - {name: wall, kind: static, shape: {type: box, size: [1, 4]}, position: [3, 0]}
agents:
  - body: robot
    max_steps_per_episode: 60
    actuators: [{type: RBMoveActuator, move_amount: 3}]
    rewards:
      - {type: EventRewardFunc, name: right, event: touch, target: right_half, reward: 10}
      - {type: EventRewardFunc, name: out, event: leave, target: right_half, reward: -1}
      - {type: EventRewardFunc, name: left, event: touch, target: left_half, reward: 5}
      - {type: EventRewardFunc, name: bump, event: touch, target: wall, reward: -2}
      - {type: EventRewardFunc, name: once, event: touch, target: right_half, only_one_time: true}
    brains: [{type: LocalBrain, controller: {type: ReplayController, actions: [{}]}}]
"""


def there_and_back() -> Any:
    """Return a controller that drives to the wall and back again, twice."""
    count = 0

    def drive(_percept: Any) -> dict[str, list[float]]:
        nonlocal count
        count += 1
        return {"move": [1.0 if count // 14 % 2 == 0 else -1.0, 0, 0, 0]}

    return drive


def halves() -> ControlRequestor:
    return Scene.loads(SCENE).build(brains=lambda _: LocalBrain(controller=there_and_back()))


def run(sim: ControlRequestor, steps: int = 50) -> None:
    sim.reset(1)
    for _ in range(steps):
        sim.step()


def listen(agent: BasicAgent) -> list[tuple[str, str, int]]:
    told: list[tuple[str, str, int]] = []
    for name in CONTACT_EVENTS:
        getattr(agent, name).connect(
            lambda each, thing, name=name: told.append((name, thing, each.steps))
        )
    return told


def test_events_come_once_for_each_way_in_and_out() -> None:
    sim = halves()
    told = listen(sim.agents[0])
    run(sim)
    way = ["area_left", "area_entered", "touched", "area_left", "area_entered"]
    assert [name for name, _, _ in told] == way + way
    assert [thing for _, thing, _ in told[:5]] == [
        "left_half",
        "right_half",
        "wall",
        "right_half",
        "left_half",
    ]
    assert [step for _, _, step in told] == sorted(step for _, _, step in told)


def test_an_episode_begins_without_events() -> None:
    sim = halves()
    told = listen(sim.agents[0])
    run(sim, 1)
    sim.reset(1)
    sim.step()
    sim.restart(sim.agents[0])
    sim.step()
    assert told == [], "it begins in the left half, and has not entered it"


def test_a_handler_pays_as_in_ai4us_guide() -> None:
    sim = halves()
    agent = sim.agents[0]
    agent.area_entered.connect(lambda agent, area: agent.add_reward(10, name=area))
    agent.touched.connect(lambda agent, _: agent.add_reward(-1, request_done=True))
    sim.reset(1)
    while not agent.done:
        sim.step()
    assert agent.terminated
    assert agent.ledger.episode_terms["right_half"] == 10
    assert agent.reward_terms["handlers"] == -1


def test_an_error_names_handler_and_event() -> None:
    sim = halves()

    def counts(_agent: BasicAgent, _name: str) -> None:
        raise ValueError("a slip")

    sim.agents[0].touched.connect(counts)
    with pytest.raises(ValueError, match="a slip") as caught:
        run(sim)
    assert "handler counts of touched" in "".join(caught.value.__notes__)


def test_a_disconnected_handler_hears_no_more_and_costs_no_ticks() -> None:
    sim = halves()
    agent = sim.agents[0]
    agent.rewards.clear()
    agent.setup(sim.world)
    told = listen(agent)
    before = agent.contacts.has_handlers
    for name in CONTACT_EVENTS:
        event = getattr(agent, name)
        event.disconnect(event.handlers[0])
    assert (before, agent.contacts.has_handlers) == (True, False)
    run(sim)
    assert told == []


def test_a_copy_of_the_world_goes_on_without_a_false_event() -> None:
    sim, copy = halves(), halves()
    run(sim, 20)
    listen(sim.agents[0])
    sim.step()
    told = listen(copy.agents[0])
    copy.set_state(sim.get_state())
    copy.step()
    assert told == []


def test_rewards_pay_for_each_event() -> None:
    sim = halves()
    run(sim)
    terms = sim.agents[0].ledger.episode_terms
    assert terms == {"right": 20, "out": -2, "left": 10, "bump": -4, "once": 1}


def test_an_event_counts_once_in_a_decision_of_many_ticks() -> None:
    robot_only: list[RewardFunc] = [EventRewardFunc(event="touch", target="gate", reward=3)]
    sim = gate(robot_only, skip_frame=90)
    sim.reset(1)
    sim.step()
    assert sim.agents[0].reward == 3, "it drove in and out again within the decision"


def test_a_condition_on_an_event() -> None:
    way_out = EventRewardFunc(event="leave", target="gate", reward=0)
    sim = gate([OrRewardFunc(reward=7, children=[way_out])], skip_frame=90)
    sim.reset(1)
    sim.step()
    assert sim.agents[0].reward == 7


def gate(rewards: list[RewardFunc], skip_frame: int) -> ControlRequestor:
    world = World()
    world.add_body("robot", CircleShape(radius=0.4), position=(-1, 0))
    world.add_area("gate", BoxShape(size=(0.5, 2)))
    agent = BasicAgent(
        body="robot",
        actuators=[RBMoveActuator(move_amount=3)],
        rewards=rewards,
        brains=[
            LocalBrain(controller=lambda _: {"move": [1, 0, 0, 0]}, skip_frame=skip_frame),
        ],
    )
    return ControlRequestor(world, [agent])


def test_a_recording_is_replayed_with_the_same_rewards() -> None:
    sim = halves()
    paid: list[dict[str, float]] = []
    sim.agents[0].percept_ready.connect(lambda agent: paid.append(agent.reward_terms))
    recorder = Recorder(sim, scene=Scene.loads(SCENE).description)
    run(sim)
    recorder.finish()
    replay = Replay(recorder.episodes[-1])
    assert replay.verdict.why == ""
    assert [dict(replay.at(step).snapshot.agents[0].reward_terms) for step in (12, 26)] == [
        paid[12],
        paid[26],
    ]
    here = replay.continue_from(20, brains={"0": LocalBrain(controller=there_and_back())})
    here.step()
    assert here.agents[0].ledger.episode_terms["right"] == 10


def test_a_wrong_target_is_explained() -> None:
    sim = halves()
    agent = sim.agents[0]
    agent.rewards[:] = [EventRewardFunc(target="right_hal")]
    with pytest.raises(BlockError, match="did you mean 'right_half'"):
        agent.setup(sim.world)


def test_a_body_is_left_as_an_area_is() -> None:
    sim = halves()
    agent = sim.agents[0]
    agent.rewards[:] = [EventRewardFunc(name="free", event="leave", target="wall", reward=4)]
    agent.setup(sim.world)
    run(sim)
    assert agent.ledger.episode_terms == {"free": 8}


def test_scene_keeps_events_and_is_checked() -> None:
    scene = Scene.loads(SCENE)
    assert Scene.loads(scene.dumps()) == scene
    assert "EventRewardFunc" in scene.dumps()
    report = str(check_scene(scene))
    assert "EventRewardFunc" not in report, report
