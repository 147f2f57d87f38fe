"""Stars that students' programs have earned in the scenes of the library.

A student's page tells them, as a notebook tells the results of exercises; nobody proves them.
"""

from collections import defaultdict

from ai4u_edu.classroom.store import ClassStore
from ai4u_edu.scenes.star_goals import library_star_counts

_SAVE = (
    "insert into stars values (?, ?, ?) "
    "on conflict do update set count = max(count, excluded.count)"
)


class Stars:
    """The stars of a class, in memory and in its file.

    Belongs to the event loop, except :meth:`save`.

    Args:
        store: of the class.
    """

    def __init__(self, store: ClassStore) -> None:
        self._store = store
        self.read()

    def read(self) -> None:
        """Read all stars from the store."""
        self._of: dict[int, dict[str, int]] = defaultdict(dict)
        for seat, scene, count in self._store.query("select seat, scene, count from stars"):
            self._of[seat][scene] = count

    def save(self, seat: int, scene: str, count: int) -> None:
        """Store the stars of a seat in a scene, which never become fewer; a thread may do it.

        Raises:
            ValueError: there is no such scene in the library, or it has fewer stars.
            StoreError: it can't be written.
        """
        most = library_star_counts().get(scene, 0)
        if not 1 <= count <= most:
            raise ValueError(f"expected 1 to {most} stars in the scene {scene[:80]!r}, got {count}")
        with self._store.transaction() as database:
            database.execute(_SAVE, [seat, scene, count])

    def note(self, seat: int, scene: str, count: int) -> None:
        """Take over stars that are on disk."""
        self._of[seat][scene] = max(count, self._of[seat].get(scene, 0))

    def of_seat(self, seat: int) -> dict[str, int]:
        """Return the stars of a seat by scene."""
        return dict(self._of.get(seat, {}))

    def by_seat(self) -> dict[str, dict[str, int]]:
        """Return all stars as the teacher's page gets them."""
        return {str(seat): dict(stars) for seat, stars in self._of.items() if stars}
