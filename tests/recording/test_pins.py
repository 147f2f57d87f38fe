"""Episodes that stay in the archive: pinned ones, and a person's beside a network's."""

from dataclasses import replace

import pytest

from ai4u_edu.recording import Archive, Episode, RecordingError
from ai4u_edu.recording.archive import MAX_PINNED, size_of
from tests.recording.recorded_drives import take


@pytest.fixture(scope="module")
def by_person() -> Episode:
    return with_driver(take("box_chase", decisions=3).episode, "LocalBrain(WASDRBMoveController)")


@pytest.fixture(scope="module")
def by_network() -> Episode:
    return with_driver(take("box_chase", decisions=3).episode, "LocalBrain(NeuralNetController)")


def with_driver(episode: Episode, title: str) -> Episode:
    agents = tuple(replace(agent, driver=title) for agent in episode.agents)
    return replace(episode, agents=agents)


def numbers(archive: Archive) -> list[int]:
    return [entry.number for entry in archive.entries]


def test_a_network_does_not_displace_a_person(by_person: Episode, by_network: Episode) -> None:
    archive = Archive(keep=2)
    for each in (by_person, by_network, by_network, by_network, by_person):
        archive.append(each)
    assert numbers(archive) == [1, 3, 4, 5]
    assert [entry.is_person for entry in archive.entries] == [True, False, False, True]


def test_a_pinned_episode_stays(by_network: Episode) -> None:
    archive = Archive(keep=2)
    archive.append(by_network)
    archive.pin(1)
    for _ in range(4):
        archive.append(by_network)
    assert numbers(archive) == [1, 4, 5]
    archive.pin(1, on=False)
    archive.append(by_network)
    assert numbers(archive) == [5, 6]


def test_a_pinned_episode_stays_when_memory_is_full(by_network: Episode) -> None:
    archive = Archive(keep=50, largest=2 * size_of(by_network))
    archive.append(by_network)
    archive.pin(1)
    for _ in range(3):
        archive.append(by_network)
    assert numbers(archive) == [1, 4]


def test_pins_are_bounded(by_network: Episode) -> None:
    archive = Archive(keep=50)
    for number in range(1, MAX_PINNED + 2):
        archive.append(by_network)
        if number <= MAX_PINNED:
            archive.pin(number)
    with pytest.raises(RecordingError, match="at most 20 pinned episodes"):
        archive.pin(MAX_PINNED + 1)
    with pytest.raises(RecordingError, match="episode 99 is not kept any more"):
        archive.pin(99)
