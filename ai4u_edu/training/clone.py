"""Behaviour cloning: a network that does what somebody showed it. Loads torch."""

import hashlib
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

import numpy as np
import numpy.typing as npt
import torch
from gymnasium import spaces
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn
from torch import Tensor, nn

from ai4u_edu.blocks.brains.network import ABOUT
from ai4u_edu.envs.spaces_of import outputs_of
from ai4u_edu.errors import SetupError
from ai4u_edu.recording import Episode
from ai4u_edu.recording.player import Player
from ai4u_edu.scenes.plain import to_plain
from ai4u_edu.training.algorithms import THREADS
from ai4u_edu.training.demonstrations import Demonstrations, demonstrations
from ai4u_edu.training.export import graph_of, inputs_of
from ai4u_edu.version import __version__

LAYERS = (128, 128)
RATE = 1e-3
BATCH = 128
UPDATES = 2000
"""Gradient steps; a handful of episodes is learned by then."""
HELD_BACK = 0.1
"""The share of the decisions that is not learned from, but shows when to stop."""
LOOK = 100
"""Updates between two looks at those."""

Floats = npt.NDArray[np.float32]


@dataclass(frozen=True)
class Cloned:
    """What came out of it."""

    path: Path
    decisions: int
    """So many were shown."""
    loss: float
    """On those that it did not learn from: mean error of an action whose numbers reach from -1 to
    1, or the cross-entropy of a choice."""


class Clone(nn.Module):  # type: ignore[misc]  # seen without its types
    """Readings in, an action out; scaling happens inside.

    Args:
        seen: (n, r) all readings that were shown, one row each; their mean and spread are kept.
        space: of the actions.
    """

    def __init__(self, seen: Floats, space: spaces.Space[Any]) -> None:
        super().__init__()
        self.middle: Tensor
        self.spread: Tensor
        self.low: Tensor
        self.high: Tensor
        spread = seen.std(axis=0)
        self.register_buffer("middle", torch.as_tensor(seen.mean(axis=0)))
        # a reading that was always the same says nothing, and may not shout when it is another
        self.register_buffer("spread", torch.as_tensor(np.where(spread < 1e-3, 1.0, spread)))
        self.chooses = isinstance(space, spaces.Discrete)
        if isinstance(space, spaces.Discrete):
            count, self.first = int(space.n), int(space.start)
        elif isinstance(space, spaces.Box) and space.is_bounded():
            count = int(np.prod(space.shape))
            self.register_buffer("low", torch.as_tensor(space.low.ravel()))
            self.register_buffer("high", torch.as_tensor(space.high.ravel()))
        else:
            raise SetupError(
                f"expected an agent with one actuator whose numbers have a range, got {space}"
            )
        layers: list[nn.Module] = []
        width = seen.shape[1]
        for size in LAYERS:
            layers += [nn.Linear(width, size), nn.ReLU()]
            width = size
        self.layers = nn.Sequential(*layers, nn.Linear(width, count))

    def forward(self, *readings: Tensor) -> Tensor:
        """An action for each row of the readings."""
        numbers = self.numbers(
            torch.cat([each.to(torch.float32).flatten(1) for each in readings], 1)
        )
        if self.chooses:
            return numbers.argmax(dim=1) + self.first
        return self.low + 0.5 * (torch.tanh(numbers) + 1.0) * (self.high - self.low)

    def numbers(self, seen: Tensor) -> Tensor:
        """What the last layer says."""
        # cut: what lies far outside of all that was shown should not count for more than that
        scaled = torch.clamp((seen - self.middle) / self.spread, -10.0, 10.0)
        found: Tensor = self.layers(scaled)
        return found

    def loss(self, seen: Tensor, done: Tensor) -> Tensor:
        """How far it is from what was done."""
        numbers = self.numbers(seen)
        if self.chooses:
            return nn.functional.cross_entropy(numbers, done.long().ravel() - self.first)
        wide = torch.clamp(self.high - self.low, min=1e-6)
        wanted = 2 * (done - self.low) / wide - 1
        # not the square: who drives with keys jumps from one end to the other, and between the two
        # lies what nobody does
        return nn.functional.smooth_l1_loss(torch.tanh(numbers), wanted, beta=0.1)


