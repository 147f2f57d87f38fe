"""A neural network in NumPy: what it computes (forward), what to change (backward), and Adam.

Start here. A network is a function with many numbers that can be turned, its *parameters*. To learn
is to turn each of them a little, again and again, so that a *loss* (a number that says how wrong
the outputs are) gets smaller. Three steps repeat:

1. ``forward``: compute the outputs from the inputs.
2. ``backward``: compute the *gradient*, which says for each parameter how fast the loss grows if
   that parameter grows. It needs only the chain rule, one layer after another, last layer first.
3. ``Adam.step``: move each parameter a little against its gradient.

This example learns y = x0 - x1 from four examples:

>>> generator = np.random.default_rng(0)
>>> network = Mlp([2, 8, 1])
>>> network.draw(generator)
>>> optimizer = Adam(network.parameters, rate=0.01)
>>> inputs = np.array([[0, 0], [0, 1], [1, 0], [1, 1]], np.float32)
>>> wanted = np.array([[0], [-1], [1], [0]], np.float32)
>>> for _ in range(500):
...     error = network.forward(inputs) - wanted
...     network.backward(2 * error / len(error))  # the slope of the mean of error ** 2
...     optimizer.step(network.gradient)
>>> bool(np.abs(network.forward(inputs) - wanted).max() < 0.05)
True
"""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.floating[Any]]
"""Array of real numbers; those of networks are float32."""


class Mlp:
    """Multilayer perceptron: layers of neurons, each followed by tanh, but the last one.

    A neuron multiplies each of its inputs by a weight, adds all that up, and adds one more number,
    its bias. A layer has many neurons with the same inputs, so its weights are a matrix.

    All parameters lie in one array, and the weights of a layer are a view of a piece of it: who
    changes the one, changes the other. So an optimizer, a file or a copy needs to know nothing of
    layers.

    Args:
        sizes: count of inputs, of the neurons of each hidden layer, and of outputs.
        parameters: (count,) array to keep the parameters in; left out, a new one of zeros.
        gradient: (count,) array to write the gradient to; left out, a new one.

    Attributes:
        weights: (outputs, inputs) of each layer, first layer first.
        biases: (outputs,) of each layer.

    >>> [each.shape for each in Mlp([3, 8, 2]).weights]
    [(8, 3), (2, 8)]
    """

    def __init__(
        self,
        sizes: Sequence[int],
        parameters: Floats | None = None,
        gradient: Floats | None = None,
    ) -> None:
        count = parameter_count(sizes)
        self.sizes = tuple(sizes)
        self.parameters = np.zeros(count, np.float32) if parameters is None else parameters
        self.gradient = np.zeros(count, np.float32) if gradient is None else gradient
        self.weights, self.biases = _views(self.parameters, self.sizes)
        self._weight_gradients, self._bias_gradients = _views(self.gradient, self.sizes)
        self._inputs: list[Floats] = []
        """Inputs of each layer in the latest forward pass; backward needs them."""

    def draw(self, generator: np.random.Generator, last_gain: float = 1.0) -> None:
        """Draw random weights, and set all biases to 0.

        Equal weights would stay equal, as their gradients are: every neuron of a layer would learn
        the same. So weights begin at random. Here the rows of a matrix stand at right angles to
        each other, so that no two neurons begin with the same idea.

        Args:
            generator: source of the random numbers.
            last_gain: factor of the last layer's weights; a small one makes all outputs begin
                close to 0.
        """
        for layer, weights in enumerate(self.weights):
            is_last = layer == len(self.weights) - 1
            # tanh makes numbers smaller; a factor of sqrt(2) keeps their size from layer to layer
            gain = last_gain if is_last else math.sqrt(2.0)
            weights[:] = gain * _orthogonal(generator, *weights.shape)
            self.biases[layer][:] = 0.0

    def forward(self, inputs: Floats) -> Floats:
        """Return the outputs (n, outputs) for inputs (n, inputs): n examples at once."""
        self._inputs = [inputs]
        *hidden, (weights, biases) = zip(self.weights, self.biases, strict=True)
        for matrix, offsets in hidden:
            # without tanh, two layers could do no more than one: both only multiply and add
            self._inputs.append(np.tanh(self._inputs[-1] @ matrix.T + offsets))
        outputs: Floats = self._inputs[-1] @ weights.T + biases
        return outputs

    def backward(self, slope: Floats) -> None:
        """Write the gradient of the loss for the examples of the latest forward pass.

        Args:
            slope: (n, outputs) how fast the loss grows with each output of each example.
        """
        for layer in reversed(range(len(self.weights))):
            inputs = self._inputs[layer]
            # output = sum of weight * input + bias: a weight counts as much as its input is large,
            # and a bias counts as it is. The examples add up.
            np.matmul(slope.T, inputs, out=self._weight_gradients[layer])
            np.sum(slope, axis=0, out=self._bias_gradients[layer])
            if layer:
                # one layer back: through the weights, then through tanh, whose slope is
                # 1 - tanh(x) ** 2, and tanh(x) is what this layer got as its input
                slope = (slope @ self.weights[layer]) * (1.0 - inputs * inputs)


