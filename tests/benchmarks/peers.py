"""Other environments from the package index, each in a virtual environment of its own.

They do other things than the yardstick, so their figures show the order of magnitude only. Each
runs in a process of its own that waits for a line before every round, so it takes its turn like all
other contenders. ``python -m tests.benchmarks --peers`` makes them once, under ``.venvs/``.
"""

import contextlib
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

from tests.benchmarks.interleaved import Work

FOLDER = Path(__file__).resolve().parent.parent.parent / ".venvs"
INSTALL_TIMEOUT_S = 600
"""Timeout (s) of an installation."""
ROUNDS_TIMEOUT_S = 120.0
"""Time (s) for all rounds of one environment, ours in between included."""

LOOP = """
import sys
print("ready", flush=True)
for line in sys.stdin:
    for i in range(int(line)):
        step(i)
    print("done", flush=True)
"""


class Peer(NamedTuple):
    """Another environment."""

    title: str
    package: str
    """Requirements for pip, the environment's own package first."""
    steps: int
    """Steps in one round."""
    program: str
    """Python code that defines ``step(i)``."""
    worlds: int = 1
    """Number of worlds that one step moves."""


PEERS = {
    "lander": Peer(
        "LunarLander of Gymnasium, no rays",
        "gymnasium[box2d]==1.2.3",
        1000,
        """
import gymnasium
env = gymnasium.make("LunarLander-v3")
env.reset(seed=1)
def step(i):
    *_, terminated, truncated, _ = env.step(i % 4)
    if terminated or truncated:
        env.reset()
""",
    ),
    "waterworld": Peer(
        "Waterworld of PettingZoo, two agents with 30 rays",
        # its extra [sisl] wants Box2D compiled, for another environment
        "pettingzoo==1.24.3 pymunk<7 pygame scipy numpy<2",
        100,
        """
import numpy
from pettingzoo.sisl import waterworld_v4
env = waterworld_v4.parallel_env(n_pursuers=2, n_sensors=30)
env.reset(seed=1)
rng = numpy.random.default_rng(1)
def step(i):
    if not env.agents:
        env.reset()
    env.step({name: rng.uniform(-1, 1, 2).astype("f4") for name in env.agents})
""",
    ),
    "ir-sim": Peer(
        "ir-sim, 32 lidar rays",
        "ir-sim",
        60,
        """
import os, tempfile
import irsim, numpy
WORLD = '''
world: {height: 10, width: 10, step_time: 0.0667, sample_time: 0.0667, collision_mode: stop}
robot:
  - kinematics: {name: diff}
    shape: {name: circle, radius: 0.3}
    state: [5, 5, 0]
    goal: [9, 9, 0]
    sensors:
      - {name: lidar2d, range_min: 0, range_max: 10, angle_range: 6.28, number: 32}
obstacle:
  - number: 10
    distribution: {name: random, range_low: [1, 1, 0], range_high: [4, 4, 3.14]}
    shape: {name: rectangle, length: 0.4, width: 0.4}
'''
folder = tempfile.mkdtemp()
path = os.path.join(folder, "world.yaml")
with open(path, "w") as file:
    file.write(WORLD)
env = irsim.make(path, display=False, disable_all_plot=True, log_level="CRITICAL")
def step(i):
    env.step(numpy.array([[0.3], [0.5]]))
""",
    ),
    "playgrounds": Peer(
        "simple-playgrounds, 32 lidar rays",
        "simple-playgrounds==0.9.31 pymunk<7 numpy<2 scikit-image<0.25",
        60,
        """
from simple_playgrounds.agents.agents import BaseAgent
from simple_playgrounds.agents.parts.controllers import External
from simple_playgrounds.agents.sensors.robotic_sensors import Lidar
from simple_playgrounds.elements.collection.basic import Physical
from simple_playgrounds.engine import Engine
from simple_playgrounds.playgrounds.layouts import SingleRoom
room = SingleRoom(size=(400, 400))
for i in range(10):
    box = Physical("square", radius=8, movable=True, mass=5)
    room.add_element(box, ((50 + 70 * (i % 5), 60 + 250 * (i // 5)), 0))
agent = BaseAgent(controller=External())
base, own = agent.base_platform, agent.parts
agent.add_sensor(Lidar(base, invisible_elements=own, fov=360, resolution=32, max_range=400))
room.add_agent(agent, ((200, 200), 0))
engine = Engine(room)
forward, turn = agent.actuators[:2]
def step(i):
    engine.step({agent: {forward: 0.5, turn: 0.3}})
    engine.update_observations()
""",
    ),
    "vmas": Peer(
        "VMAS, navigation with lidar, one world",
        "vmas",
        30,
        """
import torch, vmas
torch.set_num_threads(1)
env = vmas.make_env(scenario="navigation", num_envs=1, device="cpu", seed=1, n_agents=1)
env.reset()
def step(i):
    env.step([torch.full((1, 2), 0.3)])
""",
    ),
    "vmas-1024": Peer(
        "VMAS, the same, 1,024 worlds at once",
        "vmas",
        10,
        """
import torch, vmas
torch.set_num_threads(1)
env = vmas.make_env(scenario="navigation", num_envs=1024, device="cpu", seed=1, n_agents=1)
env.reset()
def step(i):
    env.step([torch.full((1024, 2), 0.3)])
""",
        1024,
    ),
    "highway": Peer(
        "highway-env",
        "highway-env",
        2,
        """
import gymnasium, highway_env
env = gymnasium.make("highway-v0")
env.reset(seed=1)
def step(i):
    *_, terminated, truncated, _ = env.step(1)
    if terminated or truncated:
        env.reset()
""",
    ),
}


