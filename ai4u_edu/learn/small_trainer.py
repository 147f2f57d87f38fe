"""The small learner as a trainer: what ``ai4u-edu train`` and ``clone`` run without torch.

:mod:`ai4u_edu.learn.small` knows neither settings files nor folders; here they meet. The folder of
a training (:class:`~ai4u_edu.learn.training.run.Run`) can be read while another process learns:
each file is replaced as a whole. Whoever kills the process loses the last second or two.

Start the process with :data:`~ai4u_edu.base.numeric_threads.ONE_THREAD` in its environment: then
the same seed gives the same network on the same machine.
"""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path

from ai4u_edu.agent import ControlRequestor
from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import SetupError
from ai4u_edu.learn.small.actor_critic import ActorCritic
from ai4u_edu.learn.small.behaviour_cloning import UPDATES, DriveData, clone_drives
from ai4u_edu.learn.small.onnx_file import read_network, write_network
from ai4u_edu.learn.small.opponents import FILE, SELF, Opponents, kinds_of_opponents
from ai4u_edu.learn.small.ppo import PpoSettings
from ai4u_edu.learn.small.ppo_training import PolicyCheck, PpoTraining
from ai4u_edu.learn.training.demonstrations import Cloned, demonstrations
from ai4u_edu.learn.training.interrupt import Interrupt
from ai4u_edu.learn.training.prepare import prepare, with_learner
from ai4u_edu.learn.training.progress_bar import ProgressBar
from ai4u_edu.learn.training.run import Check, Config, Run, Trained
from ai4u_edu.learn.training.settings import NO_REWARD, Settings
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording import Episode
from ai4u_edu.recording.player import Player
from ai4u_edu.runtime.training_progress import CurvePoint, TrainingProgress
from ai4u_edu.scenes import Scene

__all__ = ["clone", "kinds_of_opponents", "resume", "seat_opponents", "train"]

PACKAGES = ("ai4u-edu", "numpy", "pymunk", "gymnasium")
GAMES = PpoSettings(steps=128, batch=256, rate=1e-3, discount=0.99)
"""Settings against somebody. A game may pay at its end only, so a round is long enough for some
ends; and the other side changes, so that the network changes more slowly."""
MIN_INTERVAL_S = 1.0
"""Shortest time between two writes of the present state."""
OnRound = Callable[[int, Callable[[Path], object]], object]
"""Called with the decisions that were learned from so far, and a function that writes the network
as it is to a file."""
REACTION_S = 0.15
"""Time until a person's keys answer what they see, or rather a bit less, since people look ahead.
Measured by ``python -m tests.benchmarks.clones``."""
BLOCK_S = 2.0
"""Time of a block of decisions that is held out of a cloning with few drives."""


