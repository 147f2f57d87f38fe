"""Forget a class: end its rooms, delete all that was made, and begin anew."""

import asyncio
import shutil

from ai4u_edu.base.atomic_write import reason
from ai4u_edu.classroom.errors import StoreError
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.race import FOLDER as RACES
from ai4u_edu.classroom.room_proxy import RoomProxy
from ai4u_edu.classroom.store import TEACHER_SETTING
from ai4u_edu.classroom.tournament.networks import FOLDER as NETWORKS
from ai4u_edu.classroom.tournament.tournaments import FOLDER as TOURNAMENTS

FOLDERS = ("rooms", RACES, NETWORKS, TOURNAMENTS)
"""Folders of a class beside its file."""
SENTENCE = "The class is over, and your teacher has deleted everything of it."


async def forget(live: LiveClass, proxy: RoomProxy) -> None:
    """Delete everything of a class but the secret of the teacher's page, and set a new code.

    Nothing of seats, tokens, names and addresses is left in the folder; the file with the tables
    is made anew, since deleted rows may be read from one.

    Raises:
        StoreError: something can't be deleted; the class goes on without what is deleted already.
    """
    rooms, seats = list(live.seats.scenes()), live.seats.all()
    live.seats.let_nobody_in()  # else a page that comes back would start its room again
    live.end_all_links(SENTENCE)
    for seat in seats:
        proxy.end(seat.number, "the class is over")
    await asyncio.gather(*(live.host.end(each) for each in rooms))
    await live.results.finish()
    await live.tournament.end()
    live.attention.end()  # so that no message of the teacher is saved again
    await asyncio.to_thread(_delete, live)
    live.begin_anew()


def _delete(live: LiveClass) -> None:
    token = live.store.setting(TEACHER_SETTING)
    live.seats.begin_anew()
    live.store.set_setting(TEACHER_SETTING, token)
    for name in FOLDERS:
        folder = live.store.folder / name
        try:
            if folder.exists():
                shutil.rmtree(folder)
        except OSError as error:
            raise StoreError(
                f"{folder} can't be deleted: {reason(error)}. Delete it yourself."
            ) from None
