"""Readings of several texts (AI4U's sstrings): through percept, wire, recording, page and check."""

from typing import Any

import numpy as np
import pytest
from gymnasium import spaces
from pydantic import Field

from ai4u_edu import FloatArrayCompositeSensor, Sensor, check_scene, check_sensor
from ai4u_edu.base.errors import BlockError, ReadingError
from ai4u_edu.blocks import Layout, Percept
from ai4u_edu.blocks.brains.links.link import ReadingSpec
from ai4u_edu.learn.envs.spaces_of import Observer
from ai4u_edu.page.server.scripts.welcome import ObservationSubset
from ai4u_edu.recording.checksum import percept_checksum
from ai4u_edu.remote import connect
from ai4u_edu.remote.spaces import reading_space
from ai4u_edu.snapshot import capture_snapshot
from ai4u_edu.wire import native
from ai4u_edu.wire.agent_codec import AgentCodec
from ai4u_edu.wire.texts import unpack_texts
from tests.builders import small_sim
from tests.page.server.rooms import served
from tests.waiting import LIMIT_S


class Signs(Sensor):
    """Reads the texts on signs."""

    words: list[Any] = Field(default_factory=lambda: ["to the left", "", "stop"])

    def space(self) -> spaces.Space[Any]:
        return spaces.Sequence(spaces.Text(20))

    def read(self, body: Any, view: Any) -> Any:
        return self.words


class Two(Signs):
    """Two words each time."""

    def space(self) -> spaces.Space[Any]:
        return spaces.Tuple([spaces.Text(20), spaces.Text(4)])


class Named(Signs):
    """Declares its own type."""

    kind = "sstrings"

    def space(self) -> spaces.Space[Any]:
        return spaces.Text(20)


@pytest.mark.parametrize("kind", [Signs, Two, Named])
def test_a_percept_has_a_tuple_of_texts(kind: Any) -> None:
    sensor = kind(perception_key="signs")
    assert sensor.reading_kind() == "sstrings"
    sim = small_sim([sensor])
    percept = sim.agents[0].percept
    assert percept["signs"] == ("to the left", "", "stop")
    assert hash(percept["signs"])  # nobody can change it
    sensor.words = ["go"]
    assert percept["signs"] == ("to the left", "", "stop")
    sim.step()
    assert sim.agents[0].percept["signs"] == ("go",)
    sensor.is_active = False
    sim.step()
    assert sim.agents[0].percept["signs"] == ()


@pytest.mark.parametrize("words", ["stop", [1, 2], None, [["a"]], 5])
def test_what_is_no_list_of_texts_is_refused(words: Any) -> None:
    sensor = Signs()
    sim = small_sim([sensor])
    sensor.words = words
    with pytest.raises(ReadingError) as caught:
        sim.step()
    assert str(caught.value) == (
        f"agent '0', Signs 'signs': expected a list of texts, got {words!r}"
    )


def test_a_composite_takes_none() -> None:
    with pytest.raises(BlockError, match="Signs 'signs' reads text; a composite takes numbers"):
        small_sim([FloatArrayCompositeSensor(sensors=[Signs()])])


def test_our_own_protocol_carries_them() -> None:
    sim = small_sim([Signs()])
    with served(sim) as room, connect(room.url, mode="lockstep", patience=LIMIT_S) as robot:
        percept = robot.sense()
        assert percept["signs"] == ("to the left", "", "stop")
        assert percept["id"] == "0"
        told = {each.key: each for each in robot.welcome.readings}["signs"]
        assert (told.kind, told.sensor_type) == ("text", "sstrings")
        assert isinstance(reading_space(told), spaces.Sequence)


def test_too_many_are_cut_off_at_a_whole_text() -> None:
    (agent,) = small_sim([Signs(words=["x" * 1000] * 9)]).agents
    _, texts = ObservationSubset(agent, ["signs"]).extract(agent.percept)
    assert len(texts[0]) <= native.MAX_READING_CHARS
    assert unpack_texts(texts[0]) == ("x" * 1000,) * 3


def test_ai4us_protocol_carries_them_as_type_7() -> None:
    signs = ReadingSpec("signs", "sstrings", spaces.Sequence(spaces.Text(20)), "", is_input=True)
    codec = AgentCodec([signs], [])
    assert codec.metadata == '{"inputs": [], "outputs": []}'
    assert codec.sensors({"signs": ("left", "stop")}) == [b"   5signs7       9left stop"]


def test_a_recording_tells_them_apart() -> None:
    def print_of(*texts: Any) -> int:
        layout = Layout([("x", "sfloat", ())], [f"text{index}" for index in range(len(texts))])
        return percept_checksum(Percept(layout, np.zeros(1, np.float32).tobytes(), texts))

    lists = [("a", "b"), ("a", "c"), ("ab",), ("a",), (), ("a", "b", "")]
    assert len({print_of(each) for each in lists}) == len(lists)
    assert print_of(("a",), ("b", "c")) != print_of(("a", "b"), ("c",))
    assert print_of("a", "b") == print_of("a", "b") != print_of(("a",), "b")


def test_the_api_shows_them() -> None:
    from ai4u_edu.page.server.api import SnapshotView

    sim = small_sim([Signs(words=["a<b", "stop"])])
    view = SnapshotView.of(capture_snapshot(sim))
    assert view.agents[0].percept["signs"] == ["a<b", "stop"]


def test_an_environment_observes_them() -> None:
    (agent,) = small_sim([Signs()]).agents
    observations = Observer(agent, "dict")
    assert observations.observe(agent.percept)["signs"] == ("to the left", "", "stop")


def test_they_can_be_checked() -> None:
    report = check_sensor(Signs(is_input=False), decisions=8)
    assert report.ok, str(report)
    long = check_sensor(Two(words=["short", "much too long"], is_input=False), decisions=8)
    assert "expected up to 4 characters as its space() says" in str(long)
    few = check_sensor(Two(words=["short"], is_input=False), decisions=8)
    assert "expected 2 texts as its space() says" in str(few)
    assert check_scene("box_chase", decisions=2).ok
