"""A person's networks, which learned in the page."""

import json
import shutil
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType

import msgspec

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import SetupError, shorten
from ai4u_edu.locale import gettext as _
from ai4u_edu.locale import packed, unpacked
from ai4u_edu.teach.network_score import NetworkScore
from ai4u_edu.teach.scene_folder import SceneFolder, number_of

FOLDER = "networks"
"""Folder of networks in a folder of work."""
HANDED_OUT = "handed_out"
"""Folder of networks, in that of a class's room, which a teacher gave it."""
MAX_NETWORKS = 20
"""Networks that are kept for a scene."""
MAX_TITLE_CHARS = 40


@dataclass(frozen=True)
class KeptNetwork:
    """Title and origin of a network."""

    number: int
    """Number among those of its scene."""
    title: str
    """Name that a person gave it, or a first one."""
    agent: str
    """Id of the agent that learned."""
    how: str
    """Sentence about how it learned."""
    alike: float | None = None
    """Share of held-out moments in which it acts like the person; None if none were held out."""
    made_at: float = 0.0
    """Time (s since 1970) at which it was kept; 0 if it is not known."""
    facts: tuple[str, ...] = ()
    """Sentences about its rewards, drives and settings."""
    replays: tuple[int, ...] = ()
    """Decisions of its practice after which an episode was kept, ascending."""
    score: NetworkScore | None = None
    """Starts from which it reaches the goal; None if that is not known."""


class NetworkFolder:
    """The networks of all scenes; one thread changes it, any may read it.

    A network's title and origin lie in a file beside it, so that a new title leaves the network as
    it is. Episodes of its practice lie in a folder beside it.

    Args:
        folder: it is created with the first network.
    """

    def __init__(self, folder: Path) -> None:
        self._networks, self._about = SceneFolder(folder, ".onnx"), SceneFolder(folder, ".json")
        self._replays = SceneFolder(folder, ".replays")

    def add(
        self,
        scene: str,
        network: bytes,
        about: KeptNetwork,
        replays: Mapping[int, bytes] = MappingProxyType({}),
    ) -> KeptNetwork:
        """Keep a network, and return it with its number.

        Args:
            scene: name of the scene.
            network: the network's file.
            about: its origin; number, time and replays are set here.
            replays: episodes of its practice, by the decisions before them.

        Raises:
            SetupError: there are as many as may be.
            OSError: it can't be written.
        """
        if len(self._networks.files(scene)) >= MAX_NETWORKS:
            raise SetupError(
                _(
                    "expected at most {number} networks of a scene; delete one that you "
                    "do not need, then learn again",
                    number=MAX_NETWORKS,
                )
            )
        path = self._networks.next_file(scene)
        number = number_of(path)
        kept = replace(
            about,
            number=number,
            title=about.title or _("Network {number}", number=number),
            made_at=time.time(),
            replays=tuple(sorted(replays)),
        )
        self._write(scene, kept)
        for decisions, episode in replays.items():
            file = self.replay(scene, number, decisions)
            file.parent.mkdir(mode=0o700, exist_ok=True)
            write_atomically(file, episode, mode=0o600)
        # last, so that whoever sees it finds the rest
        write_atomically(path, network, over=False, mode=0o600)
        return kept

    def networks(self, scene: str) -> Sequence[KeptNetwork]:
        """Return a scene's networks, the oldest first."""
        return [self._read(scene, number_of(path)) for path in self._networks.files(scene)]

    def all(self) -> Sequence[tuple[str, KeptNetwork]]:
        """Return the networks of all scenes, each with its scene's name as files have it."""
        return [
            (scene, network)
            for scene in self._networks.scenes()
            for network in self.networks(scene)
        ]

    def file(self, scene: str, number: int) -> Path:
        """Return the file of a network.

        Raises:
            SetupError: there is none of that number.
        """
        path = self._networks.file(scene, number)
        if not path.is_file():
            raise SetupError(
                _("there is no network {number} of this scene any more", number=number)
            )
        return path

    def replay(self, scene: str, number: int, decisions: int) -> Path:
        """Return the file of an episode of a network's practice; it may not be there."""
        return self._replays.file(scene, number) / f"{decisions:09}.episode"

    def rename(self, scene: str, number: int, title: str) -> None:
        """Give a network another title.

        Raises:
            SetupError: there is no such network, or the title is empty or too long.
        """
        self.file(scene, number)
        title = " ".join(title.split())
        if not 0 < len(title) <= MAX_TITLE_CHARS:
            raise SetupError(
                _(
                    "expected a name of 1 to {most} characters",
                    most=MAX_TITLE_CHARS,
                )
            )
        self._write(scene, replace(self._read(scene, number), title=title))

    def remove(self, scene: str, number: int) -> None:
        """Delete a network."""
        self._networks.file(scene, number).unlink(missing_ok=True)
        self._about.file(scene, number).unlink(missing_ok=True)
        shutil.rmtree(self._replays.file(scene, number), ignore_errors=True)

    def _read(self, scene: str, number: int) -> KeptNetwork:
        try:
            plain = json.loads(self._about.file(scene, number).read_bytes())
            return KeptNetwork(
                number=number,
                title=shorten(unpacked(str(plain["title"])), MAX_TITLE_CHARS),
                agent=str(plain["agent"]),
                how=unpacked(str(plain["how"])),
                alike=None if plain["alike"] is None else float(plain["alike"]),
                made_at=float(plain.get("made_at", 0.0)),
                facts=tuple(unpacked(str(fact)) for fact in plain.get("facts", ())),
                replays=tuple(int(decisions) for decisions in plain.get("replays", ())),
                score=msgspec.convert(plain.get("score"), NetworkScore | None),
            )
        except (OSError, ValueError, TypeError, KeyError):  # somebody put the network there
            return KeptNetwork(number, _("Network {number}", number=number), "", "")

    def _write(self, scene: str, about: KeptNetwork) -> None:
        write_atomically(
            self._about.file(scene, about.number),
            msgspec.json.encode(about, enc_hook=packed),
            mode=0o600,
        )
