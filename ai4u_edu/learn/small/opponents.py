"""Opponents: an agent learns against somebody, or against itself.

Before: :mod:`~ai4u_edu.learn.small.easy_starts`. New here is the other side. In a game, what is
good to do depends on who plays against one: the scene's own player (the controller that its file
names), a network in a file, or the learner itself.

Who plays only against itself gets better and better at games that nobody else plays: both sides
learn the same habits, and lose to the first stranger. So the learner has a *league*: the scene's
player, and networks that it was at earlier checks. Half of the decisions are of games in which the
network plays both sides, and learns from both. The other half are of games against a member of the
league; the more often a member wins, the more often it is drawn (:meth:`League.draw`).

Where both sides have the same robots, the worlds take turns with the side of the learner.

>>> from ai4u_edu import Scene
>>> from ai4u_edu.learn.small.ppo import PpoSettings
>>> from ai4u_edu.learn.small.ppo_training import PpoTraining
>>> opponents = Opponents(Scene.load("sumo"), "blue", SELF)
>>> opponents.learners
('blue', 'orange')
>>> settings = PpoSettings(worlds=4, steps=8, check_every=32, check_episodes=2, check_decisions=8)
>>> training = PpoTraining(opponents.scene, settings, opponents=opponents)
>>> training.learn(32)
>>> len(training.league.members)  # the scene's player, and the network of the first check
2

Source of the league and of how its members are drawn: O. Vinyals et al., Grandmaster level in
StarCraft II using multi-agent reinforcement learning, Nature 575, 2019.
"""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from ai4u_edu.agent import BasicAgent, ControlRequestor
from ai4u_edu.base.errors import BlockError, SetupError, suggest
from ai4u_edu.blocks import Brain, LocalBrain, trained_brain
from ai4u_edu.games.tournament.drivers import scripted
from ai4u_edu.games.tournament.sides import Sides, sides_of
from ai4u_edu.learn.envs.external_brain import HeldBrain
from ai4u_edu.learn.envs.scene_env import SceneEnv
from ai4u_edu.learn.envs.spaces_of import Observer, action_space_of, outputs_of
from ai4u_edu.learn.envs.worlds import Worlds
from ai4u_edu.learn.small.actor_critic import ActorCritic
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes import Scene

PLAYER, SELF, FILE = "player", "self", "file"
"""Kinds of opponents: the scene's player, the learner itself, a network in a file."""
Kind = Literal["player", "self", "file"]
MAX_MEMBERS = 9
"""Members of a league at most; each earlier network takes a pass through it at each decision."""
FIRST_SCORE = 0.5
"""Score of a member that nobody has played against yet."""
SCORE_SHARE = 0.1
"""Share of the latest game in a member's score: the last ten or twenty games count."""
MIN_WEIGHT = 0.02
"""Weight with which a member is drawn that always loses: it may have been forgotten how to win."""


