"""Untrusted files: scenes and recorded episodes."""

import json
import random
import zlib
from functools import cache
from typing import Any

import msgpack
from ruamel.yaml import YAML

from ai4u_edu.base.errors import AI4UError
from ai4u_edu.blocks import Block
from ai4u_edu.recording import Episode, Recorder, RecordingError
from ai4u_edu.recording.episode import HEADER, MAX_RECORDING_BYTES, decode, encode
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.scene import LIBRARY
from tests.fuzz.mutate import ODD, bent, bent_and_packed, mangled
from tests.fuzz.target import MANY, Target

SMALL = """\
name: small
success: touch
world: {ticks_per_second: 60}
floors:
  - {name: plate, shape: {type: box, size: [10, 10]}}
bodies:
  - {name: robot, shape: {type: circle, radius: 0.5}, random: {x: [-3, 3], heading_deg: [0, 90]}}
  - {name: box, shape: {type: box, size: [1, 1]}, position: [3, 0], mass: 5, tags: [target]}
areas:
  - {name: goal, shape: {type: box, size: [1, 1]}, position: [-4, 0]}
agents:
  - id: "0"
    body: robot
    max_steps_per_episode: 50
    sensors:
      - {type: RayCastingSensor, rows: 1, columns: 4, group_code: {target: 2}}
      - {type: OrientationSensor, target: box, stacked_observations: 2}
    actuators:
      - {type: RBMoveActuator, move_amount: 2}
      - {type: RespawnActuator, poses: [[0, 0, 0]]}
    rewards:
      - {type: TouchRewardFunc, target: box, reward: 1, cause_episode_to_end: true}
    brains:
      - {type: LocalBrain, controller: {type: WASDRBMoveController}}
"""
TINY = """\
name: tiny
bodies: [{name: r, shape: {type: circle, radius: 0.5}}]
agents:
- body: r
  actuators: [{type: RBMoveActuator}]
  brains: [{type: LocalBrain, controller: {type: WASDRBMoveController}}]
"""

YAML_TOKENS = (
    b"&a ", b"*a", b"!!python/object:os.system ", b"<<: ", b"? ", b"- ", b": ", b"|\n", b">\n  ",
    b"%YAML 9\n", b"---\n", b"...\n", b"{", b"}", b"[" * 40, b"]", b"\t", b"'", b'"', b"#", b"\x00",
    b"\xff", b"\xef\xbb\xbf", b".inf", b".nan", b"1e400", b"0x" + b"f" * 400, b"9" * 5000, b"0o9",
    b"2026-13-45", b"2026-01-01", b"1:30:00", b"~", b"yes", b"@", b"`", b"\xe2\x80\xa8", b"\\u0000",
)  # fmt: skip


@cache
def _scenes() -> tuple[tuple[bytes, ...], tuple[Any, ...], tuple[Any, ...]]:
    """Return scene texts, the same as plain data, and values to insert."""
    texts = [SMALL, TINY, *(path.read_text() for path in sorted(LIBRARY.glob("*.yaml")))]
    weights = [SMALL] * 30 + [TINY] * 100 + texts  # most are small: they are read much faster
    trees = [YAML(typ="safe").load(text) for text in weights]
    # one that looks out for a script would open a socket for each
    types = sorted(name for name in Block.types if "Remote" not in name)
    return tuple(text.encode() for text in weights), tuple(trees), (*ODD, *types, *_blocks(trees))


def _blocks(tree: Any) -> list[Any]:
    """Return all typed parts of some scenes, blocks and shapes, to insert in wrong places."""
    found: list[Any] = []
    for each in tree.values() if isinstance(tree, dict) else tree:
        if isinstance(each, dict | list):
            found += [each] if "type" in each else []
            found += _blocks(each)
    return found[:400]


def make_scene(rng: random.Random) -> bytes:
    """Return a scene file with a fault in it."""
    texts, trees, odd = _scenes()
    if rng.random() < 0.4:
        return mangled(rng.choice(texts), rng, YAML_TOKENS)
    tree = rng.choice(trees)
    for _ in range(rng.choice((1, 1, 2, 4))):
        tree = bent(tree, rng, odd)
    # of what JSON can't say, YAML has names of its own
    try:
        text = json.dumps(tree, default=repr, ensure_ascii=rng.random() < 0.5)
    except RecursionError:
        text = "name: deep\nbodies: " + "[" * 900 + "]" * 900
    text = text.replace("NaN", ".nan").replace("Infinity", ".inf")
    return text.encode(errors="replace")


def read_scene(data: bytes) -> None:
    """Load a scene; if that succeeds, write it, read it again, and play it."""
    try:
        text = data.decode()
    except UnicodeDecodeError:  # as when a file is opened
        text = data.decode("latin-1")
    scene = Scene.loads(text)
    sim = scene.build(seed=1)
    try:
        sim.reset(seed=1)
        sim.step()
        again = scene.dumps()
    finally:
        for agent in sim.agents:
            agent.brain.close()
    assert Scene.loads(again) == scene


@cache
def _episodes() -> tuple[tuple[bytes, Any], ...]:
    """Return recorded files, and their contents."""
    found = []
    for text in (TINY, SMALL):
        scene = Scene.loads(text)
        sim = scene.build()
        recorder = Recorder(sim, scene=scene.description)
        sim.reset(1)
        for _ in range(4):
            sim.step()
        sim.restart(sim.agents[0])
        sim.step()
        recorder.finish()
        whole = encode(recorder.episodes[-1])
        found.append((whole, msgpack.unpackb(zlib.decompress(whole[len(HEADER) :]))))
    return tuple(found)


def make_recording(rng: random.Random) -> bytes:
    """Return a recorded episode with a fault in the file, in the packed part or in the data."""
    whole, tree = rng.choice(_episodes())
    match rng.randrange(5):
        case 0:
            return mangled(whole, rng, (HEADER, b"\x78\xda", b"ai4u-edu episode 3\n"))
        case 1:
            plain = mangled(zlib.decompress(whole[len(HEADER) :]), rng)
        case 2:
            deep = rng.choice((b"\x91", b"\x81\xa1x")) * rng.choice((30, 400, 1018))
            odd = rng.choice(list(tree))
            plain = msgpack.Packer().pack_map_header(len(tree))
            for key, each in tree.items():
                value = deep + b"\xc0" if key == odd else msgpack.packb(each)
                plain += msgpack.packb(key) + value
        case _:
            plain = bent_and_packed(tree, rng)
    return HEADER + zlib.compress(plain, 1)


def read_recording(data: bytes) -> None:
    """Read an episode, its every decision, and write it again."""
    episode = decode(Episode, data, "x.episode")
    for record in episode.agents:
        for decision in record:
            assert decision.end >= decision.begin
    str(episode), episode.success, episode.places, episode.restart_places
    again = decode(Episode, encode(episode), "again.episode")
    assert encode(again) == encode(episode)


def read_packed(data: bytes) -> None:
    """Read the unpacked part of a file, since a fuzzer without zlib gets no further."""
    read_recording(HEADER + zlib.compress(data[:MAX_RECORDING_BYTES], 1))


SCENE = Target(
    "scene",
    make_scene,
    read_scene,
    (AI4UError,),
    count=MANY,
)
RECORDING = Target(
    "recording",
    make_recording,
    read_recording,
    (RecordingError,),
    count=MANY,
)
