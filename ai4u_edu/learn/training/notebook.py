"""The training commands of ``ai4u-edu`` as functions for notebooks and scripts.

torch and Stable-Baselines3 are imported when a function needs them. Where they are not installed,
the small learner learns: PPO and cloning with NumPy alone, see :mod:`ai4u_edu.learn.small`.
"""

import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ai4u_edu.base.atomic_write import make_folder, write_atomically
from ai4u_edu.base.errors import SetupError, suggest
from ai4u_edu.base.optional_deps import has, need
from ai4u_edu.base.options import SMALL_TRAINER, load_option
from ai4u_edu.base.seeding import seeds_from
from ai4u_edu.locale import gettext as _

if TYPE_CHECKING:
    from ai4u_edu.blocks import Controller
    from ai4u_edu.learn.training.demonstrations import Cloned
    from ai4u_edu.learn.training.evaluating import Evaluation
    from ai4u_edu.learn.training.run import Trained
    from ai4u_edu.learn.training.varying import Tried
    from ai4u_edu.learn.training.watch import Watch
    from ai4u_edu.recording import Episode
    from ai4u_edu.scenes import Scene

    SceneLike = str | Path | Scene
    Who = str | Path | Trained | Cloned | Controller | Callable[..., Any]

TRAINERS = ("sb3", "small")
"""Names of the learners: Stable-Baselines3 with torch, and the small one with NumPy alone."""
WHY_SMALL = _(
    "the small learner (PPO and cloning with NumPy) learns, since "
    "Stable-Baselines3 and torch are not installed here; to have them: pip "
    'install "ai4u-edu[train]"\n'
)


