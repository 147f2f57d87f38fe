"""The controller that asks a network: what it answers, and what it says when nothing fits."""

import json
import pickle
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import numpy as np
import onnx
import pytest
from onnx import TensorProto, helper

from ai4u_edu import (
    BasicAgent,
    BearingSensor,
    CircleShape,
    Command,
    ControlRequestor,
    GroundStatusSensor,
    HeadingSensor,
    LocalBrain,
    NeuralNetController,
    RBMoveActuator,
    Scene,
    Sensor,
    World,
    trained_brain,
)
from ai4u_edu.base.errors import AI4UError, BlockError, SetupError
from tests.learn.training.networks import network

pytestmark = pytest.mark.needs("train")


def sim_with(
    path: Path | str, *sensors: Sensor, actuator: str = "move", **parameters: object
) -> ControlRequestor:
    """A robot beside a box, driven by a network."""
    world = World()
    world.add_body("robot", CircleShape(radius=0.5))
    world.add_body("box", CircleShape(radius=0.5), position=(3, 4))
    controller = NeuralNetController(model_path=str(path), **parameters)  # type: ignore[arg-type]
    agent = BasicAgent(
        body="robot",
        max_steps_per_episode=3,
        sensors=list(sensors),
        actuators=[RBMoveActuator(action_name=actuator)],
        brains=[LocalBrain(controller=controller)],
    )
    return ControlRequestor(world, [agent])


def test_it_answers_with_the_networks_action(tmp_path: Path) -> None:
    file = network(tmp_path / "sum.onnx", {"heading": (2,), "ground_status": (1,)})
    sim = sim_with(file, HeadingSensor(), GroundStatusSensor())
    sim.reset()
    agent = sim.agents[0]
    expected = sum(agent.percept["heading"]) + agent.percept["ground_status"][0]
    answer = agent.brain.decide(agent.percept)
    assert not isinstance(answer, Command)
    np.testing.assert_allclose(answer["move"], [expected] * 4, rtol=1e-6)
    sim.step()
    assert agent.last_action["move"] == (1.0, 1.0, 1.0, 1.0)  # 2, cut to what the actuator takes


@pytest.mark.parametrize("repeat", [True, False])
def test_a_new_episode_when_one_is_over(tmp_path: Path, repeat: bool) -> None:
    file = network(tmp_path / "sum.onnx", {"heading": (2,)})
    sim = sim_with(file, HeadingSensor(), repeat=repeat)
    sim.reset()
    for _ in range(10):
        sim.step()
    assert sim.episode == (3 if repeat else 1)


def test_a_sensor_is_missing(tmp_path: Path) -> None:
    sensors = {"bearing": {"type": "BearingSensor", "target": "box"}}
    about = json.dumps({"sensors": sensors, "scene": "sumo"})
    file = network(tmp_path / "a.onnx", {"bearing": (2,), "heading": (2,)}, about=about)
    with pytest.raises(
        BlockError,
        match=(
            r"the network a.onnx does not fit agent '0' \(it was trained in the scene 'sumo'\): "
            r"sensor 'bearing' of shape \(2,\) \(a "
            r"BearingSensor, where it was trained\) is missing; did you mean 'heading'\?"
        ),
    ):
        sim_with(file, HeadingSensor())


def test_a_sensor_that_is_off_is_missing_too(tmp_path: Path) -> None:
    file = network(tmp_path / "a.onnx", {"heading": (2,)})
    with pytest.raises(
        BlockError, match=r"sensor 'heading' of shape .* is missing; there are none"
    ):
        sim_with(file, HeadingSensor(is_active=False))


def test_every_sensor_of_another_shape_is_told(tmp_path: Path) -> None:
    file = network(tmp_path / "a.onnx", {"bearing": (2, 2), "heading": (3,)})
    with pytest.raises(BlockError) as caught:
        sim_with(file, BearingSensor(target="box", stacked_observations=4), HeadingSensor())
    assert str(caught.value).endswith(
        "sensor 'bearing' has the shape (4, 2), and the network was trained with (2, 2); "
        "sensor 'heading' has the shape (2,), and the network was trained with (3,)"
    )


def test_actuators_that_do_not_fit(tmp_path: Path) -> None:
    file = network(tmp_path / "a.onnx", {"heading": (2,)}, "wheels", size=2)
    with pytest.raises(BlockError, match=r"gives 2 numbers for 'move', and .* takes 4"):
        sim_with(file, HeadingSensor())
    with pytest.raises(BlockError, match=r"drives an actuator 'mvoe', .*; did you mean 'move'"):
        sim_with(file, HeadingSensor(), main_output="mvoe")
    four = network(tmp_path / "b.onnx", {"heading": (2,)}, "wheels", size=4)
    sim = sim_with(four, HeadingSensor(), actuator="wheels")  # the output's own name comes first
    sim.reset()
    sim.step()
    assert sim.agents[0].last_action["wheels"] == (1.0, 1.0, 1.0, 1.0)


class Evil:
    """Object whose pickle creates a file when it is loaded."""

    def __reduce__(self) -> tuple[object, tuple[str, ...]]:
        return (open, ("owned", "w"))