class Opponents:
    """The other side of a scene, and who plays it.

    Args:
        scene: with the rhythm and the limit of steps to learn with.
        agent: id of the agent that learns; empty for the one that acts first.
        against: :data:`PLAYER`, :data:`SELF`, or the path of a network (.onnx) for the other side.
        model: a world of the scene, which stays as it is; left out, one is built.

    Attributes:
        scene, against: as given.
        kind: of the opponent.
        learners: ids of the agents as which the learner plays in turn: itself, and its counterpart
            where both sides have the same robots.

    Raises:
        SetupError: there is no other side, or nobody who could play it.
        BlockError: the file is no network, or one of another robot.
    """

    def __init__(
        self, scene: Scene, agent: str, against: str, *, model: ControlRequestor | None = None
    ) -> None:
        self.scene, self.against = scene, against
        self.kind: Kind = "file"
        if against in (PLAYER, SELF):
            self.kind = "player" if against == PLAYER else "self"
        if against not in (PLAYER, SELF) and Path(against).suffix != ".onnx":
            raise SetupError(
                _(
                    "against: expected {player!r}, {self!r} or a network (.onnx), got "
                    "{against!r}; {hint}",
                    player=PLAYER,
                    self=SELF,
                    against=against,
                    hint=suggest(against, (PLAYER, SELF)),
                )
            )
        self._sides = _two_sides(scene)
        self._model = model or scene.build()  # nobody plays in it: its controllers are copied
        name = agent or self._model.agents[0].id
        other = self._sides.counterpart(name)
        is_alike = bool(other) and _is_alike(self._model.agent(name), self._model.agent(other))
        self.learners: tuple[str, ...] = (name, other) if is_alike else (name,)
        if against == SELF and not is_alike:
            raise SetupError(
                _(
                    "against: {name!r} can't play against itself, since the other side of "
                    "{name2!r} has other robots; expected {player!r}, or a network (.onnx) for "
                    "{of}",
                    name=name,
                    name2=scene.description.name,
                    player=PLAYER,
                    of=", ".join(self.of(name)),
                )
            )
        for learner in self.learners:
            for opponent in self.of(learner):
                if against == PLAYER and self._player(self._model.agent(opponent)) is None:
                    others = _("{me!r} or a network", me=SELF) if is_alike else _("a network")
                    raise SetupError(
                        _(
                            "against: only a person's keys drive {opponent!r} in {name!r}; "
                            "expected {others} (.onnx), or give it a controller in the scene",
                            opponent=opponent,
                            name=scene.description.name,
                            others=others,
                        )
                    )
        if against not in (PLAYER, SELF):
            self.worlds(1)  # a network that doesn't fit is refused before anything is written

    def of(self, learner: str) -> tuple[str, ...]:
        """Return the ids of those that play against a learner.

        Where both sides have the same robots, that is its counterpart alone; the others of both
        sides are driven by the scene's controllers.
        """
        if len(self.learners) == 2:
            return (self.learners[learner == self.learners[0]],)
        return next(agents for agents in self._sides.agents if learner not in agents)

    def worlds(self, count: int) -> Worlds:
        """Return worlds with the opponents; for :data:`SELF`, with the scene's player."""
        worlds = Worlds(count, self.scene, agents=self.learners, observation="flat")
        for env in worlds.envs:
            self.seat(env.sim, env.agent.id)
        return worlds

    def seat(self, sim: ControlRequestor, learner: str, *, network: Path | None = None) -> None:
        """Give all agents of a world but the learner their drivers.

        Those for which the scene has no controller, nor one of their counterpart, are driven by
        keys that nobody presses: they rest.

        Args:
            sim: the world.
            learner: id of the agent that learns.
            network: file of the learner's network, which plays the other side for :data:`SELF`;
                left out, the scene's player does.
        """
        opponents, file = self.of(learner), None if self.against == PLAYER else self.against
        if self.against == SELF:
            file = None if network is None else str(network)
        for agent in sim.agents:
            if agent.id in opponents and file is not None:
                agent.use_brain(trained_brain(file))
            elif agent.id != learner and (player := self._player(agent)) is not None:
                agent.use_brain(player)

    def _player(self, agent: BasicAgent) -> Brain | None:
        """Return the scene's own player for an agent; None if it has none."""
        try:
            made = scripted(self._model, self._sides, agent)
        except BlockError:
            return None
        return LocalBrain(
            controller=made.controller,
            skip_frame=made.skip_frame,
            repeat_action=made.repeat_action,
        )


def kinds_of_opponents(scene: Scene, model: ControlRequestor) -> dict[str, tuple[str, ...]]:
    """Return which of :data:`PLAYER`, :data:`SELF` and :data:`FILE` each agent can play against.

    Args:
        scene: the scene.
        model: a world of it, which stays as it is.

    >>> scenes = [Scene.load(name) for name in ("sumo", "tag", "box_chase")]
    >>> [next(iter(kinds_of_opponents(scene, scene.build()).values())) for scene in scenes]
    [('player', 'self', 'file'), ('player', 'file'), ()]
    """
    return {agent.id: _kinds(scene, model, agent.id) for agent in model.agents}


