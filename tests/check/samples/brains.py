"""Samples of brains and controllers whose defaults do not suit the checks' world."""

from typing import Any

from ai4u_edu import (
    AntController,
    AStarController,
    BreadthFirstController,
    CallController,
    DiscreteActuator,
    DiscreteArrowController,
    FleeController,
    KeeperController,
    LocalBrain,
    NeuralNetController,
    PushOutController,
    RemoteBrain,
    ReplayController,
    ScriptController,
    StrikerController,
    TrainController,
    Trainer,
    WASDRBMoveController,
)
from tests.check.samples.sample import Sample


def circle(percept: Any) -> dict[str, Any]:
    """Drive in circles."""
    return {"move": [1, 0.5, 0, 0]}


class Weaving(Trainer):
    """Drives to the left and to the right in turns."""

    def on_reset(self) -> None:
        self.side = 1

    def state_updated(self, percept: Any) -> None:
        self.side = -self.side
        self.controller.request_continuous_action("move", [1, self.side, 0, 0])


def trained() -> TrainController:
    controller = TrainController()
    controller.trainer = Weaving()
    return controller


SAMPLES = (
    LocalBrain(controller=WASDRBMoveController()),
    Sample(RemoteBrain(port=9), always_same="it waits: nobody listens on this port"),
    Sample(AntController(), scene="ants"),
    Sample(AStarController(), scene="grid_world"),
    Sample(BreadthFirstController(), scene="grid_world"),
    Sample(CallController(), scene="call"),
    Sample(DiscreteArrowController(), actuators=(DiscreteActuator(),)),
    Sample(FleeController(pursuer="runner 1"), scene="tag"),
    Sample(KeeperController(), scene="soccer"),
    Sample(NeuralNetController(model_path="zoo:box_chase"), scene="box_chase"),
    Sample(PushOutController(), scene="sumo"),
    ReplayController(actions=[{"move": [1, 0, 0, 0]}, {"move": [0, 1, 0, 0]}], ending="repeat"),
    Sample(ScriptController(function=circle), always_same="its function always answers the same"),
    Sample(StrikerController(), scene="soccer"),
    trained(),
)
