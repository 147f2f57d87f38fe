"""What a RemoteBrain makes of what its link gives it; without a network."""

import json
import math
import time
from typing import Any

import numpy as np
import pytest

from ai4u_edu import (
    BasicAgent,
    BearingSensor,
    CircleShape,
    Command,
    ControlRequestor,
    DiscreteActuator,
    GroundStatusSensor,
    LocalBrain,
    LocalGridSensor,
    PositionSensor,
    RBMoveActuator,
    RemoteBrain,
    StepSensor,
    World,
)
from ai4u_edu.base.errors import ParameterError, SetupError
from ai4u_edu.blocks.brains.links.ai4u_codec import AI4UCodec
from ai4u_edu.blocks.brains.links.link import (
    AgentSpec,
    LinkState,
    Observation,
    Reply,
    Reset,
    describe_agent,
)
from ai4u_edu.blocks.brains.patience import YIELD_AFTER_S
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.wire.ai4u import Order, decode_request
from ai4u_edu.wire.ai4u_dialogue import AI4UDialogue, Phase
from tests.builders import small_sim

AHEAD = {"move": [1, 0, 0, 0]}


class PaperLink:
    """A link whose script is a list of answers; each is to what was told last."""

    def __init__(self, *answers: Any) -> None:
        self.answers = list(answers)
        self.state = LinkState.CONNECTED
        self.reason = ""
        self.ignored = 0
        self.time_asked_at = 0.0
        self.expects_reply = True
        self.will_notify = False
        self.told: list[Observation] = []
        self.refused: list[str] = []
        self.may_try_again = False
        self.timeouts: list[float] = []
        self.closed = ""
        self.idled = 0

    def open(self, offer: AgentSpec) -> None:
        self.offer = offer

    def tell(self, situation: Observation) -> None:
        self.told.append(situation)

    def ask(self, situation: Observation, timeout: float) -> Reply | None:
        self.timeouts.append(timeout)
        if not self.told or self.told[-1] is not situation:
            self.told.append(situation)
        answer = self.answers.pop(0) if self.answers else None
        if answer is None or isinstance(answer, Reply):
            return answer
        return Reply(answer, situation)

    def refuse(self, answered: Reply, reason: str) -> bool:
        self.refused.append(reason)
        return self.may_try_again

    def idle(self) -> None:
        self.idled += 1

    def close(self, reason: str) -> None:
        self.closed = reason


def over(link: PaperLink, **fields: Any) -> Any:
    brain_fields = {
        name: fields.pop(name)
        for name in ("mode", "on_missing", "receive_timeout", "skip_frame")
        if name in fields
    }
    brain = RemoteBrain.with_link(link, **({"skip_frame": 0} | brain_fields))
    sim = small_sim([BearingSensor(target="box")], brains=[brain], **fields)
    return sim, brain


def test_an_action_is_carried_out_and_the_next_situation_is_told() -> None:
    link = PaperLink(AHEAD, AHEAD)
    sim, brain = over(link)
    for _ in range(2):
        sim.tick()
    assert [each.number for each in link.told] == [1, 2, 3]
    assert [each.steps for each in link.told] == [0, 1, 2]
    assert link.told[1].percept is not link.told[0].percept
    assert brain.status().decisions == 2


def test_who_drives_in_its_place_decides_and_its_answers_are_counted() -> None:
    back = {"move": [-1, 0, 0, 0]}
    link = PaperLink(AHEAD, AHEAD, None, Command.STOP, Reset(7), AHEAD)
    sim, brain = over(link)
    sim.tick()
    brain.begin_override(LocalBrain(controller=lambda _: back))
    for _ in range(3):
        sim.tick()
        assert sim.agents[0].last_action["move"][0] == -1
        assert not sim.waiting_for_brain  # nobody waits for it
    assert [each.steps for each in link.told] == [0, 1, 2, 3, 4]
    assert link.timeouts[1:] == [0.0] * 3
    assert (brain.status().ignored, brain.status().decisions) == (2, 1)
    assert brain.status().state == "connected"
    sim.tick()  # a reset is not an action
    assert (sim.episode, sim.world.seeds.seed) == (2, 7)
    brain.end_override()
    sim.tick()
    assert sim.agents[0].last_action["move"][0] == 1


