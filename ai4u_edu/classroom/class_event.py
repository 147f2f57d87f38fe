"""The class as the teacher's page and the projector page get it."""

import re
import time
from collections import defaultdict
from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any

from msgspec.structs import asdict

from ai4u_edu.classroom.course_index import course_index, course_lessons, lesson_title, words_for
from ai4u_edu.classroom.help_score import MISTAKE_HELP
from ai4u_edu.classroom.live_class import LiveClass
from ai4u_edu.classroom.live_rooms import LiveRoom
from ai4u_edu.classroom.tournament.event import networks_event, tournament_event
from ai4u_edu.locale import catalogue, join, library_text
from ai4u_edu.locale import gettext as _
from ai4u_edu.member.episode_watch import PERSON
from ai4u_edu.page.messages import to_json
from ai4u_edu.page.server.library_pictures import picture_address
from ai4u_edu.scenes import Scene
from ai4u_edu.scenes.scene import LIBRARY
from ai4u_edu.scenes.star_goals import library_star_counts
from ai4u_edu.wire.class_link import MAX_SENT_SCENE_CHARS

_AGENT = re.compile(r"^  - id: \"?([^\W_]+)", re.MULTILINE)
_TITLE = re.compile(r"^title: *(.+?) *$", re.MULTILINE)
Event = dict[str, Any]
QrCode = Callable[[str], tuple[str, str]]
MAX_AGE_S = 0.5
MAX_CACHED = 8
"""Addresses and languages of open pages, for each of which an event is kept."""


class ClassEvents:
    """Events of a class as JSON; each is built once for all pages.

    Belongs to the event loop.

    Args:
        live: the class.
        join: returns the address that students open and its QR code, for the page's own.
        asks_for_code: False if students sign in elsewhere and need no code.
    """

    def __init__(self, live: LiveClass, join: QrCode, *, asks_for_code: bool = True) -> None:
        self._live, self._join, self._asks_for_code = live, join, asks_for_code
        self._cached: dict[tuple[str, bool, str], tuple[int, float, str]] = {}

    def text(self, url: str, *, is_projected: bool) -> str:
        """Return the present event as JSON, in the reader's language.

        Args:
            url: address of the page.
            is_projected: True for the page that everybody sees.
        """
        key = url, is_projected, catalogue().language
        version, built_at, text = self._cached.get(key, (-1, 0.0, ""))
        now = time.monotonic()
        # seconds that are left are in it, so it can't be kept for long
        if version != self._live.version or now - built_at > MAX_AGE_S:
            text = to_json(self.event(url, is_projected=is_projected)).decode()
            if len(self._cached) >= MAX_CACHED:
                self._cached.clear()
            self._cached[key] = self._live.version, now, text
        return text

    def event(self, url: str, *, is_projected: bool) -> Event:
        """Return the present event; see :meth:`text`."""
        live = self._live
        address, code = self._join(url)
        event: Event = {
            "type": "class",
            "code": live.seats.code if self._asks_for_code else "",
            "address": address,
            "qr": code,
            "open": live.seats.is_open,
            "problem": live.problem,
            "attention": live.attention.as_event(),
            "switches": asdict(live.switches),
            "shown": live.shown.model_dump(),
            "race": live.race.event(is_projected=is_projected),
            "tournament": tournament_event(
                live.tournament, live.seats.all(), is_projected=is_projected
            ),
            "scenes": _library(),
            "max_scene_chars": MAX_SENT_SCENE_CHARS,
            "exercises": [
                {**each._asdict(), "title": lesson_title(each.lesson)} for each in course_index()
            ],
            "lessons": _lessons(),
            "seats": self._seats(),
            "rooms": self._rooms(has_mistakes=not is_projected),
        }
        if is_projected:
            for room in event["rooms"]:
                del room["help"], room["why"], room["look_in"]
                del room["learning"], room["is_learning"]
            here = [seat["number"] for seat in event["seats"] if seat["is_here"]]
            event["mission_counts"] = live.missions.counts(here)
            return event
        event["rooms"].sort(key=lambda room: -room["help"])
        event["handed_in"] = networks_event(live.tournament)
        event["progress"] = live.progress.by_seat()
        event["stars"] = live.stars.by_seat()
        event["missions"] = live.missions.catalogue()
        event["mission_progress"] = live.missions.by_seat()
        event["mission_places"] = live.missions.places()
        event["runs"] = live.program_runs.by_seat()
        event["program_mistakes"] = live.program_runs.mistakes()
        event["misconceptions"] = misconceptions(live.progress.mistakes)
        return event

    def _seats(self) -> list[Event]:
        return [
            {
                "number": each.number,
                "name": each.name,
                "colour": each.colour,
                "room": each.room,
                "state": each.state,
                "is_here": self._live.is_here(each.number),
            }
            for each in self._live.seats.all()
        ]

    def _rooms(self, *, has_mistakes: bool) -> list[Event]:
        """Return all rooms that somebody has.

        Args:
            has_mistakes: True if the mistakes of students' programs are shown.
        """
        live = self._live
        found = []
        remote = {each.seat for each in live.rooms.values() if each.seat and each.state}
        members = {room: [each.number for each in seats] for room, seats in live.members().items()}
        for room, scene in live.seats.scenes().items() if live.host.is_hosting else ():
            state = live.room(room)
            is_used = state.state is not None or live.host.is_running(room)
            own = members.get(room, [])
            if own and (is_used or not remote.issuperset(own)):
                found.append(self._room(state, own, scene))
        for state in live.rooms.values():
            seats = members.get(state.id, [])
            if state.seat and seats and (state.link or state.state):
                found.append(self._room(state, seats, ""))
        for each in found if has_mistakes else ():
            self._note_stuck(each)
            mistakes = [live.program_runs.mistake_of(seat) for seat in each["seats"]]
            mistake = next(filter(None, mistakes), "")
            if each["status"] == "driving" and each["driver"] == PERSON:
                continue  # whoever drives by hand is not stuck in the program
            if mistake and each["help"] < MISTAKE_HELP:
                why = _("program stopped: {mistake}", mistake=mistake)
                each |= {"help": MISTAKE_HELP, "why": why}
                if each["status"] not in ("asleep", "away"):
                    each["status"] = "mistake"
        return found

    def _note_stuck(self, room: Event) -> None:
        """Note in a room's event who of it is stuck in a mission, if that needs help most."""
        live = self._live
        if live.attention.kind:  # nobody can go on
            return
        here = [seat for seat in room["seats"] if live.is_here(seat)]
        help_, why = max(map(live.missions.stuck, here), default=(0, ""))
        if help_ > room["help"]:
            room |= {"help": help_, "why": why}

    def _room(self, room: LiveRoom, seats: list[int], scene: str) -> Event:
        state, score = room.state, room.help()
        is_remote = room.kind == "remote"
        is_running = room.link is not None if is_remote else self._live.host.is_running(room.id)
        status = "away" if is_remote or is_running else "asleep"
        if room.link is not None and (is_remote or self._live.host.is_used(room.id)):
            status = state.status if state else "waiting"
        return {
            "id": room.id,
            "seats": seats,
            "kind": room.kind,
            "status": status,
            "is_running": is_running,
            "look_in": _look_in(room),
            "scene": state.scene if state else scene,
            "driver": state.driver if state else "",
            "seconds": round(state.seconds, 1) if state else 0.0,
            "episodes": state.episodes if state else 0,
            "falls": state.falls if state else 0,
            "is_solved": state.is_solved if state else False,
            "learning": self._learning(room.id),
            "is_learning": self._is_learning(room.id),
            "error": (state.error if state else "") or room.problem,
            "help": score[0],
            "why": score[1],
        }

    def _learning(self, room: str) -> str:
        """Return how the networks of a room learn, or have learned; empty if it has none."""
        queues = self._live.practices, self._live.trainings, self._live.tasks
        sentences = [sentence for queue in queues if (sentence := queue.sentence(room))]
        return join(sentences, "; ") if sentences else ""

    def _is_learning(self, room: str) -> bool:
        training = self._live.trainings.of_room(room)
        practices, tasks = self._live.practices.of_room(room), self._live.tasks.of_room(room)
        is_cloning = training is not None and not training.is_over
        is_over = [*(each.is_over for each in practices), *(each.is_over for each in tasks)]
        return is_cloning or not all(is_over)


