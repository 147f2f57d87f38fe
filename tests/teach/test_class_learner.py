"""A room's side of what learns in the class: what it asks for, shows, and takes."""

from pathlib import Path

import pytest

from ai4u_edu.base.errors import SetupError
from ai4u_edu.member.member import MemberTrainings
from ai4u_edu.teach.learning import LEARNED, STOPPED, UNREACHABLE, ClassLearner, Learned
from ai4u_edu.wire.class_link import Learn, RoomTrainings, StopTraining, Training
from tests.member.fake_link import FakeLink


class Asking:
    """A room that has asked for a learning, and a folder in which there is room for its network."""

    def __init__(self, folder: Path) -> None:
        self.link = FakeLink(print)
        self.trainings = MemberTrainings(self.link)
        self.taken: list[Learned] = []
        self.has_place = True
        self.learner = ClassLearner(self.trainings, folder, self._take)
        self.learner.begin("box_chase", [folder / "box_chase-1.episode"], "0")
        (self.request,) = self.link.of(Learn)
        self.file = folder / LEARNED / f"{self.request.key}.onnx"

    def tell(self, *, place: int = 0, is_done: bool = False) -> None:
        training = Training(self.request.key, "box_chase", "0", 1, place, is_done=is_done)
        self.trainings.receive(RoomTrainings((training,)))

    def _take(self, learned: Learned) -> bool:
        self.taken += [learned] if self.has_place else []
        return self.has_place


@pytest.fixture
def asking(tmp_path: Path) -> Asking:
    return Asking(tmp_path)


def shown(asking: Asking) -> tuple[str, str, bool]:
    state = asking.learner.state("box_chase", "0")
    assert state is not None
    return state.waiting, state.problem, state.is_over


def test_a_room_shows_what_its_learning_waits_for(asking: Asking) -> None:
    assert asking.request.drives == ("box_chase-1.episode",)
    assert shown(asking) == ("", "", False)
    assert asking.learner.state("box_chase", "1") is None
    assert asking.learner.state("maze", "0") is not None  # it still learns, for another scene
    asking.tell(place=3)
    assert shown(asking) == ("Your place in the line: 3.", "", False)
    key = asking.learner.key
    asking.link.is_connected = False
    assert shown(asking) == (UNREACHABLE, "", False)
    assert asking.learner.key != key
    asking.link.is_connected = True
    asking.tell()
    assert shown(asking) == ("", "", False)


def test_a_stopped_learning_is_over_whatever_the_class_still_says(asking: Asking) -> None:
    asking.tell()
    assert asking.learner.stop()
    assert asking.link.of(StopTraining)[0].training == asking.request.key
    asking.tell()  # it has not heard of it
    assert shown(asking) == ("", STOPPED, True)
    assert not asking.learner.is_busy
    assert not asking.learner.stop()


def test_a_network_is_taken_once_and_as_soon_as_there_is_a_place(asking: Asking) -> None:
    asking.file.parent.mkdir()
    asking.file.write_bytes(b"network")
    asking.learner.collect()
    assert asking.taken == []  # the class has not said that it is whole
    asking.tell(is_done=True)
    asking.has_place = False
    asking.learner.collect()
    assert asking.file.exists()
    asking.has_place = True
    for _ in range(2):
        asking.learner.collect()
    assert [each.network for each in asking.taken] == [b"network"]
    assert not asking.file.exists()


def test_a_name_that_is_too_long_for_the_link_is_a_sentence(asking: Asking) -> None:
    asking.learner.stop()
    with pytest.raises(SetupError, match="expected a name of the scene of at most 400 characters"):
        asking.learner.begin("x" * 1000, [Path("a.episode")], "0")
    assert len(asking.link.of(Learn)) == 1
    assert not asking.learner.is_busy