def _kinds(scene: Scene, model: ControlRequestor, agent: str) -> tuple[str, ...]:
    try:
        _two_sides(scene)
    except SetupError:
        return ()
    kinds = []
    for against in (PLAYER, SELF):
        with suppress(SetupError):
            Opponents(scene, agent, against, model=model)
            kinds.append(against)
    return (*kinds, FILE)


@dataclass(eq=False)
class Member:
    """Member of a league."""

    network: ActorCritic | None
    """Network of an earlier check; None for the scene's player."""
    score: float = FIRST_SCORE
    """Share of the latest games that the learner won against it; a draw counts half."""


class League:
    """Opponents of a network that learns against itself: the scene's player, and earlier networks.

    Args:
        seed: of the draws.

    Attributes:
        members: the scene's player, then the earlier networks, the oldest first.
        generator: draws the members.
    """

    def __init__(self, seed: int) -> None:
        self.members = [Member(None)]
        self.generator = np.random.default_rng([seed, 1])

    @property
    def chances(self) -> npt.NDArray[np.float64]:
        """Probability with which each member is drawn."""
        weights = np.array([(1.0 - member.score) ** 2 + MIN_WEIGHT for member in self.members])
        chances: npt.NDArray[np.float64] = weights / weights.sum()
        return chances

    def draw(self) -> Member:
        """Draw an opponent for a game: one that wins often, often."""
        return self.members[int(self.generator.choice(len(self.members), p=self.chances))]

    def note(self, member: Member, score: float) -> None:
        """Note a game: 1 if the learner has won, 0 if it has lost, else 0.5."""
        member.score += SCORE_SHARE * (score - member.score)

    def add(self, network: ActorCritic) -> None:
        """Add a copy of a network; if there are too many, the one that is easiest to beat goes."""
        if len(self.members) == MAX_MEMBERS:
            self.members.remove(max(self.members[1:], key=lambda member: member.score))
        self.members.append(Member(network.copy()))

    def state(self) -> dict[str, Any]:
        """Return the scores and the state of the draws as plain data."""
        scores = [member.score for member in self.members]
        return {"scores": scores, "generator": self.generator.bit_generator.state}

    def restore(self, state: Mapping[str, Any], networks: Sequence[ActorCritic]) -> None:
        """Restore what :meth:`state` gave.

        Args:
            state: as it was given.
            networks: of all members but the first.
        """
        self.members = [
            Member(network, float(score))
            for network, score in zip([None, *networks], state["scores"], strict=True)
        ]
        self.generator.bit_generator.state = state["generator"]


class _Game:
    """One world of :class:`Games`, and who plays against its learner."""

    def __init__(self, env: SceneEnv, opponent: BasicAgent) -> None:
        self.env, self.opponent = env, opponent
        self.player = opponent.brain
        rhythm = env.agent.brain
        self.network = HeldBrain(skip_frame=rhythm.skip_frame, repeat_action=rhythm.repeat_action)
        self.output = next(iter(outputs_of(opponent)))
        self.member: Member | None = None
        """Member of the league that plays; None if the learner plays both sides."""

    def seat(self, member: Member | None) -> None:
        """Let a member of the league play, or the learner itself."""
        self.member = member
        is_player = member is not None and member.network is None
        brain = self.player if is_player else self.network
        if self.opponent.brain is not brain:
            self.opponent.use_brain(brain)

    @property
    def score(self) -> float:
        """The learner's score: 1 if it was paid more than its opponent in this episode."""
        own = self.env.agent.ledger.episode_total
        return float(np.sign(own - self.opponent.ledger.episode_total) + 1.0) / 2.0


