"""The unmodified ai4u package from PyPI drives our worlds.

Its scripts run as processes of their own, in the environment that ``tests.remote.ai4u_venv`` makes;
what they saw is compared with what the world recorded.
"""

import base64
import contextlib
import json
import math
import secrets
import socket
import subprocess
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from ai4u_edu import (
    AgentArraySensor,
    BasicAgent,
    CircleShape,
    ControlRequestor,
    HeadingSensor,
    LocalBrain,
    PositionSensor,
    RBMoveActuator,
    RemoteBrain,
    RestlessnessRewardFunc,
    Scene,
    World,
)
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.wire.ai4u import encode_request
from tests.remote import ai4u_venv
from tests.waiting import LIMIT_MS, LIMIT_S
from tests.wire.test_ai4u import EVERY_KIND

pytestmark = pytest.mark.slow

SCRIPTS = Path(__file__).with_name("ai4u_scripts")


PORTS = range(20_000, 32_000)
"""UDP ports that no system gives to another socket by itself while a script starts."""
PATIENT_SCRIPT = """
import runpy
import sys

# AI4U's threads tell each other what they wait for after they have asked for it. No thread takes
# the other's place in between: only one that waits itself lets go.
sys.setswitchinterval(600)
sys.argv = sys.argv[1:]
runpy.run_path(sys.argv[0], run_name="__main__")
"""


def free_port() -> int:
    """A UDP port that nobody listens at."""
    while True:
        port = secrets.choice(PORTS)  # tests in other processes may have seeded alike
        with (
            socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as udp,
            contextlib.suppress(OSError),
        ):
            udp.bind(("127.0.0.1", port))
            return port


def run_script(
    name: str,
    *args: object,
    given: bytes | None = None,
    once_it_listens: Callable[[], object] | None = None,
    trains: bool = False,
) -> Any:
    """Runs a script to its end; gives what it found.

    Args:
        name: of its file.
        args: its arguments.
        given: its input.
        once_it_listens: called when it has noted its agents: before, a request would end it.
        trains: see :func:`tests.remote.ai4u_venv.find`.
    """
    python = ai4u_venv.find(trains=trains)
    if python is None:
        pytest.skip("AI4U's package is not here; python -m tests.remote.ai4u_venv gets it")
    # -E: tests.late would let them wait in that very place
    command = [str(python), "-E", "-u", "-c", PATIENT_SCRIPT, str(SCRIPTS / name), *map(str, args)]
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, stderr=pipe) as script:
        assert script.stdout is not None
        try:
            if once_it_listens is not None:
                while b"ai4u2godot started" not in (line := script.stdout.readline()):
                    assert line, script.communicate()[1].decode()[-2000:]
                once_it_listens()
            told, errors = script.communicate(given)
        finally:
            script.kill()
    output = told.decode()
    found = [line for line in output.splitlines() if line.startswith("RESULT ")]
    assert found, output[-2000:] + errors.decode()[-2000:]
    return json.loads(found[-1].removeprefix("RESULT "))


class Record:
    """Steps and percepts of an agent, recorded in the world."""

    def __init__(self, agent: BasicAgent) -> None:
        self.steps: list[tuple[int, float, bool]] = []
        """(decision of the episode, reward, whether the episode was over) of each decision."""
        self.percepts: list[Any] = []
        agent.end_of_update_state.connect(self._sensed)

    def _sensed(self, agent: BasicAgent) -> None:
        if agent.steps:
            self.steps.append((agent.steps, agent.reward, agent.done))
            self.percepts.append(agent.percept)


@contextlib.contextmanager
def running(sim: ControlRequestor) -> Iterator[Runner]:
    """The world, as fast as it goes, in a thread; what a lost script left is done by nobody."""
    runner = Runner(sim, seed=1, time_scale=math.inf)
    runner.start()
    try:
        yield runner
    finally:
        runner.stop(LIMIT_S)
    assert runner.error == ""


def remote_scene(name: str = "box_chase", **fields: Any) -> tuple[ControlRequestor, int, Record]:
    """A scene whose agent waits for a script."""
    sim = Scene.load(name).build()
    agent = sim.agents[0]
    for field, value in fields.items():
        setattr(agent, field, value)
    port = free_port()
    agent.use_brain(RemoteBrain(port=port, receive_timeout=int(LIMIT_MS)))
    return sim, port, Record(agent)


def run_in(sim: ControlRequestor, name: str, *args: object, **options: Any) -> Any:
    """Run a script, and a world once the script listens; return what the script found."""
    with contextlib.ExitStack() as world:
        enter = partial(world.enter_context, running(sim))
        return run_script(name, *args, once_it_listens=enter, **options)


def test_a_thousand_steps_with_episodes_that_end(capsys: pytest.CaptureFixture[str]) -> None:
    sim, port, record = remote_scene(max_steps_per_episode=150)
    brain = sim.agents[0].brain
    assert isinstance(brain, RemoteBrain)
    ignored: list[int] = []
    """Datagrams that were no answer, at each step; a slow script answers two greetings."""

    def note(agent: BasicAgent) -> None:
        if agent.steps:
            ignored.append(brain.status().ignored)

    sim.agents[0].end_of_update_state.connect(note)
    found = run_in(sim, "steps.py", port, 1000)
    log = found["log"]
    assert [(each["steps"], each["reward"], each["done"]) for each in log] == record.steps[:1000]
    for each, percept in zip(log, record.percepts, strict=False):
        for name in ("vision", "orientation", "last_action"):
            seen = np.array(each["obs"][name], np.float32)
            assert seen.tobytes() == percept[name].tobytes()
    assert found["spaces"] == {"vision": [120], "orientation": [2], "last_action": [4]}
    status = brain.status()
    assert (status.decisions, status.refused) == (1000, 0)
    assert ignored[0] == ignored[-1]
    ends = sum(each["done"] for each in log)
    cuts = sum(each["truncated"] for each in log)
    assert ends >= 6
    assert 0 < cuts < ends  # some are cut off, and some fall
    with capsys.disabled():
        total = sum(each["reward"] for each in log)
        print(f"\n  ai4u 0.5.0: 1000 steps, {ends} episode ends, reward {total:.3f}: as recorded")


