"""Behaviour cloning: a network learns to imitate recorded episodes. Loads torch."""

import hashlib
import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import torch
from gymnasium import spaces
from torch import Tensor, nn

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.seeding import checked_seed
from ai4u_edu.base.version import __version__
from ai4u_edu.blocks.brains.network import TRAINING_KEY
from ai4u_edu.learn.envs.spaces_of import described_blocks, inputs_of, outputs_of
from ai4u_edu.learn.training.algorithms import TORCH_THREADS
from ai4u_edu.learn.training.demonstrations import Cloned, demonstrations
from ai4u_edu.learn.training.exporting import graph_of
from ai4u_edu.learn.training.progress_bar import ProgressBar
from ai4u_edu.learn.training.rays import RayNearness
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording import Episode
from ai4u_edu.recording.player import Player

LAYERS = (128, 128)
RATE = 1e-3
BATCH = 128
DEFAULT_UPDATES = 2000
"""Gradient steps; a handful of episodes is learned by then."""
VALIDATION_SHARE = 0.1
"""Share of the decisions kept for validation (early stopping)."""
MAX_LEVELS = 64
"""Largest count of values that a whole number is one-hot encoded for; larger ones are amounts."""
VALIDATE_EVERY = 100
"""Gradient steps between two validations."""

Floats = npt.NDArray[np.float32]


class Clone(nn.Module):  # type: ignore[misc]  # seen without its types
    """Network from readings to an action, with the scaling inside.

    Args:
        seen: (n, r) all recorded readings, one row each; their mean and spread are kept.
        space: the action space; of several actuators, that of all their numbers in a row.
        layers: the hidden layers' sizes.
        levels: (r,) count of values of a reading that is a whole number from 0 on: it is one-hot
            encoded, as the next row of a grid may be quite another place. Else 0.
        rays: encoders that replace the bare readings of ray sensors.
        parts: how many of the numbers each actuator gets, if there are several.
    """

    def __init__(
        self,
        seen: Floats,
        space: spaces.Space[Any],
        layers: Sequence[int] = LAYERS,
        levels: Sequence[int] = (),
        rays: Sequence[RayNearness] = (),
        parts: Sequence[int] = (),
    ) -> None:
        super().__init__()
        self._parts = list(parts)
        self.low: Tensor
        self.high: Tensor
        self.rays = nn.ModuleList(rays)
        self._look_at(seen, levels)
        self.chooses = isinstance(space, spaces.Discrete)
        if isinstance(space, spaces.Discrete):
            count, self.first = int(space.n), int(space.start)
        elif isinstance(space, spaces.Box) and space.is_bounded():
            count = int(np.prod(space.shape))
            self.register_buffer("low", torch.as_tensor(space.low.ravel()))
            self.register_buffer("high", torch.as_tensor(space.high.ravel()))
        else:
            raise SetupError(
                _(
                    "expected an agent with one actuator whose numbers have a range, got {space}",
                    space=str(space),
                )
            )
        hidden: list[nn.Module] = []
        width = len(self.places) + len(self.wholes) * len(self.ladder)
        width += sum(each.width for each in rays)
        for size in layers:
            hidden += [nn.Linear(width, size), nn.ReLU()]
            width = size
        self.layers = nn.Sequential(*hidden, nn.Linear(width, count))

    def _look_at(self, seen: Floats, levels: Sequence[int]) -> None:
        self.middle: Tensor
        self.spread: Tensor
        self.places: Tensor
        self.wholes: Tensor
        self.ladder: Tensor
        whole = np.array(levels if len(levels) else [0] * seen.shape[1])
        spread = seen.std(axis=0)
        # what was always the same says nothing, and may not shout when it is another
        varied = (spread >= 1e-3) & (whole == 0)
        for each in self.rays:
            varied[np.concatenate([each.codes, each.distances])] = False
        coded = whole.any() or len(self.rays)
        places = np.flatnonzero(varied) if varied.any() or coded else np.arange(len(spread))
        self.register_buffer("places", torch.as_tensor(places))
        self.register_buffer("middle", torch.as_tensor(seen.mean(axis=0)[places]))
        self.register_buffer("spread", torch.as_tensor(np.where(varied, spread, 1.0)[places]))
        self.register_buffer("wholes", torch.as_tensor(np.flatnonzero(whole)))
        self.register_buffer("ladder", torch.arange(int(whole.max()), dtype=torch.float32))

    def forward(self, *readings: Tensor) -> Tensor | tuple[Tensor, ...]:
        """Return an action for each row of the readings; of several actuators, one of each."""
        numbers = self.numbers(
            torch.cat([each.to(torch.float32).flatten(1) for each in readings], 1)
        )
        if self.chooses:
            return numbers.argmax(dim=1) + self.first
        # cut, not bent: a jump of nothing at all has to be possible
        action = self.low + 0.5 * (torch.clamp(numbers, -1.0, 1.0) + 1.0) * (self.high - self.low)
        return action.split(self._parts, dim=1) if self._parts else action

    def numbers(self, seen: Tensor) -> Tensor:
        """Return the last layer's output."""
        # cut: what lies far outside of all that was shown should not count for more than that
        scaled = torch.clamp((seen[:, self.places] - self.middle) / self.spread, -10.0, 10.0)
        if len(self.wholes):
            each = seen[:, self.wholes].unsqueeze(2) == self.ladder
            scaled = torch.cat([scaled, each.to(torch.float32).flatten(1)], 1)
        if len(self.rays):
            scaled = torch.cat([scaled, *(each(seen) for each in self.rays)], 1)
        found: Tensor = self.layers(scaled)
        return found

    def loss(self, seen: Tensor, done: Tensor) -> Tensor:
        """Return the loss between the network's actions and the recorded ones."""
        numbers = self.numbers(seen)
        if self.chooses:
            return nn.functional.cross_entropy(numbers, done.long().ravel() - self.first)
        wide = torch.clamp(self.high - self.low, min=1e-6)
        wanted = 2 * (done - self.low) / wide - 1
        # beyond the end of the range is as good as at it
        beyond = numbers.detach() * wanted.sign() > 1.0
        wanted = torch.where((wanted.abs() >= 1.0) & beyond, numbers.detach(), wanted)
        # not the square: who drives with keys jumps from one end to the other, and between the two
        # lies what nobody does
        return nn.functional.smooth_l1_loss(numbers, wanted, beta=0.1)


