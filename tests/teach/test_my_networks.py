"""A person's networks: how good each is, a file that is opened, and one that drives is deleted."""

from collections.abc import Iterator

import pytest

from ai4u_edu import Scene
from ai4u_edu.blocks.brains import zoo
from ai4u_edu.page.editing.drivers import NETWORK
from ai4u_edu.teach.network_score import NetworkScore, score_network
from tests.page.panel.rooms import Message, PanelPage, PanelRoom

pytestmark = pytest.mark.slow


@pytest.fixture
def page(room: PanelRoom) -> Iterator[PanelPage]:
    with room.page() as opened:
        opened.part("teach", lambda part: part["rewards"])
        yield opened


def network_of(scene: str) -> bytes:
    return zoo.network_of(scene).read_bytes()


def opened(page: PanelPage, name: str, data: bytes) -> Message:
    """Open a file, and return the answer."""
    page.socket.send(data)
    return page.do("teach_open", name=name, size=len(data))


def test_a_scene_with_few_starts_is_driven_from_all_of_them() -> None:
    score = score_network(Scene.load("box_chase"), "0", zoo.network_of("box_chase"), 10_000)
    assert score == NetworkScore(8, 8, True, 1.0, 1.0)
    assert score.sentence == "It reaches the goal from all 8 starts."
    most = NetworkScore.of(7, 8, has_all=True)
    assert (most.sentence, most.low) == ("It reaches the goal from 7 of all 8 starts.", 7 / 8)


def test_other_scenes_are_driven_from_new_starts_within_a_limit() -> None:
    scene, network = Scene.load("push_block"), zoo.network_of("push_block")
    (agent,) = scene.build().agents
    score = score_network(scene, agent.id, network, 10_000)
    assert score is not None
    assert (score.starts, score.has_all) == (100, False)
    assert 0.8 < score.low < score.successes / 100 < score.high < 1.0
    assert f"from {score.successes} of 100 new starts (95% between" in score.sentence
    few = score_network(scene, agent.id, network, 1)
    assert few is not None
    assert few.starts == 5


def test_a_network_is_not_scored_beside_somebody_who_waits_for_keys() -> None:
    assert score_network(Scene.load("tag"), "runner_1", zoo.network_of("box_chase"), 10) is None


def test_a_file_is_opened_and_driven_with(room: PanelRoom, page: PanelPage) -> None:
    answer = opened(page, "friend.onnx", network_of("box_chase"))
    assert answer["text"] == "Opened friend."
    (network,) = page.part("teach", lambda part: part["networks"])["networks"]
    assert network["how"] == "opened from the file friend.onnx"
    assert (network["score"]["successes"], network["score"]["starts"]) == (8, 8)
    assert "It reaches the goal from all 8 starts." in network["facts"]
    assert not network["is_driving"]
    page.done("teach_drive", network=1)
    page.part("teach", lambda part: part["networks"][0]["is_driving"])
    assert "drives an agent" in page.failed("teach_delete", network=1)["text"]
    page.done("teach_delete", network=1, even_if_driving=True)
    page.part("teach", lambda part: not part["networks"])
    assert not room.editor.driver_of("0").startswith(NETWORK)


@pytest.mark.parametrize(
    ("name", "data", "problem"),
    [
        ("notes.txt", b"hello", "expected the file of a network"),
        ("junk.onnx", b"hello", "junk.onnx can't drive this robot: "),
        ("large.onnx", b"x" * (5 * 2**20 + 1), "expected at most 5 MB"),
    ],
)
def test_a_file_that_is_no_network_is_refused(
    page: PanelPage, name: str, data: bytes, problem: str
) -> None:
    for start in range(0, len(data), 2**19):
        page.socket.send(data[start : start + 2**19])
    answer = page.failed("teach_open", name=name, size=len(data))
    assert problem in answer["text"]
    assert "ai4u-edu-" not in answer["text"]
    assert page.parts["teach"]["networks"] == []


def test_a_refusal_is_in_the_readers_language_with_the_files_own_name(room: PanelRoom) -> None:
    header = {"Accept-Language": "pt-BR"}
    with PanelPage(room.url + "ws/panel", additional_headers=header) as page:
        page.part("teach", lambda part: part["rewards"])
        misfit = opened(page, "vaga.onnx", network_of("parking"))["text"]
        junk = opened(page, "nada.onnx", b"hello")["text"]
    assert misfit.startswith("vaga.onnx não consegue dirigir este robô: agente '0'")
    assert "a rede vaga.onnx não combina com o agente '0'" in misfit
    assert junk.startswith("nada.onnx não consegue dirigir este robô: nada.onnx: era esperada")
    assert "expected" not in misfit + junk


def test_a_network_of_another_robot_is_refused(page: PanelPage) -> None:
    answer = opened(page, "parking.onnx", network_of("parking"))
    assert answer["type"] == "failed"
    assert "parking.onnx can't drive this robot: " in answer["text"]
