"""Networks whose reasons are known, as somebody wrote their weights."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import numpy.typing as npt
import onnx
from onnx import TensorProto, helper

from ai4u_edu.blocks.brains.network import VALUE_OUTPUT


def linear_network(
    path: Path,
    weights: Mapping[str, npt.ArrayLike],
    *,
    output: str = "move",
    offset: npt.ArrayLike = 0.0,
    value: Mapping[str, npt.ArrayLike] | None = None,
) -> Path:
    """A network that multiplies each reading by its weights and adds all up.

    Args:
        path: of the file.
        weights: (numbers of the reading, numbers of the action) by perception key.
        output: name of the action.
        offset: added to the action.
        value: (numbers of the reading, 1) weights of a critic.
    """
    tables = {key: np.asarray(each, np.float32) for key, each in weights.items()}
    width = next(iter(tables.values())).shape[1]
    nodes, initial = _sum(tables, output, np.full(width, offset, np.float32))
    outputs = [helper.make_tensor_value_info(output, TensorProto.FLOAT, ["batch", width])]
    if value is not None:
        critic = {key: np.asarray(each, np.float32) for key, each in value.items()}
        more, weighs = _sum(critic, VALUE_OUTPUT, np.zeros(1, np.float32))
        nodes, initial = nodes + more, initial + weighs
        outputs.append(helper.make_tensor_value_info(VALUE_OUTPUT, TensorProto.FLOAT, ["batch", 1]))
    inputs = [
        helper.make_tensor_value_info(key, TensorProto.FLOAT, ["batch", len(table)])
        for key, table in tables.items()
    ]
    graph = helper.make_graph(nodes, "linear", inputs, outputs, initial)
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 18)], ir_version=9)
    path.write_bytes(model.SerializeToString())
    return path


def _sum(
    tables: Mapping[str, npt.NDArray[np.float32]], output: str, offset: npt.NDArray[np.float32]
) -> tuple[list[onnx.NodeProto], list[TensorProto]]:
    parts = {key: f"{output}/{key}" for key in tables}
    nodes = [
        helper.make_node("MatMul", [key, f"{part}/weights"], [part]) for key, part in parts.items()
    ]
    nodes.append(helper.make_node("Sum", [*parts.values(), f"{output}/offset"], [output]))
    initial = [
        onnx.numpy_helper.from_array(table, f"{parts[key]}/weights")
        for key, table in tables.items()
    ]
    return nodes, [*initial, onnx.numpy_helper.from_array(offset[None], f"{output}/offset")]
