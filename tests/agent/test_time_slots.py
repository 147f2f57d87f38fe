"""Time slots of agents' decisions (``spread_decisions``)."""

from typing import Any

import numpy as np

from ai4u_edu import (
    BasicAgent,
    BoxShape,
    CircleShape,
    Command,
    ControlRequestor,
    LocalBrain,
    RBMoveActuator,
    World,
)
from ai4u_edu.learn.envs import parallel_env
from ai4u_edu.recording import Recorder, Replay
from ai4u_edu.scenes import Scene

BRAIN = "{type: LocalBrain, skip_frame: 3, controller: {type: WASDRBMoveController}}"
SCENE = """
name: crowd
spread_decisions: true
floors: [{name: plate, shape: {type: box, size: [8, 8]}}]
bodies:
  - {name: a, shape: {type: circle, radius: 0.4}, position: [-2, 0]}
  - {name: b, shape: {type: circle, radius: 0.4}, position: [2, 0]}
agents:
  - {id: a, body: a, sensors: [EYE], actuators: [WHEELS], brains: [DRIVER]}
  - {id: b, body: b, sensors: [EYE], actuators: [WHEELS], brains: [DRIVER]}
"""
for word, block in (
    ("DRIVER", BRAIN),
    ("EYE", "{type: HeadingSensor}"),
    ("WHEELS", "{type: RBMoveActuator}"),
):
    SCENE = SCENE.replace(word, block)


def watched(skips: list[int], **options: Any) -> tuple[ControlRequestor, dict[str, list[int]]]:
    """Agents that note at which ticks of the world they decide."""
    world = World()
    world.add_floor("plate", BoxShape(size=(200, 200)))
    decided: dict[str, list[int]] = {str(number): [] for number in range(len(skips))}

    def driver(name: str) -> Any:
        def decide(_percept: Any) -> dict[str, list[float]]:
            decided[name].append(world.ticks)
            return {"move": [0.1, 0.0, 0.0, 0.0]}

        return decide

    agents = []
    for number, skip in enumerate(skips):
        name = str(number)
        world.add_body(name, CircleShape(radius=0.4), position=(0.0, 3.0 * number))
        brain = LocalBrain(controller=driver(name), skip_frame=skip)
        agents.append(BasicAgent(id=name, body=name, actuators=[RBMoveActuator()], brains=[brain]))
    sim = ControlRequestor(world, agents, **options)
    sim.reset(seed=1)
    return sim, decided


def test_all_decide_at_once_unless_it_is_said() -> None:
    sim, decided = watched([3] * 3)
    for _ in range(9):
        sim.tick()
    assert decided == {name: [0, 4, 8] for name in "012"}


def test_each_has_a_tick_of_its_own() -> None:
    sim, decided = watched([3] * 5, spread_decisions=True)
    for _ in range(10):
        sim.tick()
    assert decided == {
        "0": [0, 4, 8],
        "1": [0, 1, 5, 9],
        "2": [0, 2, 6],
        "3": [0, 3, 7],
        "4": [0, 4, 8],
    }


def test_those_who_decide_at_every_tick_go_on_so() -> None:
    sim, decided = watched([0, 0, 1], spread_decisions=True)
    for _ in range(5):
        sim.tick()
    assert decided == {"0": [0, 1, 2, 3, 4], "1": [0, 1, 2, 3, 4], "2": [0, 2, 4]}


def test_an_episode_of_its_own_comes_back_to_its_turn() -> None:
    sim, decided = watched([3] * 2, spread_decisions=True)
    for _ in range(3):
        sim.tick()
    sim.restart(sim.agent("1"))
    for _ in range(7):
        sim.tick()
    assert decided["1"] == [0, 1, 3, 5, 9]
    assert sim.agent("1").steps == 2


def test_a_world_that_waited_goes_on_in_turn() -> None:
    sim, decided = watched([3] * 2, spread_decisions=True)
    brain = sim.agents[0].brain
    assert isinstance(brain, LocalBrain)
    drives = brain.decide
    brain.decide = lambda percept: Command.HOLD  # type: ignore[method-assign]
    sim.tick()
    sim.tick()
    assert sim.world.ticks == 0
    brain.decide = drives  # type: ignore[method-assign]
    for _ in range(6):
        sim.tick()
    assert decided == {"0": [0, 4], "1": [0, 1, 5]}


def test_a_file_says_it_and_a_recording_keeps_it() -> None:
    scene = Scene.loads(SCENE)
    assert Scene.loads(scene.dumps()) == scene
    sim = scene.build()
    recorder = Recorder(sim)
    sim.reset(seed=3)
    for _ in range(40):
        sim.tick()
    recorder.finish()
    episode = recorder.episodes[-1]
    assert episode.scene.spread_decisions
    assert [len(agent) for agent in episode.agents] == [10, 11]
    assert Replay(episode).verdict.exact
    assert Replay(episode).fits(Scene.loads(SCENE).build())
    assert not Replay(episode).fits(Scene.loads(SCENE.replace("true", "false")).build())


def test_an_environment_has_all_decide_at_the_same_time() -> None:
    env = parallel_env(Scene.loads(SCENE))
    env.reset(seed=1)
    env.step({name: np.zeros(4, np.float32) for name in env.agents})
    assert env.sim.world.ticks == 4
