"""Imitation learning with an interactive teacher (DAgger). Loads torch.

A cloned network knows only the states that its teacher visited; a small error leads to a state that
was never shown. In DAgger the learner drives too, and the teacher labels each of its decisions with
the action that she would have taken: the data covers the states that the learner's errors lead to.

Source: DAgger, of S. Ross, G. Gordon and D. Bagnell, "A reduction of imitation learning and
structured prediction to no-regret online learning", 2011.
"""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import torch
from gymnasium import spaces

from ai4u_edu.agent import BasicAgent
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks import LocalBrain, Percept
from ai4u_edu.learn.envs.spaces_of import Observer, action_space_of, outputs_of
from ai4u_edu.learn.training.algorithms import TORCH_THREADS
from ai4u_edu.learn.training.cloning import BATCH, RATE, Clone, Floats, levels_of, write_network
from ai4u_edu.learn.training.evaluating import DEFAULT_MAX_DECISIONS
from ai4u_edu.learn.training.progress_bar import ProgressBar
from ai4u_edu.learn.training.rays import rays_of
from ai4u_edu.learn.training.settings import DaggerSettings
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene

Drive = Callable[[Percept], Mapping[str, Any]]

FIRST_SEED = 2**42
"""First seed of DAgger's episodes; neither trainings nor evaluations use them."""
DECISIONS_PER_TURN = 50
"""Mean number of decisions after which the driver may change."""
TEACHER_SHARE = 0.3
"""Share of the decisions in which the teacher drives, after the first round."""


class TeacherData:
    """Data labelled by the teacher so far, and the world in which she drives.

    Args:
        teacher: makes a driver for one episode; it sees only the percept.
        scene: the scene.
        seed: seed of all random choices.
    """

    def __init__(self, teacher: Callable[[], Drive], scene: Scene, seed: int) -> None:
        self.sim: ControlRequestor = scene.build()
        self.agent: BasicAgent = self.sim.agents[0]
        self._outputs = list(outputs_of(self.agent))
        self.space, self.parts = _joined(action_space_of(self.agent), self._outputs)
        limits = [actuator.limits() for actuator in outputs_of(self.agent).values()]
        self._low = np.concatenate([low for low, _high in limits])
        self._high = np.concatenate([high for _low, high in limits])
        self.rhythm: dict[str, Any] = {
            "skip_frame": self.agent.brain.skip_frame,
            "repeat_action": self.agent.brain.repeat_action,
        }
        self.levels = levels_of(self.agent)
        self.rays = rays_of(self.agent)
        self.seen: list[Floats] = []
        self.said: list[Floats] = []
        self.episodes = 0
        self._teacher = teacher
        self._observer = Observer(self.agent, "flat")
        self._chance = np.random.default_rng(seed)
        self._first = FIRST_SEED + 1_000_000 * seed

    def episode(self, pupil: Clone | None) -> None:
        """Record one more episode; the learner drives most of the time, if there is one."""
        teacher = self._teacher()
        drives = pupil is not None

        def drive(percept: Percept) -> dict[str, Any]:
            nonlocal drives
            if pupil is not None and self._chance.random() < 1 / DECISIONS_PER_TURN:
                drives = bool(self._chance.random() > TEACHER_SHARE)
            action = teacher(percept)
            said = [np.atleast_1d(np.asarray(action[name], np.float32)) for name in self._outputs]
            seen = self._observer.observe(percept)
            self.seen.append(seen)
            self.said.append(np.clip(np.concatenate(said), self._low, self._high))
            if pupil is None or not drives:
                return {
                    name: part if len(part) > 1 else part[0]
                    for name, part in zip(self._outputs, said, strict=True)
                }
            with torch.no_grad():
                done = pupil(torch.from_numpy(seen)[None])
            parts = done if isinstance(done, tuple) else (done,)
            return {name: part[0].numpy() for name, part in zip(self._outputs, parts, strict=True)}

        self.agent.use_brain(LocalBrain(controller=drive, **self.rhythm))
        self.sim.reset(self._first + self.episodes)
        self.episodes += 1
        while not self.agent.done and self.agent.steps < DEFAULT_MAX_DECISIONS:
            self.sim.step(self.agent)


