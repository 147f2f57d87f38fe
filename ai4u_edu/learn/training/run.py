"""Folder of a training: models, set-up, and the checks on the way.

::

    DIR/config.json     the algorithm, its settings, the seed, the versions of what ran
    DIR/scene.yaml      the scene, as it was
    DIR/best.zip        the model that did best in a check
    DIR/last.zip        the model as it was last: --resume goes on from it
    DIR/replay.pkl      what SAC and DQN remember
    DIR/checks.json     every check on the way
    DIR/checkpoint-*.zip   the model at each check, with --keep-checkpoints
    DIR/watched.*       model, weights and progress for the page of --watch
    DIR/tensorboard/    curves, for: tensorboard --logdir DIR

One of the small learner has networks in place of models, and writes them without a request::

    DIR/best.onnx       the network that did best in a check; at first, the one that it began with
    DIR/watched.onnx    the network as it is now, at most a second old
    DIR/watched.json    decisions so far, and the learning curve
    DIR/opponent.onnx   the network that it learns against, if it does
    DIR/state.npz       all that --resume needs, at most a second old
"""

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, ValidationError

from ai4u_edu.base.atomic_write import make_folder, partial_file
from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.parameters import explain, format_problems
from ai4u_edu.learn.training.settings import Algorithm, Settings
from ai4u_edu.locale import Text
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene

CHECKPOINT = "checkpoint-"
"""Beginning of the names of models that were kept at checks; the number of steps follows."""


Trainer = Literal["sb3", "small"]
"""Name of a learner: of Stable-Baselines3, or of the small one, which needs NumPy alone."""


class Config(BaseModel):
    """Set-up of a training."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    scene: str
    algorithm: Algorithm
    seed: int
    steps: int
    settings: Settings
    versions: dict[str, str]
    """Versions of the packages that ran, by name."""
    trainer: Trainer = "sb3"
    against: Literal["", "player", "self", "file"] = ""
    """Opponent: the scene's player, the network itself, or one in a file; empty for none."""


