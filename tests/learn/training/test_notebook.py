"""Learning in a few lines, as a notebook does it."""

import io
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from ai4u_edu import Controller, Percept, Scene
from ai4u_edu.base.errors import SetupError
from ai4u_edu.learn.training import clone, demonstrate, evaluate, export, train
from ai4u_edu.learn.training.progress_bar import ProgressBar, counted
from ai4u_edu.learn.training.run import Trained
from tests.learn.training.small import SMALL
from tests.learn.training.test_evaluate import ROAD

pytestmark = pytest.mark.needs("train")

FEW: dict[str, Any] = SMALL | {"check_episodes": 2, "max_steps": 20, "enough": 0}


class Ahead(Controller):
    """Always drives ahead."""

    def get_action(self, percept: Percept) -> dict[str, Any]:
        """Ahead."""
        return {"move": [1, 0, 0, 0]}


def small(out: Path, algo: str = "ppo", **more: Any) -> Trained:
    return train("box_chase", algo, out=out, settings=FEW, quiet=True, **more)


def test_nothing_heavy_is_loaded_before_it_is_needed() -> None:
    code = (
        "import sys; import ai4u_edu;"
        "from ai4u_edu.learn.training import clone, evaluate, export, train;"
        "print(sorted({'torch', 'stable_baselines3', 'pymunk', 'viser'} & set(sys.modules)))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


@pytest.mark.nightly  # as the commands do each time
def test_train_evaluate_export(tmp_path: Path) -> None:
    run = small(tmp_path / "a")
    assert run.folder == tmp_path / "a"
    assert run.run.config().settings.ppo.others["n_steps"] == 32
    assert repr(run).startswith("Trained(box_chase, ppo: done after 256 steps and ")
    file = export(run, tmp_path / "policy.onnx")
    short = Scene.load("box_chase")
    told = [evaluate(who, short, episodes=2, quiet=True) for who in (run, run.folder, str(file))]
    assert told[0].episodes == told[1].episodes
    assert told[0].lengths == told[2].lengths
    again = small(tmp_path / "a", overwrite=True, seed=1)
    assert again.run.config().seed == 1
    more = train(out=tmp_path / "a", resume=True, steps=400, quiet=True)
    assert more.steps >= 400
    assert more.run.config().algorithm == "ppo"


def test_overwriting_leaves_alone_what_no_training_wrote(tmp_path: Path) -> None:
    small(tmp_path, "sac")
    mine = tmp_path / "notes.txt"
    mine.write_text("mine")
    small(tmp_path, "ppo", overwrite=True)
    assert mine.read_text() == "mine"
    assert not (tmp_path / "replay.pkl").exists()  # ppo has none
    assert len(list((tmp_path / "tensorboard").glob("events*"))) == 1


def test_what_is_wrong_is_told(tmp_path: Path) -> None:
    with pytest.raises(SetupError, match="expected one of sac, ppo, dqn, got 'pop'; did you mean"):
        train("box_chase", "pop", out=tmp_path)
    with pytest.raises(SetupError, match=r"^settings: ppo\.steps: expected"):
        train("box_chase", out=tmp_path, settings={"ppo": {"steps": -1}})
    with pytest.raises(SetupError, match="resume needs out"):
        train(resume=True)
    with pytest.raises(SetupError, match="in which scene is random to drive"):
        evaluate("random")
    with pytest.raises(SetupError, match="expected a function from percept to action"):
        evaluate(3, "box_chase")  # type: ignore[arg-type]
    small(tmp_path)
    with pytest.raises(SetupError, match=r"begin anew in this one \(overwrite\)"):
        small(tmp_path)


def ahead(percept: Percept) -> dict[str, Any]:
    return {"move": [1, 0, 0, 0]}


@pytest.mark.parametrize("who", [ahead, Ahead, Ahead(), lambda percept: {"move": [1, 0, 0, 0]}])
def test_whoever_drives(who: Any) -> None:
    told = evaluate(who, Scene.loads(ROAD), episodes=12, seed=0, quiet=True)
    assert told.success_rate is not None
    assert 0 < told.success_rate < 1
    assert told.success_rate == told.success


def test_an_evaluation_shows_itself_as_a_table() -> None:
    told = evaluate(ahead, Scene.loads(ROAD), episodes=4, quiet=True)
    title, headings, row = repr(told).splitlines()
    assert title == "road, 4 episodes"
    assert headings.split("  ")[0] == "who"
    assert row.startswith("ahead")
    assert headings.index("return") == row.index(told.cells["return"])
    html: str = told._repr_html_()
    assert "<th>95% between</th>" in html
    assert f"<td>{told.cells['success']}</td>" in html


def test_show_and_clone(tmp_path: Path) -> None:
    scene = Scene.loads(ROAD)
    shown = demonstrate(ahead, scene, episodes=3, seed=5, quiet=True)
    assert [each.seed for each in shown] == [5, 6, 7]
    done = clone(shown, tmp_path / "c.onnx", updates=100, quiet=True)
    assert evaluate(done, scene, episodes=12, quiet=True).lengths == (
        evaluate(ahead, scene, episodes=12, quiet=True).lengths
    )
    shown[0].save(tmp_path / "one.episode")
    by_file = clone(tmp_path, tmp_path / "d.onnx", updates=5, quiet=True)
    assert by_file.decisions == len(shown[0].agents[0])


class Terminal(io.StringIO):
    """A stream that says that it is a terminal."""

    def isatty(self) -> bool:
        return True


def test_a_bar_has_count_text_and_lines_above_it() -> None:
    told = Terminal()
    bar = ProgressBar(3, "steps", file=told)
    bar.note("so far")
    bar.show(2, "fast")
    bar.close()
    assert "so far\n" in told.getvalue()
    assert "2/3 steps, fast" in told.getvalue()


@pytest.mark.needs("lessons")
def test_lines_above_a_bar_are_no_errors_in_a_notebook(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from ipykernel.kernelapp import IPKernelApp

    monkeypatch.setattr(IPKernelApp, "initialized", lambda: True)
    bar = ProgressBar(3, "steps")
    bar.note("so far")
    bar.close()
    told = capsys.readouterr()
    assert "so far" in told.out
    assert "so far" not in told.err


@pytest.mark.needs("lessons")
def test_a_quiet_bar_and_one_that_could_not_be_removed_write_nothing() -> None:
    import ipykernel.kernelapp  # noqa: F401 - a process that has loaded it need be no kernel

    log = io.StringIO()
    for bar in (
        ProgressBar(3, "steps", file=log, quiet=True),
        ProgressBar(3, "steps", file=log, keep=False),
    ):
        bar.note("so far")
        bar.show(3, "fast")
        bar.close()
    assert log.getvalue() == ""


def test_what_is_counted_comes_through() -> None:
    assert list(counted(range(5), "some")) == [0, 1, 2, 3, 4]
