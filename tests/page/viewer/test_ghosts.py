"""A ghost has the pose of the recorded agent at the same time; a warning says if it is unfair."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any, NamedTuple

import pytest

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.page.viewer import Viewer
from ai4u_edu.page.viewer.scene.ghost_bodies import GhostBodies
from ai4u_edu.recording import Episode, Ghosts, Recorder
from ai4u_edu.runtime.runner import Runner
from tests.page.viewer.pages import part_of, publish, shown
from tests.recording.recorded_drives import take
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


class Race(NamedTuple):
    """A world with the ghost of an episode of it."""

    viewer: Viewer
    ghosts: Ghosts
    poses: list[Any]
    """The robot's pose after each decision of the episode."""
    episode: Episode

    def step(self, times: int = 1) -> None:
        """Run some decisions, and draw."""
        runner = self.viewer.runner
        for _ in range(times):
            runner.sim.step()
        publish(runner)
        shown(self.viewer)

    def bodies(self, index: int = 0) -> list[Any]:
        """Return the drawn bodies of a ghost."""
        return [*part_of(self.viewer, GhostBodies).bodies(self.ghosts.drives[index])]


@pytest.fixture
def race() -> Iterator[Race]:
    runner, poses, episode = driving(1, 30, 0.5)
    ghosts = Ghosts()
    ghosts.race(episode, "episode <1>")
    viewer = Viewer(runner, ghosts=ghosts)
    until(lambda: ghosts.drives[0].path is not None)
    yield Race(viewer, ghosts, poses, episode)
    viewer.stop()


def test_it_follows_the_run_in_time_and_begins_anew_with_the_world(race: Race) -> None:
    sim = race.viewer.runner.sim
    sim.agents[0].use_brain(LocalBrain(controller=lambda _: {}))  # the living one stays
    for round_ in range(2):
        for number, pose in enumerate(race.poses[:20]):
            race.step()
            (body,) = race.bodies()
            if number % 2:  # its poses are those of every other tick
                assert body.frame.position[:2] == pytest.approx(pose[:2], abs=1e-5), round_
            assert body.frame.visible
        sim.reset(1)
    x, y, _ = body.frame.position
    assert body.label.position[0] == pytest.approx(x)
    assert body.label.position[1] > y
    assert body.label.text == "ghost"


def test_a_slowed_one_takes_longer(race: Race) -> None:
    race.ghosts.race(race.episode, "network", stretch=2.0)
    until(lambda: race.ghosts.drives[0].path)
    race.step(20)
    (body,) = race.bodies()
    assert body.frame.position[:2] == pytest.approx(race.poses[9][:2], abs=0.02)


def test_it_stays_at_the_end_of_its_run(race: Race) -> None:
    race.step(32)
    end = tuple(race.bodies()[0].frame.position)
    race.step(5)
    assert tuple(race.bodies()[0].frame.position) == end


def test_nothing_is_sent_while_it_stands(race: Race, monkeypatch: pytest.MonkeyPatch) -> None:
    race.step()
    body = race.bodies()[0]
    monkeypatch.setattr(type(body.frame), "position", property(fset=lambda *_: pytest.fail("sent")))
    part_of(race.viewer, GhostBodies).draw(race.viewer.runner.latest)


def test_ghost_text_names_its_episode_and_unfair_starts(race: Race) -> None:
    ghosts, runner = race.ghosts, race.viewer.runner
    race.step()
    assert ghosts.text(runner.latest) == "Ghost: episode <1>"
    runner.sim.reset(2)
    race.step()
    assert "It began otherwise: with seed 1." in ghosts.text(runner.latest)
    assert race.bodies()[0].label.text == "ghost of another start"
    ghosts.race(take("donut", decisions=5).episode, "donut")
    until(lambda: ghosts.drives[0].path is not None)
    race.step()
    assert "It ran in another scene." in ghosts.text(runner.latest)
    assert race.bodies() == []
    ghosts.race(None)
    race.step()
    assert ghosts.text(runner.latest) == ""


def test_several_have_their_names_and_a_removed_one_is_gone(race: Race) -> None:
    ghosts, runner = race.ghosts, race.viewer.runner
    runner.sim.agents[0].use_brain(LocalBrain(controller=lambda _: {}))
    others = [driving(1, 30, turn)[1:] for turn in (-0.5, 0.2)]
    ghosts.race_all([(others[0][1], "Red Fox"), (others[1][1], "Calm Owl")])
    until(lambda: all(each.path is not None for each in ghosts.drives))
    race.step(10)
    assert ghosts.text(runner.latest) == "Ghosts: Red Fox, Calm Owl"
    bodies = [race.bodies(index)[0] for index in range(2)]
    assert [each.label.text for each in bodies] == ["Red Fox", "Calm Owl"]
    for body, (poses, _) in zip(bodies, others, strict=True):
        assert body.frame.position[:2] == pytest.approx(poses[9][:2], abs=1e-5)
    ghosts.race_all([(others[1][1], "Calm Owl")])
    race.step()
    with pytest.warns(UserWarning, match="already removed"):
        bodies[0].frame.remove()


def test_a_run_that_can_not_be_played_is_told(race: Race) -> None:
    episode = race.episode
    scene = episode.scene.model_copy(update={"agents": ({"body": "nobody"},)})
    race.ghosts.race(replace(episode, scene=scene), "broken")
    until(lambda: race.ghosts.drives[0].problem)
    assert race.ghosts.text(race.viewer.runner.latest).startswith(
        "No ghost: the episode's scene can't be made"
    )
