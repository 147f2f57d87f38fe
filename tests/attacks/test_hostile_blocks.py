"""Blocks that raise, exit, flood or never return: the world says so, and all else goes on."""

import asyncio
import threading
from collections.abc import Callable, Iterator

import pytest

from ai4u_edu.agent.block_errors import message_of
from ai4u_edu.base.errors import AI4UError
from ai4u_edu.page.server.past import Exports
from ai4u_edu.recording import Recorder, RecordingError, Replay
from ai4u_edu.runtime import tick_monitor
from ai4u_edu.runtime.runner import Runner
from tests.attacks.hostile import HOOKS, MISDEEDS, Misdeed, divide, exit_process, hostile_sim
from tests.waiting import LIMIT_S, until


def wait_for(event: threading.Event) -> None:
    assert event.wait(LIMIT_S)


@pytest.fixture(autouse=True)
def disarmed() -> Iterator[None]:
    yield
    Misdeed.is_armed = False


@pytest.fixture
def runner(hook: str) -> Iterator[Runner]:
    runner = Runner(hostile_sim(hook), seed=1)
    runner.start()
    yield runner
    Misdeed.is_armed = False
    runner.stop(LIMIT_S)


@pytest.mark.parametrize(
    ("hook", "misdeed"),
    [(hook, each) for hook in HOOKS for each in (divide, exit_process)]
    + [("sensor.read", each) for each in MISDEEDS],
)
def test_a_misdeed_is_told_and_a_reset_mends_it(
    runner: Runner, misdeed: Callable[[], None]
) -> None:
    until(lambda: runner.latest.tick > 1)
    Misdeed.misdeed, Misdeed.is_armed = staticmethod(misdeed), True
    first = runner.reset()
    until(lambda: first.done() and (first.exception() or runner.latest.error))
    refused = first.exception()
    error = runner.latest.error if refused is None else message_of(refused)
    assert len(error) < 4000
    assert "'red'" in error
    assert "Hostile" in error or "andler" in error
    runner.pause().result(LIMIT_S)  # commands go on meanwhile
    runner.resume().result(LIMIT_S)
    Misdeed.is_armed = False
    runner.reset().result(LIMIT_S)
    until(lambda: runner.latest.tick > 1)
    assert not runner.latest.error


def is_named(text: str) -> bool:
    return "'red'" in text and ("Hostile" in text or "Handler of" in text)


@pytest.mark.parametrize("hook", HOOKS)
def test_a_block_that_does_not_return_is_named_until_it_does(
    runner: Runner, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tick_monitor, "STALL_S", 0.1)
    until(lambda: runner.latest.tick > 1)
    release = threading.Event()
    Misdeed.misdeed, Misdeed.is_armed = staticmethod(lambda: wait_for(release)), True
    runner.reset()
    try:
        # a tick that gets no time for a while stands in no block's hook
        until(lambda: is_named(str(runner.stall)))
    finally:
        Misdeed.is_armed = False
        release.set()
    until(lambda: runner.stall is None)
    tick = runner.latest.tick
    until(lambda: runner.latest.tick != tick)


@pytest.mark.parametrize("misdeed", [divide, exit_process])
@pytest.mark.parametrize("hook", ["sensor.read", "actuator.act"])
def test_a_replay_and_a_download_end_with_a_sentence(
    hook: str, misdeed: Callable[[], None]
) -> None:
    sim = hostile_sim(hook)
    recorder = Recorder(sim)
    sim.reset(1)
    for _ in range(5):
        sim.step()
    recorder.finish()
    (episode,) = recorder.episodes
    replay = Replay(episode)
    Misdeed.misdeed, Misdeed.is_armed = staticmethod(misdeed), True
    told: list[BaseException] = []

    def play() -> None:  # as the page's timeline does, in a thread of its own
        try:
            replay.at(4)
        except RecordingError as error:
            told.append(error)

    playing = threading.Thread(target=play)
    playing.start()
    playing.join(LIMIT_S)
    assert not playing.is_alive()
    assert "Hostile" in str(told)

    def make(*_: object) -> bytes:
        Misdeed.misdeed()
        return b""

    async def download() -> None:
        files = Exports(make)
        for _ in range(2):  # the first one takes nothing from the second one
            with pytest.raises((AI4UError, ZeroDivisionError)):
                await asyncio.wait_for(files.get(episode, "gif"), LIMIT_S)

    asyncio.run(download())
