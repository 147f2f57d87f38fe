"""Recorded episodes as training data: observations, actions, rewards."""

import json
import warnings
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from gymnasium import spaces

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.atomic_write import partial_file
from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.optional_deps import need
from ai4u_edu.blocks import Actuator
from ai4u_edu.learn.envs.spaces_of import Observer, action_space_of, outputs_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording import AgentRecord, Episode, RecordingError, Replay
from ai4u_edu.recording.agent_record import PERSON
from ai4u_edu.recording.player import Player
from ai4u_edu.scenes import Scene, SceneDescription

Array = npt.NDArray[Any]

HOW_TO_RECORD = _(
    "make some with: ai4u-edu record SCENE --brain ..., or ai4u-edu play SCENE --record DIR"
)


@dataclass(frozen=True)
class Demonstration:
    """One episode of one agent, n decisions long."""

    seed: int
    observations: Any
    """(n + 1, ...) as the scene's environment gives them, or such an array by perception key."""
    actions: Any
    """(n, ...) as the environment takes them, or such an array by actuator."""
    rewards: npt.NDArray[np.float64]
    terminations: npt.NDArray[np.bool_]
    truncations: npt.NDArray[np.bool_]
    by_person: npt.NDArray[np.bool_]
    """(n,) True where a person decided, by keys; False also in older files, which don't say."""

    def __len__(self) -> int:
        return len(self.rewards)


@dataclass(frozen=True)
class Demonstrations:
    """Demonstrations by one driver in one scene."""

    scene: SceneDescription
    agent: str
    """The agent's id."""
    skip_frame: int
    """Ticks that it skipped between two decisions."""
    repeat_action: bool
    """True if an action was applied on every tick until the next decision."""
    observation_space: spaces.Space[Any]
    action_space: spaces.Space[Any]
    episodes: tuple[Demonstration, ...]

    @property
    def decisions(self) -> int:
        """Count of all decisions."""
        return sum(map(len, self.episodes))

    def save(self, path: Path) -> Path:
        """Write all as NumPy arrays (.npz), which ``numpy.load`` reads.

        ``0/observations`` (or ``0/observations/KEY``), ``0/actions``, ``0/rewards``,
        ``0/terminations``, ``0/truncations``, ``0/seed``, then ``1/...``; ``about`` is JSON text.
        """
        about = {
            "scene": Scene(self.scene).plain(),
            "agent": self.agent,
            "skip_frame": self.skip_frame,
            "repeat_action": self.repeat_action,
            "episodes": len(self.episodes),
        }
        arrays: dict[str, Array] = {"about": np.array(json.dumps(about))}
        for index, each in enumerate(self.episodes):
            arrays |= _named(f"{index}/observations", each.observations)
            arrays |= _named(f"{index}/actions", each.actions)
            arrays[f"{index}/rewards"] = each.rewards
            arrays[f"{index}/terminations"] = each.terminations
            arrays[f"{index}/truncations"] = each.truncations
            arrays[f"{index}/seed"] = np.array(each.seed)
        with partial_file(path) as beside, beside.open("wb") as file:
            np.savez_compressed(file, **arrays)  # type: ignore[arg-type]  # the names are ours
        return path

    def to_minari(self, dataset_id: str, **about: Any) -> Any:
        """Create a Minari dataset on this machine; needs ``pip install "ai4u-edu[data]"``.

        Args:
            dataset_id: such as ``box_chase/people-v0``.
            about: other arguments of ``minari.create_dataset_from_buffers``, such as ``author``.

        Returns:
            The ``minari.MinariDataset``.

        Raises:
            SetupError: Minari is not installed, or there is such a dataset already.
        """
        need("data", "minari", "h5py")
        import minari
        from minari.data_collector import EpisodeBuffer

        if dataset_id in minari.list_local_datasets():
            raise SetupError(
                _(
                    "there is a dataset {dataset_id!r} already; expected a new name, such as "
                    "one with a higher version (-v1)",
                    dataset_id=dataset_id,
                )
            )
        buffers = [
            EpisodeBuffer(
                id=index,
                seed=each.seed % 2**63,
                observations=each.observations,
                actions=each.actions,
                rewards=each.rewards.tolist(),
                terminations=each.terminations.tolist(),
                truncations=each.truncations.tolist(),
            )
            for index, each in enumerate(self.episodes)
        ]
        told = {"description": self.scene.goal or self.scene.title} | about
        with warnings.catch_warnings():
            # it asks for an author and a permalink, which a class of beginners has no use for
            warnings.simplefilter("ignore", UserWarning)
            return minari.create_dataset_from_buffers(
                dataset_id,
                buffers,
                observation_space=self.observation_space,
                action_space=self.action_space,
                requirements=["ai4u-edu"],
                **told,
            )


@dataclass(frozen=True)
class Cloned:
    """Result of a cloning."""

    path: Path
    decisions: int
    """Count of the recorded decisions."""
    loss: float
    """Error on held-out decisions: mean error of an action whose numbers reach from -1 to 1, or the
    cross-entropy of a choice."""
    alike: float | None = None
    """Share of held-out decisions, 0 to 1, in which a network that never saw them acts like the
    driver; None if it was not measured."""
    commonest: float | None = None
    """The same share for always doing what was done most often."""
    held_out: int = 0
    """Count of held-out decisions; of five drives or more, they are those of whole drives."""
    remarks: tuple[str, ...] = ()
    """Sentences about what is wrong with the drives; empty if nothing is known to be."""


