"""Commands that ask why an agent acts as it does."""

from typing import Annotated

from msgspec import Meta, Struct

from ai4u_edu.page.messages import Degrees, Metres, Name, Number, PageCommand


class ShowWhy(PageCommand, tag="why"):
    """Show why the agent acts as it does, or no longer."""

    on: bool


class ShowMaps(PageCommand, tag="maps"):
    """Show maps over the floor: what the agent would do at each place, and what it is worth."""

    field: bool
    values: bool
    facing: Name = ""


class Change(Struct, forbid_unknown_fields=True):
    """Another value of one number of a percept."""

    key: Name
    index: Number
    value: Annotated[float, Meta(ge=-1e9, le=1e9)]


class AskWhatIf(PageCommand, tag="what_if"):
    """Return the action on the agent's percept, and on a changed one."""

    changes: Annotated[list[Change], Meta(max_length=128)]


class AskElsewhere(PageCommand, tag="elsewhere"):
    """Return the action at another pose, and show it; by default where the agent stands now."""

    x: Metres | None = None
    y: Metres | None = None
    heading_deg: Degrees | None = None


class HideElsewhere(PageCommand, tag="hide_elsewhere"):
    """Show no other pose any more."""


class AskPaid(PageCommand, tag="paid"):
    """Return the reward terms of the chosen episode over time, and the decisions that paid most."""


class ListRivals(PageCommand, tag="rivals"):
    """Return the drivers that the present one can be compared with."""


class CompareDrivers(PageCommand, tag="compare"):
    """Return where two drivers first disagree in the chosen episode; empty for the present one."""

    first: Name
    second: Name


class WatchNetwork(PageCommand, tag="watch_network"):
    """Let a trained network drive for a while, from the same start, and show why it acts so."""

    network: Name = ""
    """Name of the driver; empty for the usual one."""
    against_my_drive: bool = False
    """True to let it race against a person's best or last drive, from the start of that."""


class StopWatching(PageCommand, tag="stop_watching"):
    """Give the agent back to its own driver, at the same start."""


class RaceNetwork(PageCommand, tag="race_network"):
    """Let a person race against a trained network's ghost, from the same start."""

    network: Name = ""
    """Name of the driver; empty for the usual one."""
