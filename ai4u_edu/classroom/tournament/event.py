"""Networks and the tournament as the teacher's page and the projector page get them."""

from collections.abc import Mapping, Sequence
from typing import Any

from ai4u_edu.classroom.store import SeatRow
from ai4u_edu.classroom.tournament.network_check import missing_extras
from ai4u_edu.classroom.tournament.network_scene import OWN_PLAYER
from ai4u_edu.classroom.tournament.networks import NetworkRow
from ai4u_edu.classroom.tournament.runner import TournamentRunner
from ai4u_edu.locale import library_text, unpacked

NEUTRAL = "#808080"
"""Colour of an entry that is of no seat."""
Event = dict[str, Any]


def tournament_event(
    runner: TournamentRunner, seats: Sequence[SeatRow], *, is_projected: bool
) -> Event | None:
    """Return the present tournament; None if there is none.

    Entries have the present names of their seats.

    Args:
        runner: of the class.
        seats: all of the class.
        is_projected: True for the page that everybody sees: without problems of the machine, and
            without the reasons for which networks failed.
    """
    row = runner.tournaments.now
    if row is None:
        return None
    players = {each.seat for each in runner.networks.playing(row.scene)}
    event: Event = {
        "id": row.id,
        "scene": row.scene,
        "title": library_text(row.title),
        "phase": row.phase,
        "players": sum(each.number in players and each.state == "in" for each in seats),
        "results": None,
    }
    if runner.view is not None:
        event["results"] = _results(runner.view, _people(runner.seats, seats), is_projected)
    if not is_projected:
        event["problem"] = row.problem
    return event


def networks_event(runner: TournamentRunner) -> Event:
    """Return what was handed in, and what is missing to check and play it."""
    return {
        "missing": missing_extras() if runner.networks.rows or runner.tournaments.now else "",
        "networks": [network_facts(each) | {"seat": each.seat} for each in runner.networks.rows],
    }


def network_facts(row: NetworkRow) -> Event:
    """Return a network as its student and the teacher see it."""
    return {
        "key": row.key,
        "scene": row.scene,
        "part": row.part,
        "file": row.file,
        "verdict": row.verdict,
        "reason": unpacked(row.reason),
    }


def _people(entries: Mapping[str, int], seats: Sequence[SeatRow]) -> dict[str, Event]:
    """Return name, colour and seat of each entry by its name."""
    known = {each.number: each for each in seats}
    found = {}
    for name, number in entries.items():
        seat = known.get(number)
        shown = OWN_PLAYER if name == OWN_PLAYER else name
        found[name] = {
            "name": shown if seat is None else seat.name,
            "colour": NEUTRAL if seat is None else seat.colour,
            "seat": number,
        }
    return found


def _results(view: Event, people: Mapping[str, Event], is_projected: bool) -> Event:
    def who(name: str) -> Event:
        return people.get(name, {"name": name, "colour": NEUTRAL, "seat": 0})

    def game(each: Event) -> Event:
        return {
            "number": each["number"] if each["file"] else 0,
            "who": [who(name) for name in each["names"]],
            "points": each["points"],
            "seed": each["seed"],
        }

    order = [each["name"] for each in view["standings"]]
    return {
        "games": view["games"],
        "total": view["total"],
        "is_race": view["is_race"],
        "standings": [
            {
                **each,
                **who(each["name"]),
                "against": [each["against"].get(other) for other in order],
            }
            for each in view["standings"]
        ],
        "latest": [
            {
                "entries": [{**each, **who(each["name"])} for each in contest["entries"]],
                "seed": contest["seed"],
                "problem": "" if is_projected else unpacked(contest["problem"]),
                "has_failed": bool(contest["problem"]),
                "games": [game(each) for each in contest["games"]],
            }
            for contest in view["latest"]
        ],
        "best": [game(each) for each in view["best"]],
        "refused": []
        if is_projected
        else [
            {**who(name), "reason": unpacked(reason)} for name, reason in view["refused"].items()
        ],
    }
