"""Who drives is changed live."""

from pathlib import Path

import pytest

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.base.errors import AI4UError, BlockError, SetupError
from ai4u_edu.blocks import NeuralNetController, RemoteBrain, ReplayController, WASDRBMoveController
from ai4u_edu.blocks.brains.network import find_network
from ai4u_edu.editing import ChangeError
from ai4u_edu.recording import Recorder
from tests.editing.shops import Shop

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


def controller(shop: Shop) -> object:
    brain = shop.agent.brain
    assert isinstance(brain, LocalBrain)
    return brain.controller


def test_keys_and_back() -> None:
    shop = Shop()
    shop.tick(3)
    outcome = shop.done(shop.editor.set_driver("0", "keys:WASDRBMoveController"))
    assert outcome.when == "next decision"
    assert isinstance(controller(shop), WASDRBMoveController)
    assert (shop.agent.steps, shop.agent.brain.skip_frame) == (3, 0)
    shop.tick(2)
    assert [each.name for each in shop.editor.drivers("0")][:2] == ["brain:0", "brain:1"]
    shop.done(shop.editor.undo())
    assert isinstance(controller(shop), ReplayController)
    assert shop.editor.scene == shop.scene
    shop.done(shop.editor.redo())
    shop.done(shop.editor.set_driver("0", "brain:0"))
    assert isinstance(controller(shop), ReplayController)


def test_who_drives_does_not_end_the_recording() -> None:
    shop = Shop(record=True)
    shop.tick(3)
    shop.done(shop.editor.set_driver("0", "keys:WASDRBMoveController"))
    shop.tick(2)
    recorder = shop.runner.recorder
    assert recorder is not None
    now = recorder.current_episode()
    assert now is not None
    assert (len(now.agent()), now.changed) == (5, None)


