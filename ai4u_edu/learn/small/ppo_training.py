"""A training: improve, check, keep the best network, and be able to go on after a break.

Before: :mod:`~ai4u_edu.learn.small.opponents`. New here is what stands around the rounds of
learning. A policy that tries things out is not as good as it could be, and one round may spoil what
the last one brought. So now and then the policy drives some episodes in which it tries nothing out,
always from the same starts, which no world learns in. The network that did best there is what a
training gives. And since learning takes minutes and a computer may be switched off, its state can
be written to a file.

>>> from ai4u_edu import Scene
>>> settings = PpoSettings(worlds=2, steps=8, check_every=32, check_episodes=2)
>>> training = PpoTraining(Scene.load("yardstick"), settings)
>>> training.learn(64)
>>> [check.decisions for check in training.checks]
[32, 64]
"""

import json
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np

from ai4u_edu.base.atomic_write import partial_file
from ai4u_edu.base.errors import SetupError, text_of
from ai4u_edu.learn.envs.worlds import Worlds
from ai4u_edu.learn.small.actor_critic import ActorCritic
from ai4u_edu.learn.small.opponents import SELF, Games, League, Opponents
from ai4u_edu.learn.small.ppo import FIRST_SEED, Array, Ppo, PpoSettings
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene

FIRST_CHECK_SEED = 2 * FIRST_SEED
"""Seed of the first episode of a check; no world learns in it."""


@dataclass(frozen=True)
class PolicyCheck:
    """Result of a check: episodes in which the actor tries nothing out."""

    decisions: int
    """Decisions that were learned from until then."""
    success: float | None
    """Share of the episodes that reached the scene's goal; None in a scene without one."""
    reward: float
    """Mean reward of an episode, by the weights of this training."""
    score: float
    """Mean reward of an episode, as the scene pays it."""
    length: float
    """Mean count of decisions in an episode."""


