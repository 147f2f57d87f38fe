"""Changing the driver of an agent while the world runs."""

from pathlib import Path

import pytest

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.base.errors import AI4UError, BlockError, SetupError
from ai4u_edu.blocks import NeuralNetController, RemoteBrain, ReplayController, WASDRBMoveController
from ai4u_edu.blocks.brains.network import find_network
from ai4u_edu.page.editing import ChangeError
from ai4u_edu.recording import Recorder
from tests.page.editing.harness import EditorHarness

SCRIPT = '''
from ai4u_edu import Controller

print_me = 1

def spin(percept):
    return {"move": [0, 1, 0, 0]}

def helper(a, b):
    return a

class Ahead(Controller):
    """Drives ahead."""
    def get_action(self, percept):
        return {"move": [1, 0, 0, 0]}
'''


def controller(harness: EditorHarness) -> object:
    brain = harness.agent.brain
    assert isinstance(brain, LocalBrain)
    return brain.controller


def test_keys_and_back() -> None:
    harness = EditorHarness()
    harness.tick(3)
    outcome = harness.done(harness.editor.set_driver("0", "keys:WASDRBMoveController"))
    assert outcome.when == "next decision"
    assert isinstance(controller(harness), WASDRBMoveController)
    assert (harness.agent.steps, harness.agent.brain.skip_frame) == (3, 0)
    harness.tick(2)
    assert [each.name for each in harness.editor.drivers("0")][:2] == ["brain:0", "brain:1"]
    harness.done(harness.editor.undo())
    assert isinstance(controller(harness), ReplayController)
    assert harness.editor.scene == harness.scene
    harness.done(harness.editor.redo())
    harness.done(harness.editor.set_driver("0", "brain:0"))
    assert isinstance(controller(harness), ReplayController)


def test_driver_change_keeps_the_recording_running() -> None:
    harness = EditorHarness(record=True)
    harness.tick(3)
    harness.done(harness.editor.set_driver("0", "keys:WASDRBMoveController"))
    harness.tick(2)
    recorder = harness.runner.recorder
    assert recorder is not None
    now = recorder.current_episode()
    assert now is not None
    assert (len(now.agent()), now.changed) == (5, None)


