"""Errors of a scene file's setup name the place in the file."""

import pytest

from ai4u_edu import Scene
from ai4u_edu.base.errors import SceneError
from ai4u_edu.check import check_scene
from ai4u_edu.scenes.serialization import PlainDataError

SETUP = """
name: small
success: touch
bodies:
  - {name: robot, shape: {type: circle, radius: 0.4}}
  - {name: box, shape: {type: circle, radius: 0.4}, position: [3, 0]}
agents:
  - id: one
    body: robot
    sensors:
      - {type: BearingSensor, target: box}
      - type: TouchSensor
        target: box
    actuators:
      - {type: RBMoveActuator, move_amount: 2}
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 1}
      - type: AndRewardFunc
        name: both
        children:
          - {type: TouchRewardFunc, name: inner, target: box, reward: 1}
    brains:
      - type: LocalBrain
        controller: {type: WASDRBMoveController}
"""


def error_in(text: str) -> str:
    with pytest.raises(SceneError) as caught:
        Scene.loads(text.lstrip("\n"), name="my.yaml")
    return str(caught.value)


@pytest.mark.parametrize(
    ("old", "new", "where"),
    [
        ("BearingSensor, target: box", "BearingSensor, target: bxo",
         "line 10: agents[0].sensors[0].target: agent 'one', BearingSensor 'bearing': no body"),
        ("        target: box\n    act", "        target: bxo\n    act",
         "line 12: agents[0].sensors[1].target: agent 'one', TouchSensor 'touch': no body"),
        ("name: inner, target: box", "name: inner, target: bxo",
         "line 20: agents[0].rewards[1].children[0].target: agent 'one', "),
        ("body: robot", "body: robto", "line 8: agents[0].body: agent 'one': no body is"),
        ("      - type: TouchSensor\n        target: box",
         "      - type: BearingSensor\n        target: box",
         "line 11: agents[0].sensors[1]: agent 'one': two sensors have the perception_key"),
        ("name: both", "name: touch",
         "line 17: agents[0].rewards[1]: agent 'one': two reward functions have the name 'touch'"),
        ("    brains:\n", "    brains:\n      - type: LocalBrain\n        controller: "
         "{type: WASDRBMoveController}\n",
         "line 24: agents[0].brains[1]: agent 'one': expected exactly one enabled brain, got 2"),
        ("      - type: LocalBrain\n", "      - type: LocalBrain\n        enabled: false\n",
         "line 21: agents[0].brains: agent 'one': expected exactly one enabled brain, got none"),
        ("WASDRBMoveController}", "NeuralNetController, model_path: zoo:grid_world}",
         "line 22: agents[0].brains[0]: agent 'one', LocalBrain(NeuralNetController): the network "
         "grid_world.onnx"),
        ("WASDRBMoveController}", "NeuralNetController, model_path: nosuch.onnx}",
         "line 23: agents[0].brains[0].controller.model_path: agent 'one', "
         "LocalBrain(NeuralNetController): "),
    ],
)  # fmt: skip
def test_a_setup_that_fails_is_told_with_its_place(old: str, new: str, where: str) -> None:
    assert old in SETUP
    assert error_in(SETUP.replace(old, new, 1)).startswith(f"my.yaml, {where}")


def test_of_two_agents_with_one_id_the_second_is_told() -> None:
    second = SETUP.partition("agents:\n")[2]
    told = error_in(SETUP + second)
    assert told.startswith("my.yaml, line 24: agents[1].id: two agents have the id 'one'")


@pytest.mark.parametrize(
    ("success", "hint"),
    [
        ("touhc", "did you mean 'touch'?"),
        ("inner", "it is paid under the name 'both'"),
        ("moon", "known are 'both', 'touch'"),
    ],
)
def test_a_success_that_nothing_pays_is_a_fault(success: str, hint: str) -> None:
    text = SETUP.replace("success: touch", f"success: {success}")
    assert error_in(text) == (
        f"my.yaml, line 2: success: no reward function has the name {success!r}, so no episode "
        f"could succeed; {hint}"
    )
    scene = Scene.loads(SETUP)
    scene.description = scene.description.model_copy(update={"success": success})
    with pytest.raises(PlainDataError, match="success: no reward function has the name"):
        scene.build()
    report = check_scene(scene, decisions=2)
    assert not report.ok
    assert "no reward function has the name" in str(report)


@pytest.mark.parametrize("success", ["touch", "both", "handlers"])
def test_a_success_that_something_may_pay(success: str) -> None:
    Scene.loads(SETUP.replace("success: touch", f"success: {success}")).build()
