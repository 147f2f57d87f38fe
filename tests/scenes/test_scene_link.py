"""Links that hold a scene: what they keep, and what they refuse."""

import zlib
from base64 import urlsafe_b64encode
from random import Random

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from ai4u_edu.base.errors import AI4UError, SceneError
from ai4u_edu.base.seeding import MAX_SEED
from ai4u_edu.page.editing.sharing import read_shared, shared_link
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.scene_link import (
    MAX_LINK_CHARS,
    MAX_TEXT_BYTES,
    decode_link,
    encode_link,
    is_link,
)

MAZE = Scene.load("maze")
LINK = shared_link(MAZE, 5).fragment


def packed(data: bytes) -> str:
    return "scene=" + urlsafe_b64encode(zlib.compress(data, 9)).decode().rstrip("=")


@pytest.mark.parametrize(
    "name", [name for name in Scene.names() if not Scene.load(name).description.pictures]
)
def test_each_scene_comes_back_with_its_seed_and_comments(name: str) -> None:
    scene = Scene.load(name)
    link = shared_link(scene, MAX_SEED)
    assert link.needs == ()
    assert len(link.fragment) < 4000  # chat programs cut longer ones
    shared = read_shared(link.fragment)
    assert shared.scene == scene
    assert shared.seed == MAX_SEED
    assert shared.scene.dumps() == scene.dumps()


@pytest.mark.parametrize(
    "link",
    [
        LINK,
        f"#{LINK}",
        f"  http://127.0.0.1:8080/#{LINK}\n",
        f"https://school.example/lab/?agent=0#{LINK}",
        f"{LINK[:70]}\n{LINK[70:]}",
        f"{LINK}&more=1",
    ],
)
def test_a_link_may_be_given_whole_or_in_part_or_over_two_lines(link: str) -> None:
    assert is_link(link)
    assert read_shared(link) == (MAZE, 5)


@given(st.text(max_size=300), st.none() | st.integers(0, MAX_SEED))
def test_any_text_comes_back(text: str, seed: int | None) -> None:
    assert decode_link(encode_link(text, seed)) == (text, seed)


@example(place=1298, char="_")
@given(st.integers(6, len(LINK.partition("&")[0]) - 2), st.sampled_from("Aa0_-%+é "))
def test_a_damaged_link_says_so(place: int, char: str) -> None:
    damaged = LINK[:place] + char + LINK[place + 1 :]
    assume(damaged != LINK)
    told = ""
    try:
        link = decode_link(damaged)
    except SceneError as error:
        told = str(error)
    else:  # a few bits fill up the last byte before the checksum, and mean nothing
        assert link == decode_link(LINK)
    assert not told or "damaged" in told


@pytest.mark.parametrize("cut", [7, 20, 200, -30])
def test_a_link_that_was_cut_says_so(cut: int) -> None:
    with pytest.raises(SceneError, match="damaged: a part of it is missing"):
        decode_link(LINK.partition("&")[0][:cut])


@pytest.mark.parametrize("size", [MAX_TEXT_BYTES + 1, 60_000_000])
def test_a_decompression_bomb_is_refused(size: int) -> None:
    link = packed(b"a" * size)
    assert len(link) < MAX_LINK_CHARS
    with pytest.raises(SceneError, match=f"at most {MAX_TEXT_BYTES} bytes"):
        decode_link(link)


def test_more_after_the_end_is_damage() -> None:
    data = zlib.compress(b"name: x") + b"more"
    with pytest.raises(SceneError, match="damaged"):
        decode_link("scene=" + urlsafe_b64encode(data).decode())


@pytest.mark.parametrize("seed", ["-1", "1.5", "x", "", str(MAX_SEED + 1), "9" * 5000, "٣"])
def test_another_seed_is_refused(seed: str) -> None:
    with pytest.raises(AI4UError, match=f"seed.*0 to {MAX_SEED}"):
        decode_link(f"{LINK.partition('&')[0]}&seed={seed}")


def test_a_link_is_bounded() -> None:
    with pytest.raises(SceneError, match="characters"):
        decode_link("scene=" + "A" * (MAX_LINK_CHARS + 1))
    with pytest.raises(SceneError, match="characters"):
        decode_link("scene=" + "A" * 5_000_000)
    with pytest.raises(SceneError, match="share its file"):
        encode_link(Random(1).randbytes(100_000).hex())


@pytest.mark.parametrize("link", ["", "maze", "http://host/", "#scene", "seed=3"])
def test_something_else_is_no_link(link: str) -> None:
    assert not is_link(link)
    with pytest.raises(SceneError, match=r"expected #scene="):
        decode_link(link)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("LocalBrain", "StolenBrain", r"the link, line \d+: .*unknown type of brain 'StolenBrain'"),
        ("name: maze", "name: [", r"the link, line \d+"),
        ("  - id:", "  - host: evil.example\n    id:", "connect to 'evil.example'"),
        ("  - id:", "  - model_path: /etc/passwd\n    id:", "zoo:SCENE"),
    ],
)
def test_what_a_scene_must_not_have_is_told_as_in_files(old: str, new: str, said: str) -> None:
    text = MAZE.dumps()
    assert old in text
    with pytest.raises(AI4UError, match=said):
        read_shared(encode_link(text.replace(old, new, 1)))


def test_what_a_link_cannot_carry_is_named() -> None:
    plain = MAZE.plain()
    plain["agents"][0]["brains"] = [
        {
            "type": "LocalBrain",
            "controller": {"type": "NeuralNetController", "model_path": "mine.onnx"},
        }
    ]
    scene = Scene(MAZE.description.model_copy(update={"agents": tuple(plain["agents"])}))
    assert shared_link(scene, None).needs == ("mine.onnx",)