def test_a_person_who_restarts_asks_for_no_seed_of_the_scripts() -> None:
    link = PaperLink(Reset(7))
    sim, brain = over(link)
    sim.tick()
    assert brain.restart_seed() == 7
    brain.begin_override(LocalBrain(controller=lambda _: Command.RESTART))
    sim.tick()
    assert sim.episode == 3
    assert sim.world.seeds.seed != 7


def test_hold_lets_no_time_pass_and_asks_the_same_again() -> None:
    link = PaperLink(None, None, AHEAD)
    sim, _ = over(link)
    for _ in range(2):
        sim.tick()
        assert sim.waiting_for_brain
    assert sim.world.ticks == 0
    sim.tick()
    assert not sim.waiting_for_brain
    assert sim.world.ticks == 1
    assert [each.steps for each in link.told] == [0, 1]


def test_who_waits_for_a_call_keeps_the_world_waiting() -> None:
    link = PaperLink(None, AHEAD)
    sim, brain = over(link)
    sim.tick()
    assert (sim.waiting_for_brain, brain.keeps_waiting) == (True, False)  # it has to be asked
    link.will_notify = True
    assert brain.keeps_waiting
    brain.begin_override(LocalBrain(controller=lambda _: {}))
    assert not brain.keeps_waiting
    brain.end_override()
    link.will_notify = False
    sim.tick()
    link.will_notify = True
    assert (sim.waiting_for_brain, brain.keeps_waiting) == (
        False,
        True,
    )  # it was told what it brought
    brain.mode = "realtime"
    assert not brain.keeps_waiting