def test_pause_resume_and_stop() -> None:
    sim, port, record = remote_scene()
    seen = run_in(sim, "pausing.py", port)
    assert seen == [
        [1, False, False],
        [1, True, False],
        [1, True, False],  # ahead, and paused
        [1, False, False],
        [2, False, False],
        [2, False, True],
        [2, False, True],  # ahead, and stopped
        [2, False, True],  # a resume doesn't undo a stop
        [2, False, True],
        [0, False, False],  # a reset does
        [1, False, False],
    ]
    assert [steps for steps, _, _ in record.steps[:3]] == [1, 2, 1]


def pair() -> ControlRequestor:
    """Two robots in one world, with episodes of their own."""
    world = World()
    agents = []
    for index in range(2):
        world.add_body(f"robot{index}", CircleShape(radius=0.5), position=(0, 5 * index))
        agents.append(
            BasicAgent(
                body=f"robot{index}",
                id=str(index),
                max_steps_per_episode=8 + index,
                sensors=[PositionSensor(), HeadingSensor()],
                actuators=[RBMoveActuator()],
                rewards=[RestlessnessRewardFunc(reward=-0.1 - index)],
                brains=[LocalBrain(controller=lambda percept: {})],
            )
        )
    return ControlRequestor(world, agents)


@pytest.mark.parametrize("ports", [2, 1])
def test_two_agents_with_their_ids(ports: int) -> None:
    sim = pair()
    listening = [free_port(), free_port()]
    records = []
    for agent, port in zip(
        sim.agents, listening if ports == 2 else [listening[0]] * 2, strict=True
    ):
        agent.use_brain(RemoteBrain(port=port, receive_timeout=int(LIMIT_MS)))
        records.append(Record(agent))
    found = run_in(sim, "two_agents.py", *listening, 20)
    assert found["ids"] == ["0", "1"]
    for agent_id, record in zip(found["ids"], records, strict=True):
        mine = [
            (steps, reward, done) for id_, steps, reward, done in found["log"] if id_ == agent_id
        ]
        assert mine == record.steps[:20]
        assert sum(done for _, _, done in mine) == 2  # each began episodes of its own
    assert sim.episode == 1


def test_fields_reach_the_agent_and_unknown_ones_are_reported_to_the_script() -> None:
    world = World()
    world.add_body("robot", CircleShape(radius=0.5))
    port = free_port()
    brain = RemoteBrain(port=port, receive_timeout=int(LIMIT_MS))
    agent = BasicAgent(
        body="robot",
        sensors=[PositionSensor(), AgentArraySensor(perception_key="goal", size=2)],
        actuators=[RBMoveActuator()],
        brains=[brain],
    )
    found: list[dict[str, tuple[str, ...]]] = []
    agent.end_of_step.connect(lambda agent: found.append(agent.fields))
    first, then = run_in(ControlRequestor(world, [agent]), "fields.py", port)
    assert first == [[0, 0], ""]
    assert then[0] == [0.25, 1]
    assert then[1].startswith("field 'nobody' of 'move' had no effect: expected names of other")
    assert found[0] == {"goal": ("0.25", "1"), "nobody": ("7",)}
    assert brain.status().warning == then[1]


@pytest.mark.nightly
def test_their_training_script_learns(capsys: pytest.CaptureFixture[str]) -> None:
    sim, port, record = remote_scene(max_steps_per_episode=120)
    found = run_in(sim, "train.py", port, 500, trains=True)
    log = [(reward, done) for reward, done in found["log"]]
    # stable-baselines3 keeps rewards as float32
    recorded = [(float(np.float32(reward)), done) for _, reward, done in record.steps[:500]]
    assert log == recorded
    assert len(log) == 500
    assert found["updates"] >= 350
    ends = sum(done for _, done in log)
    assert ends >= 4
    with capsys.disabled():
        total = sum(reward for reward, _ in log)
        print(
            f"\n  ai4u 0.5.0, SAC: 500 steps, {found['updates']} updates, {ends} episode ends, "
            f"reward {total:.3f}: as recorded"
        )


def test_every_kind_of_field_is_understood() -> None:
    told = run_script("decode.py", given=encode_request(EVERY_KIND))
    assert np.array(told.pop("eyes"), np.float32).tolist() == EVERY_KIND[6].value.tolist()
    assert told == {
        "reward": -0.1,
        "steps": -7,
        "done": True,
        "truncated": False,
        "TimeLimit.truncated": False,
        "id": "Zoë @ 0;1",
        "raw": base64.b64encode(bytes(range(256))).decode(),  # it leaves bytes as they came
        "codes": [300, -4],
        "pictures": ["aGk=", "eQ=="],
    }