def train(
    scene: Scene,
    settings: Settings,
    folder: Path,
    *,
    steps: int | None = None,
    seed: int = 0,
    begin_with: Path | None = None,
    reward_weights: Mapping[str, float] | None = None,
    against: str = "",
    overwrite: bool = False,
    on_round: OnRound = lambda _decisions, _write: None,
    quiet: bool = False,
) -> Trained:
    """Start a training by PPO.

    Args:
        scene: the scene.
        settings: of the scene: its agent, rhythm, limit of steps, inputs, and how it is checked.
            The learner has its own (:class:`~ai4u_edu.learn.small.ppo.PpoSettings`).
        folder: the folder for all results.
        steps: decisions to learn from; left out, as the settings say for ``ppo``.
        seed: of the network, of what is tried out, and of the worlds.
        begin_with: file of a network of the small learner to improve, such as a clone.
        reward_weights: factor of each reward term by its name; 1 for one that is left out.
        against: who plays the other side of the scene: ``"player"``, ``"self"`` or a network's
            file; see :class:`~ai4u_edu.learn.small.opponents.Opponents`. Left out, all other
            agents are driven as the scene says.
        overwrite: True replaces a training that is in the folder.
        on_round: called before the first round, and after each.
        quiet: True shows nothing.

    Raises:
        SetupError: the agent, a file or the opponent doesn't fit, or the folder holds a training
            already.
    """
    if settings.observation != "flat":
        raise SetupError(
            _(
                "the small learner takes readings as one row of numbers (observation: "
                'flat); pictures are for Stable-Baselines3: pip install "ai4u-edu[train]"'
            )
        )
    if settings.without_reward != NO_REWARD:
        raise SetupError(
            _(
                "without_reward: the small learner has a weight for each term; say --reward "
                "{without_reward}=0",
                without_reward=settings.without_reward,
            )
        )
    settings = with_learner(scene, settings, quiet=quiet)
    opponents = _opponents(scene, settings, against)
    prepared = prepare(scene, settings) if opponents is None else opponents.scene
    sim = prepared.build()
    agent = sim.agent(settings.agent) if settings.agent else sim.agents[0]
    training = PpoTraining(
        prepared,
        replace(
            PpoSettings() if opponents is None else GAMES,
            check_episodes=settings.check_episodes,
            # who beats the scene's player can still get better than that
            enough=0 if against == SELF else settings.enough,
        ),
        seed=seed,
        agent=agent.id,
        begin_with=None if begin_with is None else read_network(begin_with.read_bytes(), agent),
        reward_weights=reward_weights,
        opponents=opponents,
    )
    run = Run(folder)
    config = Config(
        scene=scene.description.name,
        algorithm="ppo",
        seed=seed,
        steps=steps or settings.ppo.steps,
        settings=settings,
        versions={name: version(name) for name in PACKAGES},
        trainer="small",
        against="" if opponents is None else opponents.kind,
    )
    # read before what is in the folder is deleted, which may be this very file
    opponent = Path(against).read_bytes() if config.against == FILE else b""
    if overwrite:
        run.clear()
    run.begin(config, scene)
    if opponent:
        write_atomically(run.opponent, opponent)
    return _learn(run, config, training, on_round, quiet=quiet)


def resume(
    folder: Path,
    *,
    scene: Scene | None = None,
    steps: int | None = None,
    on_round: OnRound = lambda _decisions, _write: None,
    quiet: bool = False,
) -> Trained:
    """Go on with a training that ended in any way.

    Args:
        folder: the training's folder.
        scene: the scene that it began with; left out, the one in the folder, in which relative
            paths lead elsewhere.
        steps: decisions to learn from, the ones before counted too; left out, as it was begun.
        on_round: called before the first round, and after each.
        quiet: True shows nothing.

    Raises:
        SetupError: there is no training of the small learner in the folder, or nothing to do.
    """
    run = Run(folder)
    config = run.config()
    scene = scene or run.scene()
    against = str(run.opponent) if config.against == FILE else config.against
    opponents = _opponents(scene, config.settings, against)
    prepared = prepare(scene, config.settings) if opponents is None else opponents.scene
    training = PpoTraining.resume(run.state, prepared, opponents)
    config = config.model_copy(update={"steps": steps or config.steps})
    if training.ppo.decisions >= config.steps:
        raise SetupError(
            _(
                "{folder} has learned from {decisions} steps already; expected --steps "
                "larger than that, got {steps}",
                folder=str(folder),
                decisions=training.ppo.decisions,
                steps=config.steps,
            )
        )
    return _learn(run, config, training, on_round, quiet=quiet)


def seat_opponents(
    sim: ControlRequestor, scene: Scene, agent: str, against: str, network: Path
) -> None:
    """Give everybody but the learner the drivers that a training's games have.

    Args:
        sim: a world of the scene.
        scene: the scene.
        agent: id of the agent that learns.
        against: as for :func:`train`; not empty.
        network: file of the learner's network, which plays both sides against itself.

    Raises:
        SetupError: there is no other side, or nobody who could play it.
    """
    Opponents(scene, agent, against).seat(sim, agent, network=network)


