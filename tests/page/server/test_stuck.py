"""A command that serves ends at once, whatever a block or a network of its world is doing."""

import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.page.server import http_client
from tests.waiting import LIMIT_S, until

pytestmark = pytest.mark.slow

BLOCKS = '''
import time

from gymnasium.spaces import Box

from ai4u_edu import Sensor


class Stuck(Sensor):
    """Answers a few times."""

    how: str = "loop"
    count = 0

    def space(self):
        return Box(0.0, 1.0, (1,))

    def read(self, body, view):
        self.count += 1
        if self.count > 3 and self.how != "network":
            while self.how == "loop":
                pass
            time.sleep(100_000)
        return [0.0]
'''
SCENE = """
name: stuck
floors: [{name: plate, shape: {type: box, size: [9, 9]}}]
bodies: [{name: robot, shape: {type: circle, radius: 0.5}}]
agents:
  - id: "0"
    body: robot
    sensors: [{type: Stuck, how: %s}]
    actuators: [{type: RBMoveActuator}]
    brains: [{type: LocalBrain, skip_frame: 0, controller: %s}]
"""
posix = pytest.mark.skipif(os.name != "posix", reason="sends signals as POSIX has them")


def endless(path: Path) -> Path:
    """A network whose loop does not end in this life."""
    import onnx
    from onnx import TensorProto, helper

    body = helper.make_graph(
        [
            helper.make_node("Identity", ["goes_on"], ["goes_on_still"]),
            helper.make_node("Identity", ["sum"], ["sum_still"]),
        ],
        "body",
        [
            helper.make_tensor_value_info("turn", TensorProto.INT64, []),
            helper.make_tensor_value_info("goes_on", TensorProto.BOOL, []),
            helper.make_tensor_value_info("sum", TensorProto.FLOAT, None),
        ],
        [
            helper.make_tensor_value_info("goes_on_still", TensorProto.BOOL, []),
            helper.make_tensor_value_info("sum_still", TensorProto.FLOAT, None),
        ],
    )
    zeros: Any = np.zeros((1, 4), np.float32)
    graph = helper.make_graph(
        [
            helper.make_node("ReduceSum", ["stuck"], ["sum"], keepdims=0),
            helper.make_node("Add", ["zeros", "sum"], ["first"]),
            helper.make_node("Loop", ["turns", "yes", "first"], ["move"], body=body),
        ],
        "endless",
        [helper.make_tensor_value_info("stuck", TensorProto.FLOAT, ["batch", 1])],
        [helper.make_tensor_value_info("move", TensorProto.FLOAT, ["batch", 4])],
        [
            onnx.numpy_helper.from_array(np.array(2**62), "turns"),
            onnx.numpy_helper.from_array(np.array(True), "yes"),
            onnx.numpy_helper.from_array(zeros, "zeros"),
        ],
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 18)], ir_version=9)
    path.write_bytes(model.SerializeToString())
    return path


@contextmanager
def playing(folder: Path, how: str) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """``ai4u-edu play`` with a block that gets stuck, and the page's address."""
    (folder / "stuck_blocks.py").write_text(BLOCKS)
    controller = "{type: WASDRBMoveController}"
    if how == "network":
        endless(folder / "endless.onnx")
        controller = "{type: NeuralNetController, model_path: endless.onnx}"
    (folder / "stuck.yaml").write_text(SCENE % (how, controller))
    command = [sys.executable, "-m", "ai4u_edu", "play", str(folder / "stuck.yaml")]
    command += ["--no-wait-for-key"]
    command += ["--blocks", str(folder / "stuck_blocks.py"), "--no-open", "--port", "0"]
    process = subprocess.Popen(
        [*command, "--record", str(folder / "kept")],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"XDG_STATE_HOME": str(folder / "state")},
    )
    try:
        assert process.stdout is not None
        found = re.search(r"http://\S+", process.stdout.readline())
        if found is None:
            raise AssertionError(process.communicate()[1])
        yield process, found[0]
    finally:
        process.kill()
        process.communicate()


@posix
@pytest.mark.parametrize(
    ("how", "number", "block"),
    [
        ("loop", signal.SIGTERM, "Sensor Stuck 'stuck' of agent '0' (stuck_blocks.py, line "),
        pytest.param(
            *("sleep", signal.SIGINT, "Sensor Stuck 'stuck' of agent '0' (stuck_blocks.py, line "),
            marks=pytest.mark.nightly,
        ),
        pytest.param(
            *("network", signal.SIGINT, "Brain LocalBrain(NeuralNetController) of agent '0' ("),
            marks=pytest.mark.nightly,
        ),
    ],
)
def test_blocked_code_is_named_and_the_first_signal_ends_the_process(
    tmp_path: Path, how: str, number: signal.Signals, block: str
) -> None:
    with playing(tmp_path, how) as (process, url):
        until(lambda: http_client.get(url + "healthz").status_code == 503)
        assert http_client.get(url + "healthz").json()["block"].startswith(block)
        process.send_signal(number)
        _, err = process.communicate(timeout=LIMIT_S)  # what is stuck would last longer
    assert process.returncode == 0
    assert f"left behind unfinished: {block.partition(' (s')[0].removesuffix(' (')}" in err
    if how != "network":  # which never took a decision
        assert list((tmp_path / "kept").glob("stuck-*.episode"))