def _look_in(room: LiveRoom) -> str:
    """Return the address of a room's page, relative to the teacher's; empty if there is no way."""
    if room.kind == "local":
        return f"./r/{room.id}/"
    has_page = room.link is not None and room.state is not None and bool(room.state.page)
    return f"./teacher/look/{room.id}" if has_page else ""


def misconceptions(mistakes: Mapping[tuple[int, str, str], int]) -> list[Event]:
    """Return the mistakes of a class, the most frequent first, with words for each.

    Args:
        mistakes: count by seat, diagnosis and exercise.
    """
    found: dict[tuple[str, str], dict[int, int]] = defaultdict(dict)
    for (seat, diagnosis, exercise), count in mistakes.items():
        found[exercise, diagnosis][seat] = count
    rows = []
    for (exercise, diagnosis), seats in found.items():
        sentence, guide = words_for(exercise, diagnosis)
        rows.append(
            {
                "exercise": exercise,
                "diagnosis": diagnosis,
                "count": sum(seats.values()),
                "seats": sorted(seats),
                "sentence": sentence,
                "guide": guide,
            }
        )
    return sorted(rows, key=lambda row: (-len(row["seats"]), -row["count"], row["exercise"]))


def _lessons() -> list[Event]:
    return [
        {"number": each.number, "title": lesson_title(each.number), "scene": each.scene}
        for each in course_lessons()
    ]


@lru_cache(maxsize=1)
def _library() -> list[Event]:
    """Return the scenes of the library, by title.

    To load them all would take a second, in which no room is served.
    """
    found = []
    stars = library_star_counts()
    for name in Scene.names():
        text = (LIBRARY / f"{name}.yaml").read_text(encoding="utf-8")
        title = _TITLE.search(text)
        found.append(
            {
                "name": name,
                "title": library_text(title[1]) if title else name,
                "stars": stars[name],
                "is_duel": len(set(_AGENT.findall(text))) > 1,
                "picture": picture_address(name),
            }
        )
    return sorted(found, key=lambda each: each["title"].lower())
