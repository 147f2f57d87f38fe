"""Evaluations: the numbers are right, and so is who drives."""

import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from ai4u_edu import BasicAgent, Command, LocalBrain, Percept, Scene
from ai4u_edu.base.errors import AI4UError, SetupError
from ai4u_edu.cli.main import app
from ai4u_edu.learn.training.episode import EpisodeStats, wilson
from ai4u_edu.learn.training.evaluating import DEFAULT_MAX_DECISIONS, Evaluation, evaluate
from ai4u_edu.learn.training.plots import plot_curves, plot_evaluations
from ai4u_edu.learn.training.policies import Entrant, entrant

pytestmark = pytest.mark.needs("train")

ROAD = """
name: road
success: touch
bodies:
  - {name: robot, shape: {type: circle, radius: 0.5}}
  - {name: box, shape: {type: box, size: [1, 1]}, position: [3, 0], kind: static}
agents:
  - body: robot
    max_steps_per_episode: 20
    sensors: [{type: BearingSensor, target: box}]
    actuators:
      - {type: RBMoveActuator, move_amount: 3}
      - {type: RespawnActuator, poses: [[0, 0, 0], [0, 0, 90]]}
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 5, cause_episode_to_end: true}
      - {type: FallReward, success_reward: 0, fail_reward: -0.25}
    brains: [{type: LocalBrain, skip_frame: 11, controller: {type: WASDRBMoveController}}]
"""
"""Straight ahead lies the box, if the agent looks there: 2 m at 0.6 m a decision."""

MINE = """
from ai4u_edu import Controller

def ahead(percept):
    return {"move": [1, 0, 0, 0]}

class Standing(Controller):
    '''Stands still.'''
    def get_action(self, percept):
        return {"move": [0, 0, 0, 0]}
"""


def ahead(_percept: Percept) -> dict[str, list[int]]:
    return {"move": [1, 0, 0, 0]}


def driver(function: object, name: str = "ahead") -> Entrant:
    def brain(agent: BasicAgent) -> LocalBrain:
        return LocalBrain(controller=function, skip_frame=agent.brain.skip_frame)  # type: ignore[arg-type]

    return Entrant(name, brain)


def test_the_numbers() -> None:
    scene = Scene.loads(ROAD)
    told = evaluate(driver(ahead), scene, range(12))
    sim = scene.build()
    lucky = []
    for seed in range(12):
        sim.reset(seed)
        lucky.append(abs(sim.agents[0].body.heading) < 0.1)
    assert [each.success for each in told.episodes] == lucky
    assert 0 < sum(lucky) < 12
    assert [each.length for each in told.episodes] == [4 if luck else 20 for luck in lucky]
    assert told.rewards == [5 - 4 * 0.25 if luck else -5.0 for luck in lucky]
    assert [each.terminated for each in told.episodes] == lucky
    assert told.success == sum(lucky) / 12
    plain = told.plain()
    assert plain["return"]["mean"] == pytest.approx(np.mean(told.rewards))
    assert plain["length"]["highest"] == 20.0
    assert plain["each"][3]["seed"] == 3
    assert json.loads(json.dumps(plain))["interval"] == list(wilson(sum(lucky), 12))


def test_the_same_seeds_the_same_episodes() -> None:
    scene = Scene.load("box_chase")
    once, again = (evaluate(entrant("random"), scene, range(50, 54)) for _ in range(2))
    assert once == again
    assert evaluate(entrant("random"), scene, range(54, 58)).episodes != once.episodes


def test_an_evaluation_takes_any_order_of_seeds() -> None:
    scene = Scene.loads(ROAD)
    up, down = (evaluate(entrant("random"), scene, seeds) for seeds in ([1, 2, 3], [3, 2, 1]))
    assert sorted(up.episodes) == sorted(down.episodes)


@pytest.mark.parametrize(
    ("successes", "trials", "low", "high"),
    # from the formula, by hand with 50 digits
    [
        (0, 10, 0.0, 0.27753),
        (95, 100, 0.88825, 0.97846),
        (100, 100, 0.96300, 1.0),
        (1, 1, 0.20655, 1.0),
    ],
)
def test_wilson(successes: int, trials: int, low: float, high: float) -> None:
    assert wilson(successes, trials) == pytest.approx((low, high), abs=2e-5)


@pytest.mark.parametrize("command", [Command.RESTART, Command.STOP, Command.PAUSE])
def test_who_gives_up_has_not_succeeded(command: Command) -> None:
    told = evaluate(driver(lambda _percept: command), Scene.loads(ROAD), [1])
    assert (told.success, told.lengths) == (0.0, [0])


def test_a_scene_without_a_limit_or_a_goal() -> None:
    text = ROAD.replace("max_steps_per_episode: 20", "max_steps_per_episode: 0")
    text = text.replace("success: touch", "title: no goal").replace(
        "skip_frame: 11", "skip_frame: 0"
    )
    told = evaluate(driver(lambda _percept: {"move": [0, 0, 0, 0]}), Scene.loads(text), [1])
    assert told.lengths == [DEFAULT_MAX_DECISIONS]
    assert told.success is None
    assert told.interval is None


