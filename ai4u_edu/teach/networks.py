"""A person's networks, which learned in the page."""

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.base.errors import SetupError
from ai4u_edu.teach.scene_folder import SceneFolder, number_of

FOLDER = "networks"
"""Folder of networks in a folder of work."""
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


class NetworkFolder:
    """The networks of all scenes; one thread changes it, any may read it.

    A network's title and origin lie in a file beside it, so that a new title leaves the network as
    it is.

    Args:
        folder: it is created with the first network.
    """

    def __init__(self, folder: Path) -> None:
        self._networks, self._about = SceneFolder(folder, ".onnx"), SceneFolder(folder, ".json")

    def add(self, scene: str, network: bytes, about: KeptNetwork) -> KeptNetwork:
        """Keep a network, and return it with its number.

        Raises:
            SetupError: there are as many as may be.
            OSError: it can't be written.
        """
        if len(self._networks.files(scene)) >= MAX_NETWORKS:
            raise SetupError(
                f"expected at most {MAX_NETWORKS} networks of a scene; delete one that you do not "
                "need, then learn again"
            )
        path = self._networks.next_file(scene)
        number = number_of(path)
        kept = replace(about, number=number, title=about.title or f"Network {number}")
        write_atomically(path, network, over=False, mode=0o600)
        self._write(scene, kept)
        return kept

    def networks(self, scene: str) -> Sequence[KeptNetwork]:
        """Return a scene's networks, the oldest first."""
        return [self._read(scene, number_of(path)) for path in self._networks.files(scene)]

    def file(self, scene: str, number: int) -> Path:
        """Return the file of a network.

        Raises:
            SetupError: there is none of that number.
        """
        path = self._networks.file(scene, number)
        if not path.is_file():
            raise SetupError(f"there is no network {number} of this scene any more")
        return path

    def rename(self, scene: str, number: int, title: str) -> None:
        """Give a network another title.

        Raises:
            SetupError: there is no such network, or the title is empty or too long.
        """
        self.file(scene, number)
        title = " ".join(title.split())
        if not 0 < len(title) <= MAX_TITLE_CHARS:
            raise SetupError(f"expected a name of 1 to {MAX_TITLE_CHARS} characters")
        self._write(scene, replace(self._read(scene, number), title=title))

    def remove(self, scene: str, number: int) -> None:
        """Delete a network."""
        self._networks.file(scene, number).unlink(missing_ok=True)
        self._about.file(scene, number).unlink(missing_ok=True)

    def _read(self, scene: str, number: int) -> KeptNetwork:
        try:
            plain = json.loads(self._about.file(scene, number).read_bytes())
            return KeptNetwork(
                number=number,
                title=str(plain["title"])[:MAX_TITLE_CHARS],
                agent=str(plain["agent"]),
                how=str(plain["how"]),
                alike=None if plain["alike"] is None else float(plain["alike"]),
            )
        except (OSError, ValueError, TypeError, KeyError):  # somebody put the network there
            return KeptNetwork(number, f"Network {number}", "", "")

    def _write(self, scene: str, about: KeptNetwork) -> None:
        write_atomically(
            self._about.file(scene, about.number), json.dumps(asdict(about)), mode=0o600
        )
