"""Maps over the floor of a running world, place by place, and poses that are tried."""

import math
import threading
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from ai4u_edu import BasicAgent, CircleShape, ControlRequestor, LocalBrain, RemoteBrain
from ai4u_edu.explain import NotExplainableError, field, live_maps, map_maker, value_map
from ai4u_edu.explain.elsewhere import Pose, PoseTrial
from ai4u_edu.explain.live import LiveExplainer
from ai4u_edu.explain.live_maps import LiveMaps, MapChoice
from ai4u_edu.explain.map_maker import Kind, LiveMap, MapMaker, MapRequest
from ai4u_edu.explain.moment import Moment
from ai4u_edu.explain.policy import Policy
from ai4u_edu.explain.world_copy import WorldCopy
from ai4u_edu.recording.scene_export import export_scene
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.snapshot import Snapshot, capture_snapshot, capture_static_scene
from tests.explain.planted import linear_network
from tests.explain.worlds import robot_and_box
from tests.waiting import until

pytestmark = pytest.mark.needs("train")


@pytest.fixture(autouse=True)
def _few_places(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(map_maker, "CELLS", 16)
    monkeypatch.setattr(map_maker, "ROLLOUT_CELLS", 4)
    monkeypatch.setattr(map_maker, "PUBLISH_S", 0.0)
    monkeypatch.setattr(map_maker, "RETRY_S", 0.0)


def turns_to_box(percept: Any) -> Any:
    return {"move": [0.5, -percept["bearing"][0], 0, 0]}


class Watched:
    """A world that stands still, with its snapshots."""

    def __init__(self, controller: Any) -> None:
        self.sim = robot_and_box(controller)
        self.scene = capture_static_scene(self.sim)
        self.exported: SceneDescription = export_scene(self.sim)
        self.latest = self.take()
        self.explainer = LiveExplainer(lambda: self.latest, lambda _agent: self.sim.agents[0].brain)

    def take(self, *, paused: bool = True) -> Snapshot:
        self.latest = replace(capture_snapshot(self.sim, self.scene), paused=paused)
        return self.latest

    def maker(self, kind: Kind, facing: str = "") -> MapMaker:
        request = MapRequest("0", kind, facing)
        return MapMaker(request, self.explainer, lambda _: self.exported, lambda: None)

    def maps(self) -> LiveMaps:
        return LiveMaps(lambda: self.latest, self.explainer, lambda _: self.exported)

    def trial(self) -> PoseTrial:
        return PoseTrial(lambda: self.latest, self.explainer, lambda _: self.exported)


def complete(maker: MapMaker, snapshot: Snapshot) -> LiveMap:
    """Compute a map to its end."""
    while maker.advance(snapshot):
        pass
    assert maker.latest is not None
    return maker.latest


def test_a_field_is_the_same_as_in_python_and_comes_place_by_place() -> None:
    world = Watched(turns_to_box)
    maker = world.maker("field", "box")
    told = []
    while maker.advance(world.latest):
        assert maker.latest is not None
        told.append(maker.latest)
    assert [each.done for each in told[:16]] == list(range(1, 17))
    known = [int(np.isfinite(each.moves[:, 0]).sum()) for each in told]
    assert known == sorted(known)
    last = told[-1]
    wanted = field(turns_to_box, world.sim, columns=4, heading="box")
    np.testing.assert_allclose(last.poses, wanted.poses)
    np.testing.assert_allclose(last.moves, wanted.moves)
    assert last.cell == pytest.approx((3.0, 3.0))
    assert not maker.advance(world.latest)


def test_it_follows_a_world_that_has_changed() -> None:
    world = Watched(turns_to_box)
    maker = world.maker("field")
    before = complete(maker, world.latest)
    assert not maker.advance(world.take())  # nothing has changed
    world.sim.world["box"].move_to(-3.0, -3.0)
    after = complete(maker, world.take())
    wanted = field(turns_to_box, world.sim, columns=4)
    np.testing.assert_allclose(after.moves, wanted.moves)
    assert not np.allclose(before.moves, after.moves, equal_nan=True)
    # while the world runs, a pass is finished first, and the last map stays until it is complete
    world.sim.world["box"].move_to(3.0, 3.0)
    assert maker.advance(world.take(paused=False))
    began = field(turns_to_box, world.sim, columns=4)
    world.sim.world["box"].move_to(3.0, -3.0)
    world.take(paused=False)
    while maker.latest is after:
        assert maker.advance(world.latest)
    assert maker.latest is not None
    np.testing.assert_allclose(maker.latest.moves, began.moves)
    done = complete(maker, world.latest)
    np.testing.assert_allclose(done.moves, field(turns_to_box, world.sim, columns=4).moves)


def test_values_by_rollouts_stay_while_the_world_runs() -> None:
    world = Watched(turns_to_box)
    maker = world.maker("values")
    told = complete(maker, world.latest)
    assert told.source == "rollouts"
    wanted = value_map(turns_to_box, world.sim, columns=2)
    np.testing.assert_allclose(told.values, wanted.values)
    world.sim.world["box"].move_to(-3.0, -3.0)
    assert not maker.advance(world.take(paused=False))
    assert complete(maker, world.take()) is not told


def test_values_of_a_critic(tmp_path: Any) -> None:
    turn = np.array([[0, -1, 0, 0], [0.5, 0, 0, 0]])
    path = linear_network(
        tmp_path / "a.onnx", {"bearing": turn}, value={"bearing": np.array([[0.0], [2.0]])}
    )
    world = Watched(turns_to_box)
    from ai4u_edu import trained_brain

    world.sim.agents[0].use_brain(trained_brain(str(path)))
    told = complete(world.maker("values", "box"), world.take())
    assert (told.source, len(told.values)) == ("critic", 16)
    known = told.values[np.isfinite(told.values)]
    np.testing.assert_allclose(known, 2.0, rtol=1e-5)  # everywhere it faces the box


def test_another_driver_begins_anew_and_one_with_a_state_is_refused() -> None:
    world = Watched(turns_to_box)
    maker = world.maker("field")
    complete(maker, world.latest)
    calls: list[int] = []

    def counts(percept: Any) -> Any:
        calls.append(1)
        return {"move": [1, 0, 0, 0]}

    world.sim.agents[0].use_brain(LocalBrain(controller=counts))
    told = complete(maker, world.take())
    assert "it changes calls" in told.problem
    assert not len(told.poses)
    world.sim.agents[0].use_brain(LocalBrain(controller=turns_to_box))
    assert complete(maker, world.take()).problem == ""
    assert "did you mean 'box'" in complete(world.maker("field", "bax"), world.latest).problem


def test_its_thread_ends_when_nobody_looks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(live_maps, "INTEREST_S", math.inf)
    before = set(threading.enumerate())
    world = Watched(turns_to_box)
    maps = world.maps()
    choice = MapChoice(has_field=True, has_values=True)
    field_request = choice.requests("0")[1]
    assert field_request.kind == "field"

    def threads() -> list[threading.Thread]:
        running = set(threading.enumerate()) - before
        return [each for each in running if each.name == "maps"]

    def is_complete() -> bool:
        found = [maps.ask(each) for each in choice.requests("0")]
        return all(each is not None and each.done == len(each.poses) for each in found)

    until(is_complete)
    assert len(threads()) == 1
    monkeypatch.setattr(live_maps, "INTEREST_S", -1.0)
    until(lambda: not threads())
    monkeypatch.setattr(live_maps, "INTEREST_S", math.inf)
    until(lambda: maps.ask(field_request) and threads())
    maps.stop()
    until(lambda: not threads())


def test_a_pose_that_is_tried() -> None:
    world = Watched(turns_to_box)
    for _ in range(3):
        world.sim.step()
    world.take()
    agent = world.sim.agents[0]
    before = agent.body.pose, agent.percept, agent.steps
    trial = world.trial()
    here = trial.at("0")
    assert here.pose[:2] == pytest.approx(agent.body.position)
    assert here.now[1] == pytest.approx(-agent.percept["bearing"][0])
    there = trial.at("0", Pose(0.0, 1.0, np.pi / 2))
    assert there.then is not None
    assert there.then[1] == pytest.approx(1.0)  # the box is to the right
    assert there.now == here.now
    assert there.move[2] < 0
    assert [axis.name for axis in there.axes] == ["forward", "turn", "jump", "forward jump"]
    assert trial.at("0", Pose(3.0, 1.0, 0.0)).then is None  # the box is there
    assert (agent.body.pose, agent.percept, agent.steps) == before
    world.sim.world["box"].move_to(-3.0, 1.0)
    world.take()
    moved = trial.at("0", Pose(0.0, 1.0, np.pi / 2))
    assert moved.then is not None
    assert moved.then[1] == pytest.approx(-1.0)
    with pytest.raises(NotExplainableError, match="no such agent"):
        trial.at("7")


def test_in_a_copy_an_agent_of_a_script_stands_still() -> None:
    sim = robot_and_box(turns_to_box)
    sim.world.add_body("other", CircleShape(radius=0.3), position=(-4, -4))
    remote = BasicAgent(body="other", id="1", brains=[RemoteBrain()])
    both = ControlRequestor(sim.world, [*sim.agents, remote])
    both.reset(0)
    there = Moment.of_sim(both).state.world.motions["other"]
    assert (there.x, there.y) == (-4, -4)
    copy = WorldCopy(both, Policy(turns_to_box))
    # a second brain would ask the script for actions of its own
    assert isinstance(copy.sim.agent("1").brain, LocalBrain)
    copy.percept_at((0.0, 0.0, 0.0))
    copy.step()
    assert copy.sim.world["other"].position == (-4, -4)
