"""A network that does what it was shown."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

from ai4u_edu import LocalBrain, Percept, Scene
from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks.brains.network import Network
from ai4u_edu.learn.training.cloning import Clone, clone, levels_of
from ai4u_edu.learn.training.demonstrations import demonstrations
from ai4u_edu.learn.training.evaluating import evaluate
from ai4u_edu.learn.training.policies import entrant
from ai4u_edu.recording import Episode, Recorder
from tests.recording.recorded_drives import take
from tests.scenes.solvers import solver_of

pytestmark = pytest.mark.needs("train")


def solved(name: str, seeds: tuple[int, ...]) -> list[Episode]:
    """Episodes of the scripted player."""
    scene = Scene.load(name)
    sim = scene.build()
    recorder = Recorder(sim, scene=scene.description)
    agent = sim.agents[0]
    before = agent.brain
    for seed in seeds:
        brain = LocalBrain(
            controller=solver_of(name),
            skip_frame=before.skip_frame,
            repeat_action=before.repeat_action,
        )
        agent.use_brain(brain)
        sim.reset(seed)
        while not agent.done:
            sim.step(agent)
    recorder.finish()
    return list(recorder.episodes)


@pytest.mark.nightly  # a lesson's check asks the same of a clone
def test_five_episodes_are_enough_for_box_chase(tmp_path: Path) -> None:
    # they begin in five different places; there are eight
    path = tmp_path / "policy.onnx"
    clone(solved("box_chase", (0, 1, 5, 7, 9)), path, quiet=True)
    result = evaluate(entrant(str(path)), Scene.load("box_chase"), range(1000, 1030))
    assert result.success is not None
    assert result.success >= 0.6


def test_the_same_seed_gives_the_same_network(tmp_path: Path) -> None:
    episodes = [take("box_chase", decisions=40).episode]
    before = torch.random.get_rng_state()
    one, other = (
        clone(episodes, tmp_path / name, updates=30, quiet=True).path.read_bytes()
        for name in ("one.onnx", "other.onnx")
    )
    assert one == other
    assert torch.equal(torch.random.get_rng_state(), before)


@pytest.mark.nightly
def test_another_seed_gives_another_network(tmp_path: Path) -> None:
    episodes = [take("box_chase", decisions=40).episode]
    one, other = (
        clone(episodes, tmp_path / f"{seed}.onnx", updates=30, seed=seed, quiet=True).path
        for seed in (0, 1)
    )
    assert one.read_bytes() != other.read_bytes()


def test_the_file_says_where_it_comes_from(tmp_path: Path) -> None:
    episodes = [take("box_chase", decisions=40).episode]
    network = Network(clone(episodes, tmp_path / "a.onnx", updates=5, quiet=True).path)
    about = network.about
    assert (about["algorithm"], about["scene"], about["decisions"]) == ("clone", "box_chase", 40)
    assert network.rhythm == {"skip_frame": 4, "repeat_action": True}
    assert [port.name for port in network.inputs] == ["vision", "orientation", "last_action"]


def test_choices_are_learned_as_choices(tmp_path: Path) -> None:
    def drive(percept: Percept) -> dict[str, int]:
        row, column = percept["cell"].tolist()
        return {"move": 1 if column < 6 else 4 if row < 6 else 2 if column > 3 else 3}

    sim = Scene.load("grid_world").build()
    recorder = Recorder(sim)
    sim.agents[0].use_brain(LocalBrain(controller=drive, skip_frame=9))
    for seed in range(4):
        sim.reset(seed)
        for _ in range(40):
            sim.step()
    recorder.finish()
    episodes = list(recorder.episodes)
    path = clone(episodes, tmp_path / "grid.onnx", updates=400, quiet=True).path
    network = Network(path)
    data = demonstrations(episodes, observation="dict")
    right = total = 0
    for each in data.episodes:
        for index, action in enumerate(each.actions):
            percept = {key: rows[index] for key, rows in each.observations.items()}
            ((_, chosen),) = network.decide(percept).items()
            right += int(chosen) == action
            total += 1
    assert right / total > 0.9


def test_actions_without_a_range_can_not_be_learned() -> None:
    from gymnasium.spaces import Box

    with pytest.raises(SetupError, match="one actuator whose numbers have a range, got Box"):
        Clone(np.zeros((3, 2), np.float32), Box(-np.inf, np.inf, (2,)))


def test_a_reading_that_was_always_the_same_says_nothing() -> None:
    from gymnasium.spaces import Box

    seen = np.array([[1, 0], [1, 2]], np.float32)
    network: Any = Clone(seen, Box(-1.0, 1.0, (1,)))
    assert network.places.tolist() == [1]
    one, other = (network(torch.tensor([[first, 0.5]])) for first in (1.0, 99.0))
    assert torch.equal(one, other)
    # unless all of them were: then there is nothing else to go by
    network = Clone(np.ones((8, 2), np.float32), Box(-1.0, 1.0, (1,)))
    assert (network.places.tolist(), network.spread.tolist()) == ([0, 1], [1.0, 1.0])


def test_a_whole_number_has_an_input_for_each_value() -> None:
    from gymnasium.spaces import Discrete

    seen = np.array([[0, 0.5], [2, 0.7]], np.float32)
    network: Any = Clone(seen, Discrete(3), levels=[4, 0])
    assert network.layers[0].in_features == 1 + 4
    assert levels_of(Scene.load("grid_world").build().agents[0])[-3:] == [0, 20, 20]
    assert not any(levels_of(Scene.load("box_chase").build().agents[0]))


@pytest.fixture
def seeded_torch() -> Iterator[None]:
    """Begin with the same weights, whichever tests came before."""
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(0)
        yield


@pytest.mark.usefixtures("seeded_torch")
def test_the_ends_of_a_range_are_reached_and_not_more() -> None:
    """A clone must not output small values where the teacher output 0: a small jump is a jump."""
    from gymnasium.spaces import Box

    seen = np.linspace(-1, 1, 64, dtype=np.float32)[:, None]
    done = (seen > 0.0).astype(np.float32)
    network: Any = Clone(seen, Box(0.0, 1.0, (1,)))
    optimizer = torch.optim.Adam(network.parameters(), lr=3e-3)
    for _ in range(300):
        loss = network.loss(torch.from_numpy(seen), torch.from_numpy(done))
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
    answers = network(torch.from_numpy(seen)).detach().numpy()
    assert set(answers[np.abs(seen) > 0.1].tolist()) == {0.0, 1.0}
    # beyond an end is no error, on the wrong side of it is one
    with torch.no_grad():
        network.layers[-1].weight.zero_()
        network.layers[-1].bias.fill_(3.0)
        assert float(network.loss(torch.zeros(1, 1), torch.ones(1, 1))) == 0.0
        assert float(network.loss(torch.zeros(1, 1), torch.zeros(1, 1))) > 1.0