def clone(
    episodes: Sequence[Episode],
    path: Path,
    *,
    agent: str | None = None,
    seed: int = 0,
    updates: int = UPDATES,
    persons_only: bool = False,
    on_error: Callable[[int, float], object] = lambda _update, _error: None,
    quiet: bool = False,
) -> Cloned:
    """Learn to act as in recorded episodes, and write the network.

    Of five drives or more, whole ones are held out to measure how well the network acts in drives
    that it never saw.

    Args:
        episodes: of one scene, driven well.
        path: the network's file.
        agent: the id of the agent to imitate; left out, the one that acts first.
        seed: of the network, and of which moments are held out.
        updates: gradient steps at most.
        persons_only: True learns only from decisions that a person took by keys.
        on_error: called with the gradient steps so far, and the error on held-out moments.
        quiet: True shows nothing.

    Raises:
        RecordingError: the episodes can't be played again exactly.
        SetupError: such actions can't be learned.
    """
    shown = demonstrations(episodes, agent=agent)
    decisions_per_s = shown.scene.world.ticks_per_second / (shown.skip_frame + 1)
    drives = [
        DriveData(
            episode.observations,
            episode.actions,
            episode.rewards,
            episode.by_person if persons_only else None,
        )
        for episode in shown.episodes
    ]
    is_by_person = persons_only or all(episode.by_person.all() for episode in shown.episodes)
    bar = ProgressBar(updates, _("updates"), quiet=quiet)

    def show(update: int, error: float) -> None:
        bar.show(update, _("error {error:.4f}", error=error))
        on_error(update, error)

    try:
        result = clone_drives(
            drives,
            shown.observation_space,
            shown.action_space,
            seed=seed,
            updates=updates,
            block=max(1, round(BLOCK_S * decisions_per_s)),
            person_delay=round(REACTION_S * decisions_per_s) if is_by_person else None,
            on_error=show,
        )
    finally:
        bar.close()
    decisions = sum(map(len, drives))
    about = {
        "scene": shown.scene.name,
        "algorithm": "clone",
        "seed": seed,
        "steps": updates,
        "demonstrations": len(shown.episodes),
        "decisions": decisions,
        "skip_frame": shown.skip_frame,
        "repeat_action": shown.repeat_action,
    }
    write_network(result.network, Player(episodes[0]).sim.agent(shown.agent), about, path)
    return Cloned(
        path=path,
        decisions=decisions,
        loss=min(error for _, error in result.errors),
        alike=result.alike,
        commonest=result.commonest,
        held_out=result.held_out,
        remarks=result.remarks,
    )


def _opponents(scene: Scene, settings: Settings, against: str) -> Opponents | None:
    """Return who plays the other side, in a scene in which all learners decide as the settings say.

    Raises:
        SetupError: there is no other side, or nobody who could play it.
    """
    if not against:
        return None
    for learner in Opponents(scene, settings.agent, against).learners:
        scene = prepare(scene, settings.model_copy(update={"agent": learner}))
    return Opponents(scene, settings.agent, against)


def _learn(
    run: Run,
    config: Config,
    training: PpoTraining,
    on_round: OnRound,
    *,
    quiet: bool,
) -> Trained:
    interrupt = Interrupt()
    writer = _Writer(run, config, training, quiet=quiet)
    try:
        with interrupt.listening():
            writer.begin()
            on_round(training.ppo.decisions, writer.write_present)

            def after_round(_: PpoTraining) -> bool:
                writer.after_round()
                on_round(training.ppo.decisions, writer.write_present)
                return interrupt.asked

            training.learn(config.steps, after_round)
            if not training.checks or training.checks[-1].decisions < training.ppo.decisions:
                training.check()
        writer.finish()
    finally:
        writer.close()
    return Trained(
        run=run,
        steps=training.ppo.decisions,
        interrupted=interrupt.asked,
        enough=training.is_enough,
        checks=writer.checks,
        best=writer.best,
    )


