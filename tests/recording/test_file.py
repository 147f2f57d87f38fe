"""Episodes as files: small, and never believed."""

import tracemalloc
import zlib
from pathlib import Path
from typing import Any

import msgpack
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ai4u_edu import LocalBrain, Scene
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.recording import Episode, Recorder, RecordingError, Replay
from ai4u_edu.recording.episode import HEADER, MAX_UNPACKED_MB, decode, encode
from tests.recording.recorded_drives import take

EPISODE = take("tag", decisions=20).episode
BYTES = encode(EPISODE)
PLAIN: dict[str, Any] = msgpack.unpackb(zlib.decompress(BYTES[len(HEADER) :]))


def packed(plain: Any) -> bytes:
    return HEADER + zlib.compress(msgpack.packb(plain))


def error(data: bytes) -> str:
    with pytest.raises(RecordingError) as caught:
        decode(Episode, data, "mine.episode")
    return str(caught.value)


def test_there_and_back(tmp_path: Path) -> None:
    path = EPISODE.save(tmp_path / "one.episode")
    loaded = Episode.load(path)
    assert encode(loaded) == BYTES == path.read_bytes()
    assert loaded.scene == EPISODE.scene
    for one, other in zip(loaded.agents, EPISODE.agents, strict=True):
        assert list(one) == list(other)
    assert list(tmp_path.iterdir()) == [path]  # nothing is left beside it


def test_a_thousand_decisions_of_random_numbers_take_less_than_100_kb() -> None:
    scene = Scene.load("box_chase")
    sim = scene.build()
    rng = np.random.default_rng(1)

    def turning(percept: object) -> dict[str, Any]:  # it stays where it is, and lasts
        return {"move": [0.01 * rng.random(), 1 - 0.1 * rng.random(), *rng.random(2)]}

    sim.agents[0].use_brain(LocalBrain(controller=turning))
    recorder = Recorder(sim, scene=scene.description)
    sim.reset(1)
    for _ in range(1000):
        sim.step()
    recorder.finish()
    episode = recorder.episodes[-1]
    assert len(episode.agents[0]) == 1000
    assert len(encode(episode)) < 50_000
    assert Replay(episode).verdict.exact


def test_no_such_file(tmp_path: Path) -> None:
    path = tmp_path / "none.episode"
    with pytest.raises(RecordingError) as caught:
        Episode.load(path)
    assert str(caught.value) == f"{path}: can't be read: No such file or directory"


def test_something_else() -> None:
    assert error(b"GIF89a") == (
        "mine.episode: expected a recorded episode, as ai4u-edu record writes it, and this is none"
    )
    assert error(b"ai4u-edu episode 3\nabc") == (
        "mine.episode: an episode of another version of this package; expected "
        "'ai4u-edu episode 2', got b'3'"
    )


def test_truncated() -> None:
    for size in range(len(HEADER), len(BYTES), 97):
        assert error(BYTES[:size]) == "mine.episode: damaged: its end is missing"
    assert error(BYTES + b"x") == "mine.episode: damaged: something follows after its end"


def test_one_wrong_byte_anywhere_is_an_error() -> None:
    for place in range(len(HEADER), len(BYTES), 53):
        wrong = bytearray(BYTES)
        wrong[place] ^= 0x55
        assert error(bytes(wrong)).startswith("mine.episode: ")