def demonstrations(
    episodes: Iterable[Episode], *, agent: str | None = None, observation: str = "flat"
) -> Demonstrations:
    """Replay episodes, and return what one agent sensed and did.

    Args:
        episodes: episodes of the same scene. An agent that restarted within one gives several.
        agent: its id; left out, the one that acts first.
        observation: ``"flat"`` or ``"dict"``, as :class:`~ai4u_edu.learn.envs.SceneEnv` has it.

    Raises:
        RecordingError: there are none, they are of several scenes, or one can't be played exactly.
    """
    found: list[Demonstration] = []
    rhythms: set[tuple[int, bool]] = set()
    first: tuple[SceneDescription, BasicAgent] | None = None
    for episode in episodes:
        record = episode.agent(agent)
        if first is None:
            first = episode.scene, Player(episode).sim.agent(record.id)
        elif first[0].name != episode.scene.name:
            raise RecordingError(
                _(
                    "expected episodes of one scene, got {name!r} and {name2!r}",
                    name=first[0].name,
                    name2=episode.scene.name,
                )
            )
        rhythms |= {(each.skip_frame, each.repeat_action) for each in record}
        found += _own_episodes(episode, record, first[1], Observer(first[1], observation))
    if first is None or not found:
        raise RecordingError(_("expected recorded episodes with decisions in them, got none"))
    scene, driver = first
    skip_frame, repeat_action = max(rhythms)
    return Demonstrations(
        scene=scene,
        agent=driver.id,
        skip_frame=skip_frame,
        repeat_action=repeat_action,
        observation_space=Observer(driver, observation).space,
        action_space=action_space_of(driver),
        episodes=tuple(found),
    )


def load_episodes(paths: Sequence[Path]) -> list[Episode]:
    """Load episodes from files and from folders of such files.

    Raises:
        RecordingError: there are none, or one can't be read.
    """
    for path in paths:
        if not path.exists():
            raise RecordingError(
                _(
                    "{path}: expected a recorded episode (.episode), or a folder of them, and "
                    "there is none; {how_to_record}",
                    path=str(path),
                    how_to_record=HOW_TO_RECORD,
                )
            )
    files = [
        file
        for path in paths
        for file in (sorted(path.glob("*.episode")) if path.is_dir() else [path])
    ]
    if not files:
        raise RecordingError(
            _(
                "{map}: expected recorded episodes (.episode), found none; {how_to_record}",
                map=", ".join(map(str, paths)),
                how_to_record=HOW_TO_RECORD,
            )
        )
    return [Episode.load(file) for file in files]


def _own_episodes(
    episode: Episode, record: AgentRecord, driver: BasicAgent, observer: Observer
) -> list[Demonstration]:
    percepts = Replay(episode).percepts(record.id)
    outputs = outputs_of(driver)
    ends = [*record.starts.tolist()[1:], len(record)]
    found = []
    for start, end, seen in zip(record.starts.tolist(), ends, percepts, strict=True):
        steps = [step for step in range(start, end) if record[step].ended]
        decisions = [record[step] for step in steps]
        if not decisions:
            continue
        # a percept more than there are decisions: what came of the last one
        observations = [observer.observe(each) for each in seen[: len(decisions) + 1]]
        actions = [_as_taken(decision.action, outputs) for decision in decisions]
        found.append(
            Demonstration(
                seed=episode.seed,
                observations=_stacked(observations),
                actions=_stacked(actions),
                rewards=np.array([each.reward for each in decisions], np.float64),
                terminations=np.array([each.terminated for each in decisions], np.bool_),
                truncations=np.array([each.truncated for each in decisions], np.bool_),
                by_person=(record.flags[steps] & PERSON) > 0,
            )
        )
    return found


def _as_taken(action: dict[str, tuple[float, ...]], outputs: dict[str, Actuator]) -> Any:
    """Return an action as the environment takes it; an actuator without one stays at rest."""
    taken: dict[str, Any] = {}
    for name, actuator in outputs.items():
        low, high = actuator.limits()
        numbers = action.get(name, tuple(np.clip(0.0, low, high).tolist()))
        space = actuator.space()
        taken[name] = (
            np.array(numbers, space.dtype).reshape(space.shape)
            if isinstance(space, spaces.Box)
            else np.int64(numbers[0])
        )
    return next(iter(taken.values())) if len(taken) == 1 else taken


def _stacked(rows: Sequence[Any]) -> Any:
    if isinstance(rows[0], dict):
        return {key: _stacked([row[key] for row in rows]) for key in rows[0]}
    if isinstance(rows[0], str):
        return list(rows)
    if isinstance(rows[0], tuple):  # several texts, joined as AI4U's protocol joins them
        return [" ".join(row) for row in rows]
    return np.stack(rows)


def _named(name: str, data: Any) -> dict[str, Array]:
    if isinstance(data, dict):
        return {f"{name}/{key}": np.asarray(each) for key, each in data.items()}
    return {name: np.asarray(data)}
