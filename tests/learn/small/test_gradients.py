"""The small network and its optimizer give the numbers that torch gives."""

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
import torch
from torch import nn

from ai4u_edu.learn.small.neural_network import Adam, Mlp

pytestmark = pytest.mark.needs("train")

TOLERANCE = 1e-5


def both(sizes: list[int], seed: int) -> tuple[Mlp, nn.Sequential]:
    """Return the same network twice, with random weights and biases."""
    generator = np.random.default_rng(seed)
    ours = Mlp(sizes)
    ours.draw(generator)
    for biases in ours.biases:
        biases[:] = generator.normal(size=biases.shape)
    theirs: list[nn.Module] = []
    for weights, biases in zip(ours.weights, ours.biases, strict=True):
        layer = nn.Linear(weights.shape[1], weights.shape[0])
        layer.weight.data = torch.from_numpy(weights.copy())
        layer.bias.data = torch.from_numpy(biases.copy())
        theirs += [layer, nn.Tanh()]
    return ours, nn.Sequential(*theirs[:-1])


def flat(tensors: list[torch.Tensor]) -> npt.NDArray[Any]:
    """Return weights and biases in the order in which ours lie in memory."""
    return np.concatenate([each.detach().numpy().ravel() for each in tensors])


def loss_of(outputs: torch.Tensor, wanted: torch.Tensor) -> torch.Tensor:
    return ((outputs - wanted) ** 2).mean() + torch.logsumexp(outputs, dim=1).mean()


@pytest.mark.parametrize("sizes", [[5, 3], [7, 16, 2], [126, 64, 64, 4]])
@pytest.mark.parametrize("examples", [1, 33])
def test_outputs_and_gradients_are_those_of_torch(sizes: list[int], examples: int) -> None:
    ours, theirs = both(sizes, seed=1)
    generator = np.random.default_rng(2)
    inputs = generator.normal(size=(examples, sizes[0])).astype(np.float32)
    wanted = generator.normal(size=(examples, sizes[-1])).astype(np.float32)
    outputs = theirs(torch.from_numpy(inputs))
    outputs.retain_grad()
    loss_of(outputs, torch.from_numpy(wanted)).backward()
    assert outputs.grad is not None
    np.testing.assert_allclose(ours.forward(inputs), outputs.detach().numpy(), atol=TOLERANCE)
    ours.backward(outputs.grad.numpy())
    expected = flat([each.grad for each in theirs.parameters() if each.grad is not None])
    np.testing.assert_allclose(ours.gradient, expected, atol=TOLERANCE)


def test_adam_changes_parameters_as_the_one_of_torch() -> None:
    ours, theirs = both([6, 8, 3], seed=3)
    optimizer = Adam(ours.parameters, rate=0.01, epsilon=1e-5)
    other = torch.optim.Adam(theirs.parameters(), lr=0.01, eps=1e-5)
    generator = np.random.default_rng(4)
    for _ in range(50):
        inputs = generator.normal(size=(16, 6)).astype(np.float32)
        wanted = generator.normal(size=(16, 3)).astype(np.float32)
        other.zero_grad()
        ((theirs(torch.from_numpy(inputs)) - torch.from_numpy(wanted)) ** 2).mean().backward()
        other.step()
        error = ours.forward(inputs) - wanted
        ours.backward(2 * error / error.size)
        optimizer.step(ours.gradient)
    np.testing.assert_allclose(ours.parameters, flat(list(theirs.parameters())), atol=1e-4)
