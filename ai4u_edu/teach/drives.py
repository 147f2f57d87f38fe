"""A person's finished drives, kept as files until a network learns from them."""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from ai4u_edu.agent import BasicAgent
from ai4u_edu.base.atomic_write import write_atomically
from ai4u_edu.locale import gettext as _
from ai4u_edu.recording import AgentRecord, Episode, RecordingError
from ai4u_edu.recording.agent_record import PERSON
from ai4u_edu.recording.episode import encode
from ai4u_edu.recording.scene_export import without_brains
from ai4u_edu.scenes import SceneDescription
from ai4u_edu.teach.scene_folder import SceneFolder, number_of

FOLDER = "drives"
"""Folder of drives in a folder of work."""
MAX_DRIVES = 50
"""Drives that are kept for a scene; the oldest go first."""
MAX_DECISIONS = 20_000
"""Decisions of all drives that are kept for a scene."""
MIN_DECISIONS = 6
"""Fewest decisions of a drive to learn from, about half a second."""

TOO_SHORT = _("too short")
CHANGED = _("the scene was changed during it")
OTHER_ROBOT = _("the robot had other sensors or actuators")
OTHER_SCENE = _("the scene was another one")


@dataclass(frozen=True, eq=False)
class Drive:
    """A person's finished drive."""

    number: int
    """Number among those of its scene."""
    episode: Episode

    def record(self, agent: str) -> AgentRecord | None:
        """Return what an agent did in it, if a person decided there at least once; else None."""
        record = next((each for each in self.episode.agents if each.id == agent), None)
        return record if record is not None and persons_decisions(record) else None

    def reason_against(self, agent: BasicAgent, scene: SceneDescription) -> str:
        """Return why an agent can't learn from the drive, in a few words; empty if it can.

        Args:
            agent: the agent.
            scene: the present scene, as :func:`~ai4u_edu.recording.scene_export.export_scene`
                describes it.
        """
        record, episode = self.record(agent.id), self.episode
        if record is None or persons_decisions(record) < MIN_DECISIONS:
            return TOO_SHORT
        if episode.changed is not None:
            return CHANGED
        if without_brains(episode.scene) == without_brains(scene):
            return ""
        then, now = (_blocks_of(each, agent.id) for each in (episode.scene, scene))
        return OTHER_SCENE if then == now else OTHER_ROBOT


class DriveFolder:
    """The drives of all scenes; one thread calls it.

    Args:
        folder: it is created with the first drive.
    """

    def __init__(self, folder: Path) -> None:
        self._files = SceneFolder(folder, ".episode")
        self._loaded: dict[Path, Drive] = {}

    def add(self, episode: Episode) -> None:
        """Keep a drive, and delete the oldest ones of its scene if there are too many.

        Raises:
            OSError: it can't be written.
        """
        scene = episode.scene.name
        path = self._files.next_file(scene)
        write_atomically(path, encode(episode), over=False, mode=0o600)
        self._loaded[path] = Drive(number_of(path), episode)
        kept, decisions = 0, 0
        for drive in reversed(self.drives(scene)):
            kept, decisions = kept + 1, decisions + max(map(len, drive.episode.agents))
            if kept > MAX_DRIVES or (decisions > MAX_DECISIONS and kept > 1):
                self.remove(scene, drive.number)

    def drives(self, scene: str) -> Sequence[Drive]:
        """Return the drives of a scene, the oldest first; a file that can't be read is left out."""
        drives = []
        for path in self._files.files(scene):
            if path not in self._loaded:
                with suppress(RecordingError):
                    self._loaded[path] = Drive(number_of(path), Episode.load(path))
            drives += [self._loaded[path]] if path in self._loaded else []
        return drives

    def file(self, scene: str, number: int) -> Path:
        """Return the file of a drive."""
        return self._files.file(scene, number)

    def remove(self, scene: str, number: int) -> None:
        """Delete a drive."""
        path = self.file(scene, number)
        path.unlink(missing_ok=True)
        self._loaded.pop(path, None)


def persons_decisions(record: AgentRecord) -> int:
    """Return how many decisions of an agent a person took, by keys."""
    return int(((record.flags & PERSON) > 0).sum())


def _blocks_of(scene: SceneDescription, agent: str) -> object:
    """Return the sensors and actuators of an agent as plain data."""
    found = next((each for each in scene.agents if each.get("id", "0") == agent), {})
    return found.get("sensors"), found.get("actuators")
