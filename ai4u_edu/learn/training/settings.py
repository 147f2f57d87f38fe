"""Settings of trainings, from YAML files that a student can read and change.

``settings/defaults.yaml`` holds for all scenes; a file with the scene's name has what differs.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from ai4u_edu.base.errors import SceneError, SetupError, text_of
from ai4u_edu.base.parameters import explain, format_problems
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes.yaml.file import YamlFile

EXPECTED = _("lines such as algorithm: ..., sac: ..., ppo: ...")
"""The keys of a settings file, for messages."""
FOLDER = Path(__file__).parent / "settings"

Algorithm = Literal["sac", "ppo", "dqn"]
ALGORITHMS: tuple[Algorithm, ...] = ("sac", "ppo", "dqn")

NO_REWARD = "nothing"
"""Value of ``without_reward`` with which all terms are learned from."""

Policy = Literal["MlpPolicy", "MultiInputPolicy", "CnnPolicy"]
FORMS = {"MlpPolicy": "flat", "MultiInputPolicy": "dict", "CnnPolicy": "image"}
"""Form of observation for each kind of network."""

Positive = Annotated[int, Field(ge=1)]


class AlgorithmSettings(BaseModel):
    """Settings of one algorithm.

    Other names go to Stable-Baselines3 as they are (``learning_rate``,
    ``gamma``, ``batch_size``, ...).
    """

    model_config = ConfigDict(extra="allow", frozen=True)

    steps: Positive
    """Decisions, over all worlds; it may be done sooner."""
    worlds: Positive = 1
    """Number of copies of the scene to learn in at a time."""
    layers: tuple[Positive, ...] = (64, 64)
    """The hidden layers' sizes, for the policy and the critic."""
    activation: Literal["relu", "tanh"] = "relu"
    falling_rate: bool = False
    """True lets the learning rate fall linearly to 0 until the last step."""
    check_every: Positive = 1000
    """Decisions between two checks of how good the policy is."""

    @property
    def others(self) -> dict[str, Any]:
        """Settings that go to Stable-Baselines3."""
        return dict(self.model_extra or {})


class DaggerSettings(BaseModel):
    """Settings for learning from a teacher; see :mod:`ai4u_edu.learn.training.dagger`."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    rounds: Positive = 10
    """Number of rounds; the teacher drives in the first one, then mostly the learner."""
    episodes: Positive = 25
    """Episodes in each round."""
    updates: Positive = 3000
    """Gradient steps after each round."""
    layers: tuple[Positive, ...] = (128, 128)
    """The hidden layers' sizes."""
    kinds: bool = False
    """True encodes rays as the nearness of each kind of thing, in place of code and distance;
     see :class:`~ai4u_edu.learn.training.rays.RayNearness`."""


class Settings(BaseModel):
    """Settings of a scene's training."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    @model_validator(mode="before")
    @classmethod
    def _as_the_policy_wants_it(cls, given: dict[str, Any]) -> dict[str, Any]:
        form = FORMS.get(str(given.get("policy")))
        return given | {"observation": form} if form else given

    algorithm: Algorithm = "ppo"
    """Default algorithm."""
    agent: str = ""
    """The id of the agent that learns; left out, the one that acts first."""
    policy: Policy | None = None
    """Stable-Baselines3's name of the network's kind; left out, ``observation`` decides. CnnPolicy
    takes one picture, which has to be the only input (``observe``); MultiInputPolicy takes
    pictures and other readings together."""
    observation: Literal["flat", "dict", "image"] = "flat"
    """One array of all readings, one entry a sensor, or the one sensor's picture."""
    observe: tuple[str, ...] = ()
    """The perception keys that the policy gets; left out: all that are inputs."""
    skip_frame: Annotated[int, Field(ge=0)] | None = None
    """Ticks between two decisions; left out: as the agent's brain has it."""
    max_steps: Positive | None = None
    """Decisions after which an episode of the training is truncated; left out: as the agent has it.
    An evaluation always takes the agent's own."""
    without_reward: str = NO_REWARD
    """Name of a reward term that is not learned from, to see what it teaches; ``nothing`` for none.
    Checks and evaluations count it as ever."""
    actions: tuple[tuple[float, ...], ...] = ()
    """Actions to choose from, for DQN. Left out: all zeros, and each number of the action alone at
    either end of its range."""
    check_episodes: Positive = 30
    enough: Annotated[int, Field(ge=0)] = 2
    """The training ends when so many checks in a row had success in every episode; 0: never."""
    sac: AlgorithmSettings
    ppo: AlgorithmSettings
    dqn: AlgorithmSettings
    dagger: DaggerSettings = DaggerSettings()

    def of(self, algorithm: Algorithm) -> AlgorithmSettings:
        """Return the settings of one algorithm."""
        found: AlgorithmSettings = getattr(self, algorithm)
        return found


def settings_for(
    scene: str, file: Path | None = None, changes: Mapping[str, Any] | None = None
) -> Settings:
    """Return the settings of a scene's training.

    Args:
        scene: the scene's name.
        file: a YAML file in place of the scene's own.
        changes: changes to these settings.

    Raises:
        SetupError: something in it is wrong; says what.

    >>> settings_for("box_chase").sac.layers
    (64, 64)
    >>> settings_for("box_chase", changes={"sac": {"layers": [32]}}).sac.layers
    (32,)
    """
    own = file or FOLDER / f"{scene}.yaml"
    given = _read(FOLDER / "defaults.yaml")
    if file or own.is_file():
        given = _merged(given, _read(own))
    try:
        return Settings.model_validate(_merged(given, changes or {}))
    except ValidationError as error:
        problems = format_problems(explain(error.errors(), Settings))
        where = "settings" if changes else own.name
        raise SetupError(_("{where}: {problems}", where=where, problems=problems)) from None


def _read(path: Path) -> dict[str, Any]:
    try:
        return YamlFile(path.read_text(encoding="utf-8-sig"), path.name, EXPECTED).data
    except (OSError, UnicodeDecodeError) as error:
        raise SetupError(
            _("{path}: can't be read: {problem}", path=str(path), problem=str(error))
        ) from None
    except SceneError as error:
        raise SetupError(text_of(error)) from None


def _merged(below: Mapping[str, Any], above: Mapping[str, Any]) -> dict[str, Any]:
    both = {
        key: _merged(below[key], above[key])
        for key in above
        if isinstance(below.get(key), Mapping) and isinstance(above[key], Mapping)
    }
    return {**below, **above, **both}
