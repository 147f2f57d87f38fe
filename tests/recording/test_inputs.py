"""Numbers that a script gives an agent are in recordings, and a replay senses them."""

from pathlib import Path

from ai4u_edu import AgentArraySensor, BasicAgent, LocalBrain, Scene
from ai4u_edu.agent.cycle import ControlRequestor
from ai4u_edu.recording import Episode, Recorder, Replay
from tests.recording.kept import FOLDER

SCENE = Scene.loads("""
name: told
bodies: [{name: robot, shape: {type: circle, radius: 0.5}}]
agents:
  - body: robot
    max_steps_per_episode: 6
    sensors:
      - {type: AgentArraySensor, perception_key: goal, size: 2, range_max: 100}
      - {type: AgentArraySensor, perception_key: kept, range_max: 100, resetable: false}
    actuators: [{type: RBMoveActuator}]
    brains: [{type: LocalBrain, controller: {type: ReplayController, actions: [{}]}}]
""")


def sensor(agent: BasicAgent, key: str) -> AgentArraySensor:
    found = next(each for each in agent.sensors if each.perception_key == key)
    assert isinstance(found, AgentArraySensor)
    return found


def drive(sim: ControlRequestor) -> list[bytes]:
    """Run some decisions while a script and handlers give numbers at all sorts of moments."""
    agent = sim.agents[0]
    percepts: list[bytes] = []
    agent.percept_ready.connect(lambda each: percepts.append(each.percept.data))
    count = iter(range(1, 100))
    agent.begin_of_update_state.connect(lambda each: sensor(each, "goal").set_value(0, next(count)))
    agent.before_the_reset.connect(lambda each: sensor(each, "goal").set_value(1, 50))
    agent.begin_of_episode.connect(lambda each: sensor(each, "kept").set_value(0, 7))
    sim.reset(3)
    for decision in range(9):
        sim.step()
        if decision % 2:
            sensor(agent, "goal").set_value(1, decision)
        if decision == 5:
            sensor(agent, "kept").set_value(0, 9)
            sim.restart(agent)
    return percepts


def test_a_replay_senses_what_a_script_gave(tmp_path: Path) -> None:
    sim = SCENE.build(brains=lambda _: LocalBrain(controller=lambda _: {}))
    recorder = Recorder(sim, scene=SCENE.description)
    percepts = drive(sim)
    recorder.finish()
    episode = Episode.load(recorder.episodes[-1].save(tmp_path / "told.episode"))
    assert {given.name for given in episode.inputs} == {"goal", "kept"}
    assert episode.inputs == recorder.episodes[-1].inputs
    replay = Replay(episode)
    assert replay.verdict.why == ""
    replayed = [percept.data for part in replay.percepts() for percept in part]
    assert replayed == percepts
    assert replay.at(4).snapshot.agents[0].percept.data == percepts[4]


def test_what_is_kept_through_a_reset_is_in_the_next_recording() -> None:
    sim = SCENE.build(brains=lambda _: LocalBrain(controller=lambda _: {}))
    recorder = Recorder(sim, scene=SCENE.description)
    sim.reset(1)
    sim.step()
    sensor(sim.agents[0], "kept").set_value(0, 3)
    sensor(sim.agents[0], "goal").set_value(0, 3)
    sim.reset(2)
    assert sim.agents[0].percept["kept"] == [3]
    sim.step()
    recorder.finish()
    episode = recorder.episodes[-1]
    assert [given.name for given in episode.inputs] == ["kept"]
    assert Replay(episode).verdict.why == ""


def test_a_script_goes_on_after_a_replay() -> None:
    sim = SCENE.build(brains=lambda _: LocalBrain(controller=lambda _: {}))
    recorder = Recorder(sim, scene=SCENE.description)
    drive(sim)
    recorder.finish()
    there = Replay(recorder.episodes[-1]).continue_from(
        4, brains={"0": LocalBrain(controller=lambda _: {})}
    )
    sensor(there.agents[0], "goal").set_values([1, 2])
    there.step()
    assert there.agents[0].percept["goal"].tolist() == [1, 2]


def test_files_of_the_first_version_are_read(tmp_path: Path) -> None:
    episode = Episode.load(next(FOLDER.glob("*.episode")))
    assert episode.inputs == ()
    data = episode.save(tmp_path / "again.episode").read_bytes()
    old = b"ai4u-edu episode 1" + data[len(b"ai4u-edu episode 1") :]
    (tmp_path / "old.episode").write_bytes(old)
    assert Episode.load(tmp_path / "old.episode").seed == episode.seed
