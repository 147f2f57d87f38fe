"""A ghost has the pose of the recorded agent at the same time; a warning says if it is unfair."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.recording import Episode, Recorder
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.viewer import Viewer
from ai4u_edu.viewer.scene.ghost_bodies import GhostBodies
from tests.recording.recorded_drives import take
from tests.viewer.pages import part_of, publish, shown
from tests.waiting import until


def driving(seed: int, steps: int, turn: float) -> tuple[Runner, list[Any], Episode]:
    """An episode, and the robot's pose after each of its decisions; another one has just begun."""
    scene = Scene.load("box_chase")
    sim = scene.build()
    sim.agents[0].use_brain(LocalBrain(controller=lambda _: {"move": [0.2, turn, 0, 0]}))
    recorder = Recorder(sim, scene=scene.description)
    runner = Runner(sim, seed=seed, recorder=recorder)
    poses = []
    for _ in range(steps):
        sim.step()
        poses.append(sim.world["robot"].pose)
    sim.reset(seed)
    return runner, poses, recorder.episodes[-1]


@pytest.fixture
def viewer() -> Iterator[Viewer]:
    runner, poses, episode = driving(1, 30, 0.5)
    viewer = Viewer(runner)
    viewer.ghosts.race(episode, "episode <1>")
    until(lambda: viewer.ghosts.drives[0].path is not None)
    viewer.poses, viewer.episode = poses, episode  # type: ignore[attr-defined]
    yield viewer
    viewer.stop()


def step(viewer: Viewer, times: int = 1) -> None:
    runner = viewer.runner
    for _ in range(times):
        runner.sim.step()
    publish(runner)
    shown(viewer)


def bodies_of(viewer: Viewer) -> list[Any]:
    """Return the drawn bodies of the first ghost."""
    return [*part_of(viewer, GhostBodies).bodies(viewer.ghosts.drives[0])]


def test_it_follows_the_run_in_time_and_begins_anew_with_the_world(viewer: Viewer) -> None:
    sim = viewer.runner.sim
    sim.agents[0].use_brain(LocalBrain(controller=lambda _: {}))  # the living one stays
    for round_ in range(2):
        for number, pose in enumerate(viewer.poses[:20]):  # type: ignore[attr-defined]
            step(viewer)
            (body,) = bodies_of(viewer)
            if number % 2:  # its poses are those of every other tick
                assert body.frame.position[:2] == pytest.approx(pose[:2], abs=1e-5), round_
            assert body.frame.visible
        sim.reset(1)
    x, y, _ = body.frame.position
    assert body.label.position[0] == pytest.approx(x)
    assert body.label.position[1] > y
    assert body.label.text == "ghost"


def test_it_stays_at_the_end_of_its_run(viewer: Viewer) -> None:
    step(viewer, 32)
    end = tuple(bodies_of(viewer)[0].frame.position)
    step(viewer, 5)
    assert tuple(bodies_of(viewer)[0].frame.position) == end


def test_nothing_is_sent_while_it_stands(viewer: Viewer, monkeypatch: pytest.MonkeyPatch) -> None:
    step(viewer)
    body = bodies_of(viewer)[0]
    monkeypatch.setattr(type(body.frame), "position", property(fset=lambda *_: pytest.fail("sent")))
    part_of(viewer, GhostBodies).draw(viewer.runner.latest)


def test_it_says_whose_it_is_and_where_that_is_unfair(viewer: Viewer) -> None:
    ghosts, runner = viewer.ghosts, viewer.runner
    step(viewer)
    assert ghosts.text(runner.latest) == "Ghost: episode <1>"
    runner.sim.reset(2)
    step(viewer)
    assert "It began otherwise: with seed 1." in ghosts.text(runner.latest)
    assert bodies_of(viewer)[0].label.text == "ghost of another start"
    ghosts.race(take("donut", decisions=5).episode, "donut")
    until(lambda: ghosts.drives[0].path is not None)
    step(viewer)
    assert "It ran in another scene." in ghosts.text(runner.latest)
    assert bodies_of(viewer) == []
    ghosts.race(None)
    step(viewer)
    assert ghosts.text(runner.latest) == ""


def test_several_have_their_names_and_a_removed_one_is_gone(viewer: Viewer) -> None:
    ghosts, runner = viewer.ghosts, viewer.runner
    runner.sim.agents[0].use_brain(LocalBrain(controller=lambda _: {}))
    others = [driving(1, 30, turn)[1:] for turn in (-0.5, 0.2)]
    ghosts.race_all([(others[0][1], "Red Fox"), (others[1][1], "Calm Owl")])
    until(lambda: all(each.path is not None for each in ghosts.drives))
    step(viewer, 10)
    assert ghosts.text(runner.latest) == "Ghosts: Red Fox, Calm Owl"
    bodies = [part_of(viewer, GhostBodies).bodies(drive)[0] for drive in ghosts.drives]
    assert [each.label.text for each in bodies] == ["Red Fox", "Calm Owl"]
    for body, (poses, _) in zip(bodies, others, strict=True):
        assert body.frame.position[:2] == pytest.approx(poses[9][:2], abs=1e-5)
    ghosts.race_all([(others[1][1], "Calm Owl")])
    step(viewer)
    with pytest.warns(UserWarning, match="already removed"):
        bodies[0].frame.remove()


def test_a_run_that_can_not_be_played_is_told(viewer: Viewer) -> None:
    episode: Episode = viewer.episode  # type: ignore[attr-defined]
    scene = episode.scene.model_copy(update={"agents": ({"body": "nobody"},)})
    viewer.ghosts.race(replace(episode, scene=scene), "broken")
    until(lambda: viewer.ghosts.drives[0].problem)
    assert viewer.ghosts.text(viewer.runner.latest).startswith(
        "No ghost: the episode's scene can't be made"
    )
