"""Results that wait for their acknowledgement, in memory and on disk."""

from pathlib import Path

import pytest

from ai4u_edu.member import ResultOutbox
from ai4u_edu.member import outbox as outbox_module
from ai4u_edu.wire.class_link import HandedInNetwork
from tests.member.messages import result


def test_results_stay_in_order_until_they_are_acknowledged() -> None:
    outbox = ResultOutbox()
    for number in (1, 2, 3, 2):
        outbox.add(result(number))
    outbox.acknowledge(result(2).key)
    outbox.acknowledge("never-seen")
    assert outbox.keys() == [result(1).key, result(3).key]
    assert outbox.frame(result(2).key) is None


def test_the_next_process_finds_what_was_left(tmp_path: Path) -> None:
    first = ResultOutbox(tmp_path / "new" / "folder")
    for number in range(3):
        first.add(result(number))
    first.acknowledge(result(1).key)
    second = ResultOutbox(tmp_path / "new" / "folder")
    assert second.keys() == [result(0).key, result(2).key]
    assert second.frame(result(0).key) == first.frame(result(0).key)
    first.acknowledge(result(0).key)
    second.acknowledge(result(0).key)
    second.acknowledge(result(2).key)
    assert list((tmp_path / "new" / "folder").iterdir()) == []
    assert second.problem == ""


def test_damaged_files_are_left_out(tmp_path: Path) -> None:
    ResultOutbox(tmp_path).add(result(1))
    (tmp_path / "0-damaged.result").write_bytes(b"\xff\x00")
    (tmp_path / "1-other.result").write_bytes(b"\x92\xa7applied\xa2a1")
    (tmp_path / "2-folder.result").mkdir()
    assert ResultOutbox(tmp_path).keys() == [result(1).key]


def test_the_oldest_ones_make_room(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(outbox_module, "MAX_RESULTS", 3)
    outbox = ResultOutbox(tmp_path)
    for number in range(5):
        outbox.add(result(number))
    assert outbox.keys() == [result(number).key for number in (2, 3, 4)]
    assert len(list(tmp_path.iterdir())) == 3
    size = len(outbox.frame(result(4).key) or b"")
    monkeypatch.setattr(outbox_module, "MAX_BYTES", 2 * size)
    assert ResultOutbox(tmp_path).keys() == [result(3).key, result(4).key]


def test_a_folder_that_can_not_be_written_to_is_told_and_results_stay_in_memory(
    tmp_path: Path,
) -> None:
    (tmp_path / "file").touch()
    outbox = ResultOutbox(tmp_path / "file" / "folder")
    outbox.add(result(1))
    assert outbox.keys() == [result(1).key]
    assert "results can't be kept in" in outbox.problem


def test_a_network_takes_the_place_of_one_before_for_the_same_scene(tmp_path: Path) -> None:
    outbox = ResultOutbox(tmp_path)
    for number, scene in enumerate(("sumo", "tag", "sumo")):
        outbox.add(HandedInNetwork(f"network-{number}", scene, "", "a.onnx", b"a"))
        outbox.add(result(number))
    kept = ["result-0000", "network-1", "result-0001", "network-2", "result-0002"]
    assert outbox.keys() == kept
    assert ResultOutbox(tmp_path).keys() == kept