def clone(
    episodes: Sequence[Episode],
    path: Path,
    *,
    agent: str | None = None,
    seed: int = 0,
    updates: int = DEFAULT_UPDATES,
    quiet: bool = False,
) -> Cloned:
    """Train a network to imitate recorded episodes, and write it as ONNX.

    It learns what to do in recorded situations and only guesses elsewhere, so a few episodes that
    begin in different places teach more than many that begin in the same one. The same episodes and
    the same seed give the same network.

    Args:
        episodes: of one scene, driven well.
        path: the network's file.
        agent: the id of the agent to imitate; left out, the one that acts first.
        seed: seed of the network and of the order of the data.
        updates: gradient steps.
        quiet: True shows nothing.

    Raises:
        RecordingError: the episodes can't be played again exactly.
        SetupError: such actions can't be learned.
    """
    seed = checked_seed(seed)
    shown = demonstrations(episodes, agent=agent)
    if isinstance(shown.action_space, spaces.Dict):
        raise SetupError(
            _(
                "expected an agent with one actuator to learn, got {action_space}; set "
                "is_output to False on the others",
                action_space=str(sorted(shown.action_space)),
            )
        )
    seen = np.concatenate([each.observations[:-1] for each in shown.episodes]).astype(np.float32)
    done = np.concatenate(
        [np.reshape(each.actions, (len(each), -1)) for each in shown.episodes]
    ).astype(np.float32)
    driver = Player(episodes[0]).sim.agent(shown.agent)
    torch.set_num_threads(TORCH_THREADS)
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(seed)
        network = Clone(seen, shown.action_space, levels=levels_of(driver))
        loss = _learn(network, seen, done, seed, updates, quiet)
    about = {
        "scene": shown.scene.name,
        "algorithm": "clone",
        "seed": seed,
        "steps": updates,
        "demonstrations": len(shown.episodes),
        "decisions": shown.decisions,
        "skip_frame": shown.skip_frame,
        "repeat_action": shown.repeat_action,
    }
    write_network(network, driver, about, path)
    return Cloned(path, shown.decisions, loss)


def _learn(
    network: Clone,
    seen: Floats,
    done: Floats,
    seed: int,
    updates: int,
    quiet: bool,
) -> float:
    chance = np.random.default_rng(seed)
    order = chance.permutation(len(seen))
    held = max(1, round(VALIDATION_SHARE * len(order)))
    kept, rest = order[:held], order[held:] if len(order) > held else order
    readings, wanted = torch.from_numpy(seen), torch.from_numpy(done)
    optimizer = torch.optim.AdamW(network.parameters(), lr=RATE, weight_decay=1e-2)
    best, state = float("inf"), network.state_dict()
    bar = ProgressBar(updates, _("updates"), quiet=quiet)
    try:
        for update in range(1, updates + 1):
            batch = chance.choice(rest, min(BATCH, len(rest)), replace=False)
            loss = network.loss(readings[batch], wanted[batch])
            optimizer.zero_grad()
            loss.backward()
            optimizer.step()
            if update % VALIDATE_EVERY == 0 or update == updates:
                with torch.no_grad():
                    error = float(network.loss(readings[kept], wanted[kept]))
                if error < best:
                    best = error
                    state = {name: each.clone() for name, each in network.state_dict().items()}
                bar.show(update, _("error {error:.4f}", error=error))
    finally:
        bar.close()
    network.load_state_dict(state)
    return best


def levels_of(agent: BasicAgent) -> list[int]:
    """Return for each number of a flat observation how many whole values it has, or 0."""
    levels: list[int] = []
    for sensor in agent.bound_blocks.sensors:
        if sensor.is_input:
            space = sensor.observation_space()
            size = int(np.prod(space.shape or (1,)))
            few = isinstance(space, spaces.Box) and np.issubdtype(space.dtype, np.signedinteger)
            most = int(space.high.max()) + 1 if isinstance(space, spaces.Box) and few else 0
            levels += [most if 2 < most <= MAX_LEVELS else 0] * size
    return levels


def write_network(network: Clone, agent: BasicAgent, about: dict[str, Any], path: Path) -> None:
    """Write a network as ONNX, with metadata on its origin and its agent."""
    inputs = inputs_of(agent)
    graph = graph_of(network.eval(), inputs, *outputs_of(agent))
    graph.producer_name, graph.producer_version = "ai4u-edu", __version__
    told = about | {
        "version": __version__,
        **described_blocks(agent),
        "hash": hashlib.sha256(graph.SerializeToString(deterministic=True)).hexdigest(),
    }
    entry = graph.metadata_props.add()
    entry.key, entry.value = TRAINING_KEY, json.dumps(told, sort_keys=True)
    write_atomically(path, graph.SerializeToString(deterministic=True))
