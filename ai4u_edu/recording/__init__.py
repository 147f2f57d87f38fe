"""Recording, exact replay and export of episodes."""

from ai4u_edu.recording.archive import Archive, ArchiveEntry
from ai4u_edu.recording.episode import AgentRecord, Decision, Episode
from ai4u_edu.recording.errors import RecordingError
from ai4u_edu.recording.folder_recorder import recorder_into
from ai4u_edu.recording.ghost import Ghost, ghost_of
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
    "Moment",
    "Recorder",
    "RecordingError",
    "Replay",
    "Verdict",
    "ghost_of",
    "recorder_into",
]