class PeerError(Exception):
    """An environment can't be installed or doesn't run; the text says why."""


@contextlib.contextmanager
def running(name: str, limit: float = ROUNDS_TIMEOUT_S) -> Iterator[Callable[[], tuple[Work, int]]]:
    """Run an environment as a contender, in a process of its own.

    Args:
        name: a key of :data:`PEERS`.
        limit: timeout in seconds for all rounds.

    Raises:
        PeerError: the environment can't be installed, doesn't start, or takes too long.
    """
    peer = PEERS[name]
    process = subprocess.Popen(
        [installed(peer), "-W", "ignore", "-c", peer.program + LOOP],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert process.stdin
    assert process.stdout
    to_it, from_it = process.stdin, process.stdout
    late = threading.Event()

    def stop() -> None:
        late.set()
        process.kill()

    def wait_for(word: str) -> None:
        last = ""
        for line in from_it:  # some print lines of their own first
            if line.strip() == word:
                return
            last = line
        if late.is_set():
            raise PeerError(f"not done within {limit:g} s")
        raise PeerError("it ended: " + _last_words(last))

    def work() -> None:
        with contextlib.suppress(BrokenPipeError):  # it has ended; wait_for says why
            to_it.write(f"{peer.steps}\n")
            to_it.flush()
        wait_for("done")

    timer = threading.Timer(limit, stop)
    timer.start()
    try:
        wait_for("ready")
        yield lambda: (work, peer.steps * peer.worlds)
    finally:
        timer.cancel()
        process.kill()
        process.communicate()


def installed(peer: Peer) -> Path:
    """Return the Python of a peer's virtual environment; make it if it is missing."""
    packages = peer.package.split()
    folder = FOLDER / f"peer-{packages[0].partition('=')[0].partition('[')[0]}"
    python, stamp = folder / "bin" / "python", folder / "made-of.txt"
    if stamp.exists() and stamp.read_text() == peer.package:
        return python
    print(f"Getting {packages[0]} ...", file=sys.stderr, flush=True)
    for command in (
        [sys.executable, "-m", "venv", "--clear", str(folder)],
        [str(python), "-m", "pip", "install", "--quiet", "--no-input", *packages],
    ):
        try:
            done = subprocess.run(
                command, capture_output=True, text=True, timeout=INSTALL_TIMEOUT_S, check=False
            )
        except subprocess.TimeoutExpired:
            raise PeerError(f"not installed within {INSTALL_TIMEOUT_S} s") from None
        if done.returncode:
            raise PeerError("can't be installed: " + _last_words(done.stdout + done.stderr))
    stamp.write_text(peer.package)
    return python


def _last_words(text: str) -> str:
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return lines[-1] if lines else "without a word"