def test_who_can_drive(tmp_path: Path) -> None:
    file = tmp_path / "mine.py"
    file.write_text(MINE)
    scene = Scene.loads(ROAD)
    assert evaluate(entrant(f"{file}:ahead"), scene, range(6)).episodes == (
        evaluate(driver(ahead), scene, range(6)).episodes
    )
    assert evaluate(entrant(f"{file}:Standing"), scene, range(2)).success == 0.0
    assert evaluate(entrant("scene"), scene, range(2)).success == 0.0  # nobody holds a key
    assert evaluate(entrant("WASDRBMoveController"), scene, range(2)).success == 0.0


@pytest.mark.parametrize(
    ("spec", "message"),
    [
        ("randm", "nobody is called 'randm'"),
        ("WASDController2", "did you mean 'WASDController'"),
        ("none.py:f", "none.py: there is no such Python file"),
        ("{mine}:ahed", "has no 'ahed'; did you mean 'ahead'"),
        (
            "{bad}:f",
            r"bad.py, line 1: Your code stopped with ZeroDivisionError: division by zero\.",
        ),
        ("{full}:f", r"full.py, line 2: NameError: name 'wheel' is not defined"),
        ("none.onnx", "the network 'none.onnx' is not there"),
        ("none.zip", "holds no training"),
        ("zoo:nothing", "the zoo has no network for 'nothing'"),
    ],
)
def test_who_can_not(tmp_path: Path, spec: str, message: str) -> None:
    mine, bad, full = (tmp_path / name for name in ("mine.py", "bad.py", "full.py"))
    mine.write_text(MINE)
    bad.write_text("1 / 0\n")
    full.write_text("import pymunk\nwheel\n")  # a page could not run it
    with pytest.raises(AI4UError, match=message):
        entrant(spec.format(mine=mine, bad=bad, full=full))


def test_the_command(tmp_path: Path) -> None:
    file, road = tmp_path / "mine.py", tmp_path / "road.yaml"
    file.write_text(MINE)
    road.write_text(ROAD)
    told = CliRunner().invoke(
        app,
        [
            *("evaluate", str(road), "--brain", f"{file}:ahead", "--brain", "random"),
            *("--episodes", "8", "--seed", "100", "--json", str(tmp_path / "out.json")),
            *("--plot", str(tmp_path / "out.png")),
        ],
    )
    assert told.exit_code == 0, told.output
    assert "road: 8 episodes, seeds 100..107" in told.output
    found = json.loads((tmp_path / "out.json").read_text())
    assert [each["name"] for each in found] == ["ahead", "random"]
    assert [each["seed"] for each in found[1]["each"]] == list(range(100, 108))
    assert (tmp_path / "out.png").read_bytes().startswith(b"\x89PNG")
    only = CliRunner().invoke(
        app, ["evaluate", str(road), "--brain", f"{file}:ahead", "--episodes", "2", "--json", "-"]
    )
    assert json.loads(only.stdout)[0]["episodes"] == 2


def _evaluation(name: str, successes: int, count: int) -> Evaluation:
    episodes = tuple(EpisodeStats(seed, seed < successes, 1.0, 5, True) for seed in range(count))
    return Evaluation(name, "road", True, episodes)


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_the_interval_holds_the_share_that_was_found(share: float) -> None:
    for count in range(1, 400):
        evaluation = _evaluation("all", round(share * count), count)
        assert evaluation.interval is not None
        low, high = evaluation.interval
        assert evaluation.success is not None
        assert 0.0 <= low <= evaluation.success <= high <= 1.0


@pytest.mark.parametrize("count", [1, 2, 5, 10, 50])
@pytest.mark.parametrize("share", [0, 1])
def test_the_best_and_the_worst_result_can_be_drawn(tmp_path: Path, count: int, share: int) -> None:
    plot_evaluations([_evaluation("$a_{$", share * count, count)], tmp_path / "out.png")
    assert (tmp_path / "out.png").read_bytes().startswith(b"\x89PNG")


def test_there_has_to_be_something_to_draw_and_a_format(tmp_path: Path) -> None:
    with pytest.raises(SetupError, match="expected at least one evaluation"):
        plot_evaluations([], tmp_path / "out.png")
    with pytest.raises(SetupError, match="expected at least one panel"):
        plot_curves({}, tmp_path / "out.png")
    with pytest.raises(SetupError, match=r"expected a name that ends in \.png"):
        plot_evaluations([_evaluation("a", 1, 1)], tmp_path / "out.txt")
    plot_curves({"nothing yet": {}}, tmp_path / "out.png")
    plot_curves({"nothing yet": {"a": []}}, tmp_path / "out.png")
