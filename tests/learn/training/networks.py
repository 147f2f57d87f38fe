"""Networks of a few operations, made by hand."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import onnx
from onnx import TensorProto, helper


def network(
    path: Path,
    inputs: Mapping[str, tuple[int, ...]],
    output: str = "move",
    size: int = 4,
    *,
    kind: int = TensorProto.FLOAT,
    batch: Any = "batch",
    about: str = "",
) -> Path:
    """Adds all numbers of all inputs up; the sum comes out ``size`` times."""
    nodes, sums = [], []
    for name in inputs:
        nodes += [
            helper.make_node("Cast", [name], [f"{name}/float"], to=TensorProto.FLOAT),
            helper.make_node("Flatten", [f"{name}/float"], [f"{name}/flat"], axis=1),
            helper.make_node("ReduceSum", [f"{name}/flat", "axis"], [f"{name}/sum"]),
        ]
        sums.append(f"{name}/sum")
    nodes += [
        helper.make_node("Sum", sums, ["total"]),
        helper.make_node("Mul", ["total", "ones"], [output]),
    ]
    graph = helper.make_graph(
        nodes,
        "sum",
        [helper.make_tensor_value_info(n, kind, [batch, *shape]) for n, shape in inputs.items()],
        [helper.make_tensor_value_info(output, TensorProto.FLOAT, [batch, size])],
        [
            onnx.numpy_helper.from_array(np.array([1]), "axis"),
            onnx.numpy_helper.from_array(np.ones((1, size), np.float32), "ones"),
        ],
    )
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 18)], ir_version=9)
    if about:
        entry = model.metadata_props.add()
        entry.key, entry.value = "ai4u_edu", about
    path.write_bytes(model.SerializeToString())
    return path