def test_too_large(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    bomb = HEADER + zlib.compress(bytes(MAX_UNPACKED_MB * 2**20 + 1), 9)
    assert len(bomb) < 30_000
    assert error(bomb) == "mine.episode: expected at most 24 MB when it is unpacked"
    monkeypatch.setattr("ai4u_edu.recording.episode.MAX_RECORDING_BYTES", 1000)
    path = tmp_path / "big.episode"
    path.write_bytes(BYTES)
    with pytest.raises(RecordingError, match=r"big\.episode: expected at most 0 MB"):
        Episode.load(path)


@pytest.mark.slow
def test_what_is_unpacked_is_capped_while_it_is_unpacked() -> None:
    packer = zlib.compressobj(9)
    nothing = bytes(2**20)
    bomb = HEADER + b"".join(packer.compress(nothing) for _ in range(300)) + packer.flush()
    tracemalloc.start()
    text = error(bomb)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert text == "mine.episode: expected at most 24 MB when it is unpacked"
    assert peak < 100 * 2**20


def test_a_deep_nest() -> None:
    assert "can't be read" in error(HEADER + zlib.compress(b"\x91" * 1_000_000))


def test_a_long_list() -> None:
    assert "can't be read" in error(
        HEADER + zlib.compress(b"\xdd\x00\x20\x00\x00" + b"\xc0" * 2**21)
    )


def test_what_is_told_of_wrong_contents() -> None:
    assert error(packed([])) == "mine.episode: expected a mapping, got []"
    assert "unknown parameter; did you mean 'seed'?" in error(packed(PLAIN | {"sed": 1}))
    assert "seed: expected at least 0, got -1" in error(packed(PLAIN | {"seed": -1}))
    scene = PLAIN["scene"] | {"name": ""}
    assert "scene.name: expected at least 1 characters, got ''" in error(
        packed(PLAIN | {"scene": scene})
    )


def agent(**changes: Any) -> dict[str, Any]:
    first, *others = PLAIN["agents"]
    return PLAIN | {"agents": [first | changes, *others]}


def column(*numbers: int, size: int = 4) -> bytes:
    whole = b"".join(number.to_bytes(size, "little") for number in numbers)
    return b"".join(whole[place::size] for place in range(size))


@pytest.mark.parametrize(
    ("plain", "text"),
    [
        (PLAIN | {"agents": PLAIN["agents"][:1]}, "agents: expected those of the scene"),
        (agent(id="x"), "agents: expected those of the scene"),
        (agent(begin=b"abc"), "begin: expected numbers of 4 bytes, got 3 bytes"),
        (agent(skip=b""), "expected 20 skip, one for each decision, got 0"),
        (agent(skip=column(*[20_000] * 20, size=2)), "skip: expected at most 10000"),
        (agent(end=column(*range(20))), "end: expected decisions that end after they begin"),
        (agent(flags=bytes(19)), "expected 20 flags, one for each decision, got 19"),
        (agent(starts=b"", firsts=b""), "starts: expected one for each of the agent's episodes"),
        (agent(starts=column(0, 90), firsts=column(1, 2)), "starts: expected numbers of decisions"),
        (agent(action_numbers=b"\xff" * 8), "action_numbers: expected finite numbers"),
        (agent(action_numbers=bytes(8)), "action_numbers: expected "),
        (agent(action_form=column(*[9] * 20, size=2)), "action_form: expected numbers below"),
        (agent(action_forms=[[["move", -1]]]), "action_forms: expected names and how many"),
        (agent(action_forms=[[["move", 2], ["move", 2]]]), "action_forms: expected names and how"),
        (agent(rewards=b"\xff" * 160), "rewards: expected finite numbers"),
        (PLAIN | {"order": b""}, "order: expected all decisions of agent 'chaser' once each"),
        (
            PLAIN | {"restarts": [[3, [0]]]},
            "order: expected all restarts once each, in order",
        ),
        (PLAIN | {"ticks": 10**9}, "ticks: expected at most 4e+06, got 1000000000"),
        (PLAIN | {"ticks": 1}, "end: expected decisions that end after they begin"),
    ],
)
def test_what_does_not_hang_together(plain: dict[str, Any], text: str) -> None:
    assert text in error(packed(plain))


def test_time_goes_forward() -> None:
    order = EPISODE.order[::-1]
    assert "order: expected what happened later to come later" in error(
        packed(PLAIN | {"order": column(*order.tolist())})
    )


@pytest.mark.parametrize(
    ("changes", "text"),
    [
        (
            {"sensors": [{"type": "Sensors"}]},
            "agents[0].sensors[0].type: unknown type of sensor 'Sensors'",
        ),
        ({"body": "nobody"}, "no body is named 'nobody'"),
        (
            {"actuators": [{"type": "ScriptController", "function": "os.system"}]},
            "unknown type of actuator 'ScriptController'",
        ),
    ],
)
def test_a_scene_that_can_not_be_made(changes: dict[str, Any], text: str) -> None:
    first, *others = PLAIN["scene"]["agents"]
    scene = PLAIN["scene"] | {"agents": [first | changes, *others]}
    episode = decode(Episode, packed(PLAIN | {"scene": scene}), "x")
    with pytest.raises(RecordingError, match="the episode's scene can't be made: ") as caught:
        Replay(episode)
    assert text in str(caught.value)


def test_other_actions_do_not_play_exactly() -> None:
    nothing = bytes(len(PLAIN["agents"][0]["action_numbers"]))
    verdict = Replay(decode(Episode, packed(agent(action_numbers=nothing)), "x")).verdict
    assert (verdict.exact, verdict.exact_until) == (False, 1)
    assert verdict.why == "agent 'chaser', decision 0: what it sensed after it was something else"


def test_another_version_is_told() -> None:
    changed = agent(percepts=bytes(80)) | {"versions": PLAIN["versions"] | {"pymunk": "1.0"}}
    verdict = Replay(decode(Episode, packed(changed), "x")).verdict
    assert (verdict.exact, verdict.exact_until) == (False, 1)
    assert "it was recorded with pymunk 1.0 (here " in verdict.why


LEAVES = (
    st.none()
    | st.booleans()
    | st.integers(-(2**63), 2**63)
    | st.floats(allow_nan=False)
    | st.text(max_size=8)
    | st.binary(max_size=40)
)
ANYTHING = st.recursive(
    LEAVES,
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(st.text(max_size=8) | st.sampled_from(sorted(PLAIN)), inner, max_size=5)
    ),
    max_leaves=12,
)