def test_a_call_ticks_nothing_and_a_world_that_was_called_is_not_asked_again_in_vain(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("ai4u_edu.runtime.world_thread.ANSWER_POLL_S", 5.0)
    link = PaperLink(Reset(7))
    sim, _ = over(link)
    runner = Runner(sim, time_scale=math.inf)
    runner.advance()
    runner.advance()
    assert sim.waiting_for_brain
    link.answers.append(AHEAD)
    link.will_notify = True
    link.timeouts.clear()
    runner.expect_answer()
    runner.notify_answer()
    assert sim.world.ticks == 0  # whoever calls has other things to do
    runner.start()
    try:
        while sim.world.ticks == 0:
            time.sleep(0.001)
        assert runner.submit(lambda: (sim.world.ticks, len(link.timeouts))).result(4) == (1, 1)
    finally:
        runner.stop()


def pair(link: PaperLink, controller: Any) -> ControlRequestor:
    """A remote agent that decides at every tick, and one of ours that decides at every fifth."""
    world = World()
    agents = []
    for index, brain in enumerate(
        (RemoteBrain.with_link(link, skip_frame=0), LocalBrain(controller=controller, skip_frame=4))
    ):
        world.add_body(f"robot{index}", CircleShape(), position=(0, 3 * index))
        agents.append(
            BasicAgent(
                body=f"robot{index}",
                id=str(index),
                actuators=[RBMoveActuator()],
                brains=[brain],
            )
        )
    sim = ControlRequestor(world, agents)
    sim.reset(0)
    return sim


def test_what_the_others_decided_meanwhile_begins_when_the_world_goes_on() -> None:
    asked = []

    def other(percept: Any) -> dict[str, Any]:
        asked.append(sim.world.ticks)
        return AHEAD

    sim = pair(PaperLink(None, None, {}), other)
    for _ in range(3):
        sim.tick()
    assert asked == [0]  # once, before the world went on
    assert sim.world.ticks == 1
    assert sim.agents[1].body.position[0] > 0


def test_a_restart_of_one_agent_does_not_wait_for_the_world_to_go_on() -> None:
    answers = iter([Command.RESPAWN, AHEAD])
    sim = pair(PaperLink(None, AHEAD), lambda percept: next(answers))
    sim.tick()
    assert sim.waiting_for_brain
    assert [agent.episode for agent in sim.agents] == [1, 2]
    assert sim.world.ticks == 0


def test_a_held_world_is_a_good_moment_for_a_command(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("ai4u_edu.runtime.world_thread.DECISION_WAIT_S", math.inf)
    sim = pair(PaperLink(), lambda percept: AHEAD)
    runner = Runner(sim, time_scale=math.inf)
    runner.start()
    assert runner.submit(lambda: (sim.waiting_for_brain, sim.between_decisions())).result(5) == (
        True,
        False,
    )
    runner.stop()


def test_a_script_that_asks_for_time_does_not_stop_the_others_for_long() -> None:
    link = PaperLink()
    sim = pair(link, lambda percept: AHEAD)
    began = time.monotonic()
    while sim.world.ticks < 5:
        assert time.monotonic() < began + 5
        link.time_asked_at = time.monotonic()
        sim.tick()
    assert time.monotonic() - began >= YIELD_AFTER_S
    assert [agent.steps for agent in sim.agents] == [0, 1]


@pytest.mark.parametrize(
    ("on_missing", "action"),
    [("hold", {"move": (1.0, 0.0, 0.0, 0.0)}), ("coast", {}), ("stop", {"move": (0.0,) * 4})],
)
def test_a_lost_script_is_replaced_by_the_policy(on_missing: str, action: dict[str, Any]) -> None:
    link = PaperLink(AHEAD)
    sim, brain = over(link, on_missing=on_missing)
    sim.tick()
    link.state, link.reason = LinkState.LOST, "gone"
    for _ in range(3):
        sim.tick()
    agent = sim.agents[0]
    assert (agent.steps, agent.last_action) == (4, action)
    status = brain.status()
    assert (status.state, status.reason, status.missing) == ("lost", "gone", 3)


def test_while_it_waits_for_a_script_the_agent_takes_no_decisions() -> None:
    link = PaperLink()
    link.state, link.expects_reply = LinkState.WAITING, False
    sim, brain = over(link)
    for _ in range(3):
        sim.tick()
    assert (sim.world.ticks, sim.agents[0].steps) == (3, 0)
    assert brain.status().state == "waiting"


def test_a_script_that_is_silent_for_too_long_is_late() -> None:
    link = PaperLink()
    sim, brain = over(link, receive_timeout=200, on_missing="stop")
    until = time.monotonic() + 5
    while sim.world.ticks == 0:
        assert time.monotonic() < until
        sim.tick()
    status = brain.status()
    assert (status.state, status.missing) == ("late", 1)
    assert status.reason.startswith("no action for 0.")
    link.answers.append(AHEAD)
    sim.tick()
    assert (brain.status().state, brain.status().reason) == ("connected", "")


def silent_sim(link: PaperLink, **fields: Any) -> Any:
    """A sim and its brain, in lockstep, whose script was silent for too long."""
    sim, brain = over(link, receive_timeout=200, **fields)
    sim.tick()
    until = time.monotonic() + 5
    while brain.status().state != "late":
        assert time.monotonic() < until
        sim.tick()
    return sim, brain


def test_a_script_that_was_given_up_is_not_waited_for() -> None:
    link = PaperLink(AHEAD)
    sim, brain = silent_sim(link)
    link.timeouts.clear()
    link.will_notify = True
    for missing in range(2, 30):
        sim.tick()
        assert not sim.waiting_for_brain
        assert not brain.keeps_waiting
        assert brain.status().missing == missing
    assert set(link.timeouts) == {0.0}
    assert "given up, the world goes on until it answers" in brain.status().reason
    sim.reset()
    sim.tick()
    assert not sim.waiting_for_brain  # in another episode neither


@pytest.mark.parametrize("speaks", ["late", "now", "asks for time", "resets"])
def test_a_script_that_was_given_up_is_waited_for_again_once_it_speaks(speaks: str) -> None:
    link = PaperLink(AHEAD)
    sim, brain = silent_sim(link)
    sim.tick()
    match speaks:
        case "late":
            link.answers.append(Reply({"move": [0, 1, 0, 0]}, link.told[1]))
        case "now":
            link.answers.append(AHEAD)
        case "resets":
            link.answers.append(Reset())
        case "asks for time":
            link.time_asked_at = time.monotonic()
    sim.tick()
    assert sim.agents[0].last_action != {"move": (0.0, 1.0, 0.0, 0.0)}
    sim.tick()
    assert sim.waiting_for_brain
    assert brain.status().state == "connected"
    link.answers.append({"move": [0, 0, 1, 0]})
    sim.tick()
    assert not sim.waiting_for_brain
    assert sim.agents[0].last_action == {"move": (0.0, 0.0, 1.0, 0.0)}


def test_another_script_begins_anew() -> None:
    link = PaperLink(AHEAD)
    sim, _ = silent_sim(link)
    link.state = LinkState.LOST
    sim.tick()
    link.state = LinkState.CONNECTED
    sim.tick()
    assert sim.waiting_for_brain


def test_a_late_answer_in_lockstep_is_dropped_and_counted() -> None:
    link = PaperLink(AHEAD)
    sim, brain = over(link)
    sim.tick()
    link.answers.append(Reply({"move": [0, 1, 0, 0]}, link.told[0]))  # that one is answered
    sim.tick()
    assert sim.waiting_for_brain
    assert brain.status().ignored == 1
    assert sim.agents[0].last_action == {"move": (1.0, 0.0, 0.0, 0.0)}


def test_in_real_time_nobody_waits_and_a_late_answer_is_for_the_next_decision() -> None:
    link = PaperLink(None, None)
    sim, brain = over(link, mode="realtime", on_missing="coast")
    for _ in range(2):
        sim.tick()
    assert set(link.timeouts) == {0.0}
    assert (sim.agents[0].steps, brain.status().missing) == (2, 2)
    link.answers.append(Reply(AHEAD, link.told[0]))
    sim.tick()
    assert sim.agents[0].last_action == {"move": (1.0, 0.0, 0.0, 0.0)}
    link.answers += [Reply(AHEAD, link.told[0])]
    sim.reset()
    sim.tick()
    assert sim.agents[0].last_action == {}  # it was meant for another episode
    assert brain.status().ignored == 1


def test_in_real_time_a_script_is_told_as_soon_as_the_agent_has_sensed() -> None:
    link = PaperLink()
    sim, brain = over(link, mode="realtime", skip_frame=1)
    agent = sim.agents[0]
    sim.tick()
    assert [told.steps for told in link.told] == [0]
    sim.tick()
    assert [told.steps for told in link.told] == [0, 1]
    assert link.told[-1].percept is agent.percept
    assert link.told[-1].tick == sim.world.ticks == 2
    link.answers.append(Reply(AHEAD, link.told[-1]))  # in time for the very next tick
    sim.tick()
    assert agent.last_action == {"move": (1.0, 0.0, 0.0, 0.0)}
    before = len(agent.end_of_update_state.handlers)
    brain.close()
    assert len(agent.end_of_update_state.handlers) == before - 1


def test_in_lockstep_a_script_thinks_while_the_world_finishes_its_tick() -> None:
    link = PaperLink(AHEAD)
    sim, _ = over(link)
    sim.tick()
    assert [told.steps for told in link.told] == [0, 1]
    assert link.told[1].percept is sim.agents[0].percept


def test_a_reset_with_a_seed_is_the_worlds() -> None:
    link = PaperLink(Reset(seed=77), AHEAD)
    sim, _ = over(link)
    sim.tick()
    assert (sim.world.seeds.seed, sim.episode) == (77, 2)
    sim.tick()
    assert link.told[-1].truncated is False  # it asked for it itself


def test_somebody_elses_reset_is_told_as_a_cut() -> None:
    link = PaperLink(AHEAD, None)
    sim, _ = over(link)
    for _ in range(2):
        sim.tick()
    sim.reset()
    sim.tick()
    last = link.told[-1]
    assert (last.done, last.truncated, last.reward, last.steps) == (True, True, 0.0, 1)
    link.answers.append(Reset())
    sim.tick()
    sim.tick()
    assert (link.told[-1].done, link.told[-1].steps) == (False, 0)


@pytest.mark.parametrize(
    ("numbers", "says"),
    [
        ([1, 0], "expected 4 numbers, got 2"),
        ([math.nan, 0, 0, 0], "expected finite numbers"),
        ([math.inf, 0, 0, 0], "expected finite numbers"),
        ("fast", "expected 4 numbers, got 'fast'"),
        (None, "expected 4 numbers, got None"),
    ],
)
def test_a_wrong_action_never_reaches_the_physics(numbers: Any, says: str) -> None:
    link = PaperLink({"move": numbers})
    sim, brain = over(link, on_missing="coast")
    sim.tick()
    assert sim.agents[0].last_action == {}
    assert says in link.refused[0]
    assert (brain.status().refused, brain.status().decisions) == (1, 0)


def test_where_the_transport_can_say_so_the_script_answers_again() -> None:
    link = PaperLink({"mvoe": [1]}, AHEAD)
    link.may_try_again = True
    sim, brain = over(link)
    sim.tick()
    assert sim.waiting_for_brain
    assert link.refused == ["agent '0' has no actuator 'mvoe'; did you mean 'move'?"]
    sim.tick()
    assert [each.number for each in link.told] == [1, 2]  # 1 was not told twice
    assert (brain.status().decisions, brain.status().missing) == (1, 0)


def test_numbers_out_of_range_are_cut_and_counted_once() -> None:
    sim, brain = over(PaperLink({"move": [7, 0, -3, 0]}))
    sim.tick()
    assert sim.agents[0].last_action == {"move": (1.0, 0.0, 0.0, 0.0)}
    assert brain.status().clipped == sim.agents[0].actuators[0].clipped == 2


def test_stop_is_a_matter_of_the_brain_so_that_a_reset_is_still_heard() -> None:
    link = PaperLink(Command.STOP, AHEAD, Reset(), AHEAD)
    sim, _ = over(link)
    for _ in range(2):
        sim.tick()
    assert (sim.agents[0].steps, link.told[1].stopped) == (0, True)
    for _ in range(2):
        sim.tick()
    assert (sim.agents[0].steps, link.told[-1].stopped) == (1, False)


def test_another_brain_closes_it_and_it_can_be_opened_again() -> None:
    link = PaperLink(AHEAD)
    sim, brain = over(link)
    agent = sim.agents[0]
    agent.use_brain(RemoteBrain.with_link(PaperLink()))
    assert link.closed
    with pytest.raises(SetupError, match=r"was closed; expected agent.use_brain"):
        brain.decide(agent.percept)
    agent.use_brain(brain)
    sim.tick()
    assert brain.status().decisions == 1


def test_an_idle_world_keeps_in_touch() -> None:
    link = PaperLink()
    _, brain = over(link)
    brain.idle()
    assert link.idled == 1


@pytest.mark.parametrize(
    ("fields", "says"),
    [
        ({"receive_timeout": 100}, "receive_timeout: expected at least 200, got 100"),
        ({"port": 0}, "port: expected at least 1, got 0"),
        ({"mode": "fast"}, "mode: expected 'lockstep' or 'realtime', got 'fast'"),
    ],
)
def test_wrong_parameters(fields: dict[str, Any], says: str) -> None:
    with pytest.raises(ParameterError, match=says):
        RemoteBrain(**fields)


# -- in AI4U's words -------------------------------------------------------------------------------


def codec_of(sim: Any) -> tuple[AI4UCodec, Observation]:
    agent = sim.agents[0]
    offer = describe_agent(agent, skip_frame=4, repeat_action=True, tick=1 / 60)
    situation = Observation(
        number=1,
        episode=1,
        percept=agent.percept,
        reward=0.25,
        terms={},
        steps=3,
        tick=9,
        done=False,
        truncated=False,
        paused=False,
        stopped=False,
    )
    return AI4UCodec(offer), situation


def test_pictures_go_out_as_one_png_a_channel_and_numbers_flat() -> None:
    sensors = [
        LocalGridSensor(width=6, height=4, channels=["wall", "target"], self_exclude=False),
        PositionSensor(stacked_observations=2, normalized=False),
        GroundStatusSensor(),
        StepSensor(perception_key="count"),
    ]
    codec, situation = codec_of(small_sim(sensors))
    inputs = {each["name"]: each for each in json.loads(codec.metadata)["inputs"]}
    assert {name: each["shape"] for name, each in inputs.items()} == {
        "local_grid": [2, 4, 6],
        "position": [6],
        "ground_status": [1],
    }
    grid = inputs["local_grid"]
    assert (grid["type"], grid["rangeMin"], grid["rangeMax"]) == (7, 0.0, 255.0)
    dialogue = AI4UDialogue("0", metadata=codec.metadata)
    dialogue.phase = Phase.PLAYING
    fields = {
        field.name: field for field in decode_request(dialogue.request(codec.state(situation)))
    }
    assert len(fields["local_grid"].value) == 2
    assert fields["position"].value.tolist() == [0.0] * 6
    assert fields["ground_status"].value.tolist() == [1.0]
    assert fields["count"].value == 0
    assert fields["reward"].value == 0.25


def test_a_sensor_with_a_standard_name_is_sent_once() -> None:
    codec, situation = codec_of(small_sim([BearingSensor(target="box"), StepSensor()]))
    dialogue = AI4UDialogue("0", metadata=codec.metadata)
    dialogue.phase = Phase.PLAYING
    names = [field.name for field in decode_request(dialogue.request(codec.state(situation)))]
    assert names.count("steps") == 1


def test_one_of_a_few_is_discrete() -> None:
    sim = small_sim([BearingSensor(target="box")], actuators=[DiscreteActuator()])
    codec, _ = codec_of(sim)
    assert '"isContinuous": false, "shape": [5]' in codec.metadata
    action = codec.action([Order("move", ("3",)), Order("note", ("hello",))])
    assert action == {"move": ("3",)}
    assert sim.agents[0].actuators[0].accept(action["move"]) == (3.0,)


def test_of_several_actuators_the_first_is_the_policys() -> None:
    codec, _ = codec_of(
        small_sim(actuators=[RBMoveActuator(), DiscreteActuator(action_name="pick")])
    )
    metadata = json.loads(codec.metadata)
    assert metadata["inputs"] == []
    assert [each["name"] for each in metadata["outputs"]] == ["move"]
    orders = [Order("move", ("1",)), Order("pick", ("3",))]
    assert codec.action(orders) == {"move": ("1",), "pick": ("3",)}


def test_a_percepts_floats_arrive_as_they_are() -> None:
    sim = small_sim([BearingSensor(target="box")])
    sim.agents[0].body.move_to(0.3, 0.7, heading=1.1)
    sim.agents[0].sense()
    codec, situation = codec_of(sim)
    dialogue = AI4UDialogue("0", metadata=codec.metadata)
    dialogue.phase = Phase.PLAYING
    fields = {
        field.name: field for field in decode_request(dialogue.request(codec.state(situation)))
    }
    sent = fields["bearing"].value.astype(np.float32)
    assert sent.tobytes() == situation.percept["bearing"].tobytes()
