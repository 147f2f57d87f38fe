"""Learning against somebody: who plays, on which side, and what is learned from."""

from pathlib import Path

import numpy as np
import pytest

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.learn.small.onnx_file import write_network
from ai4u_edu.learn.small.opponents import (
    MAX_MEMBERS,
    PLAYER,
    SELF,
    Games,
    League,
    Opponents,
)
from ai4u_edu.learn.small.ppo import Ppo, PpoSettings
from ai4u_edu.learn.small.ppo_training import PpoTraining
from tests.learn.small.corridor import corridor

pytestmark = pytest.mark.slow

FEW = PpoSettings(
    worlds=8, steps=8, batch=32, epochs=2, check_every=64, check_episodes=2, check_decisions=30
)
"""Settings of a training that is over at once."""
FORWARD, BACKWARD, REST = [1, 0, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 0]


def sumo(against: str = SELF) -> Opponents:
    return Opponents(Scene.load("sumo"), "blue", against)


def training(against: str = SELF, seed: int = 0) -> PpoTraining:
    opponents = sumo(against)
    return PpoTraining(opponents.scene, FEW, seed=seed, opponents=opponents)


def driver(agent: BasicAgent) -> str:
    """Return the name of what drives an agent."""
    brain = agent.brain
    return type(brain.controller if isinstance(brain, LocalBrain) else brain).__name__


def test_the_sides_alternate_and_the_scenes_player_has_the_other_one() -> None:
    worlds = sumo(PLAYER).worlds(4)
    assert [agent.id for agent in worlds.agents] == ["blue", "orange", "blue", "orange"]
    for env in worlds.envs:
        (other,) = (agent for agent in env.sim.agents if agent is not env.agent)
        assert driver(other) == "PushOutController"
    # each has a controller of its own, with the numbers of the scene
    players = [env.sim.agent("orange").brain for env in worlds.envs[::2]]
    assert players[0] is not players[1]
    assert isinstance(players[0], LocalBrain)
    assert getattr(players[0].controller, "head_start", 0) == 18


def test_a_role_plays_against_the_same_role_and_all_others_have_the_scenes_players() -> None:
    opponents = Opponents(Scene.load("soccer"), "orange_keeper", SELF)
    assert opponents.learners == ("orange_keeper", "blue_keeper")
    assert opponents.of("blue_keeper") == ("orange_keeper",)
    drivers = {agent.id: driver(agent) for agent in opponents.worlds(1).envs[0].sim.agents}
    assert drivers == {
        "blue_striker": "StrikerController",
        "blue_keeper": "KeeperController",
        "orange_striker": "StrikerController",
        "orange_keeper": "HeldBrain",
    }


def test_where_the_other_side_has_other_robots_each_side_keeps_its_own() -> None:
    opponents = Opponents(Scene.load("tag"), "", PLAYER)
    assert opponents.learners == ("chaser",)
    assert opponents.of("chaser") == ("runner_1", "runner_2", "runner_3")
    worlds = opponents.worlds(2)
    assert [agent.id for agent in worlds.agents] == ["chaser", "chaser"]
    assert driver(worlds.envs[1].sim.agent("runner_3")) == "FleeController"


@pytest.mark.parametrize(
    ("scene", "agent", "against", "message"),
    [
        ("box_chase", "", SELF, "'box_chase' has one side only; expected a scene with two"),
        ("tag", "chaser", SELF, "'chaser' can't play against itself, since the other side"),
        ("tag", "runner_1", PLAYER, "only a person's keys drive 'chaser' in 'tag'; expected"),
        ("sumo", "", "slf", "expected 'player', 'self' or a network .*, got 'slf'; did you mean"),
        ("sumo", "", "gone.onnx", r"gone\.onnx"),
    ],
)
def test_an_opponent_that_can_not_play(scene: str, agent: str, against: str, message: str) -> None:
    with pytest.raises(AI4UError, match=message):
        Opponents(Scene.load(scene), agent, against)


def test_a_network_in_a_file_plays_as_it_would_drive(tmp_path: Path) -> None:
    path = tmp_path / "ahead.onnx"
    ppo = Ppo(Scene.load("sumo"), FEW, agent="blue")
    ppo.network.actor.biases[-1][0] = 1.0
    write_network(ppo.network, ppo.agent, {}, path)
    worlds = sumo(str(path)).worlds(2)
    for index, env in enumerate(worlds.envs):
        worlds.reset(index, 5)
        (other,) = (agent for agent in env.sim.agents if agent is not env.agent)
        env.decide(np.array(REST, np.float32))
        assert other.last_action["move"][0] == pytest.approx(1.0, abs=0.1)


