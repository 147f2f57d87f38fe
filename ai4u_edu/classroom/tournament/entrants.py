"""The plan of a class's tournament: an entry for each seat with networks that can play."""

import json
import shutil
from collections import defaultdict
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Literal

from ai4u_edu.base.atomic_write import reason, write_atomically
from ai4u_edu.base.errors import SetupError
from ai4u_edu.classroom.errors import CommandError, StoreError
from ai4u_edu.classroom.store import SeatRow
from ai4u_edu.classroom.tournament.network_check import driver_of
from ai4u_edu.classroom.tournament.network_scene import network_scenes
from ai4u_edu.classroom.tournament.networks import Networks
from ai4u_edu.games.tournament.entry import Driver
from ai4u_edu.games.tournament.plan import TournamentPlan

SEATS = "seats.json"
"""File with the number of the seat of each entry; 0 for the scene's own player."""
System = Literal["round-robin", "swiss"]


def write_plan(
    folder: Path,
    work: Path,
    networks: Networks,
    seats: Sequence[SeatRow],
    scene: str,
    seeds: int,
    system: System,
    *,
    has_own_player: bool,
) -> None:
    """Write the plan of a tournament into its folder; a thread does it.

    The journal of games that were played before stays, so a game with the same networks is not
    played again.

    Args:
        folder: of the tournament's results.
        work: gets the seats of the entries.
        networks: of the class.
        seats: those that may take part.
        scene: name of a scene of the library.
        seeds: number of seeds for each pair, or of races.
        system: of the pairs.
        has_own_player: True if the scene's own player takes part.

    Raises:
        CommandError: fewer than two can play.
        StoreError: it can't be written.
    """
    try:
        plan, numbers = _plan(networks, seats, scene, seeds, system, has_own_player)
        shutil.rmtree(folder, ignore_errors=True)  # files of a plan before; see the journal
        plan.save(folder)
        work.mkdir(exist_ok=True)
        write_atomically(work / SEATS, json.dumps(numbers))
    except OSError as error:
        raise StoreError(f"The tournament can't be saved: {reason(error)}.") from None
    except SetupError as error:
        raise StoreError(f"The tournament can't be saved: {error}.") from None


def _plan(
    networks: Networks,
    seats: Sequence[SeatRow],
    scene: str,
    seeds: int,
    system: System,
    has_own_player: bool,
) -> tuple[TournamentPlan, dict[str, int]]:
    """Return the plan, and the number of the seat of each entry."""
    known = network_scenes()[scene]
    own: dict[int, dict[str, Driver]] = defaultdict(dict)
    for row in networks.playing(scene):
        own[row.seat][row.part] = driver_of(networks, row)
    playing = [seat for seat in seats if seat.number in own]
    entries = [known.entry(seat.name, own[seat.number]) for seat in playing]
    numbers = {seat.name: seat.number for seat in playing}
    player = known.own_player() if has_own_player else None
    if player is not None:
        entries.append(player)
        numbers[player.name] = 0
    if len(entries) < 2:
        raise CommandError(
            f"A tournament needs two players at least, and {len(entries)} can play: wait until "
            "more networks were handed in and checked, or let the scene's player take part."
        )
    plan = TournamentPlan(
        scene={"name": scene},
        entries=tuple(entries),
        seeds=tuple(range(seeds)),
        system=system,
        rounds=0,
    )
    return plan, numbers


def seats_of(work: Path) -> Mapping[str, int]:
    """Return the number of the seat of each entry of a tournament; a thread does it."""
    try:
        found: dict[str, int] = json.loads((work / SEATS).read_bytes())
    except (OSError, ValueError):
        return {}
    return found