def train(
    scene: "SceneLike" = "box_chase",
    algo: str = "",
    *,
    steps: int | None = None,
    seed: int = 0,
    out: str | Path | None = None,
    settings: str | Path | Mapping[str, Any] | None = None,
    policy: str = "",
    observe: Sequence[str] = (),
    resume: bool = False,
    overwrite: bool = False,
    keep_checkpoints: bool = False,
    watch: "bool | Watch" = False,
    quiet: bool = False,
    trainer: str = "",
    begin_with: str | Path | None = None,
    reward_weights: Mapping[str, float] | None = None,
    agent: str = "",
    against: str | Path = "",
) -> "Trained":
    """Train an agent in a scene; Ctrl-C (a notebook's stop button) keeps what it learned so far.

    The same seed on the same machine gives the same model. It may end before the last step, when
    the policy is good enough (``settings={"enough": 0}``: never).

    Args:
        scene: a scene of the library, a YAML file, or a Scene.
        algo: ``"sac"``, ``"ppo"`` or ``"dqn"``; left out, as the scene's settings say.
        steps: decisions to learn from; left out, as the settings say.
        seed: seed of the network, the worlds and all random choices.
        out: the training's folder; left out, ``runs/SCENE-ALGO-SEED``.
        settings: changes to the scene's own settings, such as
            ``{"ppo": {"learning_rate": 1e-4}}``; or a YAML file in place of them.
        policy: Stable-Baselines3's name of the network's kind: ``"MlpPolicy"``, ``"CnnPolicy"`` for
            an agent whose only input is a picture, ``"MultiInputPolicy"`` for pictures and others.
        observe: the perception keys that the policy gets; left out, as the settings say.
        resume: True goes on with the training in ``out``, up to ``steps`` in all.
        overwrite: True replaces a training that is in ``out`` already, as when a notebook's cell
            runs for the second time.
        keep_checkpoints: True keeps the model of each check, as ``checkpoint-STEPS.zip``.
        watch: True shows the policy driving in the browser as it learns, until it has learned; a
            :class:`~ai4u_edu.learn.training.watch.Watch` shows it until that is closed.
        quiet: True shows nothing.
        trainer: ``"sb3"`` for Stable-Baselines3, or ``"small"`` for the small learner, which needs
            no torch, knows PPO alone, and takes readings as one row of numbers; left out,
            Stable-Baselines3 if it is installed.
        begin_with: network (.onnx) to improve, such as a clone by the small learner; only that
            learner takes one.
        reward_weights: factor of each reward term by its name, 1 for one that is left out; only for
            the small learner.
        agent: the id of the agent that learns; left out, as the settings say, or the first one.
        against: who plays the other side: ``"player"`` (the scene's own), ``"self"`` (the network
            itself, as it is and as it was, and the scene's player), or a network (.onnx); only for
            the small learner. Left out, all others are driven as the scene says.

    Returns:
        Its result, with ``best`` (a check with ``success``, ``reward``, ``length``), ``checks``,
        ``steps``, ``folder``. It can be evaluated and exported.

    Raises:
        SetupError: a setting is wrong or something is not installed; says what.
    """
    from ai4u_edu.learn.training.run import Run
    from ai4u_edu.learn.training.settings import ALGORITHMS, settings_for

    for_sb3 = {
        "watch": watch,
        "policy": policy,
        "keep_checkpoints": keep_checkpoints,
        "algo": algo and algo.lower() != "ppo",
    }
    for_small = {
        "begin_with": begin_with is not None,
        "reward_weights": bool(reward_weights),
        "against": bool(against),
    }
    if resume:
        if out is None:
            raise SetupError(_("resume needs out, the folder of the training to go on with"))
        began_by = Run(Path(out)).config().trainer
        if trainer not in ("", began_by):
            raise SetupError(
                _(
                    "trainer: {out} was begun by {began_by!r}, which has to go on with it, got "
                    "{trainer!r}",
                    out=str(out),
                    began_by=began_by,
                    trainer=trainer,
                )
            )
        trainer = began_by
    who = _trainer(trainer, for_sb3, for_small, quiet=quiet)
    small: Trained
    if who == "small" and resume and out is not None:
        small = load_option(SMALL_TRAINER, "resume").resume(Path(out), steps=steps, quiet=quiet)
        return small
    if who == "sb3":
        need("train", "torch", "stable_baselines3")
    if resume and out is not None:
        from ai4u_edu.learn.training import learning

        with _page_of(watch) as page:
            return learning.resume(
                Path(out),
                steps=steps,
                keep_checkpoints=keep_checkpoints,
                quiet=quiet,
                watch=page,
            )
    loaded = _scene(scene)
    name = loaded.description.name
    changes = dict(settings) if isinstance(settings, Mapping) else {}
    chosen = {"policy": policy, "observe": observe, "agent": agent}
    changes |= {name: value for name, value in chosen.items() if value}
    file = Path(settings) if isinstance(settings, str | Path) else None
    how = settings_for(name, file, changes)
    if who == "small":
        small = load_option(SMALL_TRAINER, "train").train(
            loaded,
            how,
            Path(out) if out else Path("runs") / f"{name}-small-{seed}",
            steps=steps,
            seed=seed,
            begin_with=None if begin_with is None else Path(begin_with),
            reward_weights=reward_weights,
            against=str(against),
            overwrite=overwrite,
            quiet=quiet,
        )
        return small
    algorithm = algo.lower() or how.algorithm
    for each in ALGORITHMS:
        if algorithm == each:
            from ai4u_edu.learn.training import learning

            folder = Path(out) if out else Path("runs") / f"{name}-{each}-{seed}"
            with _page_of(watch) as page:
                return learning.train(
                    loaded,
                    each,
                    how,
                    folder,
                    steps=steps,
                    seed=seed,
                    overwrite=overwrite,
                    keep_checkpoints=keep_checkpoints,
                    quiet=quiet,
                    watch=page,
                )
    raise SetupError(
        _(
            "algo: expected one of {algorithms}, got {algo!r}; {hint}",
            algorithms=", ".join(ALGORITHMS),
            algo=algo,
            hint=suggest(algo, ALGORITHMS),
        )
    )