def _joined(
    space: spaces.Space[Any], outputs: Sequence[str]
) -> tuple[spaces.Space[Any], Sequence[int]]:
    """Return the space of all actuators' numbers in a row, and how many each has.

    Args:
        space: of one actuator, or a Dict of several, each a Box.
        outputs: the actuators' names, in their order.

    Raises:
        SetupError: one of several actuators takes a choice, not numbers.
    """
    if not isinstance(space, spaces.Dict):
        return space, ()
    boxes: list[Any] = [space[name] for name in outputs]
    if not all(isinstance(box, spaces.Box) for box in boxes):
        raise SetupError(
            _(
                "expected an agent with one actuator whose numbers have a range, got {space}",
                space=str(space),
            )
        )
    low, high = (
        np.concatenate([getattr(box, end).ravel() for box in boxes]) for end in ("low", "high")
    )
    return spaces.Box(low, high), [box.low.size for box in boxes]


def imitate(
    teacher: Callable[[], Drive],
    scene: Scene,
    path: Path,
    settings: DaggerSettings | None = None,
    *,
    seed: int = 0,
    quiet: bool = False,
) -> Path:
    """Train a network from a teacher, and write it as ONNX.

    Args:
        teacher: makes a driver for one episode; it sees only the percept.
        scene: the scene.
        path: the network's file.
        settings: number of rounds, and size of the network.
        seed: the same seed gives the same network.
        quiet: True shows nothing.
    """
    how = settings or DaggerSettings()
    rounds, updates = how.rounds, how.updates
    lessons = TeacherData(teacher, scene, seed)
    bar = ProgressBar(rounds, _("rounds"), quiet=quiet)
    torch.set_num_threads(TORCH_THREADS)
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(seed)
        chance = np.random.default_rng(seed)
        pupil: Any = None
        try:
            for each in range(1, rounds + 1):
                for _episode in range(how.episodes):
                    lessons.episode(pupil)
                seen, said = np.stack(lessons.seen), np.stack(lessons.said)
                rays = lessons.rays if how.kinds else []
                new = Clone(seen, lessons.space, how.layers, lessons.levels, rays, lessons.parts)
                pupil = _as_scaled(new, pupil)
                last = each == rounds
                error = _study(pupil, seen, said, updates * (3 if last else 1), chance)
                bar.show(each, _("{n} decisions  error {error:.4f}", n=len(seen), error=error))
        finally:
            bar.close()
    about = {
        "scene": scene.description.name,
        "algorithm": "dagger",
        "seed": seed,
        "steps": updates * (rounds + 2),
        "demonstrations": lessons.episodes,
        "decisions": len(seen),
    }
    write_network(pupil, lessons.agent, about | lessons.rhythm, path)
    return path


def _as_scaled(new: Clone, old: Clone | None) -> Clone:
    """Return a network with the new input scales and the old one's weights."""
    if old is not None and torch.equal(old.places, new.places):
        new.layers.load_state_dict(old.layers.state_dict())
    return new


def _study(
    pupil: Clone,
    seen: Floats,
    said: Floats,
    updates: int,
    chance: np.random.Generator,
) -> float:
    readings, wanted = torch.from_numpy(seen), torch.from_numpy(said)
    optimizer = torch.optim.AdamW(pupil.parameters(), lr=RATE, weight_decay=1e-3)
    falling = torch.optim.lr_scheduler.LambdaLR(optimizer, lambda step: 1 - 0.95 * step / updates)
    error = 0.0
    for _update in range(updates):
        batch = chance.integers(len(seen), size=2 * BATCH)
        loss = pupil.loss(readings[batch], wanted[batch])
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
        falling.step()
        error += 0.01 * (float(loss.detach()) - error)
    return error