def test_nothing_but_onnx_is_loaded(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("model.zip", "model.pt", "model"):
        Path(name).write_bytes(pickle.dumps(Evil()))
        with pytest.raises(BlockError, match=r"expected a network as an .onnx file"):
            sim_with(name)
    Path("model.onnx").write_bytes(pickle.dumps(Evil()))
    with pytest.raises(BlockError, match="expected a network that onnxruntime can run"):
        sim_with("model.onnx")
    assert not Path("owned").exists()


def test_no_weights_out_of_other_files(tmp_path: Path) -> None:
    model = onnx.load(network(tmp_path / "a.onnx", {"heading": (2,)}))
    (tmp_path / "secret").write_bytes(b"\0" * 64)
    weights = model.graph.initializer[1]
    weights.ClearField("raw_data")
    weights.data_location = TensorProto.EXTERNAL
    entry = weights.external_data.add()
    entry.key, entry.value = "location", "secret"
    (tmp_path / "b.onnx").write_bytes(model.SerializeToString())
    with pytest.raises(BlockError, match="expected a network that onnxruntime can run"):
        sim_with(tmp_path / "b.onnx", HeadingSensor())


def test_no_weights_out_of_the_current_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # nothing that onnxruntime computes beforehand: it would look for the file when it is loaded
    weights = TensorProto(name="w", data_type=TensorProto.FLOAT, dims=[4])
    weights.data_location = TensorProto.EXTERNAL
    entry = weights.external_data.add()
    entry.key, entry.value = "location", "secret"
    nodes = [
        helper.make_node("Cast", ["heading"], ["index"], to=TensorProto.INT64),
        helper.make_node("Gather", ["w", "index"], ["found"]),
        helper.make_node("Concat", ["found", "found"], ["move"], axis=1),
    ]
    file = built(tmp_path / "a.onnx", nodes, weights)
    for folder in (tmp_path, tmp_path / "elsewhere"):
        folder.mkdir(exist_ok=True)
        monkeypatch.chdir(folder)
        (folder / "secret").write_bytes(np.ones(4, np.float32).tobytes())
        with pytest.raises(BlockError, match=r"NeuralNetController .*a\.onnx: expected a network"):
            sim_with(file, HeadingSensor())


def built(
    path: Path,
    nodes: list[onnx.NodeProto],
    *weights: TensorProto,
    output: tuple[int | str, ...] = ("batch", 4),
) -> Path:
    """A network from ``heading`` to ``move``."""
    graph = helper.make_graph(
        nodes,
        "odd",
        [helper.make_tensor_value_info("heading", TensorProto.FLOAT, ["batch", 2])],
        [helper.make_tensor_value_info("move", TensorProto.FLOAT, output)],
        weights,
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 18)], ir_version=9)
    path.write_bytes(model.SerializeToString())
    return path


def repeated() -> list[onnx.NodeProto]:
    """The sum of as many zeros as the weight ``times`` says, times what comes in."""
    return [
        helper.make_node("Cast", ["heading"], ["whole"], to=TensorProto.INT64),
        helper.make_node("ReduceMin", ["whole"], ["nothing"], keepdims=0),
        helper.make_node("Mul", ["nothing", "zero"], ["zeros"]),
        helper.make_node("Add", ["zeros", "times"], ["length"]),
        helper.make_node("ConstantOfShape", ["length"], ["many"]),
        helper.make_node("ReduceSum", ["many"], ["sum"], keepdims=1),
        helper.make_node("Concat", ["heading", "heading"], ["four"], axis=1),
        helper.make_node("Mul", ["sum", "four"], ["move"]),
    ]


def numbers(name: str, value: int) -> TensorProto:
    return onnx.numpy_helper.from_array(np.array([value]), name)


def test_a_network_that_wants_more_memory_than_there_is(tmp_path: Path) -> None:
    file = built(tmp_path / "huge.onnx", repeated(), numbers("zero", 0), numbers("times", 2**50))
    sim = sim_with(file, HeadingSensor())
    sim.reset()
    told = (
        r"NeuralNetController '.*huge\.onnx': huge\.onnx: onnxruntime can't run this network: "
        r".*; expected one that decides within the memory"
    )
    with pytest.raises(BlockError, match=told) as caught:
        sim.agents[0].brain.decide(sim.agents[0].percept)
    assert len(str(caught.value)) < 600
    assert "onnxruntime_src" not in str(caught.value)


def test_a_network_whose_output_is_other_than_its_file_says(tmp_path: Path) -> None:
    nodes = [*repeated()[:4], helper.make_node("ConstantOfShape", ["length"], ["move"])]
    sizes = onnx.numpy_helper.from_array(np.array([1, 3]), "times")
    sim = sim_with(built(tmp_path / "b.onnx", nodes, numbers("zero", 0), sizes), HeadingSensor())
    sim.reset()
    with pytest.raises(BlockError, match=r"expected outputs of the shapes \[\(1, 4\)\]"):
        sim.agents[0].brain.decide(sim.agents[0].percept)


