"""A brain with a trained network in it."""

from typing import Any

from ai4u_edu.blocks.brains.controllers.neural import NeuralNetController
from ai4u_edu.blocks.brains.local import LocalBrain

__all__ = ["trained_brain"]


def trained_brain(model_path: str, **parameters: Any) -> LocalBrain:
    """Return a LocalBrain driven by a network, with the decision interval of its training.

    Args:
        model_path: path of an ONNX file, or ``zoo:`` and a scene's name.
        parameters: further parameters of :class:`NeuralNetController`.

    Raises:
        BlockError: there is no such network, or it can't be run.
    """
    controller = NeuralNetController(model_path=model_path, **parameters)
    brain = LocalBrain(controller=controller)
    return brain.changed(**controller.network.rhythm)
