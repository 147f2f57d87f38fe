"""Recording, exact replay and export of episodes."""

import warnings
from typing import Any

from ai4u_edu.recording.archive import Archive, ArchiveEntry
from ai4u_edu.recording.episode import AgentRecord, Decision, Episode
from ai4u_edu.recording.errors import RecordingError
from ai4u_edu.recording.folder_recorder import recorder_into
from ai4u_edu.recording.ghosts import Ghost, Ghosts, ghost_of
from ai4u_edu.recording.recorder import Recorder
from ai4u_edu.recording.replay import Moment, Replay
from ai4u_edu.recording.verdict import Verdict

__all__ = [
    "AgentRecord",
    "Archive",
    "ArchiveEntry",
    "Decision",
    "Episode",
    "Ghost",
    "Ghosts",
    "Moment",
    "Recorder",
    "RecordingError",
    "Replay",
    "Verdict",
    "ghost_of",
    "recorder_into",
]


def __getattr__(name: str) -> Any:
    if name == "Entry":
        warnings.warn(f"{__name__}.Entry is now ArchiveEntry", DeprecationWarning, stacklevel=2)
        return ArchiveEntry
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