class Check(BaseModel):
    """Evaluation of a policy during a training."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    steps: int
    """Decisions learned from so far."""
    seconds: float
    """Seconds since the training began, checks included."""
    success: float | None
    """Share of the episodes that reached the goal; None in a scene without one."""
    reward: float
    """Mean reward of an episode."""
    length: float
    """Mean number of decisions in an episode."""

    @property
    def line(self) -> Text:
        """Its results in a line."""
        told = {**self.model_dump(), "success": self.success or 0.0}
        if self.success is None:
            return _(
                "after {steps} steps, {seconds:.0f} s: reward {reward:.2f} in {length:.0f} "
                "decisions",
                **told,
            )
        return _(
            "after {steps} steps, {seconds:.0f} s: success {success:.0%}, reward {reward:.2f} in "
            "{length:.0f} decisions",
            **told,
        )

    @property
    def rank(self) -> tuple[float, float]:
        """Sort key; larger is better: more success; if all succeeded, faster; else more reward."""
        return (self.success or 0.0, -self.length if self.success == 1.0 else self.reward)


def run_of(path: Path) -> "Run":
    """Return the training in a folder, or of a model in it.

    Raises:
        SetupError: there is no such folder or model.
    """
    if path.is_dir():
        return Run(path)
    if not path.is_file():
        folder = path.with_suffix("") if path.suffix == ".zip" else path
        raise SetupError(
            _(
                "{path} holds no training: there is no such folder or model (.zip); begin "
                "one with: ai4u-edu train SCENE --out {folder}",
                path=str(path),
                folder=str(folder),
            )
        )
    if path.suffix != ".zip":
        raise SetupError(
            _("{path}: expected a training's folder, or a model (.zip) in it", path=str(path))
        )
    return Run(path.parent)


class Run:
    """Folder of a training.

    Args:
        folder: its path; it may not exist yet.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.best = folder / "best.zip"
        self.last = folder / "last.zip"
        self.replay = folder / "replay.pkl"
        self.tensorboard = folder / "tensorboard"
        self.best_network = folder / "best.onnx"
        self.state = folder / "state.npz"
        self.opponent = folder / "opponent.onnx"
        self.watched_network = folder / "watched.onnx"
        self.watched_model = folder / "watched.zip"
        self.watched_weights = folder / "watched.pt"
        self.progress = folder / "watched.json"

    def checkpoint(self, steps: int) -> Path:
        """Return the file of the model that has learned from so many decisions."""
        return self.folder / f"{CHECKPOINT}{steps:09}.zip"

    @property
    def checkpoints(self) -> list[Path]:
        """Models of the checks that were kept, the earliest first."""
        return sorted(self.folder.glob(f"{CHECKPOINT}*.zip"))

    def clear(self) -> None:
        """Delete what a training wrote, and nothing else in the folder."""
        for name in ("config.json", "scene.yaml", "checks.json"):
            (self.folder / name).unlink(missing_ok=True)
        kept = (self.best, self.last, self.replay, self.best_network, self.state, self.opponent)
        watched = (self.watched_model, self.watched_weights, self.watched_network, self.progress)
        events = self.tensorboard.glob("events.*")
        for path in (*kept, *watched, *events, *self.checkpoints):
            path.unlink(missing_ok=True)

    def begin(self, config: Config, scene: Scene) -> None:
        """Create the folder.

        Raises:
            SetupError: there is a training in it already.
        """
        if (self.folder / "config.json").exists():
            raise SetupError(
                _(
                    "{folder} holds a training already; go on with it (resume), choose another "
                    "folder (out), or begin anew in this one (overwrite)",
                    folder=str(self.folder),
                )
            )
        make_folder(self.folder, _("a training"))
        scene.save(self.folder / "scene.yaml")
        self._write("config.json", config.model_dump(mode="json"))

    def config(self) -> Config:
        """Return its set-up.

        Raises:
            SetupError: there is no training in the folder.
        """
        path = self.folder / "config.json"
        try:
            return Config.model_validate_json(path.read_bytes())
        except OSError:
            raise SetupError(
                _(
                    "{folder} holds no training; begin one with: ai4u-edu train SCENE --out "
                    "{folder}",
                    folder=str(self.folder),
                )
            ) from None
        except ValidationError as error:
            raise SetupError(
                _(
                    "{path}: not as a training writes it: {problem}",
                    path=str(path),
                    problem=format_problems(explain(error.errors(), Config)),
                )
            ) from None

    def scene(self) -> Scene:
        """Return the scene as it was."""
        return Scene.load(self.folder / "scene.yaml")

    def checks(self) -> list[Check]:
        """Return all checks so far."""
        path = self.folder / "checks.json"
        if not path.is_file():
            return []
        return [Check.model_validate(each) for each in json.loads(path.read_bytes())]

    def note(self, checks: list[Check]) -> None:
        """Save all checks."""
        self._write("checks.json", [check.model_dump(mode="json") for check in checks])

    def put(self, path: Path, write: Callable[[Path], object]) -> None:
        """Write a file atomically, with a function that takes a path."""
        with partial_file(path) as beside:
            write(beside)

    def put_text(self, path: Path, text: str) -> None:
        """Write a text file atomically."""
        self.put(path, lambda beside: beside.write_text(text + "\n", "utf-8"))

    def _write(self, name: str, data: Any) -> None:
        self.put_text(self.folder / name, json.dumps(data, indent=1))


@dataclass(frozen=True)
class Trained:
    """Result of a training."""

    run: Run
    steps: int
    """Decisions learned from, including those before a resume."""
    interrupted: bool
    """True if Ctrl-C ended it."""
    enough: bool
    """True if it ended early because the policy was good enough."""
    checks: list[Check]
    best: Check
    """Check of the model that was kept."""

    @property
    def folder(self) -> Path:
        """Folder with everything that the training wrote."""
        return self.run.folder

    def __repr__(self) -> str:
        """Return one line.

        The dataclass's own would list every check.
        """
        best, config = self.best, self.run.config()
        why = "interrupted" if self.interrupted else "good enough" if self.enough else "done"
        success = "" if best.success is None else f"success {best.success:.0%}, "
        return (
            f"Trained({config.scene}, {config.algorithm}: {why} after {self.steps} steps and "
            f"{self.checks[-1].seconds:.0f} s; best {success}reward {best.reward:.2f} "
            f"after {best.steps} steps; in {self.folder})"
        )
