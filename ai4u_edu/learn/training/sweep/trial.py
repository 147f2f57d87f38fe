"""One training of a sweep: a job's function."""

import base64
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from ai4u_edu.learn.training.algorithms import load_model
from ai4u_edu.learn.training.exporting import export
from ai4u_edu.learn.training.learning import train
from ai4u_edu.learn.training.run import Check
from ai4u_edu.learn.training.settings import Algorithm, Settings
from ai4u_edu.scenes.scene_data import scene_from

CHECKS = 10
"""Checks of a trial: the points of its evaluation curve, the same for all algorithms."""
MIN_RIVALS = 4
"""Finished trials before others are pruned."""
MIN_CHECKS = 2
"""Checks before a trial may be pruned."""


def trial(
    scene: Mapping[str, Any],
    algorithm: Algorithm,
    settings: Mapping[str, Any],
    seed: int,
    budget: int,
    rivals: Sequence[Sequence[float]] = (),
) -> dict[str, Any]:
    """Train, and return the evaluation curve and the best network as data.

    The result depends on the arguments alone: no folder is read or written that stays, and no
    other trial is asked while it runs.

    Args:
        scene: as :func:`~ai4u_edu.scenes.scene_data.scene_data` made it.
        algorithm: the algorithm's name.
        settings: all settings, as plain data.
        seed: of the network, the worlds and all random choices.
        budget: decisions to learn from.
        rivals: evaluation curves of other trials; with them, a trial whose best check is below
            the median of theirs is pruned.

    Returns:
        ``checks``, ``steps``, whether it was ``pruned``, and the best ``network`` (ONNX in base64,
        empty if it was pruned).

    Raises:
        SetupError: the settings don't fit the scene.
    """
    loaded = scene_from(scene)
    has_goal = loaded.description.success is not None
    prunes = _pruner(rivals, has_goal)
    pruned = False

    def stop(checks: Sequence[Check]) -> bool:
        nonlocal pruned
        pruned = prunes(checks)
        return pruned

    with tempfile.TemporaryDirectory(prefix="ai4u-trial-") as folder:
        done = train(
            loaded,
            algorithm,
            Settings.model_validate(settings),
            Path(folder) / "run",
            steps=budget,
            seed=seed,
            quiet=True,
            stop=stop,
        )
        if done.interrupted:  # it is no finished trial
            raise KeyboardInterrupt
        network = b""
        if not pruned:
            model = load_model(algorithm, done.run.best)
            file = export(model, loaded, done.run.config(), Path(folder) / "policy.onnx")
            network = file.read_bytes()
    # their seconds differ from run to run
    checks = [each.model_dump(mode="json") | {"seconds": 0.0} for each in done.checks]
    return {
        "checks": checks,
        "steps": done.steps,
        "pruned": pruned,
        "network": base64.b64encode(network).decode(),
    }


def value_of(check: Check, has_goal: bool) -> float:
    """Return what a sweep maximizes: the share of successes, or the reward in a scene without."""
    return (check.success or 0.0) if has_goal else check.reward


def curve_of(checks: Sequence[Check], has_goal: bool) -> list[float]:
    """Return the evaluation curve, which has a point for each check.

    A trial that ended early, as it was good enough, has its last value at the checks after it.
    """
    values = [value_of(each, has_goal) for each in checks]
    return values + values[-1:] * (CHECKS - len(values))


def _pruner(rivals: Sequence[Sequence[float]], has_goal: bool) -> Callable[[Sequence[Check]], bool]:
    """Return a function that tells from all checks whether to prune, by Optuna's median rule."""
    if not rivals:
        return lambda _checks: False
    import optuna

    level = optuna.logging.get_verbosity()
    optuna.logging.set_verbosity(optuna.logging.ERROR)
    study = optuna.create_study(
        direction="maximize",
        pruner=optuna.pruners.MedianPruner(MIN_RIVALS, MIN_CHECKS - 1),
    )
    for curve in rivals:
        points = dict(enumerate(curve))
        study.add_trial(optuna.trial.create_trial(value=max(curve), intermediate_values=points))
    asked = study.ask()
    optuna.logging.set_verbosity(level)

    def prunes(checks: Sequence[Check]) -> bool:
        asked.report(value_of(checks[-1], has_goal), len(checks) - 1)
        return bool(asked.should_prune())

    return prunes
