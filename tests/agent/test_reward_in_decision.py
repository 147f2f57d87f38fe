"""Every reward is in one decision, wherever it is paid: ledger, agent, sensor and env agree."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from gymnasium.spaces import Box

from ai4u_edu import (
    BasicAgent,
    CircleShape,
    Command,
    Controller,
    ControlRequestor,
    FloatArrayCompositeSensor,
    LocalBrain,
    Percept,
    RBMoveActuator,
    RemoteBrain,
    RewardSensor,
    Scene,
    Sensor,
    World,
)
from ai4u_edu.learn.envs import SceneEnv
from ai4u_edu.recording import Recorder, Replay
from tests.blocks.scripted_link import ScriptedLink
from tests.builders import still

FORWARD = {"move": [1, 0, 0, 0]}


class PayingController(Controller):
    """Pays 1 for being asked, and 0.25 for a percept."""

    def on_setup(self, agent: Any, view: Any) -> None:
        self._agent = agent

    def new_state_event(self, percept: Percept) -> None:
        self._agent.add_reward(0.25, name="seen")

    def get_action(self, percept: Percept) -> Any:
        self._agent.add_reward(1.0, name="asked")
        return FORWARD


class PayingSensor(Sensor):
    """Pays 1 for each reading, and may end the episode with one."""

    done_at: int = 0
    amount: float = 1.0

    def on_setup(self, agent: Any, view: Any) -> None:
        self._agent = agent
        self.readings = 0

    def on_reset(self, agent: Any, view: Any) -> None:
        self.readings = 0

    def space(self) -> Box:
        return Box(0.0, 1.0, (1,))

    def read(self, body: Any, view: Any) -> float:
        request_done = self.done_at == self.readings > 0
        self._agent.add_reward(self.amount, request_done=request_done, name="read")
        self.readings += 1
        return 0.0


def one_agent(**parameters: Any) -> tuple[ControlRequestor, BasicAgent]:
    """A world of one agent that senses its reward first, before anything else pays."""
    world = World()
    world.add_body("robot", CircleShape(radius=0.3))
    given: dict[str, Any] = {
        "actuators": [RBMoveActuator()],
        "brains": [LocalBrain(controller=lambda percept: FORWARD)],
    }
    given |= parameters
    given["sensors"] = [RewardSensor(), *given.get("sensors", [])]
    agent = BasicAgent(body="robot", **given)
    return ControlRequestor(world, [agent]), agent


def check_sums(sim: ControlRequestor, agent: BasicAgent, decisions: int, expected: float) -> None:
    """Check that all totals say the same after each decision."""
    agent.ledger.keep_history(1000)
    sim.reset()
    assert (agent.reward, agent.ledger.episode_total, agent.percept["reward"]) == (0, 0, 0)
    total = 0.0
    for _ in range(decisions):
        percept = sim.step()
        assert agent.reward == expected
        assert float(percept["reward"]) == expected
        assert sum(agent.reward_terms.values()) == expected
        total += agent.reward
        assert agent.ledger.episode_total == total
        latest = agent.ledger.latest()[-1]
        assert (latest.total, latest.so_far) == (expected, total)


def test_what_a_controller_pays_is_in_the_decision_that_it_takes() -> None:
    sim, agent = one_agent(brains=[LocalBrain(controller=PayingController())])
    check_sums(sim, agent, 3, 1.25)


def test_what_a_controller_pays_while_it_waits_is_in_its_next_decision() -> None:
    def patient(percept: Percept) -> Any:
        agent.add_reward(-1.0)
        asked.append(percept)
        return Command.WAIT if len(asked) % 3 else FORWARD

    asked: list[Percept] = []
    sim, agent = one_agent(brains=[LocalBrain(controller=patient, skip_frame=0)])
    sim.reset()
    for _ in range(6):
        sim.tick()
    assert (agent.steps, agent.reward, agent.ledger.episode_total) == (2, -3.0, -6.0)


def test_what_a_sensor_pays_is_in_the_decision_that_its_reading_ends() -> None:
    sim, agent = one_agent(sensors=[PayingSensor()])
    check_sums(sim, agent, 3, 1.0)


@pytest.mark.parametrize("event", ["begin_of_update_state", "end_of_update_state"])
def test_what_a_handler_pays_while_sensing_is_in_the_decision_that_ends(event: str) -> None:
    sim, agent = one_agent()
    getattr(agent, event).connect(lambda agent: agent.add_reward(2.0))
    check_sums(sim, agent, 3, 2.0)


def test_a_composite_shows_a_reward_that_a_sensor_inside_it_pays() -> None:
    paying = PayingSensor(stacked_observations=2)
    children = [RewardSensor(perception_key="inner"), paying]
    composite = FloatArrayCompositeSensor(sensors=children, stacked_observations=2)
    sim, agent = one_agent(sensors=[composite])
    check_sums(sim, agent, 3, 1.0)
    assert paying.readings == 4  # the reset's and three: it was not read twice
    assert agent.percept["array"].tolist() == [[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]


def test_what_is_paid_before_the_first_decision_is_in_none() -> None:
    sim, agent = one_agent(sensors=[PayingSensor()])
    for event in ("before_the_reset", "begin_of_episode"):
        getattr(agent, event).connect(lambda agent: agent.add_reward(100.0))
    check_sums(sim, agent, 2, 1.0)
    check_sums(sim, agent, 2, 1.0)


def test_what_is_paid_after_the_end_is_in_no_total() -> None:
    sim, agent = one_agent(max_steps_per_episode=1)
    sim.reset()
    sim.step()
    agent.add_reward(7.0)
    sim.tick()
    assert (agent.reward, agent.ledger.episode_total) == (0.0, 0.0)


Asks = Callable[[BasicAgent, Callable[[], bool]], None]


def by_handler(event: str) -> Asks:
    def connect(agent: BasicAgent, is_time: Callable[[], bool]) -> None:
        def ask(agent: BasicAgent) -> None:
            agent.add_reward(0.5 * is_time(), request_done=is_time())

        getattr(agent, event).connect(ask)

    return connect


@pytest.mark.parametrize("event", ["begin_of_update_state", "end_of_update_state", "end_of_step"])
def test_an_end_that_a_handler_asks_for_while_sensing_is_at_once(event: str) -> None:
    sim, agent = one_agent()
    ends: list[float] = []
    agent.end_of_episode.connect(lambda agent: ends.append(agent.reward))
    by_handler(event)(agent, lambda: agent.steps >= (1 if event == "end_of_step" else 2))
    sim.reset()
    sim.step()
    assert not agent.done
    percept = sim.step()
    assert (agent.terminated, agent.truncated, agent.steps) == (True, False, 2)
    assert (bool(percept["done"]), float(percept["reward"])) == (True, 0.5)
    assert ends == [0.5]
    agent.begin_of_step.connect(lambda agent: ends.append(1000.0))
    sim.tick()  # the brain is asked, and its action is not applied
    assert (agent.steps, ends) == (2, [0.5])


def test_an_end_that_a_sensor_asks_for_is_at_once() -> None:
    sim, agent = one_agent(sensors=[PayingSensor(done_at=2)])
    ends: list[bool] = []
    agent.end_of_episode.connect(lambda agent: ends.append(agent.terminated))
    sim.reset()
    assert not bool(sim.step()["done"])
    percept = sim.step()
    assert (agent.terminated, bool(percept["done"]), ends) == (True, True, [True])


def test_a_negative_reward_of_a_sensor_ends_at_once_where_that_is_asked_for() -> None:
    sensors = [PayingSensor(amount=-1.0)]
    sim, agent = one_agent(sensors=sensors, done_at_negative_reward=True)
    sim.reset()
    assert not agent.done
    percept = sim.step()
    assert (agent.terminated, bool(percept["done"])) == (True, True)


def test_an_episode_ends_once_also_if_its_limit_is_reached_at_the_same_time() -> None:
    sim, agent = one_agent(sensors=[PayingSensor(done_at=1)], max_steps_per_episode=1)
    ends: list[bool] = []
    agent.end_of_episode.connect(lambda agent: ends.append(agent.terminated))
    sim.reset()
    sim.step()
    assert (agent.terminated, agent.truncated, ends) == (False, True, [False])


def two_agents() -> tuple[ControlRequestor, BasicAgent, BasicAgent]:
    world = World()
    crew = []
    for name, y in (("first", 0.0), ("second", 3.0)):
        world.add_body(name, CircleShape(radius=0.3), position=(0.0, y))
        crew.append(
            BasicAgent(
                id=name,
                body=name,
                sensors=[RewardSensor()],
                actuators=[RBMoveActuator()],
                brains=[LocalBrain(controller=still)],
            )
        )
    first, second = crew
    return ControlRequestor(world, crew), first, second


def test_what_one_agent_pays_another_at_the_same_tick_is_in_that_decision() -> None:
    sim, first, second = two_agents()
    ends: list[str] = []
    first.end_of_episode.connect(lambda agent: ends.append(agent.id))

    def tag(agent: BasicAgent) -> None:
        first.add_reward(-3.0, request_done=agent.steps == 1)

    second.end_of_step.connect(tag)
    sim.reset()
    sim.step(second)
    assert (first.reward, float(first.percept["reward"]), first.done) == (-3.0, -3.0, False)
    sim.step(second)
    assert (first.reward, float(first.percept["reward"])) == (-3.0, -3.0)
    assert (first.terminated, bool(first.percept["done"]), ends) == (True, True, ["first"])
    assert first.ledger.episode_total == -6.0
    sim.step(second)
    assert first.ledger.episode_total == -6.0  # it is out


def test_gymnasium_and_the_ledger_have_the_same_sum() -> None:
    env = SceneEnv("box_chase")
    env.reset(seed=1)
    agent, total = env.agent, 0.0
    agent.end_of_update_state.connect(lambda agent: agent.add_reward(0.5))
    for _ in range(5):
        agent.add_reward(1.0)  # as a training loop that shapes its rewards may do
        _, reward, _, _, info = env.step(np.zeros(4, np.float32))
        assert sum(info["reward_terms"].values()) == pytest.approx(reward)
        total += reward
    assert total == pytest.approx(agent.ledger.episode_total)
    assert agent.ledger.episode_terms["handlers"] == 7.5


def test_gymnasium_hears_of_an_end_that_a_handler_asks_for_while_sensing() -> None:
    env = SceneEnv("box_chase")
    by_handler("end_of_update_state")(env.agent, lambda: env.agent.steps >= 2)
    env.reset(seed=1)
    assert env.step(np.zeros(4, np.float32))[2] is False
    assert env.step(np.zeros(4, np.float32))[2] is True


def test_a_script_is_told_what_handlers_pay_after_it_began_to_listen() -> None:
    link = ScriptedLink(*[FORWARD] * 3)
    sim, agent = one_agent(brains=[RemoteBrain.with_link(link, clock=link.clock)])
    by_handler("end_of_update_state")(agent, lambda: agent.steps >= 1)
    sim.reset()
    sim.step()
    told = link.told[-1]
    assert (told.reward, told.done, bool(told.percept["done"])) == (0.5, True, True)


def test_an_episode_whose_controller_pays_is_replayed_exactly() -> None:
    sim = Scene.load("box_chase").build()
    agent = sim.agents[0]

    def paying(percept: Percept) -> Any:
        agent.add_reward(0.1, name="a")
        agent.add_reward(0.2, name="b")
        agent.add_reward(0.3, name="a")
        return {"move": [1, 0.1, 0, 0]}

    agent.use_brain(LocalBrain(controller=paying))
    recorder = Recorder(sim)
    sim.reset(seed=3)
    rewards = []
    for _ in range(10):
        sim.step()
        rewards.append(agent.reward)
    recorder.finish()
    episode = recorder.episodes[-1]
    assert episode.agents[0].rewards.tolist() == rewards
    assert set(episode.agents[0][0].reward_terms) >= {"a", "b"}
    replay = Replay(episode)
    assert replay.verdict.why == ""
    assert replay.verdict.exact
    assert replay.at(9).decision.reward == rewards[9]


def test_a_file_keeps_what_controllers_paid(tmp_path: Any) -> None:
    sim = Scene.load("box_chase").build()
    agent = sim.agents[0]
    recorder = Recorder(sim)
    sim.reset(seed=3)
    for number in range(4):
        if number % 2:
            agent.add_reward(0.1 * number)
        sim.step()
    recorder.finish()
    path = recorder.episodes[-1].save(tmp_path / "paid.episode")
    loaded = type(recorder.episodes[-1]).load(path)
    assert Replay(loaded).verdict.exact
    assert [round(each.reward_terms.get("handlers", 0.0), 6) for each in loaded.agents[0]] == [
        0.0,
        0.1,
        0.0,
        0.3,
    ]


def test_an_end_that_a_controller_asks_for_is_replayed_exactly() -> None:
    sim = Scene.load("box_chase").build()
    agent = sim.agents[0]

    def impatient(percept: Percept) -> Any:
        agent.add_reward(-1.0, request_done=agent.steps == 2)
        return FORWARD

    agent.use_brain(LocalBrain(controller=impatient))
    recorder = Recorder(sim)
    sim.reset(seed=3)
    for _ in range(3):
        sim.step()
    assert (agent.steps, agent.terminated) == (3, True)
    recorder.finish()
    verdict = Replay(recorder.episodes[-1]).verdict
    assert (verdict.exact, verdict.why) == (True, "")
