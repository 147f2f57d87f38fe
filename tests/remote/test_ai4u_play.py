"""``ai4u-edu play --brain``."""

import json

import pytest

from ai4u_edu import RemoteBrain, Scene
from ai4u_edu.base.errors import AI4UError, NameNotFoundError, ParameterError, SetupError
from ai4u_edu.blocks.brains.address import brain_at
from ai4u_edu.learn.training.assigned import with_drivers
from tests.playing import played
from tests.remote.test_ai4u_package import free_port, run_script
from tests.waiting import LIMIT_MS

pytestmark = pytest.mark.slow


def test_a_served_scene_is_driven_by_a_script() -> None:
    port = free_port()
    address = f"ai4u://127.0.0.1:{port}?receive_timeout={int(LIMIT_MS)}"
    with played("box_chase", "--seed", "1", "--brain", address) as server:
        (agent,) = server.snapshot()["agents"]
        assert agent["brain"] == f"RemoteBrain(127.0.0.1:{port})"
        assert agent["steps"] == 0  # nobody drives yet
        log = run_script("steps.py", port, 20)["log"]
        assert [each["steps"] for each in log] == list(range(1, 21))


def test_the_brain_decides_as_often_as_the_one_before() -> None:
    plain = Scene.load("box_chase").plain()
    plain["agents"][0]["brains"][0]["skip_frame"] = 9
    scene = Scene.loads(json.dumps(plain))  # JSON is YAML as well
    sim, _ = with_drivers(scene, ["0=ai4u://localhost:9?mode=realtime"], is_served=True)
    brain = sim.agents[0].brain
    assert isinstance(brain, RemoteBrain)
    assert (brain.host, brain.port, brain.mode, brain.skip_frame) == ("localhost", 9, "realtime", 9)
    brain.close()


def test_the_address_says_how_often_it_decides() -> None:
    address = "ai4u://localhost:9?skip_frame=0&repeat_action=false"
    sim, _ = with_drivers(Scene.load("box_chase"), [address], is_served=True)
    brain = sim.agents[0].brain
    assert (brain.skip_frame, brain.repeat_action) == (0, False)
    brain.close()


@pytest.mark.parametrize(("address", "ms"), [("", 60_000), ("?receive_timeout=700", 700)])
def test_the_worlds_patience_holds_for_a_script_whose_address_names_none(
    address: str, ms: int
) -> None:
    spec, scene = f"ai4u://localhost:9{address}", Scene.load("box_chase")
    sim, _ = with_drivers(scene, [spec], is_served=True, receive_timeout=60_000)
    brain = sim.agents[0].brain
    assert isinstance(brain, RemoteBrain)
    assert brain.receive_timeout == ms
    brain.close()


def test_with_several_agents_one_is_named() -> None:
    pair = Scene.load("tag")
    says = r"the scene has several agents \(.*\); name one, as in --brain .*=ai4u://127.0.0.1:9"
    with pytest.raises(SetupError, match=says):
        with_drivers(pair, ["ai4u://127.0.0.1:9"], is_served=True)
    with pytest.raises(NameNotFoundError, match="no agent has the id '7'"):
        with_drivers(pair, ["7=ai4u://127.0.0.1:9"], is_served=True)


@pytest.mark.parametrize(
    "address", ["", "8080", "ws://host:1", "ai4u://", "ai4u://a:b", "ai4u://a/b"]
)
def test_what_is_no_address(address: str) -> None:
    with pytest.raises(SetupError, match=r"expected an address such as ai4u://127.0.0.1:8080, got"):
        brain_at(address)


@pytest.mark.parametrize(
    ("address", "says"),
    [
        ("ai4u://host:1?port=2", "expected port in front of the question mark"),
        ("ai4u://host:1?host=other", "expected host in front of the question mark"),
        ("ai4u://host:1?enabled=false", "expected no enabled in an address"),
        ("ai4u://host:1?mode=realtime&mode=lockstep", "expected mode once, got it 2 times"),
        ("ai4u://host:1?mode=", "mode: expected"),
        ("ai4u://host:1#mode", "expected an address such as"),
        ("ai4u://user@host:1", "expected an address such as"),
    ],
)
def test_nothing_in_an_address_is_overwritten_or_dropped(address: str, says: str) -> None:
    with pytest.raises(AI4UError, match=says):
        brain_at(address)


def test_an_unknown_parameter() -> None:
    with pytest.raises(ParameterError, match="mod: unknown parameter; did you mean 'mode'"):
        brain_at("ai4u://127.0.0.1:8080?mod=realtime")
