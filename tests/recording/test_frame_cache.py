"""The frames that a cache replays equal the recorded ones, bit for bit."""

import threading
import tracemalloc
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.check.rollout import RandomDrive
from ai4u_edu.recording import Episode, Recorder
from ai4u_edu.recording.frame_cache import FrameCache
from ai4u_edu.snapshot import AgentState, Snapshot, capture_snapshot, capture_static_scene
from tests.recording.recorded_drives import GO, HOLD, LEFT, RESPAWN, WAIT, driver, field_of, take
from tests.waiting import LIMIT_S


def lived(name: str, decisions: int) -> tuple[Episode, dict[int, Snapshot]]:
    """Return a random drive, and the frames that were shown meanwhile, by tick."""
    sim = Scene.load(name).build()
    for number, agent in enumerate(sim.agents):
        drive = RandomDrive(agent)
        drive.restart(number)
        agent.ledger.keep_history(240)
        skip = agent.brain.skip_frame + number  # each in a rhythm of its own
        agent.use_brain(LocalBrain(controller=drive, skip_frame=skip))
    recorder = Recorder(sim)
    sim.reset(4)
    static_scene = capture_static_scene(sim)
    seen = {0: capture_snapshot(sim, static_scene)}
    while sim.agents[0].steps < decisions and not sim.agents[0].done:
        sim.tick()
        seen[sim.world.ticks] = capture_snapshot(sim, static_scene)
    recorder.finish()
    return recorder.episodes[-1], seen


def sensed(state: AgentState) -> tuple[object, ...]:
    rays = {
        key: (ray.origin, ray.ends.tobytes(), tuple(ray.groups)) for key, ray in state.rays.items()
    }
    return state.percept.data, state.percept.texts, rays, state.needs, state.steps


def paid(state: AgentState) -> tuple[object, ...]:
    return (
        state.action,
        state.clipped,
        state.reward,
        list(state.reward_terms.items()),
        state.episode_reward,
        list(state.episode_terms.items()),
        state.phase,
        state.history,
    )


@pytest.mark.parametrize(("name", "decisions"), [("box_chase", 60), ("tag", 40), ("soccer", 30)])
def test_every_step_is_as_it_was_seen_live(name: str, decisions: int) -> None:
    episode, seen = lived(name, decisions)
    frame_cache = FrameCache(episode, number=3).start()
    record = episode.agents[0]
    assert frame_cache.snapshot(len(record), timeout=None) is not None
    assert (frame_cache.last, frame_cache.ended, frame_cache.problem) == (len(record), True, "")
    for step, decision in enumerate(record):
        past = frame_cache.snapshot(step, timeout=None)
        assert past is not None
        then, after = seen[decision.begin], seen[decision.end]
        who = "" if len(episode.agents) == 1 else f" of agent {record.id}"
        assert past.past == f"episode 3, step {step + 1} of {len(record)}{who}"
        assert (past.tick, past.time, past.seed) == (then.tick, then.time, then.seed)
        assert past.bodies == then.bodies
        assert past.static_scene == then.static_scene
        assert past.agents[0].brain == then.agents[0].brain
        assert sensed(past.agents[0]) == sensed(then.agents[0])
        assert paid(past.agents[0]) == paid(after.agents[0])
        for other in range(1, len(episode.agents)):
            assert sensed(past.agents[other]) == sensed(then.agents[other])
            theirs = episode.agents[other]
            now = int(np.searchsorted(theirs.begin, decision.begin, side="right")) - 1
            ended = seen.get(int(theirs.end[now]))
            if ended is not None and theirs.end[now] > theirs.begin[now]:
                assert paid(past.agents[other]) == paid(ended.agents[other])
    end, last = frame_cache.snapshot(len(record), timeout=None), seen[episode.ticks]
    assert end is not None
    assert end.past == f"episode 3, the end{who}"
    assert end.bodies == last.bodies
    assert sensed(end.agents[0]) == sensed(last.agents[0])
    assert paid(end.agents[0]) == paid(last.agents[0])
    assert end.agents[0].terminated == last.agents[0].terminated
    frame_cache.stop()


def test_who_begins_anew_has_done_nothing_yet() -> None:
    sim = field_of(
        driver("a", [GO, WAIT, LEFT, RESPAWN, GO, HOLD, GO], max_steps_per_episode=4),
        driver("b", [LEFT, RESPAWN, GO, HOLD, RESPAWN, GO], skip_frame=1),
    )
    recorder = Recorder(sim)
    sim.reset(3)
    for _ in range(50):
        sim.tick()
    recorder.finish()
    episode = recorder.episodes[-1]
    frame_cache = FrameCache(episode, agent="b").start()
    for step, decision in enumerate(episode.agent("b")):
        picture = frame_cache.snapshot(step, timeout=None)
        assert picture is not None
        assert picture.agents[1].action == decision.action
        assert picture.agents[1].reward_terms == decision.reward_terms
        assert picture.tick == decision.begin
    frame_cache.stop()