def test_a_network_of_more_numbers_than_any_sensor_gives(tmp_path: Path) -> None:
    file = network(tmp_path / "wide.onnx", {"heading": (2**20, 2**20)})
    with pytest.raises(BlockError, match=r"wide\.onnx: 'heading' .* at most 16777216 numbers"):
        sim_with(file, HeadingSensor())


def test_a_network_whose_size_overflows(tmp_path: Path) -> None:
    file = network(tmp_path / "wide.onnx", {"heading": (2**32, 2**32)})
    # some versions of onnxruntime refuse it before its inputs are looked at
    with pytest.raises(BlockError, match=r"wide\.onnx: ('heading' .* at most|expected a network)"):
        sim_with(file, HeadingSensor())


def test_a_damaged_file_is_told_of_whatever_is_wrong_with_it(tmp_path: Path) -> None:
    data = network(tmp_path / "a.onnx", {"heading": (2,)}, about="{}").read_bytes()
    for place in range(0, len(data), 7):
        for byte in (0x00, 0xFF):
            damaged = data[:place] + bytes([byte]) + data[place + 1 :]
            (tmp_path / "a.onnx").write_bytes(damaged)
            with suppress(AI4UError):  # some bytes make no difference
                sim = sim_with(tmp_path / "a.onnx", HeadingSensor())
                sim.reset()
                sim.agents[0].brain.decide(sim.agents[0].percept)


def test_files_that_are_not_as_they_should_be(tmp_path: Path) -> None:
    with pytest.raises(BlockError, match=r"the network 'a.onnx' is not there as .*a.onnx"):
        sim_with("a.onnx")
    with pytest.raises(BlockError, match="the zoo has no network for 'box_chess'"):
        sim_with("zoo:box_chess")
    for batch in (2, 0):
        file = network(tmp_path / "b.onnx", {"heading": (2,)}, batch=batch)
        with pytest.raises(BlockError, match=f"takes {batch} decisions at once"):
            sim_with(file, HeadingSensor())
    file = network(tmp_path / "c.onnx", {"heading": (2,)}, kind=TensorProto.DOUBLE)
    with pytest.raises(BlockError, match=r"'heading' is a tensor\(double\); expected one of"):
        sim_with(file, HeadingSensor())
    for about in ("[]", "{", '"x"', "[" * 5000):
        file = network(tmp_path / "d.onnx", {"heading": (2,)}, about=about)
        with pytest.raises(BlockError, match="its entry 'ai4u_edu' is no JSON mapping"):
            sim_with(file, HeadingSensor())


@pytest.mark.parametrize("about", ['{"sensors": 3}', '{"sensors": {"heading": []}}', "{}"])
def test_odd_words_about_itself_do_no_harm(tmp_path: Path, about: str) -> None:
    file = network(tmp_path / "a.onnx", {"heading": (2,)}, about=about)
    with pytest.raises(BlockError, match=r"sensor 'heading' of shape \(2,\) is missing"):
        sim_with(file)


def test_a_brain_in_the_networks_own_rhythm(tmp_path: Path) -> None:
    about = json.dumps({"skip_frame": 7, "repeat_action": False})
    file = network(tmp_path / "a.onnx", {"heading": (2,)}, about=about)
    brain = trained_brain(str(file))
    assert (brain.skip_frame, brain.repeat_action) == (7, False)
    elsewhere = trained_brain(str(network(tmp_path / "b.onnx", {"heading": (2,)})))
    assert (elsewhere.skip_frame, elsewhere.repeat_action) == (4, True)
    odd = network(tmp_path / "c.onnx", {"heading": (2,)}, about='{"skip_frame": -1}')
    with pytest.raises(SetupError, match="skip_frame: expected at least 0, got -1"):
        trained_brain(str(odd))


def test_a_path_begins_beside_the_scene_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    elsewhere = tmp_path / "elsewhere"
    (tmp_path / "nets").mkdir()
    elsewhere.mkdir()
    network(tmp_path / "nets/a.onnx", {"heading": (2,)})
    text = """
name: mine
bodies: [{name: robot, shape: {type: circle, radius: 0.5}}]
agents:
  - body: robot
    sensors: [{type: HeadingSensor}]
    actuators: [{type: RBMoveActuator}]
    brains: [{type: LocalBrain, controller: {type: NeuralNetController, model_path: nets/a.onnx}}]
"""
    (tmp_path / "mine.yaml").write_text(text)
    monkeypatch.chdir(elsewhere)
    scene = Scene.load(tmp_path / "mine.yaml")
    sim = scene.build()
    sim.reset()
    sim.step()
    assert sim.agents[0].last_action["move"][0] == 1.0
    assert scene.plain()["agents"][0]["brains"][0]["controller"]["model_path"] == "nets/a.onnx"
    with pytest.raises(SetupError, match="is not there as"):
        Scene.loads(text)


def test_the_core_loads_no_network_before_there_is_one() -> None:
    code = (
        "import sys; from ai4u_edu import NeuralNetController; import ai4u_edu.cli.main;"
        "print(sorted({'onnxruntime', 'onnx', 'torch', 'stable_baselines3'} & set(sys.modules)))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"