class Games(Worlds):
    """Worlds in which a network plays against itself and against a league.

    In the first worlds the network plays both sides, and its rows are those of all worlds, then
    those of the opponents in these.

    Args:
        rows: agents that learn at once, at least 2; a half of them play against each other.
        opponents: of the scene.
        league: members that play in the other worlds.
    """

    def __init__(self, rows: int, opponents: Opponents, league: League) -> None:
        mirrored = max(1, rows // 4)
        count = rows - mirrored
        super().__init__(count, opponents.scene, agents=opponents.learners, observation="flat")
        self._league = league
        self._games = []
        # learners, then opponents: those that learn come first in both
        self._seen = np.zeros((2 * count, self.observations.shape[1]), np.float32)
        self.observations = self._seen[:rows]
        self._write = [env.observer.writer(self._seen, row) for row, env in enumerate(self.envs)]
        self._write_opponent = []
        for row, env in enumerate(self.envs):
            opponents.seat(env.sim, env.agent.id)
            (name,) = opponents.of(env.agent.id)
            opponent = env.sim.agent(name)
            self._games.append(_Game(env, opponent))
            self._write_opponent.append(Observer(opponent, "flat").writer(self._seen, count + row))
        self._mirrored = self._games[:mirrored]
        self.agents += [game.opponent for game in self._mirrored]
        self.terminated, self.truncated = np.zeros(rows, np.bool_), np.zeros(rows, np.bool_)

    def reset(
        self, index: int, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> None:
        """Begin a game; those of the last rows begin with the first ones."""
        if index >= len(self.envs):
            return
        game, member = self._games[index], None
        if game.member is not None and game.env.agent.done:
            self._league.note(game.member, game.score)
        if index >= len(self._mirrored):
            member = self._league.draw()
        game.seat(member)
        super().reset(index, seed, options)
        self._write_opponent[index](game.opponent.percept)

    def step(self, actions: Any, resting: npt.NDArray[np.bool_] | None = None) -> None:
        """Step every world by one decision of both sides.

        Args:
            actions: one for each row.
            resting: worlds whose episode is over: they are reset instead.
        """
        count = len(self.envs)
        for game, action in zip(self._mirrored, actions[count:], strict=True):
            game.network.action = {game.output: action}
        self._ask_league()
        super().step(actions[:count], resting)
        for game, write in zip(self._games, self._write_opponent, strict=True):
            # a fall ends the decision of one side some ticks before that of the other
            while game.env.sim.is_deciding(game.opponent):
                game.env.sim.tick()
            write(game.opponent.percept)
        self.terminated = np.array([agent.terminated for agent in self.agents])
        self.truncated = np.array([agent.truncated for agent in self.agents])
        # a game is over for both sides: for the one that could go on, it is cut off
        is_over = self.terminated | self.truncated
        learners, others = np.arange(len(self._mirrored)), np.arange(count, len(self.agents))
        for row, other in ((learners, others), (others, learners)):
            self.truncated[row] |= is_over[other] & ~self.terminated[row]

    def _ask_league(self) -> None:
        """Set the actions of the earlier networks: one pass for all games of each."""
        count = len(self.envs)
        games: dict[int, list[int]] = {}
        networks: dict[int, ActorCritic] = {}
        for index, game in enumerate(self._games):
            if game.member is not None and game.member.network is not None:
                games.setdefault(id(game.member), []).append(index)
                networks[id(game.member)] = game.member.network
        for key, indices in games.items():
            answers = networks[key].act(self._seen[[count + index for index in indices]])
            for index, action in zip(indices, answers, strict=True):
                self._games[index].network.action = {self._games[index].output: action}


def _two_sides(scene: Scene) -> Sides:
    sides = sides_of(scene)
    if sides.is_race:
        raise SetupError(
            _(
                "against: {name!r} has one side only; expected a scene with two, such as "
                "sumo, soccer or tag, or a training without it",
                name=scene.description.name,
            )
        )
    return sides


def _is_alike(agent: BasicAgent, other: BasicAgent) -> bool:
    """Return True if one network can play both: the same readings, actions and reward terms."""
    one, two = (
        (
            list(outputs_of(each)),
            action_space_of(each),
            Observer(each, "flat").space,
            [sensor.perception_key for sensor in each.sensors if sensor.is_input],
            [reward.name for reward in each.rewards],
        )
        for each in (agent, other)
    )
    return one == two