def test_who_waits_after_a_restart_is_shown_with_nothing_done() -> None:
    sim = field_of(driver("a", []), driver("b", [GO, GO, RESPAWN] + 100 * [WAIT]))
    recorder = Recorder(sim)
    sim.reset(3)
    for _ in range(40):
        sim.tick()
    recorder.finish()
    frame_cache = FrameCache(recorder.episodes[-1], agent="a").start()
    assert frame_cache.snapshot(frame_cache.last, timeout=None) is not None
    actions = []
    for step in range(frame_cache.last):
        picture = frame_cache.snapshot(step, timeout=None)
        assert picture is not None
        actions.append(picture.agents[1].action)
    assert actions[0] == {"move": (1.0, 0.0, 0.0, 0.0)}
    assert actions[3:] == [{}] * (len(actions) - 3)
    frame_cache.stop()


def test_with_little_memory_it_shows_the_same() -> None:
    episode = take("box_chase", decisions=120).episode
    whole, small = FrameCache(episode).start(), FrameCache(episode, largest=100_000).start()
    last = len(episode.agents[0])
    assert small.snapshot(last, timeout=None) is not None
    assert small.stride >= 4
    for step in (37, 36, 35, 2, last, 101, 5, last - 1, 0):
        one, other = whole.snapshot(step, timeout=None), small.snapshot(step, timeout=None)
        assert one is not None
        assert other is not None
        assert one.bodies == other.bodies
        assert sensed(one.agents[0]) == sensed(other.agents[0])
        assert paid(one.agents[0]) == paid(other.agents[0])
    assert len(small._frames) < last / 2
    whole.stop()
    small.stop()


def test_its_snapshots_take_no_more_memory_than_they_may() -> None:
    episode, _seen = lived("soccer", 60)
    taken = []
    for largest in (1_000_000, 100_000_000):
        tracemalloc.start()
        frame_cache = FrameCache(episode, largest=largest).start()
        assert frame_cache.snapshot(len(episode.agents[0]), timeout=None) is not None
        taken.append(tracemalloc.get_traced_memory()[0])
        frame_cache.stop()
        tracemalloc.stop()
    # all snapshots together take 3.4 MB; besides, both need the same
    assert taken[1] - taken[0] > 2_000_000


def test_a_snapshot_that_was_not_kept_is_made_with_as_many_as_fit() -> None:
    episode = take("box_chase", decisions=120).episode
    frame_cache = FrameCache(episode, largest=50_000).start()
    assert frame_cache.snapshot(119, timeout=None) is not None
    kept = len(frame_cache._frames)
    assert frame_cache.stride > 20
    assert frame_cache.snapshot(95, timeout=None) is not None
    assert len(frame_cache._frames) <= kept + 1
    frame_cache.stop()


def test_what_is_not_ready_is_made_and_can_be_asked_for_again() -> None:
    episode = take("box_chase", decisions=30).episode
    frame_cache = FrameCache(episode)
    assert frame_cache.snapshot(3) is None
    frame_cache.start()
    assert frame_cache.snapshot(3, timeout=None) is not None
    frame_cache.stop()


def test_it_ends_where_the_world_was_changed_by_hand() -> None:
    episode = replace(take("box_chase", decisions=30).episode, changed=60)
    frame_cache = FrameCache(episode).start()
    assert frame_cache.snapshot(11, timeout=None) is not None
    assert (frame_cache.last, frame_cache.ended) == (11, False)
    assert frame_cache.problem == "the world was changed by hand there"
    frame_cache.stop()


def test_what_can_not_be_played_has_no_pictures_and_says_why() -> None:
    episode = take("box_chase", decisions=5).episode
    scene = episode.scene.model_copy(update={"agents": ({"body": "nobody"},)})
    frame_cache = FrameCache(replace(episode, scene=scene))
    frame_cache.start()
    assert frame_cache.snapshot(0, timeout=None) is None
    frame_cache._thread.join()
    assert frame_cache.last == -1
    assert "the episode's scene can't be made" in frame_cache.problem
    frame_cache.stop()


class Lingering(FrameCache):
    """A cache whose thread lives on for a while after its work."""

    over = threading.Event()

    def _run(self) -> None:
        super()._run()
        assert self.over.wait(LIMIT_S)


def test_whoever_waits_for_what_can_not_be_made_is_told_before_the_thread_is_gone() -> None:
    episode = take("box_chase", decisions=5).episode
    scene = episode.scene.model_copy(update={"agents": ({"body": "nobody"},)})
    frame_cache = Lingering(replace(episode, scene=scene))
    frame_cache.start()
    with ThreadPoolExecutor(1) as pool:
        try:
            asked = pool.submit(frame_cache.snapshot, 0, timeout=None)
            assert asked.result(LIMIT_S) is None
        finally:
            frame_cache.over.set()
            frame_cache.stop()
    assert not frame_cache.is_alive