def test_a_script_that_was_named(tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text(SCRIPT)
    harness = EditorHarness(offers=(tmp_path,))
    names = [each.name for each in harness.editor.drivers("0")]
    assert [name for name in names if name.startswith("script:")] == [
        "script:mine.py:spin",
        "script:mine.py:Ahead",
    ]
    harness.done(harness.editor.set_driver("0", "script:mine.py:spin"))
    harness.tick(2)
    assert harness.agent.last_action == {"move": (0, 1, 0, 0)}
    harness.done(harness.editor.set_driver("0", "script:mine.py:Ahead"))
    harness.tick(2)
    assert harness.agent.last_action == {"move": (1, 0, 0, 0)}
    harness.done(harness.editor.undo())
    harness.tick(2)
    assert harness.agent.last_action == {"move": (0, 1, 0, 0)}
    for name in ("helper", "print_me", "Controller", "nobody"):
        with pytest.raises(SetupError, match=r"mine\.py has no driver"):
            harness.done(harness.editor.set_driver("0", f"script:mine.py:{name}"))
    assert harness.editor.scene == harness.scene  # a function is in no scene file
    # it stays when blocks are changed
    harness.done(harness.editor.add_block("0", "sensors", {"type": "HeadingSensor"}))
    harness.tick(2)
    assert harness.agent.last_action == {"move": (0, 1, 0, 0)}


@pytest.mark.parametrize(
    "name",
    [
        "script:other.py:spin",
        "script:../mine.py:spin",
        "script:mine.py:helper",
        "script:/etc/passwd:x",
        "recording:nothing.episode",
        "keys:Controller",
        "network:zoo:nowhere",
        "brain:7",
        "brain:-1",
        "import os",
    ],
)
def test_files_that_were_not_offered_are_not_run(tmp_path: Path, name: str) -> None:
    (tmp_path / "mine.py").write_text("raise SystemExit\n" + SCRIPT)
    (tmp_path / "offered").mkdir()
    harness = EditorHarness(offers=(tmp_path / "offered",))
    harness.tick(2)
    brain = harness.agent.brain
    with pytest.raises(AI4UError):
        harness.done(harness.editor.set_driver("0", name))
    assert harness.agent.brain is brain
    harness.tick(2)


def test_a_script_that_fails_is_told_with_its_line(tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text(SCRIPT + "\n1 / 0\n")
    harness = EditorHarness(offers=(tmp_path,))
    with pytest.raises(SetupError, match=r"mine.py, line 17: ZeroDivisionError"):
        harness.done(harness.editor.set_driver("0", "script:mine.py:spin"))
    (tmp_path / "mine.py").write_text(SCRIPT + "\n1 +\n")
    with pytest.raises(SetupError, match="no driver 'spin'"):  # no driver can be read in it
        harness.done(harness.editor.set_driver("0", "script:mine.py:spin"))
    (tmp_path / "mine.py").write_text(
        "from ai4u_edu import Controller\nclass WASDController(Controller):\n    pass\n"
    )
    with pytest.raises(SetupError, match="WASDController is the name of a built-in block"):
        harness.done(harness.editor.set_driver("0", "script:mine.py:WASDController"))


def test_a_recording_drives_again(tmp_path: Path) -> None:
    sim = EditorHarness().scene.build()
    recorder = Recorder(sim)
    sim.reset(1)
    for _ in range(6):
        sim.step()
    recorder.finish()
    recorder.episodes[0].save(tmp_path / "run.episode")
    harness = EditorHarness(offers=(tmp_path,))
    harness.done(harness.editor.set_driver("0", "keys:WASDRBMoveController"))
    harness.done(harness.editor.set_driver("0", "recording:run.episode"))
    harness.tick(6)
    assert harness.agent.last_action == {"move": (1.0, 0.2, 0.0, 0.0)}
    assert harness.world["robot"].pose == sim.world["robot"].pose
    harness.tick(2)  # it stops there


def test_a_network_and_the_sensors_that_it_needs() -> None:
    harness = EditorHarness(Scene.load("box_chase"))
    harness.tick(3)
    harness.done(harness.editor.set_driver("0", "network:zoo:box_chase"))
    assert isinstance(controller(harness), NeuralNetController)
    harness.tick(10)
    percept = list(harness.agent.percept)
    with pytest.raises(BlockError, match="sensor 'vision' of shape"):
        harness.done(harness.editor.remove_block("0", ("sensors", 0)))
    assert list(harness.agent.percept) == percept
    harness.tick(10)
    harness.done(harness.editor.set_driver("0", "brain:0"))
    harness.done(harness.editor.remove_block("0", ("sensors", 0)))
    harness.tick(5)


def test_an_ai4u_script() -> None:
    harness = EditorHarness()
    harness.done(harness.editor.set_driver("0", "ai4u://127.0.0.1:18123"))
    assert isinstance(harness.agent.brain, RemoteBrain)
    harness.done(harness.editor.undo())
    with pytest.raises(ChangeError, match=r"can't have this machine connect to '10\.0\.0\.1'"):
        harness.done(harness.editor.set_driver("0", "ai4u://10.0.0.1:8080"))


def test_networks_that_were_named_are_offered(tmp_path: Path) -> None:
    network = find_network("zoo:box_chase", None)
    (tmp_path / "nets").mkdir()
    for name in ("mine.onnx", "nets/other.onnx", "secret.onnx"):
        (tmp_path / name).write_bytes(network.read_bytes())
    harness = EditorHarness(
        Scene.load("box_chase"), offers=(tmp_path / "mine.onnx", str(tmp_path / "nets"))
    )
    drivers = {each.name: each.title for each in harness.editor.drivers("0")}
    assert drivers["network:mine.onnx"] == "Network mine.onnx"
    for name in ("network:mine.onnx", "network:other.onnx"):
        assert name in drivers
        harness.done(harness.editor.set_driver("0", name))
        assert isinstance(controller(harness), NeuralNetController)
        assert harness.agent.brain.skip_frame == 9
        assert harness.editor.driver_of("0") == name
        harness.tick(10)
    assert harness.editor.scene == harness.scene  # a file of this machine is in no scene
    for name in (
        *("network:secret.onnx", "network:../secret.onnx", "network:nets/other.onnx", "network:"),
        f"network:{tmp_path / 'secret.onnx'}",
    ):
        with pytest.raises(ChangeError, match="is offered here; networks are offered that lie"):
            harness.done(harness.editor.set_driver("0", name))
    assert harness.editor.driver_of("0") == "network:other.onnx"


def test_networks_beside_the_scene_are_offered(tmp_path: Path) -> None:
    (tmp_path / "best.onnx").write_bytes(find_network("zoo:box_chase", None).read_bytes())
    Scene.load("box_chase").save(tmp_path / "mine.yaml")
    harness = EditorHarness(Scene.load(tmp_path / "mine.yaml"), offers=(tmp_path / "best.onnx",))
    names = [each.name for each in harness.editor.drivers("0")]
    assert names.count("network:best.onnx") == 1
    harness.done(harness.editor.set_driver("0", "network:best.onnx"))
    harness.tick(10)


def test_an_ai4u_script_at_an_address_that_was_named() -> None:
    harness = EditorHarness(
        offers=("ai4u://127.0.0.2:18123", "ai4u://localhost:18124?mode=realtime")
    )
    drivers = {each.name: each.title for each in harness.editor.drivers("0")}
    assert drivers["ai4u://127.0.0.2:18123"] == "AI4U script at 127.0.0.2:18123"
    harness.done(harness.editor.set_driver("0", "ai4u://127.0.0.2:18123"))
    brain = harness.agent.brain
    assert isinstance(brain, RemoteBrain)
    assert (brain.host, brain.port, brain.skip_frame) == ("127.0.0.2", 18123, 0)
    harness.done(harness.editor.set_driver("0", "ai4u://localhost:18124?mode=realtime"))
    assert harness.agent.brain.mode == "realtime"
    harness.done(harness.editor.set_driver("0", "brain:0"))
    with pytest.raises(ChangeError, match="can't have this machine connect to"):
        harness.done(harness.editor.set_driver("0", "ai4u://127.0.0.2:18125"))


@pytest.mark.parametrize("name", ["nothere.py", "nothere.onnx", "nothere", "notes.txt", "http://x"])
def test_unsupported_offers_raise_at_start(tmp_path: Path, name: str) -> None:
    (tmp_path / "notes.txt").write_text("hello")
    place = name if "://" in name else str(tmp_path / name)
    with pytest.raises(SetupError, match=r"expected a Python file \(\.py\), a recorded episode"):
        EditorHarness(offers=(place,))
    with pytest.raises(SetupError, match="expected an address such as"):
        EditorHarness(offers=("ai4u://a:b",))


@pytest.mark.parametrize("is_offered", [True, False])
def test_an_address_says_how_often_its_script_decides(is_offered: bool) -> None:
    address = "ai4u://127.0.0.1:9?skip_frame=2"
    harness = EditorHarness(offers=(address,) if is_offered else ())
    harness.done(harness.editor.set_driver("0", address))
    brain = harness.agent.brain
    assert isinstance(brain, RemoteBrain)
    assert (brain.skip_frame, brain.repeat_action) == (2, True)
    brain.close()
