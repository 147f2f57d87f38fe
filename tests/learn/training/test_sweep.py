"""Sweeps: what is tried, how it goes on, and what is in the folder at the end."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from ai4u_edu import Scene
from ai4u_edu.base.errors import AI4UError, SetupError
from ai4u_edu.blocks.brains.network import Network
from ai4u_edu.cli.main import app
from ai4u_edu.cli.sweep import parse_seeds, with_rewards_left_out
from ai4u_edu.games.jobs import JobOutcome
from ai4u_edu.learn.training.run import Check
from ai4u_edu.learn.training.sweep.page import page_of
from ai4u_edu.learn.training.sweep.plan import Choice, SweepPlan
from ai4u_edu.learn.training.sweep.result import TrialResult, csv_text, groups, ranked
from ai4u_edu.learn.training.sweep.search_space import Parameter
from ai4u_edu.learn.training.sweep.trial import CHECKS, trial
from ai4u_edu.learn.training.worlds import make_worlds
from ai4u_edu.scenes.scene_data import scene_data
from tests.learn.training.small import CHOICES, small_settings

pytestmark = pytest.mark.needs("sweep")


def plan(**changes: object) -> SweepPlan:
    return SweepPlan.model_validate(
        {
            "scene": {"name": "box_chase"},
            "algorithms": ("ppo",),
            "seeds": (0, 1),
            "parameters": (),
            "trials": 0,
            "batch": 1,
            "steps": 64,
            "settings": small_settings().model_dump(mode="json"),
        }
        | changes
    )


def parameters(*texts: str) -> tuple[Parameter, ...]:
    return tuple(map(Parameter.parse, texts))


def result(
    number: int, success: float, *, seed: int = 0, at: int = 64, **told: object
) -> TrialResult:
    check = Check(steps=at, seconds=0, success=success, reward=success * 10, length=20)
    done = {"checks": [check.model_dump()], "steps": 64, "pruned": False, "network": "AAAA"} | told
    choice = Choice(algorithm="ppo", seed=seed, settings={"gamma": 0.9})
    return TrialResult.of(number, choice, JobOutcome(plan().job(choice), done), has_goal=True)


# -- what is tried ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text",
    ["rate", "=1", "rate=", "rate=1..", "rate=2..1", "rate=0..1:log", "rate=1..2:exp", "x.rate=1"],
)
def test_what_is_no_setting_is_told(text: str) -> None:
    with pytest.raises(SetupError, match="--set"):
        Parameter.parse(text)


def test_values_have_their_types() -> None:
    (found,) = parameters("x=1,2.5,1e-3,true,64x32,tanh")
    assert found.values == (1, 2.5, 0.001, True, [64, 32], "tanh")
    (whole,) = parameters("batch_size=32..256")
    assert whole.is_whole
    with pytest.raises(SetupError, match="set by --steps"):
        Parameter.parse("steps=100")


@pytest.mark.parametrize("text", ["", "a", "3-1", "0-99999", "-1", "99999999999"])
def test_what_are_no_seeds_is_told(text: str) -> None:
    with pytest.raises(SetupError, match="--seeds"):
        parse_seeds(text)


def test_all_combinations_are_tried_with_each_seed() -> None:
    found = plan(
        algorithms=("sac", "ppo"), parameters=parameters("gamma=0.9,0.99", "sac.tau=0.01,0.02")
    ).choices()
    assert len(found) == (2 * 2 + 2) * 2
    assert {each.seed for each in found} == {0, 1}
    assert not any("sac.tau" in each.settings for each in found if each.algorithm == "ppo")


def test_a_setting_is_an_algorithms_or_the_trainings() -> None:
    choice = Choice(algorithm="ppo", seed=3, settings={"gamma": 0.5, "skip_frame": 2})
    told = plan().job(choice).arguments
    assert told["settings"]["ppo"]["gamma"] == 0.5
    assert told["settings"]["skip_frame"] == 2
    assert told["settings"]["sac"].get("gamma") != 0.5
    assert (told["budget"], told["settings"]["ppo"]["check_every"]) == (64, 6)


def test_unknown_settings_are_told_before_anything_runs() -> None:
    with pytest.raises(SetupError, match="knows no setting 'learning_rat'"):
        plan(parameters=parameters("learning_rat=0.1,0.2")).check()
    with pytest.raises(SetupError, match="--set: skip_frame: expected at least 0, got -1"):
        plan(parameters=parameters("skip_frame=-1,2")).check()
    with pytest.raises(SetupError, match="expected --trials"):
        plan(parameters=parameters("gamma=0.9..0.99")).check()


def test_all_algorithms_have_the_same_budget() -> None:
    both = plan(algorithms=("sac", "ppo"), steps=100)
    assert "sac: 100; ppo: 128" in both.unlike_budgets()
    equal = both.with_equal_budgets()
    assert equal.steps == 128
    assert equal.unlike_budgets() == ""
    assert {equal.job(each).arguments["budget"] for each in equal.choices()} == {128}
    assert plan(algorithms=("sac",), steps=100).with_equal_budgets().steps == 100
    varied = plan(algorithms=("sac", "ppo"), steps=100, parameters=parameters("ppo.n_steps=32,48"))
    assert varied.with_equal_budgets().steps == 192


def test_unlike_budgets_are_told_on_the_page() -> None:
    several = parameters("ppo.n_steps=31,37,41")
    unlike = plan(algorithms=("sac", "ppo"), steps=100, parameters=several)
    assert unlike.with_equal_budgets() == unlike, "no number of steps is near"
    told = "different numbers of decisions, which is no fair race: sac: 100; ppo: 124 / 148 / 164"
    assert told in page_of(unlike, [result(0, 1.0)], None, 5, [])
    settings = plan(algorithms=("sac", "ppo"), steps=None)
    assert "sac: 200; ppo: 256" in page_of(settings, [result(0, 1.0)], None, 5, [])


def test_the_two_lengths_have_two_names() -> None:
    assert "length" not in result(0, 1.0).cells(())
    page = page_of(plan(), [result(0, 1.0)], None, 1, [])
    assert "<th>check length</th>" in page
    assert "the limit of the scene" in page


def test_each_reward_term_is_left_out_in_turn(tmp_path: Path) -> None:
    left_out = with_rewards_left_out(plan(parameters=parameters("gamma=0.9,0.99")))
    names = [each.settings["without_reward"] for each in left_out.choices()]
    assert names[::2][:4] == ["nothing", "touch", "fall", "min_dist"]
    told = left_out.job(left_out.choices()[2]).arguments
    assert told["settings"]["without_reward"] == "touch"
    with pytest.raises(SetupError, match="got both"):
        with_rewards_left_out(left_out)
    (tmp_path / "choices.yaml").write_text(CHOICES)
    with pytest.raises(SetupError, match="expected several reward terms"):
        with_rewards_left_out(plan(scene=scene_data(str(tmp_path / "choices.yaml"), ())))


def test_a_term_that_is_left_out_is_not_learned_from_and_still_ends_the_episode() -> None:
    scene = Scene.load("box_chase")
    rewards = []
    for name in ("nothing", "fall"):
        worlds = make_worlds(scene, small_settings(without_reward=name), "sac")
        worlds.seed(3)
        worlds.reset()
        ahead = np.array([[1.0, 0.0, 0.0, 0.0]] * worlds.num_envs, np.float32)
        told = [worlds.step(ahead) for _ in range(60)]
        rewards.append(np.array([each[1] for each in told]))
        ended = np.array([each[2] for each in told])
    fell = ended & (rewards[0] < 0)
    assert fell.any()
    np.testing.assert_allclose(rewards[1] - rewards[0], fell.astype(float))
    with pytest.raises(SetupError, match="no reward term is called 'fell'; did you mean 'fall'"):
        make_worlds(scene, small_settings(without_reward="fell"), "sac")


def test_only_the_number_of_trials_may_change() -> None:
    one = plan(trials=5, parameters=parameters("gamma=0.9..0.99"))
    assert one.difference(one.model_copy(update={"trials": 9})) == ""
    assert one.difference(plan(trials=5)) == "parameters"
    assert plan().difference(plan(trials=5)) == "trials"


# -- what comes out ------------------------------------------------------------------------------


def test_the_best_is_the_one_with_the_best_check_then_the_faster_one() -> None:
    results = [
        result(0, 0.5),
        result(1, 1.0, at=64),
        result(2, 1.0, at=32),
        result(3, 1.0, at=8, pruned=True, network=""),
    ]
    assert [each.number for each in ranked(results)] == [2, 1, 0, 3]


def test_settings_are_summed_up_over_seeds() -> None:
    (row,) = groups([result(0, 0.5), result(1, 1.0, seed=1)])
    assert row == {
        "settings": "ppo, gamma=0.9",
        "seeds": "2",
        "mean": "75%",
        "worst": "50%",
        "best": "100%",
    }


def test_a_trial_that_failed_is_in_table_and_page_as_text() -> None:
    choice = Choice(algorithm="ppo", seed=0, settings={"gamma": "<b>"})
    failed = TrialResult.of(
        1, choice, JobOutcome(plan().job(choice), error="ValueError: <script>"), has_goal=True
    )
    page = page_of(plan(parameters=parameters("gamma=<b>")), [result(0, 1.0), failed], None, 5, [])
    assert "<script>" not in page
    assert "<b>" not in page
    told = "Trials: 5, all combinations. Decisions of each: 64. Finished: 1, failed: 1. "
    told += "3 have not run yet."
    assert told in " ".join(page.split())
    rows = [*csv.DictReader(csv_text([result(0, 1.0), failed], ["gamma"]).splitlines())]
    assert [row["state"] for row in rows] == ["finished", "failed"]


@pytest.mark.slow
def test_a_trial_below_the_median_is_pruned() -> None:
    arguments = plan().job(Choice(algorithm="ppo", seed=0, settings={})).arguments
    told = trial(**arguments | {"rivals": [[1.0] * CHECKS] * 4, "budget": 640})
    assert told["pruned"]
    assert told["network"] == ""
    assert len(told["checks"]) < CHECKS


@pytest.mark.slow
def test_a_sweep_goes_on_where_it_ended(tmp_path: Path) -> None:
    scene, settings, out = tmp_path / "short.yaml", tmp_path / "small.yaml", tmp_path / "out"
    text = Scene.load("box_chase").dumps()
    scene.write_text(text.replace("steps_per_episode: 3000", "steps_per_episode: 20"))
    settings.write_text(json.dumps(small_settings().model_dump(mode="json")))
    begin = ["sweep", str(scene), "--settings", str(settings), "--out", str(out), "--steps", "64"]
    begin += ["--algo", "ppo", "--seeds", "0-1", "--engine", "inline"]
    search = ["--set", "learning_rate=0.001..0.01:log", "--batch", "2"]

    def run(*arguments: str) -> str:
        done = CliRunner().invoke(app, list(arguments))
        if done.exception is not None and not isinstance(done.exception, SystemExit):
            raise done.exception
        return done.output

    assert "best network, box_chase, 100 episodes" in run(*begin, *search, "--trials", "1")
    journal, table = (out / "journal.jsonl").read_bytes(), (out / "trials.csv").read_text()
    assert (out / "best.onnx").read_bytes() == (out / "networks/trial-000.onnx").read_bytes()
    assert Network(out / "best.onnx").about["algorithm"] == "ppo"
    page = (out / "index.html").read_text()
    assert page.count("data:image/png;base64,") == 2
    assert page.count("http") == 1, "http-equiv alone: the page loads nothing"

    run(*begin, *search, "--trials", "1")
    assert (out / "journal.jsonl").read_bytes() == journal, "what is finished runs no more"
    assert (out / "trials.csv").read_text() == table
    resumed = run("sweep", "--resume", "--out", str(out), "--trials", "2", "--engine", "inline")
    assert ("1/2 trials" in resumed, "0/2 trials" in resumed) == (True, False), resumed
    rows = (out / "trials.csv").read_text().splitlines()
    assert rows[:2] == table.splitlines()
    assert len(rows) == 3
    with pytest.raises(AI4UError, match="holds a sweep with other batch"):
        run(*begin, *search[:2], "--trials", "1")


@pytest.mark.nightly
def test_which_term_taught_it(tmp_path: Path) -> None:
    """Without what it is paid for touching the box or for coming closer, it learns to do less."""
    out = tmp_path / "out"
    arguments = ["sweep", "box_chase", "--algo", "sac", "--steps", "3000", "--leave-out-rewards"]
    done = CliRunner().invoke(app, [*arguments, "--engine", "inline", "--out", str(out)])
    assert done.exit_code == 0, done.output
    rows = [*csv.DictReader((out / "trials.csv").read_text().splitlines())]
    success = {row["without_reward"]: float(row["success"]) for row in rows}
    assert set(success) == {"nothing", "touch", "fall", "min_dist"}
    assert success["nothing"] > 0.8
    assert min(success.values()) < success["nothing"]
    assert (out / "terms.png").stat().st_size > 10_000
    assert (out / "index.html").read_text().count("data:image/png;base64,") == 3
