"""Scenes that the teacher has given to rooms."""

import secrets
from collections.abc import Iterable
from dataclasses import dataclass, replace

from ai4u_edu.classroom.store import ClassStore
from ai4u_edu.wire.class_link import Assignment, race_assignment

EVERY_ROOM = ""
"""Id in the place of a room's for rooms that have no assignment of their own, also later ones."""
NONE = Assignment("", "", "", None)


@dataclass(frozen=True)
class AssignedScene:
    """A scene to assign."""

    title: str
    text: str
    """Name in the library, or YAML; empty if worlds are to stay as they are."""
    lesson: str = ""
    """Lesson that it belongs to; empty for none."""
    program: str = ""
    """Python that students may begin with; empty for none."""
    mission: str = ""
    """Name of the mission for which it is assigned; empty for none."""


class Assignments:
    """The present assignment of each room, in memory and in the class's file.

    Args:
        store: of the class.
    """

    def __init__(self, store: ClassStore) -> None:
        self._store = store
        self.read()

    def read(self) -> None:
        """Read all from the store."""
        rows = self._store.query(
            "select room, id, title, scene, seed, lesson, program, mission from assignments"
        )
        self._by_room = {room: Assignment(*rest) for room, *rest in rows}

    def of(self, room: str) -> Assignment:
        """Return a room's assignment; an empty one if nothing is assigned."""
        return self._by_room.get(room) or self._by_room.get(EVERY_ROOM, NONE)

    def forget(self, rooms: Iterable[str]) -> None:
        """Forget rooms that were deleted."""
        for room in rooms:
            self._by_room.pop(room, None)

    def assign_race(self, scene: AssignedScene, race: str) -> None:
        """Store a race's scene for students who come later; rooms that know the race have it.

        Args:
            scene: of the race.
            race: its id.

        Raises:
            StoreError: it can't be stored; then nothing has changed.
        """
        lesson = self._by_room.get(EVERY_ROOM, NONE).lesson
        self.assign(replace(scene, lesson=lesson), None, None, race_assignment(race))

    def assign(
        self,
        scene: AssignedScene,
        rooms: Iterable[str] | None,
        seed: int | None,
        name: str = "",
    ) -> None:
        """Store an assignment, which replaces others.

        Args:
            scene: the scene.
            rooms: ids of the rooms; None for all, also those of students who come later.
            seed: of the world; None for a random one in each room.
            name: id of the assignment; by default a random one.

        Raises:
            StoreError: it can't be stored; then nothing has changed.
        """
        name = name or secrets.token_hex(8)
        facts = (scene.title, scene.text, seed, scene.lesson, scene.program, scene.mission)
        assignment = Assignment(name, *facts)
        places = [EVERY_ROOM] if rooms is None else list(rooms)
        with self._store.transaction() as database:
            if rooms is None:
                database.execute("delete from assignments")
            database.executemany(
                "insert or replace into assignments values (?, ?, ?, ?, ?, ?, ?, ?)",
                [(each, name, *facts) for each in places],
            )
        if rooms is None:
            self._by_room = {}
        self._by_room |= dict.fromkeys(places, assignment)