def reads_or_refuses(data: bytes) -> None:
    """Nothing but a RecordingError ever comes of it; what can be read, can also be played."""
    try:
        episode = decode(Episode, data, "x")
    except RecordingError:
        return
    try:
        replay = Replay(episode)
        assert replay.verdict.exact_until >= 0
        list(replay.moments())
    except AI4UError:
        pass


@given(st.binary(max_size=200))
def test_any_bytes(data: bytes) -> None:
    reads_or_refuses(data)
    reads_or_refuses(HEADER + data)
    reads_or_refuses(HEADER + zlib.compress(data))


@pytest.mark.slow
@given(ANYTHING)
def test_any_contents(plain: Any) -> None:
    try:
        data = packed(plain)
    except OverflowError:
        return
    reads_or_refuses(data)


@pytest.mark.slow
@settings(max_examples=60, deadline=None)
@given(st.sampled_from(sorted(PLAIN)), ANYTHING)
def test_any_contents_in_place_of_the_right_ones(key: str, value: Any) -> None:
    try:
        data = packed(PLAIN | {key: value})
    except OverflowError:
        return
    reads_or_refuses(data)


@pytest.mark.slow
@settings(max_examples=20, deadline=None)
@given(st.sampled_from(sorted(PLAIN["agents"][0])), st.data())
def test_other_numbers_in_a_column(key: str, data: st.DataObject) -> None:
    new: Any = PLAIN["agents"][0][key]
    if isinstance(new, bytes):
        column = bytearray(new)
        for _ in range(data.draw(st.integers(1, 4)) if new else 0):
            column[data.draw(st.integers(0, len(new) - 1))] = data.draw(st.integers(0, 255))
        new = bytes(column)
    else:
        new = data.draw(ANYTHING)
    try:
        packed_again = packed(agent(**{key: new}))
    except OverflowError:
        return
    reads_or_refuses(packed_again)
