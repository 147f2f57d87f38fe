"""Plan of a tournament: all that its results depend on, kept in its folder."""

import math
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, ValidationError, model_validator

from ai4u_edu.base.atomic_write import make_folder, write_atomically
from ai4u_edu.base.errors import SetupError
from ai4u_edu.base.parameters import explain, format_problems
from ai4u_edu.games.tournament.entry import Entry
from ai4u_edu.games.tournament.sides import Sides, sides_of
from ai4u_edu.locale import gettext as _
from ai4u_edu.scenes.scene_data import scene_from

FILE = "tournament.json"
CHECK_SEED = 2**31 - 1
"""Seed of the game that an entry plays against itself before it takes part."""


class TournamentPlan(BaseModel):
    """Scene, entries, seeds and system of a tournament."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    scene: dict[str, Any]
    """See :func:`ai4u_edu.scenes.scene_data.scene_data`."""
    entries: tuple[Entry, ...]
    seeds: tuple[int, ...]
    """Seeds of each pair's duels, or of the races."""
    system: Literal["round-robin", "swiss"]
    rounds: int
    """Rounds of the Swiss system; 0 for as many as find the best one."""

    @model_validator(mode="after")
    def _check_entries(self) -> "TournamentPlan":
        names = [each.name for each in self.entries]
        if len({*names}) < len(names):
            raise ValueError(
                _("expected entries with different names, got {names}", names=", ".join(names))
            )
        return self

    @property
    def text(self) -> str:
        """The plan as its file has it."""
        return self.model_dump_json(indent=1) + "\n"

    @property
    def sides(self) -> Sides:
        """Sides of the scene."""
        return sides_of(scene_from(self.scene))

    @property
    def title(self) -> str:
        """Name of the scene."""
        return scene_from(self.scene).description.name

    def rounds_for(self, count: int) -> int:
        """Return the number of Swiss rounds for a number of entries."""
        return self.rounds or max(1, math.ceil(math.log2(max(2, count))) + 1)

    def games_for(self, count: int) -> int:
        """Return the number of games for a number of entries, without their checks."""
        if self.sides.is_race:
            return count * len(self.seeds)
        if self.system == "swiss":
            return count // 2 * self.rounds_for(count) * 2 * len(self.seeds)
        return count * (count - 1) * len(self.seeds)

    def save(self, folder: Path) -> None:
        """Write the plan into a tournament's folder."""
        make_folder(folder, _("a tournament"))
        write_atomically(folder / FILE, self.text)

    @classmethod
    def load(cls, folder: Path) -> "TournamentPlan":
        """Read the plan of a tournament's folder.

        Raises:
            SetupError: there is no tournament in the folder.
        """
        path = folder / FILE
        try:
            return cls.model_validate_json(path.read_bytes())
        except OSError:
            raise SetupError(
                _(
                    "{folder} holds no tournament; begin one with: ai4u-edu tournament SCENE "
                    "ENTRY ENTRY --out {folder}",
                    folder=str(folder),
                )
            ) from None
        except ValidationError as error:
            raise SetupError(
                _(
                    "{path}: not as a tournament writes it: {problem}",
                    path=str(path),
                    problem=format_problems(explain(error.errors(), cls)),
                )
            ) from None

    def difference(self, other: "TournamentPlan") -> str:
        """Return the name of a part that differs; empty if both are equal."""
        names = type(self).model_fields
        return next((each for each in names if getattr(self, each) != getattr(other, each)), "")