class PpoTraining:
    """A training by PPO. It can be saved and taken up again at any time between two rounds.

    Args:
        scene: with the rhythm and the limit of steps to learn with.
        settings: of the training.
        seed, agent, begin_with, reward_weights: as :class:`~ai4u_edu.learn.small.ppo.Ppo` takes
            them.
        opponents: who plays the other side, of this scene; left out, all other agents are driven as
            the scene says. Their agent learns then.

    Attributes:
        ppo: the learner, with the network as it is now.
        best: the network as it was in its best check.
        checks: all checks so far.
        league: members that a network plays against which learns against itself, else None. It is
            checked against the first one, the scene's player.
    """

    def __init__(
        self,
        scene: Scene,
        settings: PpoSettings | None = None,
        *,
        seed: int = 0,
        agent: str | None = None,
        begin_with: ActorCritic | None = None,
        reward_weights: Mapping[str, float] | None = None,
        opponents: Opponents | None = None,
    ) -> None:
        settings = settings or PpoSettings()
        worlds: Worlds | None = None
        self.league: League | None = None
        if opponents is not None and opponents.against == SELF:
            self.league = League(seed)
            worlds = Games(settings.worlds, opponents, self.league)
        elif opponents is not None:
            worlds = opponents.worlds(settings.worlds)
        self.ppo = Ppo(
            scene,
            settings,
            seed=seed,
            agent=agent,
            begin_with=begin_with,
            reward_weights=reward_weights,
            worlds=worlds,
        )
        self.best = self.ppo.network.copy()
        self.checks: list[PolicyCheck] = []
        self._has_goal = scene.description.success is not None
        self._check_worlds = (
            Worlds(settings.check_episodes, scene, observation="flat", agent=self.ppo.agent.id)
            if opponents is None
            else opponents.worlds(settings.check_episodes)
        )

    def learn(
        self, decisions: int, on_round: Callable[["PpoTraining"], bool | None] = lambda _: None
    ) -> None:
        """Improve until ``decisions`` decisions were learned from in all, or the policy is enough.

        Args:
            decisions: those before a :meth:`resume` count too.
            on_round: called after each round, and after its check if it had one; True ends the
                training.
        """
        ppo, every = self.ppo, self.ppo.settings.check_every
        while ppo.decisions < decisions:
            before = ppo.decisions
            ppo.improve()
            has_check = ppo.decisions // every > before // every or ppo.decisions >= decisions
            if has_check:
                self.check()
            if on_round(self) or (has_check and self.is_enough):
                return

    def check(self) -> PolicyCheck:
        """Drive some episodes without trying anything out, and keep the network if it is best."""
        ppo, settings = self.ppo, self.ppo.settings
        count = settings.check_episodes
        worlds, envs = self._check_worlds, self._check_worlds.envs
        for index in range(count):
            worlds.reset(index, FIRST_CHECK_SEED + index)
        rewards, scores, lengths = np.zeros(count), np.zeros(count), np.zeros(count)
        under_way = list(range(count))
        while under_way:
            actions = ppo.network.act(worlds.observations[under_way])
            for index, action in zip(under_way, actions, strict=True):
                env = envs[index]
                worlds.observations[index] = env.observer.observe(env.decide(action))
                rewards[index] += ppo.reward_of(env.agent)
                scores[index] += env.agent.ledger.total
                lengths[index] += 1
            under_way = [
                index
                for index in under_way
                if not envs[index].agent.done and lengths[index] < settings.check_decisions
            ]
        check = PolicyCheck(
            decisions=ppo.decisions,
            success=float(np.mean([env.success for env in envs])) if self._has_goal else None,
            reward=float(rewards.mean()),
            score=float(scores.mean()),
            length=float(lengths.mean()),
        )
        if all(self._rank(check) >= self._rank(other) for other in self.checks):
            self.best = ppo.network.copy()
        self.checks.append(check)
        if self.league is not None:
            self.league.add(ppo.network)
        return check

    @property
    def best_check(self) -> PolicyCheck | None:
        """Check of :attr:`best`; of equal ones, the latest. None before the first check."""
        return max(reversed(self.checks), key=self._rank, default=None)

    @property
    def is_enough(self) -> bool:
        """True if the latest checks saw nothing but success, and success is what is learned."""
        enough = self.ppo.settings.enough
        latest = [check.success for check in self.checks[-enough:]]
        return not self._has_other_aim and 0 < enough <= latest.count(1.0)

    def save(self, path: Path) -> None:
        """Write all that is needed to go on, as NumPy arrays (.npz); atomically."""
        ppo, network, optimizer = self.ppo, self.ppo.network, self.ppo.optimizer
        state = {
            "settings": asdict(ppo.settings),
            "seed": ppo.seed,
            "agent": ppo.agent.id,
            "reward_weights": ppo.reward_weights,
            "decisions": ppo.decisions,
            "optimizer_steps": optimizer.steps,
            "generator": ppo.generator.bit_generator.state,
            "checks": [asdict(check) for check in self.checks],
            "league": None if self.league is None else self.league.state(),
            "easy_starts": None if ppo.easy_starts is None else ppo.easy_starts.state(),
        }
        earlier = [] if self.league is None else self.league.members[1:]
        with partial_file(path) as beside, beside.open("wb") as file:
            np.savez(
                file,
                state=np.array(json.dumps(state)),
                parameters=network.parameters,
                best=self.best.parameters,
                middle=network.middle,
                size=network.size,
                mean=optimizer.mean,
                square=optimizer.square,
                league=np.array([each.network.parameters for each in earlier if each.network]),
                key_actions=np.array([] if network.key_actions is None else network.key_actions),
            )

    @classmethod
    def resume(cls, path: Path, scene: Scene, opponents: Opponents | None = None) -> "PpoTraining":
        """Return a training that goes on where it was saved.

        Its worlds begin new episodes, so it is not bit for bit what it would have been without a
        break.

        Args:
            path: as :meth:`save` wrote it.
            scene: the same as before.
            opponents: the same as before.

        Raises:
            SetupError: the file is no saved training, or one of another agent.
        """
        try:
            # opened here, since NumPy doesn't close a file that is no archive
            with path.open("rb") as source, np.load(source, allow_pickle=False) as file:
                arrays = {name: file[name] for name in file.files}
            state = json.loads(str(arrays.pop("state")))
            state["settings"]["layers"] = tuple(state["settings"]["layers"])
            training = cls(
                scene,
                PpoSettings(**state["settings"]),
                seed=state["seed"],
                agent=state["agent"],
                reward_weights=state["reward_weights"],
                opponents=opponents,
            )
            training._restore(state, arrays)
        except (OSError, ValueError, KeyError, TypeError, EOFError, BadZipFile) as error:
            raise SetupError(
                _(
                    "{path}: expected a saved training of this agent: {problem}",
                    path=str(path),
                    problem=text_of(error),
                )
            ) from None
        return training

    def _restore(self, state: Mapping[str, Any], arrays: Mapping[str, Array]) -> None:
        ppo = self.ppo
        if arrays["key_actions"].size:  # it began with a clone that chooses among them
            ppo.choose_among(arrays["key_actions"])
        network, optimizer = ppo.network, ppo.optimizer
        network.parameters[:] = arrays["parameters"]
        network.middle[:], network.size[:] = arrays["middle"], arrays["size"]
        self.best = network.copy()
        self.best.parameters[:] = arrays["best"]
        optimizer.mean[:], optimizer.square[:] = arrays["mean"], arrays["square"]
        optimizer.steps = int(state["optimizer_steps"])
        ppo.generator.bit_generator.state = state["generator"]
        ppo.decisions = int(state["decisions"])
        self.checks = [PolicyCheck(**check) for check in state["checks"]]
        if self.league is not None:
            earlier = [network.copy() for _ in arrays["league"]]
            for one, parameters in zip(earlier, arrays["league"], strict=True):
                one.parameters[:] = parameters
            self.league.restore(state["league"], earlier)
        if ppo.easy_starts is not None and state["easy_starts"] is not None:
            ppo.easy_starts.restore(state["easy_starts"])
        ppo.begin_episodes()

    @property
    def _has_other_aim(self) -> bool:
        """True if the weights pay for something else than the scene does."""
        return any(weight != 1.0 for weight in self.ppo.reward_weights.values())

    def _rank(self, check: PolicyCheck) -> tuple[float, float]:
        """Return what makes a check better than another one.

        With the scene's own rewards: more success, and if all succeeded, sooner. With others, only
        the reward that was asked for counts: if that was a bad choice, it should be seen.
        """
        if self._has_other_aim or check.success is None:
            return (0.0, check.reward)
        return (check.success, -check.length if check.success == 1.0 else check.reward)
