"""A world that a test advances step by step, and its editor."""

from concurrent.futures import Future
from pathlib import Path
from typing import Any, TypeVar

from ai4u_edu import Scene
from ai4u_edu.page.editing import SceneEditor
from ai4u_edu.recording import Recorder
from ai4u_edu.runtime.runner import Runner

T = TypeVar("T")

TEXT = """
name: small
floors:
  - name: plate
    shape: {type: box, size: [12, 12]}
bodies:
  - name: robot
    shape: {type: circle, radius: 0.5}
  - name: box
    shape: {type: box, size: [1, 1]}
    position: [4, 0]
    tags: [target]
  - name: wall
    shape: {type: box, size: [0.4, 4]}
    position: [-4, 0]
    kind: static
    tags: [wall]
agents:
  - id: "0"
    body: robot
    sensors:
      - {type: BearingSensor, target: box, stacked_observations: 3}
    actuators:
      - {type: RBMoveActuator, move_amount: 2, turn_amount: 2}
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 1}
      - {type: ProgressReward, target: box}
    brains:
      - type: LocalBrain
        skip_frame: 0
        controller:
          {type: ReplayController, actions: [{move: [1, 0.2, 0, 0]}], ending: repeat}
"""


class EditorHarness:
    """A runner without a thread, its editor and its recorder."""

    def __init__(
        self,
        scene: Scene | str = TEXT,
        *,
        record: bool = False,
        offers: tuple[Path | str, ...] = (),
    ) -> None:
        self.scene = Scene.loads(scene) if isinstance(scene, str) else scene
        sim = self.scene.build()
        recorder = Recorder(sim, scene=self.scene.description) if record else None
        self.runner = Runner(sim, seed=1, recorder=recorder)
        self.editor = SceneEditor(self.runner, self.scene, offers=offers)

    def done(self, future: "Future[T]") -> T:
        """Run commands until a future is done; ticks only as long as decisions are under way."""
        self.runner._run_commands()
        while not future.done():
            self.tick()
            self.runner._run_commands()
        return future.result(0)

    def tick(self, times: int = 1) -> None:
        for _ in range(times):
            self.runner._tick()
            assert self.runner.error == ""

    @property
    def agent(self) -> Any:
        return self.runner.sim.agents[0]

    @property
    def world(self) -> Any:
        return self.runner.sim.world


def trace(sim: Any, seed: int, ticks: int = 60) -> list[Any]:
    """Return everything observable of an episode, to be compared bit for bit."""
    sim.reset(seed)
    seen = []
    for _ in range(ticks):
        sim.tick()
        bodies = [(name, *body.pose, *body.velocity) for name, body in sim.world.bodies.items()]
        agents = [
            (each.id, each.percept.data, list(each.percept), each.reward_terms, each.last_action)
            for each in sim.agents
        ]
        seen.append((bodies, agents))
    return seen
