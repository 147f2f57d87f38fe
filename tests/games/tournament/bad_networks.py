"""ONNX files that can't play: each with what the refusal says."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import onnx
from onnx import TensorProto, helper

from tests.learn.training.networks import network

INPUTS = {"opponent": (3,), "position": (3,), "heading": (2,), "velocity": (3,)}


def broken(path: Path) -> None:
    path.write_bytes(b"this is no network" * 50)


def cut(path: Path) -> None:
    data = network(path, INPUTS).read_bytes()
    path.write_bytes(data[: len(data) // 2])


def other_inputs(path: Path) -> None:
    network(path, {"rays": (32,)})


def other_shape(path: Path) -> None:
    network(path, INPUTS | {"opponent": (7,)})


def few_outputs(path: Path) -> None:
    network(path, INPUTS, size=3)


def other_actuator(path: Path) -> None:
    network(path, INPUTS | {"rays": (1,)}, "wings")


def many_at_once(path: Path) -> None:
    network(path, INPUTS, batch=8)


def not_a_number(path: Path) -> None:
    _save(path, [helper.make_node("Log", ["minus"], ["move"])], [_row("minus", -1.0)])


def greedy(path: Path) -> None:
    """Wants 64 GB for a decision."""
    nodes = [
        helper.make_node("Add", ["size", "zero"], ["size now"]),
        helper.make_node("ConstantOfShape", ["size now"], ["all"]),
        helper.make_node("ReduceSum", ["all"], ["sum"], keepdims=0),
        helper.make_node("Mul", ["sum", "ones"], ["move"]),
    ]
    size = onnx.numpy_helper.from_array(np.array([2**17, 2**17]), "size")
    zero = onnx.numpy_helper.from_array(np.array([0, 0]), "zero")
    _save(path, nodes, [size, zero, _row("ones", 1.0)])


def slow(path: Path) -> None:
    """Multiplies matrices for ever."""
    body = helper.make_graph(
        [
            helper.make_node("Identity", ["going"], ["going on"]),
            helper.make_node("MatMul", ["matrix", "matrix"], ["more"]),
            helper.make_node("Clip", ["more", "low", "high"], ["product"]),
        ],
        "body",
        [
            helper.make_tensor_value_info("turn", TensorProto.INT64, []),
            helper.make_tensor_value_info("going", TensorProto.BOOL, []),
            helper.make_tensor_value_info("matrix", TensorProto.FLOAT, [64, 64]),
        ],
        [
            helper.make_tensor_value_info("going on", TensorProto.BOOL, []),
            helper.make_tensor_value_info("product", TensorProto.FLOAT, [64, 64]),
        ],
    )
    nodes = [
        helper.make_node("Cast", ["heading"], ["heading now"], to=TensorProto.FLOAT),
        helper.make_node("ReduceSum", ["heading now"], ["start"], keepdims=0),
        helper.make_node("Add", ["start", "matrix0"], ["first"]),
        helper.make_node("Loop", ["turns", "yes", "first"], ["last"], body=body),
        helper.make_node("ReduceSum", ["last"], ["sum"], keepdims=0),
        helper.make_node("Mul", ["sum", "ones"], ["move"]),
    ]
    values = [
        onnx.numpy_helper.from_array(np.array(2**62), "turns"),
        onnx.numpy_helper.from_array(np.array(True), "yes"),
        onnx.numpy_helper.from_array(np.full((64, 64), 0.01, np.float32), "matrix0"),
        onnx.numpy_helper.from_array(np.array(-1, np.float32), "low"),
        onnx.numpy_helper.from_array(np.array(1, np.float32), "high"),
        _row("ones", 1.0),
    ]
    _save(path, nodes, values)


def folding(path: Path, size: int = 6000) -> None:
    """Multiply constants, which onnxruntime does when it loads the network."""
    nodes = [helper.make_node("ConstantOfShape", ["size"], ["product0"])]
    for number in range(7):
        before, after = f"product{number}", f"product{number + 1}"
        nodes += [
            helper.make_node("MatMul", [before, before], [f"{after} raw"]),
            helper.make_node("Clip", [f"{after} raw", "low", "high"], [after]),
        ]
    nodes += [
        helper.make_node("ReduceSum", ["product7"], ["sum"], keepdims=0),
        helper.make_node("Mul", ["sum", "zeros"], ["move"]),
    ]
    values = [
        onnx.numpy_helper.from_array(np.array([size, size]), "size"),
        onnx.numpy_helper.from_array(np.array(-1, np.float32), "low"),
        onnx.numpy_helper.from_array(np.array(1, np.float32), "high"),
        _row("zeros", 0.0),
    ]
    _save(path, nodes, values)


BAD: dict[Callable[[Path], None], str] = {
    broken: "expected a network that onnxruntime can run",
    cut: "expected a network that onnxruntime can run",
    other_inputs: "sensor 'rays' of shape (32,) is missing",
    other_shape: "has the shape (3,), and the network was trained with (7,)",
    few_outputs: "gives 3 numbers for 'move', and that actuator of agent 'blue' takes 4",
    other_actuator: "sensor 'rays' of shape (1,) is missing",
    many_at_once: "takes 8 decisions at once",
    not_a_number: "expected finite numbers, got",
    greedy: "Failed to allocate memory",
    slow: "of processor time for a decision; expected at most 1 s",
}
"""Files by function, and a part of the sentence with which each is refused."""


def _row(name: str, value: float) -> onnx.TensorProto:
    return onnx.numpy_helper.from_array(np.full((1, 4), value, np.float32), name)


def _save(path: Path, nodes: list[onnx.NodeProto], values: list[onnx.TensorProto]) -> None:
    graph = helper.make_graph(
        nodes,
        "bad",
        [helper.make_tensor_value_info("heading", TensorProto.FLOAT, [1, 2])],
        [helper.make_tensor_value_info("move", TensorProto.FLOAT, [1, 4])],
        values,
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 18)], ir_version=9)
    path.write_bytes(model.SerializeToString())
