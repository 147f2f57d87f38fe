"""Messages to AI4U scripts: readings, spaces and actions."""

import json
from typing import Any

import numpy as np

from ai4u_edu import (
    BearingSensor,
    DiscreteActuator,
    GroundStatusSensor,
    LocalGridSensor,
    PositionSensor,
    RBMoveActuator,
    StepSensor,
)
from ai4u_edu.blocks.brains.links.ai4u import AI4UCodec
from ai4u_edu.blocks.brains.links.link import (
    Observation,
    describe_agent,
)
from ai4u_edu.wire.ai4u import ReplyCommand, decode_request
from ai4u_edu.wire.ai4u_dialogue import AI4UDialogue, SessionPhase
from tests.builders import small_sim


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
        episode_reward=0.25,
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
    dialogue.phase = SessionPhase.PLAYING
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
    dialogue.phase = SessionPhase.PLAYING
    names = [field.name for field in decode_request(dialogue.request(codec.state(situation)))]
    assert names.count("steps") == 1


def test_one_of_a_few_is_discrete() -> None:
    sim = small_sim([BearingSensor(target="box")], actuators=[DiscreteActuator()])
    codec, _ = codec_of(sim)
    assert '"isContinuous": false, "shape": [5]' in codec.metadata
    action = codec.action([ReplyCommand("move", ("3",)), ReplyCommand("note", ("hello",))])
    assert action == {"move": ("3",)}
    assert sim.agents[0].actuators[0].accept(action["move"]) == (3.0,)


def test_of_several_actuators_the_first_is_the_policys() -> None:
    codec, _ = codec_of(
        small_sim(actuators=[RBMoveActuator(), DiscreteActuator(action_name="pick")])
    )
    metadata = json.loads(codec.metadata)
    assert metadata["inputs"] == []
    assert [each["name"] for each in metadata["outputs"]] == ["move"]
    orders = [ReplyCommand("move", ("1",)), ReplyCommand("pick", ("3",))]
    assert codec.action(orders) == {"move": ("1",), "pick": ("3",)}


def test_a_percepts_floats_arrive_as_they_are() -> None:
    sim = small_sim([BearingSensor(target="box")])
    sim.agents[0].body.move_to(0.3, 0.7, heading=1.1)
    sim.agents[0].sense()
    codec, situation = codec_of(sim)
    dialogue = AI4UDialogue("0", metadata=codec.metadata)
    dialogue.phase = SessionPhase.PLAYING
    fields = {
        field.name: field for field in decode_request(dialogue.request(codec.state(situation)))
    }
    sent = fields["bearing"].value.astype(np.float32)
    assert sent.tobytes() == situation.percept["bearing"].tobytes()
