"""Recording, exact replay and export of episodes."""

from ai4u_edu.recording.agent_record import AgentRecord, RecordedDecision
from ai4u_edu.recording.archive import Archive, ArchiveEntry
from ai4u_edu.recording.episode import Episode
from ai4u_edu.recording.errors import RecordingError
from ai4u_edu.recording.ghosts import Ghost, Ghosts, ghost_of
from ai4u_edu.recording.recorder import Recorder
from ai4u_edu.recording.replay import Replay, ReplayMoment
from ai4u_edu.recording.verdict import Verdict

__all__ = [
    "AgentRecord",
    "Archive",
    "ArchiveEntry",
    "Episode",
    "Ghost",
    "Ghosts",
    "RecordedDecision",
    "Recorder",
    "RecordingError",
    "Replay",
    "ReplayMoment",
    "Verdict",
    "ghost_of",
]