class _Writer:
    """Writes what a training has reached into its folder, and shows it.

    Args:
        run: the folder.
        config: for what the files say of their origin.
        training: whose state is written.
        quiet: True shows nothing.
    """

    def __init__(self, run: Run, config: Config, training: PpoTraining, *, quiet: bool) -> None:
        self._run, self._config, self._training = run, config, training
        self._seconds = {check.steps: check.seconds for check in run.checks()}
        self._seconds_before = max(self._seconds.values(), default=0.0)
        self._checks_written = len(training.checks)
        self._began = self._written_at = time.perf_counter()
        self._first = training.ppo.decisions
        self._bar = ProgressBar(config.steps, _("steps"), done=self._first, quiet=quiet)

    @property
    def checks(self) -> list[Check]:
        """All checks so far, as a training's folder has them."""
        return [self._as_check(check) for check in self._training.checks]

    @property
    def best(self) -> Check:
        """Check of the network that is kept; there has been one."""
        best = self._training.best_check
        assert best is not None  # noqa: S101 - a training ends with a check
        return self._as_check(best)

    def begin(self) -> None:
        """Write all files, so that a reader finds them and a training goes on from any moment."""
        self._write_network(self._training.best, self._run.best_network)
        self._write_progress()

    def after_round(self) -> None:
        """Write what is new: after a check all of it, else the present state, if it is time."""
        if len(self._training.checks) > self._checks_written:
            self._write_check()
        elif time.perf_counter() - self._written_at > MIN_INTERVAL_S:
            self._write_progress()
        decisions = self._training.ppo.decisions
        speed = (decisions - self._first) / max(time.perf_counter() - self._began, 1e-9)
        self._bar.show(min(decisions, self._config.steps), f"{speed:.0f}/s")

    def finish(self) -> None:
        """Write the last state."""
        if len(self._training.checks) > self._checks_written:
            self._write_check()
        self._write_progress(is_over=True)

    def close(self) -> None:
        """Remove the bar."""
        self._bar.close()

    def write_present(self, path: Path) -> None:
        """Write the network as it is to a file."""
        self._write_network(self._training.ppo.network, path)

    def _write_check(self) -> None:
        training = self._training
        latest = training.checks[-1]
        self._checks_written = len(training.checks)
        self._seconds[latest.decisions] = self._seconds_before + time.perf_counter() - self._began
        # the network comes first: a state without it would never write it again
        if training.best_check is latest:
            self._write_network(training.best, self._run.best_network)
        training.save(self._run.state)
        checks = self.checks
        self._run.note(checks)
        self._write_progress()
        check = checks[-1]
        self._bar.note(check.line)

    def _write_progress(self, *, is_over: bool = False) -> None:
        self._written_at = time.perf_counter()
        training, run = self._training, self._run
        starts = training.ppo.easy_starts
        training.save(run.state)
        self.write_present(run.watched_network)
        curve = tuple(
            CurvePoint(decisions=check.decisions, reward=check.reward, success=check.success)
            for check in training.checks
        )
        progress = TrainingProgress(
            decisions=training.ppo.decisions,
            total=self._config.steps,
            is_over=is_over,
            curve=curve,
            easy_starts=None if starts is None else starts.share,
        )
        run.put_text(run.progress, progress.model_dump_json())

    def _write_network(self, network: ActorCritic, path: Path) -> None:
        training = self._training
        best = training.best_check
        is_best = path == self._run.best_network
        about = {
            "scene": self._config.scene,
            "algorithm": self._config.algorithm,
            "trainer": self._config.trainer,
            "seed": self._config.seed,
            "steps": best.decisions if is_best and best else training.ppo.decisions,
        }
        write_network(network, training.ppo.agent, about, path)

    def _as_check(self, check: PolicyCheck) -> Check:
        return Check(
            steps=check.decisions,
            seconds=self._seconds.get(check.decisions, self._seconds_before),
            success=check.success,
            reward=check.reward,
            length=check.length,
        )