def clone(
    episodes: Sequence[Episode],
    path: Path,
    *,
    agent: str | None = None,
    seed: int = 0,
    updates: int = UPDATES,
    console: Console | None = None,
    quiet: bool = False,
) -> Cloned:
    """Learns to do what was recorded, and writes the network as ONNX.

    It learns what to do where somebody has been, and only guesses elsewhere: a few episodes that
    begin in different places teach more than many that begin in the same one. The same episodes and
    the same seed give the same network.

    Args:
        episodes: of one scene, driven well.
        path: of the network's file.
        agent: the id of the one who shows it; left out, the one that acts first.
        seed: of the network and the order in which it learns.
        updates: gradient steps.
        console: where to show how it goes.
        quiet: whether to show nothing.

    Raises:
        RecordingError: the episodes can't be played again exactly.
        SetupError: such actions can't be learned.
    """
    shown = demonstrations(episodes, agent=agent)
    if isinstance(shown.action_space, spaces.Dict):
        raise SetupError(
            f"expected an agent with one actuator to learn, got {sorted(shown.action_space)}; "
            "set is_output to False on the others"
        )
    seen = np.concatenate([each.observations[:-1] for each in shown.episodes]).astype(np.float32)
    done = np.concatenate(
        [np.reshape(each.actions, (len(each), -1)) for each in shown.episodes]
    ).astype(np.float32)
    torch.set_num_threads(THREADS)
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(seed)
        network = Clone(seen, shown.action_space)
        loss = _learn(network, seen, done, seed, updates, console or Console(stderr=True), quiet)
    _write(network.eval(), episodes[0], shown, seed, updates, path)
    return Cloned(path, shown.decisions, loss)


def _learn(
    network: Clone,
    seen: Floats,
    done: Floats,
    seed: int,
    updates: int,
    console: Console,
    quiet: bool,
) -> float:
    chance = np.random.default_rng(seed)
    order = chance.permutation(len(seen))
    held = max(1, round(HELD_BACK * len(order)))
    kept, rest = order[:held], order[held:] if len(order) > held else order
    readings, wanted = torch.from_numpy(seen), torch.from_numpy(done)
    optimizer = torch.optim.AdamW(network.parameters(), lr=RATE, weight_decay=1e-2)
    best, state = float("inf"), network.state_dict()
    with Progress(
        BarColumn(bar_width=24),
        TextColumn("{task.completed}/{task.total} updates"),
        TextColumn("error {task.fields[error]}"),
        TextColumn("left"),
        TimeRemainingColumn(),
        console=console,
        disable=quiet,
    ) as progress:
        task = progress.add_task("cloning", total=updates, error="-")
        for update in range(1, updates + 1):
            batch = chance.choice(rest, min(BATCH, len(rest)), replace=False)
            loss = network.loss(readings[batch], wanted[batch])
            optimizer.zero_grad()
            loss.backward()
            optimizer.step()
            if update % LOOK == 0 or update == updates:
                with torch.no_grad():
                    error = float(network.loss(readings[kept], wanted[kept]))
                if error < best:
                    best = error
                    state = {name: each.clone() for name, each in network.state_dict().items()}
                progress.update(task, completed=update, error=f"{error:.4f}")
    network.load_state_dict(state)
    return best


def _write(
    network: Clone, episode: Episode, shown: Demonstrations, seed: int, updates: int, path: Path
) -> None:
    agent = Player(episode).sim.agent(shown.agent)
    inputs = inputs_of(agent)
    ((output, actuator),) = outputs_of(agent).items()
    graph = graph_of(cast(Any, network), inputs, output)
    graph.producer_name, graph.producer_version = "ai4u-edu", __version__
    about = {
        "version": __version__,
        "scene": shown.scene.name,
        "algorithm": "clone",
        "seed": seed,
        "steps": updates,
        "demonstrations": len(shown.episodes),
        "decisions": shown.decisions,
        "skip_frame": shown.skip_frame,
        "repeat_action": shown.repeat_action,
        "sensors": {
            sensor.perception_key: to_plain(sensor)
            | {"shape": list(inputs[sensor.perception_key][0])}
            for sensor in agent.sensors
            if sensor.perception_key in inputs
        },
        "actuators": {output: to_plain(actuator) | {"space": str(shown.action_space)}},
        "hash": hashlib.sha256(graph.SerializeToString(deterministic=True)).hexdigest(),
    }
    entry = graph.metadata_props.add()
    entry.key, entry.value = ABOUT, json.dumps(about, sort_keys=True)
    beside = path.with_name(f".new-{path.name}")
    beside.write_bytes(graph.SerializeToString(deterministic=True))
    beside.replace(path)
