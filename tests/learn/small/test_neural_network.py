"""A network in NumPy, without torch."""

import numpy as np
import pytest

from ai4u_edu.learn.small.neural_network import Mlp, clip_norm


def test_layers_are_views_of_one_array() -> None:
    network = Mlp([3, 5, 2])
    network.weights[1][0, 0] = 7.0
    network.biases[0][2] = -1.0
    assert 7.0 in network.parameters
    network.parameters[:] = 0.5
    assert all((each == 0.5).all() for each in [*network.weights, *network.biases])


def test_two_networks_may_share_one_array() -> None:
    memory, slopes = np.zeros(2 * 8, np.float32), np.zeros(2 * 8, np.float32)
    first = Mlp([3, 2], memory[:8], slopes[:8])
    second = Mlp([3, 2], memory[8:], slopes[8:])
    second.draw(np.random.default_rng(0))
    second.forward(np.ones((1, 3), np.float32))
    second.backward(np.ones((1, 2), np.float32))
    assert not first.parameters.any()
    assert not slopes[:8].any()
    assert memory[8:].any()
    assert slopes[8:].any()


def test_the_gradient_is_the_slope_of_the_loss() -> None:
    # by the definition of a slope, without another library
    network = Mlp([4, 6, 3], np.zeros(51, np.float32))
    network.draw(np.random.default_rng(0))
    inputs = np.random.default_rng(1).normal(size=(5, 4)).astype(np.float32)
    network.forward(inputs)
    network.backward(np.ones((5, 3), np.float32))  # the loss is the sum of all outputs
    for index in (0, 10, 25, 30, 50):
        before, step = network.parameters[index], 1e-2
        sums = []
        for value in (before - step, before + step):
            network.parameters[index] = value
            sums.append(float(network.forward(inputs).sum()))
        network.parameters[index] = before
        assert network.gradient[index] == pytest.approx((sums[1] - sums[0]) / (2 * step), abs=2e-3)


@pytest.mark.parametrize("sizes", [[3, 8], [8, 3]])
def test_neurons_begin_at_right_angles(sizes: list[int]) -> None:
    network = Mlp(sizes)
    network.draw(np.random.default_rng(0))
    matrix = network.weights[0]
    square = matrix @ matrix.T if len(matrix) < matrix.shape[1] else matrix.T @ matrix
    np.testing.assert_allclose(square, np.eye(len(square)), atol=1e-5)


def test_a_long_gradient_is_shortened_and_a_short_one_is_not() -> None:
    gradient = np.array([3.0, 4.0], np.float32)
    clip_norm(gradient, 10.0)
    assert gradient.tolist() == [3.0, 4.0]
    clip_norm(gradient, 1.0)
    np.testing.assert_allclose(gradient, [0.6, 0.8], atol=1e-6)
