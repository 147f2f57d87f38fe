"""Deletion of what a class keeps: everything, or what is of one seat."""

import asyncio

from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.live_rooms import remote_id
from ai4u_edu.classroom.race import FOLDER as RACES
from ai4u_edu.classroom.room_proxy import RoomProxy
from ai4u_edu.classroom.seats import SeatState
from ai4u_edu.classroom.store import TEACHER_SETTING
from ai4u_edu.classroom.tournament.networks import FOLDER as NETWORKS
from ai4u_edu.classroom.tournament.tournaments import FOLDER as TOURNAMENTS
from ai4u_edu.locale import gettext as _

ROOMS = "rooms"


async def delete_class(live: LiveClass, proxy: RoomProxy) -> None:
    """Delete everything of a class but the secret of the teacher's page, and set a new code.

    Nothing of seats, tokens, names and addresses is left in the folder; the file with the tables
    is made again, since deleted rows may be read from one.

    Raises:
        StoreError: something can't be deleted; the class goes on without what is deleted already.
    """
    rooms, seats = list(live.seats.scenes()), live.seats.all()
    live.seats.let_nobody_in()  # else a page that comes back would start its room again
    live.end_all_links(_("The class is over, and your teacher has deleted everything of it."))
    for seat in seats:
        proxy.end(seat.number, _("the class is over"))
    await asyncio.gather(*(live.host.end(each) for each in rooms))
    await live.results.finish()
    await live.tournament.end()
    await live.trainings.end()
    await live.practices.end()
    await live.tasks.end()
    live.attention.end()  # so that no message of the teacher is saved again
    await asyncio.to_thread(_delete_all, live)
    live.begin_anew()


async def delete_seat(live: LiveClass, proxy: RoomProxy, number: int) -> None:
    """Delete everything of a seat, and of its room if no other seat has that.

    Tournaments that its networks have played in are deleted, too: their journals have the games.
    What the teacher has handed out to others has no name, and stays.

    Args:
        live: the class.
        proxy: has the sockets of the rooms' pages.
        number: of the seat.

    Raises:
        JoinError: there is no such seat.
        CommandError: a tournament is played now.
        StoreError: something can't be deleted; the seat is banned, and can be deleted again.
    """
    live.tournament.refuse_while_running()
    # first, else a page that comes back would start its room again
    await asyncio.to_thread(live.seats.set_state, number, SeatState.BANNED)
    sentence = _("Your teacher has deleted this seat, with everything of it.")
    proxy.end(number, sentence)
    live.end_links(number, sentence)
    (seat,) = (each for each in live.seats.all() if each.number == number)
    rooms = [remote_id(number)]
    if live.all_seats_of(seat.room) == [seat]:
        rooms.append(seat.room)
        await live.host.end(seat.room)
    for room in rooms:
        await live.trainings.delete(room)
        await live.practices.delete(room)
        await live.tasks.delete(room)
    await live.results.finish()
    await live.tournament.delete(number)
    if live.shown.room in rooms:
        live.show("join", "")
    await asyncio.to_thread(_delete_rows, live, number, rooms)
    live.forget(number, rooms)


def _delete_all(live: LiveClass) -> None:
    token = live.store.setting(TEACHER_SETTING)
    live.seats.begin_anew()
    live.store.set_setting(TEACHER_SETTING, token)
    live.store.delete_folders(ROOMS, RACES, NETWORKS, TOURNAMENTS)


def _delete_rows(live: LiveClass, number: int, rooms: list[str]) -> None:
    """Delete a seat and its rooms from the disk."""
    live.store.delete_folders(*(f"{ROOMS}/{room}" for room in rooms))
    live.races.delete_episodes(rooms)
    live.seats.delete(number, rooms)
