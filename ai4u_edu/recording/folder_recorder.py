"""Recorder that also writes each finished episode to a folder."""

from pathlib import Path

from ai4u_edu.agent import ControlRequestor
from ai4u_edu.base.atomic_write import make_folder, write_atomically
from ai4u_edu.base.limits import DEFAULT_KEPT_EPISODES
from ai4u_edu.recording.archive import Archive
from ai4u_edu.recording.episode import Episode, encode
from ai4u_edu.recording.recorder import Recorder
from ai4u_edu.scenes import Scene

MAX_SCENE_NAME_BYTES = 150
"""Length of a scene's name in the name of a file."""


def recorder_into(
    folder: Path | None, sim: ControlRequestor, scene: Scene, keep: int = DEFAULT_KEPT_EPISODES
) -> Recorder:
    """Return a recorder that archives the last episodes and writes each to a folder when it ends.

    An episode that can't be written, for example since the disk is full, stays in memory.

    Args:
        folder: folder for episode files; None writes none.
        sim: the world and its agents.
        scene: the scene that the world was built from.
        keep: number of episodes that are kept in memory.

    Raises:
        SetupError: the folder can't be created.
    """
    episodes = Archive(keep)
    if folder is None:
        return Recorder(sim, scene=scene.description, episodes=episodes)
    make_folder(folder, "recorded episodes")

    def write(episode: Episode) -> None:
        folder.mkdir(parents=True, exist_ok=True)  # somebody may have removed it meanwhile
        scene = episode.scene.name.encode()[:MAX_SCENE_NAME_BYTES].decode(errors="ignore")
        name, data, count = f"{scene}-{episode.seed}", encode(episode), 1
        path = folder / f"{name}.episode"
        while True:
            try:
                write_atomically(path, data, over=False)
            except FileExistsError:  # of an earlier episode, or of another server
                count += 1
                path = folder / f"{name}-{count}.episode"
            else:
                return

    return Recorder(sim, scene=scene.description, episodes=episodes, on_episode=write)
