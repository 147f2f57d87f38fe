"""Networks that students hand in: what is kept, what counts, and what is refused unopened."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from ai4u_edu.classroom import ClassStore
from ai4u_edu.classroom.class_event import _library
from ai4u_edu.classroom.errors import NetworkError, StoreError
from ai4u_edu.classroom.tournament.network_scene import OWN_PLAYER, network_scenes
from ai4u_edu.classroom.tournament.networks import FOLDER, MAX_NETWORKS, NetworkRow, Networks
from ai4u_edu.wire.class_link import MAX_NETWORK_BYTES
from tests.classroom.two_seats import two_seats


@pytest.fixture
def store(tmp_path: Path) -> Iterator[ClassStore]:
    with two_seats(tmp_path) as store:
        yield store


def facts(networks: Networks) -> list[tuple[int, str, str, str]]:
    return [(each.seat, each.scene, each.file, each.verdict) for each in networks.rows]


def files(store: ClassStore) -> list[bytes]:
    return sorted(path.read_bytes() for path in (store.folder / FOLDER).iterdir())


def judged(networks: Networks, reason: str = "") -> NetworkRow:
    row = networks.next_open()
    assert row is not None
    networks.judge(row, reason)
    return row


def test_the_latest_network_of_a_seat_counts_once_it_has_passed_its_check(
    store: ClassStore,
) -> None:
    changed: list[int] = []
    networks = Networks(store, changed.append)
    networks.add(1, "sumo", "", "a.onnx", b"a")
    networks.add(1, "sumo", "", "b.onnx", b"b")  # before a was checked
    networks.add(2, "sumo", "", "of another.onnx", b"o")
    assert files(store) == [b"b", b"o"]
    judged(networks)
    assert facts(networks) == [
        (1, "sumo", "b.onnx", "right"),
        (2, "sumo", "of another.onnx", "open"),
    ]
    networks.add(1, "sumo", "", "c.onnx", b"c")
    assert [each.file for each in networks.playing("sumo")] == ["b.onnx"]
    judged(networks, "too large")
    judged(networks, "it is slow")
    assert [(each.file, each.reason) for each in networks.of_seat(1)] == [
        ("b.onnx", ""),
        ("c.onnx", "it is slow"),
    ]
    assert files(store) == [b"b"], "a refused file is not kept"
    networks.add(1, "sumo", "", "d.onnx", b"d")
    judged(networks)
    assert [each.file for each in networks.of_seat(1)] == ["d.onnx"]
    assert files(store) == [b"d"]
    assert changed == [1, 1, 2, 1, 1, 2, 1, 1, 1]
    assert Networks(store, changed.append).rows == networks.rows


def test_parts_and_scenes_have_networks_of_their_own(store: ClassStore) -> None:
    networks = Networks(store, lambda _: None)
    for scene, part in (("soccer", "striker"), ("soccer", "keeper"), ("soccer", ""), ("sumo", "")):
        networks.add(1, scene, part, "a.onnx", b"a")
    assert [each.place[1:] for each in networks.rows] == [
        ("soccer", "striker"),
        ("soccer", "keeper"),
        ("soccer", ""),
        ("sumo", ""),
    ]


def test_a_network_that_comes_again_over_a_link_counts_once(store: ClassStore) -> None:
    networks = Networks(store, lambda _: None)
    assert networks.add(1, "sumo", "", "a.onnx", b"a", "key-of-a")
    assert networks.add(1, "sumo", "", "b.onnx", b"b", "key-of-b")
    assert not networks.add(1, "sumo", "", "a.onnx", b"a", "key-of-a")
    assert not networks.add(2, "sumo", "", "a.onnx", b"a", "key-of-b")
    assert facts(networks) == [(1, "sumo", "b.onnx", "open")]
    assert files(store) == [b"b"]


def test_a_verdict_on_a_network_that_was_replaced_meanwhile_is_none(store: ClassStore) -> None:
    networks = Networks(store, lambda _: None)
    networks.add(1, "sumo", "", "a.onnx", b"a")
    row = networks.next_open()
    assert row is not None
    networks.add(1, "sumo", "", "b.onnx", b"b")
    networks.judge(row, "")
    assert facts(networks) == [(1, "sumo", "b.onnx", "open")]


@pytest.mark.parametrize(
    ("scene", "part", "file", "size", "told"),
    [
        ("chess", "", "a.onnx", 1, "scene: expected one of"),
        ("../sumo", "", "a.onnx", 1, "scene: expected one of"),
        ("sumo", "keeper", "a.onnx", 1, "part: Sumo has these parts: none; got 'keeper'"),
        ("soccer", "goal", "a.onnx", 1, "these parts: striker, keeper; got 'goal'"),
        ("sumo", "", "model.zip", 1, "Expected a network as an .onnx file, got 'model.zip'"),
        ("sumo", "", "a.onnx", 0, "This file is empty"),
        ("sumo", "", "a.onnx", MAX_NETWORK_BYTES + 1, "at most 5 MB"),
    ],
)
def test_invalid_networks_are_refused_with_a_sentence(
    store: ClassStore, scene: str, part: str, file: str, size: int, told: str
) -> None:
    networks = Networks(store, lambda _: None)
    with pytest.raises(NetworkError) as refused:
        networks.add(1, scene, part, file, bytes(size))
    assert told in str(refused.value)
    assert not (store.folder / FOLDER).exists()


def test_a_seat_has_a_limit_and_a_seat_that_is_gone_leaves_no_file(store: ClassStore) -> None:
    networks = Networks(store, lambda _: None)
    places = [(each.name, part) for each in network_scenes().values() for part in ("", *each.parts)]
    for scene, part in places[:MAX_NETWORKS]:
        networks.add(1, scene, part, "a.onnx", b"a")
    with pytest.raises(NetworkError, match="at most 12 networks"):
        networks.add(1, *places[MAX_NETWORKS], "a.onnx", b"a")
    networks.add(1, *places[0], "b.onnx", b"b")
    count = len(files(store))
    with pytest.raises(StoreError):
        networks.add(9, "sumo", "", "a.onnx", b"a")
    assert len(files(store)) == count == MAX_NETWORKS


def test_parts_of_scenes_and_their_own_players() -> None:
    scenes = network_scenes()
    parts = {each.name: each.parts for each in scenes.values() if each.parts}
    assert parts == {"soccer": ("striker", "keeper"), "tag": ("chaser", "runner")}
    network = {"kind": "network", "file": "a.onnx", "data": ""}
    # the scene has no controller for the chaser
    assert scenes["tag"].entry("a", {"runner": network}).drivers == {
        "runner": network,
        "chaser": {"kind": "random"},
    }
    keeper = scenes["soccer"].entry("a", {"striker": network}).drivers
    assert keeper["blue_keeper"] == keeper["orange_keeper"] == {"kind": "scene"}
    own = {name: each.own_player() for name, each in scenes.items()}
    assert {each.name for each in own.values() if each is not None} == {OWN_PLAYER}
    without = [name for name, each in own.items() if each is None]
    assert without == ["endless_rescue"]
    duels = {each["name"]: each["is_duel"] for each in _library()}
    assert duels == {name: not each.sides.is_race for name, each in scenes.items()}
