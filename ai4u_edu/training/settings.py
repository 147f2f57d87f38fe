"""How a scene is learned: what a student can read and change, out of YAML files.

``settings/defaults.yaml`` holds for all scenes; a file by the scene's name says what is different.
"""

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from ai4u_edu.errors import SceneError, SetupError
from ai4u_edu.parameters import explain
from ai4u_edu.scenes.yaml_file import YamlFile

FOLDER = Path(__file__).parent / "settings"

Algorithm = Literal["sac", "ppo", "dqn"]
ALGORITHMS: tuple[Algorithm, ...] = ("sac", "ppo", "dqn")

Positive = Annotated[int, Field(ge=1)]


class AlgorithmSettings(BaseModel):
    """How one algorithm learns a scene.

    What is not named here goes to Stable-Baselines3 under its own name (``learning_rate``,
    ``gamma``, ``batch_size``, ...).
    """

    model_config = ConfigDict(extra="allow", frozen=True)

    steps: Positive
    """Decisions, over all worlds; it may be done sooner."""
    worlds: Positive = 1
    """How many copies of the scene are learned in at a time."""
    layers: tuple[Positive, ...] = (64, 64)
    """The hidden layers' sizes, for the policy and the critic."""
    activation: Literal["relu", "tanh"] = "relu"
    falling_rate: bool = False
    """Whether the learning rate falls to 0 until the last step."""
    check_every: Positive = 1000
    """Decisions between two checks of how good the policy is."""

    @property
    def others(self) -> dict[str, Any]:
        """What goes to Stable-Baselines3."""
        return dict(self.model_extra or {})


class Settings(BaseModel):
    """How a scene is learned."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    algorithm: Algorithm = "ppo"
    """What learns it, unless another is asked for."""
    agent: str = ""
    """The id of the agent that learns; left out, the one that acts first."""
    observation: Literal["flat", "dict"] = "flat"
    """One array of all readings, or one entry a sensor (for pictures)."""
    observe: tuple[str, ...] = ()
    """The perception keys that the policy gets; left out: all that are inputs."""
    skip_frame: Annotated[int, Field(ge=0)] | None = None
    """Ticks between two decisions; left out: as the agent's brain has it."""
    max_steps: Positive | None = None
    """Decisions after which an episode of the training is cut off; left out: as the agent has it.
    An evaluation always takes the agent's own."""
    actions: tuple[tuple[float, ...], ...] = ()
    """For DQN, which chooses among a few: the actions to choose from. Left out: none at all, and
    each number of the action alone at either end of its range."""
    check_episodes: Positive = 30
    enough: Annotated[int, Field(ge=0)] = 2
    """The training ends when so many checks in a row had success in every episode; 0: never."""
    sac: AlgorithmSettings
    ppo: AlgorithmSettings
    dqn: AlgorithmSettings

    def of(self, algorithm: Algorithm) -> AlgorithmSettings:
        """Those of one algorithm."""
        found: AlgorithmSettings = getattr(self, algorithm)
        return found


def settings_for(scene: str, file: Path | None = None) -> Settings:
    """How a scene is learned.

    Args:
        scene: its name.
        file: a YAML file in place of the scene's own.

    Raises:
        SetupError: something in the file is wrong; says what.

    >>> settings_for("box_chase").sac.layers
    (64, 64)
    """
    own = file or FOLDER / f"{scene}.yaml"
    given = _read(FOLDER / "defaults.yaml")
    if file or own.is_file():
        given = _merged(given, _read(own))
    try:
        return Settings.model_validate(given)
    except ValidationError as error:
        problems = "; ".join(map(str, explain(error.errors(), Settings)))
        raise SetupError(f"{own.name}: {problems}") from None


def _read(path: Path) -> dict[str, Any]:
    try:
        return YamlFile(path.read_text(encoding="utf-8"), path.name).data
    except (OSError, UnicodeDecodeError) as error:
        raise SetupError(f"{path}: can't be read: {error}") from None
    except SceneError as error:
        raise SetupError(str(error)) from None


def _merged(below: dict[str, Any], above: dict[str, Any]) -> dict[str, Any]:
    both = {
        key: _merged(below[key], above[key])
        for key in above
        if isinstance(below.get(key), dict) and isinstance(above[key], dict)
    }
    return below | above | both
