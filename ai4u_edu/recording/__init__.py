"""Episodes that are kept, played again exactly, and exported."""

from ai4u_edu.recording.archive import Archive, Entry
from ai4u_edu.recording.episode import AgentRecord, Decision, Episode
from ai4u_edu.recording.errors import RecordingError
from ai4u_edu.recording.ghost import Ghost, ghost_of
from ai4u_edu.recording.recorder import Recorder
from ai4u_edu.recording.recorder_into import recorder_into
from ai4u_edu.recording.replay import Moment, Replay, Verdict

__all__ = [
    "AgentRecord",
    "Archive",
    "Decision",
    "Entry",
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