def test_a_script_that_was_named(tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text(SCRIPT)
    shop = Shop(offers=(tmp_path,))
    names = [each.name for each in shop.editor.drivers("0")]
    assert [name for name in names if name.startswith("script:")] == [
        "script:mine.py:spin",
        "script:mine.py:Ahead",
    ]
    shop.done(shop.editor.set_driver("0", "script:mine.py:spin"))
    shop.tick(2)
    assert shop.agent.last_action == {"move": (0, 1, 0, 0)}
    shop.done(shop.editor.set_driver("0", "script:mine.py:Ahead"))
    shop.tick(2)
    assert shop.agent.last_action == {"move": (1, 0, 0, 0)}
    shop.done(shop.editor.undo())
    shop.tick(2)
    assert shop.agent.last_action == {"move": (0, 1, 0, 0)}
    for name in ("helper", "print_me", "Controller", "nobody"):
        with pytest.raises(SetupError, match=r"mine\.py has no driver"):
            shop.done(shop.editor.set_driver("0", f"script:mine.py:{name}"))
    assert shop.editor.scene == shop.scene  # a function is in no scene file
    # it stays when blocks are changed
    shop.done(shop.editor.add_block("0", "sensors", {"type": "HeadingSensor"}))
    shop.tick(2)
    assert shop.agent.last_action == {"move": (0, 1, 0, 0)}


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
def test_nothing_else_is_run(tmp_path: Path, name: str) -> None:
    (tmp_path / "mine.py").write_text("raise SystemExit\n" + SCRIPT)
    (tmp_path / "offered").mkdir()
    shop = Shop(offers=(tmp_path / "offered",))
    shop.tick(2)
    brain = shop.agent.brain
    with pytest.raises(AI4UError):
        shop.done(shop.editor.set_driver("0", name))
    assert shop.agent.brain is brain
    shop.tick(2)


def test_a_script_that_fails_is_told_with_its_line(tmp_path: Path) -> None:
    (tmp_path / "mine.py").write_text(SCRIPT + "\n1 / 0\n")
    shop = Shop(offers=(tmp_path,))
    with pytest.raises(SetupError, match=r"mine.py, line 17: ZeroDivisionError"):
        shop.done(shop.editor.set_driver("0", "script:mine.py:spin"))
    (tmp_path / "mine.py").write_text(
        "from ai4u_edu import Controller\nclass WASDController(Controller):\n    pass\n"
    )
    with pytest.raises(SetupError, match="WASDController is the name of a built-in block"):
        shop.done(shop.editor.set_driver("0", "script:mine.py:WASDController"))


def test_a_recording_drives_again(tmp_path: Path) -> None:
    sim = Shop().scene.build()
    recorder = Recorder(sim)
    sim.reset(1)
    for _ in range(6):
        sim.step()
    recorder.finish()
    recorder.episodes[0].save(tmp_path / "run.episode")
    shop = Shop(offers=(tmp_path,))
    shop.done(shop.editor.set_driver("0", "keys:WASDRBMoveController"))
    shop.done(shop.editor.set_driver("0", "recording:run.episode"))
    shop.tick(6)
    assert shop.agent.last_action == {"move": (1.0, 0.2, 0.0, 0.0)}
    assert shop.world["robot"].pose == sim.world["robot"].pose
    shop.tick(2)  # it stops there


def test_a_network_and_the_sensors_that_it_needs() -> None:
    pytest.importorskip("onnxruntime")
    shop = Shop(Scene.load("box_chase"))
    shop.tick(3)
    shop.done(shop.editor.set_driver("0", "network:zoo:box_chase"))
    assert isinstance(controller(shop), NeuralNetController)
    shop.tick(10)
    percept = list(shop.agent.percept)
    with pytest.raises(BlockError, match="sensor 'vision' of shape"):
        shop.done(shop.editor.remove_block("0", ("sensors", 0)))
    assert list(shop.agent.percept) == percept
    shop.tick(10)
    shop.done(shop.editor.set_driver("0", "brain:0"))
    shop.done(shop.editor.remove_block("0", ("sensors", 0)))
    shop.tick(5)


def test_an_ai4u_script() -> None:
    shop = Shop()
    shop.done(shop.editor.set_driver("0", "ai4u://127.0.0.1:18123"))
    assert isinstance(shop.agent.brain, RemoteBrain)
    shop.done(shop.editor.undo())
    with pytest.raises(ChangeError, match=r"can't have this machine connect to '10\.0\.0\.1'"):
        shop.done(shop.editor.set_driver("0", "ai4u://10.0.0.1:8080"))


def test_networks_that_were_named_are_offered(tmp_path: Path) -> None:
    pytest.importorskip("onnxruntime")
    network = find_network("zoo:box_chase", None)
    (tmp_path / "nets").mkdir()
    for name in ("mine.onnx", "nets/other.onnx", "secret.onnx"):
        (tmp_path / name).write_bytes(network.read_bytes())
    shop = Shop(Scene.load("box_chase"), offers=(tmp_path / "mine.onnx", str(tmp_path / "nets")))
    drivers = {each.name: each.title for each in shop.editor.drivers("0")}
    assert drivers["network:mine.onnx"] == "Network mine.onnx"
    for name in ("network:mine.onnx", "network:other.onnx"):
        assert name in drivers
        shop.done(shop.editor.set_driver("0", name))
        assert isinstance(controller(shop), NeuralNetController)
        assert shop.agent.brain.skip_frame == 9
        assert shop.editor.driver_of("0") == name
        shop.tick(10)
    assert shop.editor.scene == shop.scene  # a file of this machine is in no scene
    for name in (
        *("network:secret.onnx", "network:../secret.onnx", "network:nets/other.onnx", "network:"),
        f"network:{tmp_path / 'secret.onnx'}",
    ):
        with pytest.raises(ChangeError, match="is offered here; networks are offered that lie"):
            shop.done(shop.editor.set_driver("0", name))
    assert shop.editor.driver_of("0") == "network:other.onnx"


def test_networks_beside_the_scene_are_offered(tmp_path: Path) -> None:
    pytest.importorskip("onnxruntime")
    (tmp_path / "best.onnx").write_bytes(find_network("zoo:box_chase", None).read_bytes())
    Scene.load("box_chase").save(tmp_path / "mine.yaml")
    shop = Shop(Scene.load(tmp_path / "mine.yaml"), offers=(tmp_path / "best.onnx",))
    names = [each.name for each in shop.editor.drivers("0")]
    assert names.count("network:best.onnx") == 1
    shop.done(shop.editor.set_driver("0", "network:best.onnx"))
    shop.tick(10)


def test_an_ai4u_script_at_an_address_that_was_named() -> None:
    shop = Shop(offers=("ai4u://127.0.0.2:18123", "ai4u://localhost:18124?mode=realtime"))
    drivers = {each.name: each.title for each in shop.editor.drivers("0")}
    assert drivers["ai4u://127.0.0.2:18123"] == "AI4U script at 127.0.0.2:18123"
    shop.done(shop.editor.set_driver("0", "ai4u://127.0.0.2:18123"))
    brain = shop.agent.brain
    assert isinstance(brain, RemoteBrain)
    assert (brain.host, brain.port, brain.skip_frame) == ("127.0.0.2", 18123, 0)
    shop.done(shop.editor.set_driver("0", "ai4u://localhost:18124?mode=realtime"))
    assert shop.agent.brain.mode == "realtime"
    shop.done(shop.editor.set_driver("0", "brain:0"))
    with pytest.raises(ChangeError, match="can't have this machine connect to"):
        shop.done(shop.editor.set_driver("0", "ai4u://127.0.0.2:18125"))


@pytest.mark.parametrize("name", ["nothere.py", "nothere.onnx", "nothere", "notes.txt", "http://x"])
def test_what_cant_be_offered_is_told_at_the_start(tmp_path: Path, name: str) -> None:
    (tmp_path / "notes.txt").write_text("hello")
    place = name if "://" in name else str(tmp_path / name)
    with pytest.raises(SetupError, match=r"expected a Python file \(\.py\), a recorded episode"):
        Shop(offers=(place,))
    with pytest.raises(SetupError, match="expected an address such as"):
        Shop(offers=("ai4u://a:b",))
