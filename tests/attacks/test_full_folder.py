"""A class's folder that is nearly full, and full: the teacher is told, and nothing more is kept."""

import sys
from contextlib import suppress
from pathlib import Path

import psutil
import pytest

from ai4u_edu.classroom.errors import StoreError
from ai4u_edu.classroom.folder_quota import MEASURE_S, FolderQuota
from tests.classroom.served_class import ServedClass, served_class
from tests.page.server.rooms import Clock
from tests.waiting import until

MB = 10**6
OFTEN = {"ai4u_edu.classroom.folder_quota.MEASURE_S": 0.05}


def test_a_folder_is_measured_now_and_then_and_told_before_it_is_full(tmp_path: Path) -> None:
    clock = Clock(1000.0)
    quota = FolderQuota(tmp_path, 0.01, clock)
    quota.measure()
    assert quota.warning == ""
    (tmp_path / "rooms").mkdir()
    file = tmp_path / "rooms" / "scene.yaml"
    file.write_bytes(bytes(9 * MB))
    quota.measure()
    assert quota.warning == ""  # it was measured just now
    clock.now += MEASURE_S
    quota.measure()
    assert "0.009 of its 0.01 GB" in quota.warning
    quota.check()
    file.write_bytes(bytes(10 * MB))
    clock.now += MEASURE_S
    quota.measure()
    assert "nothing more" in quota.warning
    with pytest.raises(StoreError, match="folder is full"):
        quota.check()
    file.unlink()
    clock.now += MEASURE_S
    quota.measure()
    assert quota.warning == ""


@pytest.mark.slow
def test_a_full_folder_takes_no_more_work_and_lets_those_who_are_there_go_on(
    tmp_path: Path,
) -> None:
    with served_class(tmp_path, "--max-folder", "0.01", replaced=OFTEN) as served:
        ada = served.joined()
        assert ada.get("healthz").status_code == 200
        assert served.state()["problem"] == ""
        filler = tmp_path / "rooms" / "filler"
        filler.write_bytes(bytes(9 * MB))
        until(lambda: "of its 0.01 GB" in served.state()["problem"])
        filler.write_bytes(bytes(10 * MB))
        until(lambda: "nothing more" in served.state()["problem"])
        for path in ("api/program", "api/stars", "api/mission-progress", "api/network"):
            answer = ada.client.put(path, content=b"{}")
            assert answer.status_code == 507
            assert "full" in answer.json()["problem"]
        refused = served.student().join()
        assert refused.status_code == 503
        assert "folder is full" in refused.json()["problem"]
        assert ada.get("healthz").status_code == 200
        if sys.platform == "linux":
            until(lambda: 0 in limits_of_files(served))
        filler.unlink()
        until(lambda: served.state()["problem"] == "")
        assert served.student().join().status_code == 200
        if sys.platform == "linux":
            until(lambda: 0 not in limits_of_files(served))


def limits_of_files(served: ServedClass) -> list[int]:
    """Return how large a file each process below the class's may write."""
    found = []
    for each in psutil.Process(served.process.pid).children(recursive=True):
        with suppress(psutil.NoSuchProcess):  # it has ended meanwhile
            found.append(each.rlimit(psutil.RLIMIT_FSIZE)[0])
    return found
