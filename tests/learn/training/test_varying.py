"""One number with many values: right numbers, the same starts, and errors that help."""

import csv
import io
from pathlib import Path

import pytest
from typer.testing import CliRunner

from ai4u_edu import Scene
from ai4u_edu.cli.main import app
from ai4u_edu.games.jobs import engine
from ai4u_edu.learn.training.evaluating import evaluate
from ai4u_edu.learn.training.policies import entrant
from ai4u_edu.learn.training.varying import (
    MAX_VALUES,
    number_parameters,
    parameter_named,
    try_values,
    with_driver,
    with_value,
)

SPEED = ["vary", "box_chase", "--parameter", "move_amount", "--brain", "zoo"]


def rows_of(*words: str) -> list[dict[str, str]]:
    """Return what the command writes as CSV."""
    done = CliRunner().invoke(app, [*words, "--csv", "-"])
    assert done.exit_code == 0, done.output
    return list(csv.DictReader(io.StringIO(done.stdout)))


def error_of(*words: str) -> str:
    """Return the sentence with which the command ends."""
    done = CliRunner().invoke(app, list(words))
    assert done.exit_code != 0
    return f"{done.exception} {done.output}"


def test_the_numbers_are_those_of_an_evaluation_in_the_changed_scene() -> None:
    rows = rows_of(*SPEED, "--values", "2,5", "--episodes", "4", "--seed", "30")
    assert [row["0.move.move_amount"] for row in rows] == ["2", "5"]
    slow = Scene.loads(Scene.load("box_chase").source.replace("move_amount: 5", "move_amount: 2"))
    for row, scene in zip(rows, (slow, Scene.load("box_chase")), strict=True):
        expected = evaluate(entrant("zoo:box_chase"), scene, range(30, 34))
        assert int(row["successes"]) == expected.successes
        assert (float(row["success_low"]), float(row["success_high"])) == expected.interval
        assert float(row["reward"]) == pytest.approx(sum(expected.rewards) / 4)
        assert float(row["seconds"]) == pytest.approx(sum(expected.seconds) / 4)
        assert float(row["decisions"]) == sum(expected.lengths) / 4
    assert float(rows[0]["seconds"]) > float(rows[1]["seconds"])


def test_the_table_has_a_row_for_each_value() -> None:
    done = CliRunner().invoke(app, [*SPEED, "--values", "5,2.5", "--episodes", "2"])
    assert done.exit_code == 0, done.output
    first, heading, *rows = done.stdout.splitlines()
    assert first == "box_chase: 2 episodes with each value, the same starts (seeds 0..1)"
    assert "0.move.move_amount (m/s)" in heading
    assert [row.split()[0] for row in rows] == ["5", "2.5"]
    assert "34.2 and 100.0%" in rows[0]


@pytest.mark.slow
def test_the_numbers_do_not_depend_on_the_count_of_workers() -> None:
    words = [*SPEED, "--values", "1,2,5", "--episodes", "5"]
    assert rows_of(*words) == rows_of(*words, "--workers", "2")


def test_a_network_decides_as_often_as_it_is_told() -> None:
    words = ["vary", "box_chase", "--parameter", "brain.skip_frame", "--brain", "zoo"]
    often, seldom = rows_of(*words, "--values", "1,19", "--episodes", "2")
    assert float(often["decisions"]) > 5 * float(seldom["decisions"])


def test_each_value_begins_at_the_same_places() -> None:
    scene = Scene.load("box_chase")
    mass = parameter_named(scene, "bodies.box.mass")
    worlds = [with_value(scene, mass, value).build() for value in (1, 50)]
    for seed in range(5):
        for sim in worlds:
            sim.reset(seed)
        assert worlds[0].world["robot"].pose == worlds[1].world["robot"].pose
    assert scene == Scene.load("box_chase")