def evaluate(
    who: "Who",
    scene: "SceneLike | None" = None,
    *,
    episodes: int = 100,
    seed: int = 0,
    quiet: bool = False,
) -> "Evaluation":
    """Measure how well a driver does, on seeds not used for training.

    Args:
        who: what :func:`train` or :func:`clone` gave; a function from percept to action, or a
            Controller; a training's folder, a model (.zip), a network (.onnx, ``"zoo:SCENE"``), a
            controller's name, ``"random"``, or ``"scene"`` for the scene's own controller.
        scene: the scene; left out, the one it was trained in.
        episodes: number of episodes.
        seed: seed of the first episode; the next ones follow.
        quiet: True shows no progress.

    Returns:
        ``success_rate`` (0..1), ``interval``, ``rewards``, ``lengths``, ``episodes``; as text or in
        a notebook, a table.

    >>> from ai4u_edu.learn.training import evaluate
    >>> told = evaluate("random", "box_chase", episodes=2, quiet=True)
    >>> [each.seed for each in told.episodes]
    [0, 1]
    """
    from ai4u_edu.learn.training.evaluating import evaluate as evaluated
    from ai4u_edu.learn.training.policies import entrant_of
    from ai4u_edu.learn.training.progress_bar import counted

    driver = entrant_of(who)
    where = scene if scene is not None else driver.scene
    if not where:
        raise SetupError(
            _("in which scene is {name} to drive? Expected scene=...", name=driver.name)
        )
    seeds: Iterable[int] = seeds_from(seed, episodes)
    return evaluated(driver, _scene(where), counted(seeds, driver.name, quiet=quiet))


def vary(
    who: "Who",
    scene: "SceneLike",
    parameter: str,
    values: Sequence[float],
    *,
    episodes: int = 20,
    seed: int = 0,
    quiet: bool = False,
) -> "Tried":
    """Drive from the same starts with each value of one number of a scene.

    Args:
        who: drives, as for :func:`evaluate`.
        scene: the scene; it stays as it is.
        parameter: the number, such as ``"vision.noise"``, ``"bodies.box.mass"`` or
            ``"world.damping"``; ``ai4u-edu vary SCENE`` lists all.
        values: of the number.
        episodes: number of episodes with each value.
        seed: seed of the first episode; the next ones follow.
        quiet: True shows no progress.

    Returns:
        ``rows`` with ``value``, ``success`` (0..1), ``low``, ``high``, ``reward``, ``seconds``; as
        text or in a notebook, a table.

    >>> from ai4u_edu.learn.training import vary
    >>> result = vary("zoo", "box_chase", "move_amount", [5, 2.5], episodes=2, quiet=True)
    >>> [(row.value, row.success) for row in result.rows]
    [(5, 1.0), (2.5, 1.0)]
    """
    from ai4u_edu.learn.training.evaluating import evaluate as evaluated
    from ai4u_edu.learn.training.policies import entrant_of
    from ai4u_edu.learn.training.progress_bar import counted
    from ai4u_edu.learn.training.varying import (
        Tried,
        TriedValue,
        parameter_named,
        with_driver,
        with_value,
    )

    driven = _scene(scene)
    if isinstance(who, str | Path):  # in the scene, so that its numbers can be varied too
        driven, who = with_driver(driven, str(who))
    number, driver = parameter_named(driven, parameter), entrant_of(who)
    scenes = [with_value(driven, number, value) for value in values]
    seeds = seeds_from(seed, episodes)
    rows = [
        TriedValue.of(value, evaluated(driver, each, counted(seeds, f"{value:g}", quiet=quiet)))
        for value, each in zip(values, scenes, strict=True)
    ]
    return Tried(number, rows)


