"""The page of a training: the latest policy drives, and afterwards the one that was kept."""

import json
import re
import shutil
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, Any

import httpx
import pytest

from ai4u_edu.base.errors import SetupError
from ai4u_edu.learn.training.algorithms import load_model
from ai4u_edu.learn.training.run import Run
from ai4u_edu.learn.training.watch import Watch
from tests.learn.training.small import copied_training, small_settings
from tests.page.server import http_client
from tests.waiting import until

pytestmark = pytest.mark.needs("train")

TOTAL = 5000
TURN = [0.0, 1.0, 0.0, 0.0]
TRAIN = "train box_chase --algo ppo --steps 128 --watch"


def watching(run: Run, port: int = 0) -> Watch:
    """Return the callback of a training that has just begun."""
    watch = Watch(port, open_page=False)
    watch.set_training(run, TOTAL)
    watch.init_callback(load_model("ppo", run.last))
    shutil.copy(run.last, run.watched_model)
    watch.write_weights()
    return watch


@contextmanager
def page_of(watch: Watch) -> Iterator[str]:
    """Run the page's process, and give its address."""
    with subprocess.Popen(watch.command(), stderr=subprocess.PIPE, text=True) as page:
        try:
            assert page.stderr is not None
            yield address_in(page.stderr)
        finally:
            page.terminate()


def address_in(stream: IO[str]) -> str:
    line = next(line for line in stream if "watch it learn" in line)
    found = re.search(r"http://\S+", line)
    assert found
    return found[0]


def get(address: str, path: str) -> Any:
    return http_client.get(address + path).json()


def only_turn(model: Any) -> None:
    """Let a policy do nothing but turn to the right."""
    weights = model.policy.action_net
    weights.weight.data.zero_()
    weights.bias.data[:] = weights.bias.new_tensor([0.0, 1.0, 0.0, 0.0])


def test_the_progress_is_told_and_the_latest_policy_drives_then_the_best(tmp_path: Path) -> None:
    run = copied_training(tmp_path).run
    checks = run.checks()
    with (
        socket.create_server(("127.0.0.1", 0)) as taken,
        page_of(watch := watching(run, port := taken.getsockname()[1])) as address,
    ):
        assert f":{port}/" not in address

        def progress() -> Any:
            return get(address, "api/training")["training"]

        def move() -> Any:
            # none in the first picture of an episode
            return get(address, "api/snapshot")["agents"][0]["action"].get("move")

        told = progress()
        assert told["decisions"] == watch.model.num_timesteps > 0
        assert told["total"] == TOTAL
        assert not told["is_over"]
        assert [each["decisions"] for each in told["curve"]] == [each.steps for each in checks]
        assert [each["reward"] for each in told["curve"]] == [each.reward for each in checks]
        first = get(address, "api/snapshot")["episode"]  # of 20 decisions
        until(lambda: get(address, "api/snapshot")["episode"] > first + 1)
        assert get(address, "api/snapshot")["agents"][0]["brain"] == "LocalBrain(ScriptController)"
        assert move() != TURN
        run.note([*checks, checks[-1].model_copy(update={"success": 1.0})])
        only_turn(watch.model)
        watch.write_weights()
        until(lambda: move() == TURN)
        until(lambda: len(progress()["curve"]) == len(checks) + 1)
        assert progress()["curve"][-1]["success"] == 1.0
        watch.finish()  # the model that was kept does something else
        until(lambda: move() not in (None, TURN))
        until(lambda: progress()["is_over"])


def test_it_needs_a_training() -> None:
    with pytest.raises(SetupError, match=r"give this to train\(watch=...\)"):
        Watch().command()


def train_command(folder: Path) -> subprocess.Popen[str]:
    """Run a short training with its page."""
    settings = folder / "mine.yaml"
    settings.write_text(json.dumps(small_settings().model_dump(mode="json")))  # JSON is YAML
    options = ("--settings", str(settings), "--out", str(folder / "run"), "--port", "0")
    return subprocess.Popen(
        [sys.executable, "-m", "ai4u_edu", *TRAIN.split(), *options],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def is_served(address: str) -> bool:
    """Return True while somebody answers at an address."""
    try:
        http_client.get(address + "healthz")
    except httpx.TransportError:
        return False
    return True


@pytest.mark.nightly
@pytest.mark.skipif(sys.platform == "win32", reason="sends signals")
@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGKILL])
def test_the_command_keeps_the_page_open_until_it_ends(tmp_path: Path, end: int) -> None:
    with train_command(tmp_path) as training:
        assert training.stdout is not None
        assert training.stderr is not None
        address = address_in(training.stderr)
        assert any("the trained policy drives in the page" in line for line in training.stdout)
        until(lambda: get(address, "api/training")["training"]["is_over"])
        assert training.poll() is None
        training.send_signal(end)
        training.wait()
    assert training.returncode == (0 if end == signal.SIGINT else -end)
    until(lambda: not is_served(address))
