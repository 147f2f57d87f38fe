"""A person's networks on the disk."""

from dataclasses import replace
from pathlib import Path

import pytest

from ai4u_edu.base.errors import SetupError
from ai4u_edu.locale import PSEUDO, Catalogue, gettext
from ai4u_edu.teach import networks
from ai4u_edu.teach.networks import KeptNetwork, NetworkFolder

CLONE = KeptNetwork(0, "Clone of 5 drives", "0", "learned from 5 drives", 0.9)


def test_networks_keep_their_titles_and_numbers(tmp_path: Path) -> None:
    folder = NetworkFolder(tmp_path)
    for network in (b"one", b"two"):
        folder.add("box_chase", network, CLONE)
    folder.rename("box_chase", 2, "  The   second ")
    found = NetworkFolder(tmp_path).networks("box_chase")
    assert [(each.number, each.title, each.alike) for each in found] == [
        (1, "Clone of 5 drives", 0.9),
        (2, "The second", 0.9),
    ]
    assert folder.file("box_chase", 2).read_bytes() == b"two"
    folder.remove("box_chase", 1)
    assert [each.number for each in folder.networks("box_chase")] == [2]
    assert len(list(tmp_path.iterdir())) == 2


@pytest.mark.parametrize("title", ["", "   ", "x" * 41])
def test_a_title_that_does_not_fit_changes_nothing(tmp_path: Path, title: str) -> None:
    folder = NetworkFolder(tmp_path)
    folder.add("box_chase", b"one", CLONE)
    with pytest.raises(SetupError, match="1 to 40 characters"):
        folder.rename("box_chase", 1, title)
    assert folder.networks("box_chase")[0].title == CLONE.title


def test_there_are_not_more_networks_than_may_be(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(networks, "MAX_NETWORKS", 1)
    folder = NetworkFolder(tmp_path)
    folder.add("box_chase", b"one", CLONE)
    with pytest.raises(SetupError, match="delete one"):
        folder.add("box_chase", b"two", CLONE)
    folder.add("maze", b"two", CLONE)


def test_a_network_whose_title_is_lost_is_still_there(tmp_path: Path) -> None:
    folder = NetworkFolder(tmp_path)
    folder.add("box_chase", b"one", CLONE)
    for text in ('{"title": 3}', "[]", "nonsense", None):
        about = tmp_path / "box_chase-1.json"
        about.unlink() if text is None else about.write_text(text)
        assert folder.networks("box_chase") == [KeptNetwork(1, "Network 1", "", "")]
    with pytest.raises(SetupError, match="no network 2"):
        folder.file("box_chase", 2)


def test_a_networks_episodes_and_facts_go_with_it(tmp_path: Path) -> None:
    folder = NetworkFolder(tmp_path)
    about = replace(CLONE, facts=("Seed: 0.",))
    folder.add("box_chase", b"one", about, {8192: b"late", 0: b"early"})
    (network,) = NetworkFolder(tmp_path).networks("box_chase")
    assert (network.replays, network.facts) == ((0, 8192), ("Seed: 0.",))
    assert network.made_at > 0
    assert folder.replay("box_chase", 1, 8192).read_bytes() == b"late"
    folder.rename("box_chase", 1, "Racer")
    assert folder.networks("box_chase") == [replace(network, title="Racer")]
    folder.remove("box_chase", 1)
    assert list(tmp_path.iterdir()) == []


def test_how_a_network_learned_is_kept_in_no_language(tmp_path: Path) -> None:
    fact = gettext("Seed: {seed}.", seed=7)
    about = KeptNetwork(0, "", "0", gettext("opened from the file {name}", name="x"), facts=(fact,))
    NetworkFolder(tmp_path).add("maze", b"one", about)
    (found,) = NetworkFolder(tmp_path).networks("maze")
    assert (found.title, found.how, found.facts) == ("Network 1", about.how, (fact,))
    translate = Catalogue(PSEUDO).translate
    assert [*map(translate, (found.how, *found.facts))] == [*map(translate, (about.how, fact))]
    assert translate(found.how) != found.how