class Adam:
    """Optimizer that changes parameters in place, each by about ``rate`` a step at first.

    Plain gradient descent moves a parameter by ``rate * gradient``: too far where the gradient is
    large, hardly at all where it is small. Adam divides the average of the latest gradients by
    their usual size. So all parameters move at about the same speed, those whose gradients keep
    their sign faster than those whose gradients change it with every batch.

    Args:
        parameters: (count,) changed in place.
        rate: largest usual change of a parameter in a step.
        epsilon: added to the divisor, so that it is never 0.

    Attributes:
        mean: (count,) moving average of the gradients.
        square: (count,) moving average of their squares.
        steps: count of steps so far.

    Source: D. P. Kingma and J. Ba, Adam: A Method for Stochastic Optimization, ICLR 2015.
    """

    MEAN_DECAY = 0.9
    """Weight of the old average of gradients in the new one."""
    SQUARE_DECAY = 0.999
    """Weight of the old average of squares in the new one."""

    def __init__(self, parameters: Floats, rate: float = 1e-3, epsilon: float = 1e-8) -> None:
        self.parameters = parameters
        self.rate, self.epsilon = rate, epsilon
        self.mean, self.square = np.zeros_like(parameters), np.zeros_like(parameters)
        self.steps = 0

    def step(self, gradient: Floats) -> None:
        """Move all parameters against their gradients, (count,)."""
        self.steps += 1
        self.mean += (1.0 - self.MEAN_DECAY) * (gradient - self.mean)
        self.square += (1.0 - self.SQUARE_DECAY) * (gradient * gradient - self.square)
        # both averages begin at 0 and need many steps to get away from it: make up for that
        mean_share = 1.0 - self.MEAN_DECAY**self.steps
        square_share = 1.0 - self.SQUARE_DECAY**self.steps
        usual_size = np.sqrt(self.square) / math.sqrt(square_share) + self.epsilon
        self.parameters -= (self.rate / mean_share) * self.mean / usual_size


def parameter_count(sizes: Sequence[int]) -> int:
    """Return the count of weights and biases of a network with layers of these sizes.

    >>> parameter_count([126, 64, 64, 4])
    12548
    """
    return sum(outputs * (inputs + 1) for inputs, outputs in pairwise(sizes))


def clip_norm(gradient: Floats, largest: float) -> None:
    """Shorten a gradient in place to a length of at most ``largest``.

    One strange batch then can't throw the parameters far away.
    """
    length = math.sqrt(float(gradient @ gradient))
    if length > largest:
        gradient *= largest / length


def _views(memory: Floats, sizes: Sequence[int]) -> tuple[list[Floats], list[Floats]]:
    """Return the pieces of an array that are the layers' weights, and those that are biases."""
    weights: list[Floats] = []
    biases: list[Floats] = []
    start = 0
    for inputs, outputs in pairwise(sizes):
        end = start + outputs * inputs
        weights.append(memory[start:end].reshape(outputs, inputs))
        start = end + outputs
        biases.append(memory[end:start])
    return weights, biases


def _orthogonal(generator: np.random.Generator, rows: int, columns: int) -> Floats:
    """Return a random matrix whose rows (or columns, if they are fewer) are orthonormal."""
    drawn = generator.normal(size=(max(rows, columns), min(rows, columns)))
    columns_at_right_angles, triangle = np.linalg.qr(drawn)
    # QR prefers some signs; these make every direction as likely as any other
    columns_at_right_angles *= np.sign(np.diag(triangle))
    found: Floats = columns_at_right_angles if rows >= columns else columns_at_right_angles.T
    return found.astype(np.float32)
