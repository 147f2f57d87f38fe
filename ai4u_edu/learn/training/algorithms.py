"""The algorithms of Stable-Baselines3, set up as a settings file says. Loads torch."""

import inspect
from collections.abc import Callable
from pathlib import Path
from typing import Any

import torch
from gymnasium import spaces
from stable_baselines3 import DQN, PPO, SAC
from stable_baselines3.common.base_class import BaseAlgorithm
from stable_baselines3.common.preprocessing import is_image_space
from stable_baselines3.common.vec_env import VecEnv

from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.learn.training.settings import Algorithm, AlgorithmSettings
from ai4u_edu.locale import gettext as _

CLASSES: dict[Algorithm, type[BaseAlgorithm]] = {"sac": SAC, "ppo": PPO, "dqn": DQN}

RESERVED_SETTINGS = frozenset(
    ["self", "policy", "env", "seed", "policy_kwargs", "tensorboard_log", "verbose", "device"]
)
"""Arguments that a settings file can't set."""

MIN_PICTURE_CELLS = 36
"""Smallest width of a picture for the layers of Stable-Baselines3's CnnPolicy."""

TORCH_THREADS = 1
"""Torch's threads; with layers this small a second one only waits for the first."""


def new_model(
    algorithm: Algorithm, settings: AlgorithmSettings, worlds: VecEnv, seed: int
) -> BaseAlgorithm:
    """Return an untrained model.

    Raises:
        SetupError: the algorithm can't choose such actions, or doesn't know one of its settings.
    """
    torch.set_num_threads(TORCH_THREADS)
    options = checked_options(algorithm, settings)
    rate = options.pop("learning_rate", 1e-3)
    layers: Any = list(settings.layers)
    activation = torch.nn.ReLU if settings.activation == "relu" else torch.nn.Tanh
    own = options.pop("log_std_init", None)
    if algorithm != "ppo":
        options.setdefault("buffer_size", settings.steps)  # it remembers all that it tries
    return CLASSES[algorithm](
        _policy_for(worlds.observation_space),
        worlds,
        seed=seed,
        device="cpu",
        learning_rate=falling(rate) if settings.falling_rate else rate,
        policy_kwargs={"net_arch": layers, "activation_fn": activation}
        | ({} if own is None else {"log_std_init": own}),
        **options,
    )


def load_model(algorithm: Algorithm, path: Path, worlds: VecEnv | None = None) -> BaseAlgorithm:
    """Load a saved model.

    The file contains pickled objects, and reading one can run any program: only for the user's own
    files, named by the user.
    """
    torch.set_num_threads(TORCH_THREADS)
    try:
        # with n_steps it stores the buffer's class as well, and on loading warns of having both
        custom = {} if algorithm == "ppo" else {"replay_buffer_class": None}
        return CLASSES[algorithm].load(path, env=worlds, device="cpu", custom_objects=custom)
    except (OSError, ValueError, KeyError) as error:
        raise SetupError(
            _(
                "{path}: expected a model of {algorithm}, got: {problem}",
                path=str(path),
                algorithm=algorithm,
                problem=str(error),
            )
        ) from None


def check_actions(algorithm: Algorithm, space: spaces.Space[Any]) -> None:
    """Check that an algorithm can choose actions of a space.

    Raises:
        SetupError: it can't; says which can.
    """
    if isinstance(space, spaces.Dict):
        raise SetupError(
            _(
                "expected an agent with one actuator for a policy to drive, got {space}; "
                "set is_output to False on the others",
                space=str(sorted(space)),
            )
        )
    if algorithm == "sac" and not isinstance(space, spaces.Box):
        raise SetupError(
            _(
                "sac needs actions of real numbers, and here they are {space}; try dqn",
                space=str(space),
            )
        )


def falling(rate: float) -> Callable[[float], float]:
    """Return a schedule in which the learning rate falls linearly from ``rate`` to 0."""
    return lambda left: rate * left


def _policy_for(space: spaces.Space[Any]) -> str:
    if isinstance(space, spaces.Dict):
        return "MultiInputPolicy"
    if not is_image_space(space):
        return "MlpPolicy"
    height, width, *_rest = space.shape or ()
    if min(height, width) < MIN_PICTURE_CELLS:
        raise SetupError(
            _(
                "CnnPolicy: expected a picture of at least {fewest} x {fewest} cells, got "
                "{height} x {width}; make the sensor's width and height larger",
                fewest=MIN_PICTURE_CELLS,
                height=height,
                width=width,
            )
        )
    return "CnnPolicy"


def checked_options(algorithm: Algorithm, settings: AlgorithmSettings) -> dict[str, Any]:
    """Return the settings that go to Stable-Baselines3.

    Raises:
        SetupError: it doesn't know one of them.
    """
    known = set(inspect.signature(CLASSES[algorithm]).parameters) - RESERVED_SETTINGS | {
        "log_std_init"
    }
    for name in settings.others:
        if name not in known:
            raise SetupError(
                _(
                    "{algorithm}: Stable-Baselines3 knows no setting {name!r}; {hint}",
                    algorithm=algorithm,
                    name=name,
                    hint=suggest(name, known),
                )
            )
    return settings.others