def test_a_network_of_another_robot_is_refused(tmp_path: Path) -> None:
    ppo = Ppo(corridor(), FEW)
    write_network(ppo.network, ppo.agent, {}, tmp_path / "corridor.onnx")
    with pytest.raises(AI4UError, match=r"corridor\.onnx"):
        sumo(str(tmp_path / "corridor.onnx"))


def test_the_stronger_a_member_the_more_often_it_is_drawn() -> None:
    league = League(seed=1)
    network = Ppo(corridor(), PpoSettings(worlds=1)).network
    league.add(network)
    league.add(network)
    strong, even, weak = league.members
    for _ in range(30):
        league.note(strong, 0.0)
        league.note(weak, 1.0)
    assert strong.score < 0.1 < even.score < 0.9 < weak.score
    drawn = [league.draw() for _ in range(1000)]
    counts = [drawn.count(member) for member in league.members]
    assert counts[0] > 600 > counts[1] > 100 > counts[2] > 0
    assert np.allclose(np.array(counts) / 1000, league.chances, atol=0.05)


def test_of_too_many_members_the_easiest_to_beat_leaves_but_never_the_player() -> None:
    league = League(seed=0)
    network = Ppo(corridor(), PpoSettings(worlds=1)).network
    for _ in range(MAX_MEMBERS - 1):
        league.add(network)
    player, easy = league.members[0], league.members[4]
    player.score, easy.score = 1.0, 0.9
    league.add(network)
    assert len(league.members) == MAX_MEMBERS
    assert player in league.members
    assert easy not in league.members


def test_who_plays_both_sides_learns_from_both() -> None:
    games = Games(4, sumo(), League(seed=0))
    assert len(games.envs) == 3
    assert [agent.id for agent in games.agents] == ["blue", "orange", "blue", "orange"]
    for row in range(4):
        games.reset(row, 7 + row)
    assert games.observations.shape == (4, 11)
    assert not np.array_equal(games.observations[0], games.observations[3])
    while not games.terminated[3]:  # blue of the first world drives out of the ring
        games.step(np.array([BACKWARD, REST, REST, REST], np.float32))
    assert games.terminated[0]
    assert [games.agents[row].ledger.total for row in (0, 3)] == [-10.0, 10.0]


def test_a_game_ends_for_both_sides_at_once() -> None:
    limit = "max_steps_per_episode: "
    text = Scene.load("sumo").dumps().replace(f"{limit}720", f"{limit}3", 1)  # of blue alone
    games = Games(4, Opponents(Scene.loads(text), "", SELF), League(seed=0))
    for row in range(4):
        games.reset(row, row)
    for _ in range(3):
        games.step(np.array([REST] * 4, np.float32))
    assert games.truncated[[0, 3]].tolist() == [True, True]


def test_the_league_hears_how_a_game_went() -> None:
    league = League(seed=0)
    games = Games(4, sumo(), league)
    for row in range(4):
        games.reset(row, row)
    (player,) = league.members
    while not games.terminated[1]:
        games.step(np.array([REST, BACKWARD, REST, REST], np.float32))
    games.reset(1)
    assert player.score < 0.5


def test_a_training_against_itself_gives_the_same_network_twice() -> None:
    one, same, other = (training(seed=seed) for seed in (1, 1, 2))
    for each in (one, same, other):
        each.learn(192)
    assert np.array_equal(one.ppo.network.parameters, same.ppo.network.parameters)
    assert not np.array_equal(one.ppo.network.parameters, other.ppo.network.parameters)
    assert one.checks == same.checks
    assert one.league is not None
    assert same.league is not None
    assert one.league.state() == same.league.state()
    assert [member.network is None for member in one.league.members] == [True, False, False, False]


@pytest.mark.parametrize("against", [PLAYER, SELF])
def test_it_is_checked_against_the_scenes_player(against: str) -> None:
    trained = training(against)
    check = trained.check()
    network = Ppo(Scene.load("sumo"), FEW, agent="blue").network
    assert np.array_equal(trained.ppo.network.parameters, network.parameters)
    assert check == training(PLAYER).check()


def test_a_league_goes_on_from_its_file(tmp_path: Path) -> None:
    path, trained = tmp_path / "state.npz", training(seed=3)
    trained.learn(128)
    trained.save(path)
    again = PpoTraining.resume(path, trained.ppo.worlds.envs[0].scene, sumo())
    assert trained.league is not None
    assert again.league is not None
    assert again.league.state()["scores"] == trained.league.state()["scores"]
    for member, before in zip(again.league.members[1:], trained.league.members[1:], strict=True):
        assert member.network is not None
        assert before.network is not None
        assert np.array_equal(member.network.parameters, before.network.parameters)
    again.learn(256)
    assert len(again.league.members) == 5