def export(
    model: "str | Path | Trained",
    out: str | Path = "policy.onnx",
    *,
    with_critic: bool = False,
) -> Path:
    """Write a model as a network (.onnx) that drives without torch and can be shared.

    Args:
        model: the result of :func:`train`, its folder, or a model (.zip) in it.
        out: the network's file.
        with_critic: True keeps the critic too, for a map of values; see :mod:`ai4u_edu.explain`.

    Returns:
        The file; ``trained_brain(file)`` and ``evaluate(file)`` take it.
    """
    from ai4u_edu.learn.training.run import run_of

    path = Path(model) if isinstance(model, str | Path) else model.folder
    run = run_of(path)
    config = run.config()
    if config.trainer == "small":  # it is a network already, with its critic
        write_atomically(Path(out), run.best_network.read_bytes())
        return Path(out)
    need("train", "torch", "stable_baselines3", "onnx", "onnxscript")
    from ai4u_edu.learn.training.algorithms import load_model
    from ai4u_edu.learn.training.exporting import export as exported

    loaded: Any = load_model(config.algorithm, run.best if path.is_dir() else path)
    return exported(loaded, run.scene(), config, Path(out), with_critic=with_critic)


def export_checkpoints(
    model: "str | Path | Trained", out: str | Path, *, with_critic: bool = False
) -> list[Path]:
    """Write the model of each check that a training kept as a network (.onnx), to compare them.

    Args:
        model: the result of :func:`train` with ``keep_checkpoints``, or its folder.
        out: the folder for the files, ``checkpoint-STEPS.onnx``.
        with_critic: as for :func:`export`.

    Returns:
        The files, the earliest check first.

    Raises:
        SetupError: the training kept no checkpoints.
    """
    from ai4u_edu.learn.training.run import run_of

    path = Path(model) if isinstance(model, str | Path) else model.folder
    checkpoints = run_of(path).checkpoints
    if not checkpoints:
        raise SetupError(
            _(
                "{path} has no checkpoints; train with: ai4u-edu train SCENE --keep-checkpoints",
                path=str(path),
            )
        )
    make_folder(Path(out), _("networks"))
    return [
        export(each, Path(out) / f"{each.stem}.onnx", with_critic=with_critic)
        for each in checkpoints
    ]


def demonstrate(
    who: "Who",
    scene: "SceneLike | None" = None,
    *,
    episodes: int = 10,
    seed: int = 1000,
    quiet: bool = False,
) -> "list[Episode]":
    """Record episodes of a driver, for :func:`clone`.

    Args:
        who: as in :func:`evaluate`.
        scene: the scene; left out, the one it was trained in.
        episodes: number of episodes.
        seed: seed of the first episode; the next ones follow.
        quiet: True shows no progress.

    >>> from ai4u_edu.learn.training import demonstrate
    >>> episodes = demonstrate("random", "box_chase", episodes=2, quiet=True)
    >>> [episode.seed for episode in episodes]
    [1000, 1001]
    """
    from ai4u_edu.learn.training.evaluating import DEFAULT_MAX_DECISIONS
    from ai4u_edu.learn.training.policies import entrant_of, expect_here
    from ai4u_edu.learn.training.progress_bar import counted
    from ai4u_edu.recording import Recorder

    driver = entrant_of(who)
    where = scene if scene is not None else driver.scene
    if not where:
        raise SetupError(
            _("in which scene is {name} to drive? Expected scene=...", name=driver.name)
        )
    fitted = expect_here(driver).fitted(_scene(where))
    sim = fitted.build()
    agent = sim.agent(driver.agent) if driver.agent else sim.agents[0]
    recorder = Recorder(sim, scene=fitted.description, keep=100_000)
    for each in counted(seeds_from(seed, episodes), driver.name, quiet=quiet):
        agent.use_brain(driver.brain(agent))
        sim.reset(each)
        for _number in range(DEFAULT_MAX_DECISIONS):  # so often too if it takes no decisions
            if agent.done or agent.stopped or agent.paused:
                break
            sim.step(agent)
    recorder.finish()
    return list(recorder.episodes)


