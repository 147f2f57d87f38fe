"""Other environments run in processes of their own; a failure is reported with its reason."""

import sys
from pathlib import Path

import pytest

from tests.benchmarks import peers
from tests.benchmarks.interleaved import race
from tests.benchmarks.peers import Peer, PeerError, running

GOOD = """
print("hello")
def step(i):
    sum(range(1000))
"""


@pytest.fixture
def peer(monkeypatch: pytest.MonkeyPatch) -> dict[str, Peer]:
    """No peers yet, and this Python instead of one with their packages."""
    monkeypatch.setattr(peers, "PEERS", {})
    monkeypatch.setattr(peers, "installed", lambda _: Path(sys.executable))
    return peers.PEERS


def test_a_peer_takes_its_turn(peer: dict[str, Peer]) -> None:
    peer["good"] = Peer("Good", "good", 50, GOOD, worlds=2)
    with running("good") as contender:
        work, units = contender()
        assert units == 100
        work()
        timings = race({"good": contender}, "good", 3)
    assert timings["good"].speed == 1.0
    assert timings["good"].microseconds > 1


@pytest.mark.parametrize("program", ["import nothing_of_this_name", "def step(i): 1 / 0"])
def test_one_that_fails_says_why(program: str, peer: dict[str, Peer]) -> None:
    peer["bad"] = Peer("Bad", "bad", 1, program)
    said = pytest.raises(PeerError, match=r"it ended: (ModuleNotFound|ZeroDivision)Error")
    with said, running("bad") as contender:
        contender()[0]()


def test_one_that_takes_too_long_is_ended(peer: dict[str, Peer]) -> None:
    peer["slow"] = Peer("Slow", "slow", 1, "import time\ndef step(i): time.sleep(60)")
    said = pytest.raises(PeerError, match=r"not done within 1 s")
    with said, running("slow", limit=1) as contender:
        contender()[0]()


def test_one_that_can_not_be_had_says_why(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(peers, "FOLDER", tmp_path)
    monkeypatch.setattr(sys, "executable", "false")
    with pytest.raises(PeerError, match="can't be installed: without a word"):
        peers.installed(Peer("None", "nothing", 1, ""))
