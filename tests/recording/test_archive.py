"""The last episodes stay, as many as fit."""

import threading
from dataclasses import replace

from ai4u_edu.recording import Archive, Episode
from ai4u_edu.recording.archive import size_of
from tests.recording.recorded_drives import take


def episodes(count: int) -> list[Episode]:
    first = take("box_chase", decisions=20).episode
    return [replace(first, seed=seed) for seed in range(count)]


def test_the_last_ones_are_kept_under_their_numbers() -> None:
    archive = Archive(keep=3)
    for episode in episodes(5):
        archive.append(episode)
    assert [entry.number for entry in archive.entries] == [3, 4, 5]
    assert [episode.seed for episode in archive] == [2, 3, 4]
    assert (len(archive), archive[-1].seed, archive.next_number) == (3, 4, 6)
    assert [episode.seed for episode in archive[:2]] == [2, 3]
    found = archive.find(4)
    assert found is not None
    assert found.episode.seed == 3
    assert archive.find(1) is None


def test_the_oldest_go_when_there_is_no_room() -> None:
    several = episodes(6)
    archive = Archive(largest=3 * size_of(several[0]) + 10)
    for episode in several:
        archive.append(episode)
    assert [episode.seed for episode in archive] == [3, 4, 5]


def test_the_latest_is_kept_however_large() -> None:
    archive = Archive(largest=10)
    for episode in episodes(2):
        archive.append(episode, "friend.episode")
    assert [entry.number for entry in archive.entries] == [2]
    assert archive.entries[0].source == "friend.episode"


def test_its_size_is_about_that_of_its_columns() -> None:
    short, long = (take("box_chase", decisions=n).episode for n in (10, 100))
    more = size_of(long) - size_of(short)
    # an action has four numbers, and a decision some forty bytes beside it and its terms
    assert 90 * 60 < more < 90 * 250


def test_the_best_one_reached_the_goal_first() -> None:
    archive = Archive()
    drives = [take("box_chase", seed=seed, decisions=60).episode for seed in range(40)]
    for episode in drives:
        archive.append(episode)
    (best,) = archive.bests()
    lucky = archive.find(best)
    assert lucky is not None
    assert lucky.success
    assert lucky.episode.seconds == min(each.seconds for each in drives if each.success)
    archive.append(lucky.episode, "friend.episode")
    assert archive.bests() == {best}


def test_the_best_ones_of_scenes_and_drivers_are_apart() -> None:
    archive = Archive()
    assert archive.bests() == frozenset()
    lost = take("box_chase", decisions=20).episode
    (agent,) = lost.agents
    no_goal = lost.scene.model_copy(update={"success": None})
    chase = replace(lost, scene=no_goal)
    by_keys = "LocalBrain(WASDRBMoveController)"
    person = replace(chase, agents=(replace(agent, driver=by_keys),))
    program = replace(chase, agents=(replace(agent, driver="RemoteBrain(a script)"),))
    other = replace(chase, scene=no_goal.model_copy(update={"name": "donut"}))
    changed = replace(chase, scene=no_goal.model_copy(update={"bodies": no_goal.bodies[:1]}))
    for episode in (chase, chase, person, person, program, other, changed, lost, lost):
        archive.append(episode)
    assert archive.bests() == {1, 3}  # one of a kind is no best one, and neither is a lost one
    archive.append(program)
    assert archive.bests() == {1, 3, 5}


def test_a_program_that_took_most_decisions_is_no_person() -> None:
    (agent,) = take("box_chase", decisions=20).episode.agents
    by_both = "RemoteBrain(a script), LocalBrain(WASDRBMoveController)"
    for driver, is_person in ((by_both, False), (", ".join(by_both.split(", ")[::-1]), True)):
        episode = replace(episodes(1)[0], agents=(replace(agent, driver=driver),))
        assert Archive().append(episode).is_person == is_person


def test_no_number_is_given_twice() -> None:
    archive = Archive(keep=1000)
    first = episodes(1)[0]
    threads = [
        threading.Thread(target=lambda: [archive.append(first) for _ in range(100)])
        for _ in range(4)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [entry.number for entry in archive.entries] == list(range(1, 401))