def clone(
    data: "str | Path | Sequence[str | Path | Episode]",
    out: str | Path = "policy.onnx",
    *,
    agent: str | None = None,
    seed: int = 0,
    updates: int = 2000,
    quiet: bool = False,
    trainer: str = "",
) -> "Cloned":
    """Train a network to imitate recorded episodes (behaviour cloning).

    Args:
        data: recorded episodes (the result of :func:`demonstrate`, .episode files, folders).
        out: the network's file.
        agent: the id of the agent to imitate; left out, the one that acts first.
        seed: the same seed gives the same network.
        updates: gradient steps.
        quiet: True shows nothing.
        trainer: as in :func:`train`.

    Returns:
        ``path`` of the network, ``decisions`` learned from, ``loss``; of the small learner also
        ``alike``, the share of held-out decisions in which it acts like the driver. It can be
        evaluated.
    """
    who = _trainer(trainer, {}, {}, quiet=quiet)
    from ai4u_edu.learn.training.demonstrations import load_episodes
    from ai4u_edu.recording import Episode

    given = [data] if isinstance(data, str | Path) else list(data)
    episodes = [each for each in given if isinstance(each, Episode)]
    paths = [Path(each) for each in given if isinstance(each, str | Path)]
    if paths or not episodes:
        episodes += load_episodes(paths)
    if who == "small":
        small: Cloned = load_option(SMALL_TRAINER, "clone").clone(
            episodes, Path(out), agent=agent, seed=seed, updates=updates, quiet=quiet
        )
        return small
    need("train", "torch", "stable_baselines3", "onnx", "onnxscript")
    from ai4u_edu.learn.training.cloning import clone as cloned

    return cloned(episodes, Path(out), agent=agent, seed=seed, updates=updates, quiet=quiet)


def _trainer(
    name: str, for_sb3: Mapping[str, object], for_small: Mapping[str, object], *, quiet: bool
) -> str:
    """Return which learner learns: the one that is named, or one that takes what is asked for.

    Args:
        name: one of :data:`TRAINERS`; empty for none.
        for_sb3: arguments that only Stable-Baselines3 takes, by name; those that are asked for are
            truthy.
        for_small: the same for the small learner.
        quiet: False says on stderr why the small learner was chosen.

    Raises:
        SetupError: none is called so, or takes all of it.
    """
    if name and name not in TRAINERS:
        raise SetupError(
            _(
                "trainer: expected one of {trainers}, got {name!r}; {hint}",
                trainers=", ".join(TRAINERS),
                name=name,
                hint=suggest(name, TRAINERS),
            )
        )
    asked_sb3 = [each for each, value in for_sb3.items() if value]
    asked_small = [each for each, value in for_small.items() if value]
    chosen = name
    if not chosen:
        if asked_small or asked_sb3:
            chosen = "small" if asked_small else "sb3"
        elif has("torch", "stable_baselines3"):
            chosen = "sb3"
        else:
            chosen = "small"
            if not quiet:
                sys.stderr.write(WHY_SMALL)
    wrong = asked_sb3 if chosen == "small" else asked_small
    if wrong:
        raise SetupError(
            _(
                "{wrong}: the trainer {chosen!r} has no such choice; leave it out, or take "
                "{value!r}",
                wrong=wrong[0],
                chosen=chosen,
                value="sb3" if chosen == "small" else "small",
            )
        )
    return chosen


@contextmanager
def _page_of(watch: "bool | Watch") -> "Iterator[Watch | None]":
    """Give the page of a training; close it afterwards, unless the caller made it."""
    if not isinstance(watch, bool):
        yield watch
    elif watch:
        from ai4u_edu.learn.training.watch import Watch

        with Watch() as page:
            yield page
    else:
        yield None


def _scene(given: "SceneLike") -> "Scene":
    from ai4u_edu.scenes import Scene

    return given if isinstance(given, Scene) else Scene.load(str(given))