def test_the_agent_that_is_named_is_driven_and_measured() -> None:
    ids = [agent.id for agent in Scene.load("tag").build().agents]
    scene, who = with_driver(Scene.load("tag"), "FleeController", ids[1])
    steps = parameter_named(scene, f"{ids[1]}.max_steps_per_episode")
    with engine("inline") as running:
        (row,) = try_values(scene, steps, [3], [7], running, who=who, agent=ids[1])
    assert row.decisions <= 3


def test_every_number_of_a_scene_can_be_set_to_its_present_value() -> None:
    for name in ("box_chase", "forage", "soccer"):
        scene = Scene.load(name)
        parameters = number_parameters(scene)
        names = [each.name for each in parameters]
        assert len(set(names)) == len(names)
        for each in parameters[:: max(1, len(parameters) // 12)]:
            if each.value is not None:
                with_value(scene, each, each.value)


def test_without_a_parameter_it_lists_them() -> None:
    done = CliRunner().invoke(app, ["vary", "box_chase"])
    assert done.exit_code == 0, done.output
    assert "0.brain.controller.speed" in done.stdout
    assert "world.gravity" in done.stdout
    assert "m/s^2" in done.stdout


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["noise", "--values", "1"], "expected the whole name of one parameter, got 'noise': 0.vi"),
        (["vision", "--values", "1"], "expected a parameter, got 'vision', which has 0.vision."),
        (["vision.colums", "--values", "1"], "did you mean '0.vision.columns'?"),
        (["vision.noise"], "expected the values of 0.vision.noise to try, as in --values 1,2,4"),
        (["vision.noise", "--values", "1;2"], "expected numbers with commas between"),
        (["vision.noise", "--values", "-1"], "0.vision.noise = -1: expected at least 0, got -1"),
        (["rows", "--values", "3,2.5"], "0.vision.rows = 2.5: expected a whole number, got 2.5"),
        (["columns", "--values", "9"], "does not fit agent '0'"),
        (["columns", "--values", "9"], "vary another number, or choose a controller"),
        (
            ["rows", "--values", ",".join(map(str, range(1, MAX_VALUES + 2)))],
            f"expected at most {MAX_VALUES} values, got {MAX_VALUES + 1}",
        ),
        (["rows", "--values", "3", "--seed", str(2**63 - 1)], "expected room for 20 seeds"),
    ],
)
def test_a_mistake_is_explained(words: list[str], sentence: str) -> None:
    assert sentence in error_of("vary", "box_chase", "--brain", "zoo", "--parameter", *words)


def test_a_driver_that_can_not_drive_here_is_explained() -> None:
    words = ["vary", "box_chase", "--parameter", "rows", "--values", "3", "--brain"]
    assert "follows keys (WASDRBMoveController), which nobody presses" in error_of(*words, "scene")
    assert "a script drives in a served world only" in error_of(*words, "ai4u://127.0.0.1:8080")
    assert "nobody is called 'Nobody'" in error_of(*words, "Nobody")


def test_a_scene_s_own_blocks_and_a_program_can_be_tried(tmp_path: Path) -> None:
    blocks, scene = tmp_path / "mine.py", tmp_path / "own.yaml"
    blocks.write_text(
        "from ai4u_edu import Controller\n\n\n"
        "class Ahead(Controller):\n"
        "    '''Drives ahead.'''\n\n"
        "    share: float = 1.0\n\n"
        "    def get_action(self, percept):\n"
        "        return {'move': [self.share, 0, 0, 0]}\n"
    )
    text = Scene.load("box_chase").source
    scene.write_text(
        text[: text.index("    brains:")] + "    brains: [{type: LocalBrain, "
        "controller: {type: Ahead}}]\n"
    )
    words = ["vary", str(scene), "--blocks", str(blocks), "--parameter", "share"]
    still, fast = rows_of(*words, "--values", "0,1", "--episodes", "2")
    assert float(still["decisions"]) == 3000
    assert float(fast["decisions"]) < 3000
