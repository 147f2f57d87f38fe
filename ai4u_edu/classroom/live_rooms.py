"""Present states of the rooms of a class, as their links sent them."""

import json
import time
from dataclasses import dataclass
from typing import Literal, Protocol

from ai4u_edu.classroom.help_score import Signals, help_score
from ai4u_edu.member.room_state import RoomCounts
from ai4u_edu.wire.class_link import Drawing, DrawnShape, FromClass, People, Poses, State, Work

REMOTE_PREFIX = "seat-"
POSE_DIGITS = 3


class OpenLink(Protocol):
    """The class's side of an open link."""

    def send(self, message: FromClass) -> None:
        """Send a message; one of the same kind that was not sent yet is left out."""

    def end(self, sentence: str) -> None:
        """End the link for good."""


@dataclass
class LiveRoom:
    """Present state of a room. Belongs to the event loop."""

    id: str
    kind: Literal["local", "remote"]
    seat: int = 0
    """Number of the seat of a remote room; 0 for a local one."""
    link: OpenLink | None = None
    state: State | None = None
    work: Work | None = None
    drawing: Drawing | None = None
    drawing_json: str = ""
    """The present drawing as a message for pages; empty before the first one."""
    poses_json: str = ""
    poses_version: int = 0
    idle_since: float = 0.0
    """Time (s, monotonic) since when its status is idle."""
    wrong: int = 0
    wrong_answer: tuple[str, str] = ("", "")
    """Exercise and diagnosis of the last wrong check, and how often it came in a row."""
    problem: str = ""
    """Reason for which the room could not open its assignment."""
    people: People | None = None
    """Seats that were sent to the link."""

    def note_state(self, state: State) -> None:
        """Take a new state."""
        was_idle = self.state is not None and self.state.status == "idle"
        if state.status == "idle" and not was_idle:
            self.idle_since = time.monotonic()
        self.state = state

    def note_counts(self, counts: RoomCounts) -> None:
        """Take what an earlier process of the room has counted, until it runs again."""
        if counts.episodes:
            numbers = counts.episodes, counts.falls, counts.is_solved
            self.state = State("idle", counts.scene, "", 0.0, *numbers)

    def note_drawing(self, drawing: Drawing) -> None:
        """Take a new drawing; poses of another one are void."""
        self.drawing = drawing
        self.drawing_json = json.dumps(
            {
                "type": "drawing",
                "room": self.id,
                "number": drawing.number,
                "bounds": drawing.bounds,
                "ground": [_shape(each) for each in drawing.ground],
                "bodies": [
                    {
                        "name": each.name,
                        "is_agent": each.is_agent,
                        "shapes": [_shape(one) for one in each.shapes],
                    }
                    for each in drawing.bodies
                ],
            }
        )

    def note_poses(self, poses: Poses) -> None:
        """Take new poses."""
        values = [round(each, POSE_DIGITS) for each in poses.values]
        self.poses_json = json.dumps({"drawing": poses.drawing, "values": values})
        self.poses_version += 1

    def note_check(self, exercise: str, diagnosis: str) -> None:
        """Count checks in a row with the same mistake; an empty diagnosis is a right answer."""
        is_same = (exercise, diagnosis) == self.wrong_answer
        self.wrong = (self.wrong + 1 if is_same else 1) if diagnosis else 0
        self.wrong_answer = exercise, diagnosis

    def help(self) -> tuple[int, str]:
        """Return how much the room needs help, and why; see :func:`help_score`."""
        state = self.state
        exercise = self.wrong_answer[0]
        if state is None or self.link is None:
            lost = self.kind == "remote" and self.link is None
            return help_score(Signals(wrong=self.wrong, exercise=exercise, lost=lost))
        return help_score(
            Signals(
                status=state.status,
                error=state.error,
                is_solved=state.is_solved,
                falls=state.falls,
                episodes=state.episodes,
                idle_minutes=(time.monotonic() - self.idle_since) / 60,
                wrong=self.wrong,
                exercise=exercise,
            )
        )


def remote_id(seat: int) -> str:
    """Return the id of the room that a seat brings along.

    >>> remote_id(7)
    'seat-7'
    """
    return f"{REMOTE_PREFIX}{seat}"


def _shape(shape: DrawnShape) -> dict[str, object]:
    return {"colour": shape.colour, "radius": shape.radius, "points": shape.points}
