"""Round trips a second with AI4U's package: ``python -m tests.benchmarks.ai4u_round_trips``.

The unmodified package drives an agent, as ``play`` runs it at full speed: in box_chase, and in an
empty world with a constant observation of box_chase's agent (most of the script's work is parsing
it, which depends on the number and length of its values). Then it talks to a bare responder, which
has no world and repeats the same bytes. They take turns, since the load of a machine changes; on a
busy one, put ``chrt -r 5`` in front (as root).
"""

import argparse
import math
import socket
import statistics
import threading
import time

import numpy as np
import numpy.typing as npt
from gymnasium.spaces import Box

from ai4u_edu import (
    BasicAgent,
    CircleShape,
    ControlRequestor,
    LocalBrain,
    RBMoveActuator,
    RemoteBrain,
    Scene,
    Sensor,
    World,
)
from ai4u_edu.blocks.brains.links.ai4u import AI4UCodec
from ai4u_edu.blocks.brains.links.link import Observation, describe_agent
from ai4u_edu.runtime.process_tuning import tuned_process
from ai4u_edu.runtime.runner import Runner
from ai4u_edu.wire.ai4u_dialogue import AI4UDialogue, SessionPhase
from ai4u_edu.world import BodyView, WorldView
from tests.remote.test_ai4u_package import free_port, run_script


def main() -> None:
    """Run the benchmark and print its table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=3000)
    parser.add_argument("--turns", type=int, default=5)
    options = parser.parse_args()
    found: dict[str, list[float]] = {"bare": [], "empty world": [], "box_chase": []}
    for turn in range(options.turns):
        found["bare"].append(without_a_world(options.steps))
        found["empty world"].append(with_a_world(empty_world(), options.steps))
        found["box_chase"].append(with_a_world(Scene.load("box_chase").build(), options.steps))
        print(turn + 1, *(f"{name} {rates[-1]:.0f}" for name, rates in found.items()), sep="  ")
    bare = statistics.median(found["bare"])
    for name, rates in found.items():
        middle = statistics.median(rates)
        print(f"{name}: {middle:.0f} round trips a second (median), {middle / bare:.0%} of bare")


class Constant(Sensor):
    """A reading that never changes."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.reading: npt.NDArray[np.float32] = np.zeros(1, np.float32)

    def space(self) -> Box:
        """Return a space of the reading's shape."""
        return Box(-np.inf, np.inf, self.reading.shape)

    def read(self, body: BodyView, view: WorldView) -> npt.NDArray[np.float32]:
        """Return the constant reading."""
        return self.reading


def constant(key: str, reading: npt.NDArray[np.float32]) -> Constant:
    """Return a sensor with a constant reading."""
    sensor = Constant(perception_key=key)
    sensor.reading = reading
    return sensor


def empty_world() -> ControlRequestor:
    """Return a robot in an empty world, with a constant observation of box_chase."""
    model = Scene.load("box_chase").build()
    model.reset(1)
    percept = model.step()
    world = World()
    world.add_body("robot", CircleShape(radius=0.5))
    agent = BasicAgent(
        body="robot",
        sensors=[constant(key, percept[key]) for key in ("vision", "orientation", "last_action")],
        actuators=[RBMoveActuator()],
        brains=[LocalBrain(controller=lambda percept: {})],
    )
    return ControlRequestor(world, [agent])


def with_a_world(sim: ControlRequestor, steps: int) -> float:
    """Return round trips a second with a world."""
    port = free_port()
    sim.agents[0].use_brain(RemoteBrain(port=port))
    runner = Runner(sim, seed=1, time_scale=math.inf)
    runner.start()
    with tuned_process():
        found = run_script("clocked.py", port, steps)
    runner.stop()
    return float(found)


def without_a_world(steps: int) -> float:
    """Return round trips a second with the bare responder."""
    port = free_port()
    ended = threading.Event()
    responder = threading.Thread(target=respond, args=(port, ended))
    responder.start()
    found = run_script("clocked.py", port, steps)
    ended.set()
    responder.join()
    return float(found)


def respond(port: int, ended: threading.Event) -> None:
    """Run the world's side of the protocol, without a world."""
    sim = Scene.load("box_chase").build()
    sim.reset(1)
    agent = sim.agents[0]
    codec = AI4UCodec(describe_agent(agent, skip_frame=4, repeat_action=True, tick=1 / 60))
    state = codec.state(
        Observation(
            number=1,
            episode=1,
            percept=agent.percept,
            reward=0.5,
            terms={},
            steps=1,
            tick=5,
            done=False,
            truncated=False,
            paused=False,
            stopped=False,
        )
    )
    dialogue = AI4UDialogue("0", metadata=codec.metadata)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as udp:
        udp.connect(("127.0.0.1", port))
        udp.settimeout(0.5)
        same = b""
        while not ended.is_set():
            if dialogue.phase is SessionPhase.PLAYING:
                same = same or dialogue.request(state)
            else:
                time.sleep(0.05)
            try:
                udp.send(same or dialogue.request(state))
                reply = udp.recv(2**16)
            except OSError:
                continue
            if not same:
                dialogue.parse_reply(reply)


if __name__ == "__main__":
    main()
