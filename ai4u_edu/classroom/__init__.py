"""A class: many rooms behind one address, with seats in place of accounts."""

from ai4u_edu.classroom.gateway import class_app
from ai4u_edu.classroom.local_rooms import LocalRooms
from ai4u_edu.classroom.seats import RoomRule, Seats
from ai4u_edu.classroom.store import ClassStore

__all__ = ["ClassStore", "LocalRooms", "RoomRule", "Seats", "class_app"]
