"""A pupil beside a teacher: it is told what she would do where its own errors take it."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ai4u_edu import Percept, Scene, World
from ai4u_edu.base.errors import SetupError
from ai4u_edu.blocks.brains.network import Network
from ai4u_edu.learn.training import evaluate
from ai4u_edu.learn.training.dagger import FIRST_SEED, TeacherData, imitate
from ai4u_edu.learn.training.settings import DaggerSettings
from tests.learn.training.teachers import OWN
from tests.scenes.solvers import solver_of

pytestmark = pytest.mark.needs("train")

FEW = DaggerSettings(rounds=2, episodes=2, updates=50, layers=(16,))


def test_it_learns_and_is_better_than_a_clone_of_so_few(tmp_path: Path) -> None:
    how = DaggerSettings(rounds=4, episodes=4, updates=400, layers=(64,))
    scene = Scene.load("box_chase")
    file = imitate(lambda: solver_of("box_chase"), scene, tmp_path / "a.onnx", how, quiet=True)
    told = evaluate(file, scene, episodes=20, quiet=True)
    assert told.success_rate is not None
    assert told.success_rate >= 0.9
    about = Network(file).about
    assert (about["algorithm"], about["scene"], about["demonstrations"]) == (
        "dagger",
        "box_chase",
        16,
    )


@pytest.mark.nightly
def test_the_same_seed_gives_the_same_network_and_no_seed_of_an_evaluation(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    given: list[int] = []
    reset = World.reset

    def noting(world: World, seed: int | None = None) -> None:
        if seed is not None:
            given.append(seed)
        reset(world, seed)

    monkeypatch.setattr(World, "reset", noting)
    files = [
        imitate(
            lambda: solver_of("box_chase"),
            Scene.load("box_chase"),
            tmp_path / f"{number}.onnx",
            FEW,
            seed=seed,
            quiet=True,
        ).read_bytes()
        for number, seed in enumerate((0, 0, 1))
    ]
    assert files[0] == files[1] != files[2]
    assert min(given) >= FIRST_SEED


def test_the_teacher_speaks_while_the_pupil_drives() -> None:
    """A pupil that does nothing is told at each decision what the teacher would do there."""

    def ahead(_percept: Percept) -> dict[str, Any]:
        return {"move": [1, 0, 0, 0]}

    class Idle:
        def __call__(self, seen: Any) -> Any:
            return seen.new_zeros(1, 4)

    scene = Scene.loads(
        Scene.load("box_chase")
        .dumps()
        .replace("max_steps_per_episode: 3000", "max_steps_per_episode: 200")
    )
    lessons = TeacherData(lambda: ahead, scene, seed=0)
    for _ in range(6):
        lessons.episode(Idle())  # type: ignore[arg-type]
    assert (np.stack(lessons.said) == [1, 0, 0, 0]).all()
    # what was done is the last reading: mostly nothing, but she took the wheel now and then
    last = np.stack(lessons.seen)[1:, -4]
    assert 0.0 < last.mean() < 0.7


@pytest.mark.parametrize("name", OWN)
def test_the_teachers_solve_their_scenes(name: str) -> None:
    assert evaluate(OWN[name](), name, episodes=20, quiet=True).success_rate == 1.0


def test_several_actuators_are_learned_together(tmp_path: Path) -> None:
    scene = Scene.load("call")
    how = DaggerSettings(rounds=2, episodes=2, updates=300, layers=(32,))
    file = imitate(lambda: solver_of("call"), scene, tmp_path / "a.onnx", how, quiet=True)
    network = Network(file)
    assert {port.name: port.shape for port in network.outputs} == {"move": (4,), "speak": (1,)}
    call, silence = (
        network.decide({"hear": [0.0], "partner": [cosine, 5.0], "goal": [-1.0]})["speak"][0]
        for cosine in (1.0, -0.5)
    )
    assert call > silence + 0.2


def test_a_choice_beside_another_actuator_is_refused(tmp_path: Path) -> None:
    text = Scene.load("grid_world").dumps()
    scene = Scene.loads(
        text.replace("    actuators:\n", "    actuators:\n      - {type: PenActuator}\n", 1)
    )
    with pytest.raises(SetupError, match="one actuator whose numbers have a range, got Dict"):
        imitate(lambda: solver_of("grid_world"), scene, tmp_path / "a.onnx", FEW, quiet=True)
