"""Settings that a sweep varies, in the form of the command line's ``--set``."""

import re
from collections.abc import Iterable, Mapping, Sequence
from itertools import product
from typing import Any, Self

from pydantic import BaseModel, ConfigDict

from ai4u_edu.base.errors import SetupError
from ai4u_edu.learn.training.settings import ALGORITHMS, Algorithm, Settings
from ai4u_edu.locale import gettext as _

FORMS = _(
    "NAME=LOW..HIGH, NAME=LOW..HIGH:log, or NAME=VALUE,VALUE, as in learning_rate=1e-4..1e-2:log "
    "or layers=64x64,128x128"
)

LEFT_OUT = "without_reward"
"""Setting of :class:`~ai4u_edu.learn.training.settings.Settings` without a reward term."""

Value = bool | int | float | str | list[int]


class Parameter(BaseModel):
    """One setting that varies: a range, or values to choose from."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: str
    """Name of the setting; ``sac.tau`` is one of SAC alone."""
    values: tuple[Value, ...] = ()
    """The values to choose from; empty for a range."""
    low: float = 0.0
    high: float = 0.0
    is_log: bool = False
    """True draws from the range's logarithms."""
    is_whole: bool = False
    """True draws whole numbers."""

    @classmethod
    def parse(cls, text: str) -> Self:
        """Return the parameter that a text describes.

        Raises:
            SetupError: it is in no known form.

        >>> Parameter.parse("batch_size=64,128").values
        (64, 128)
        >>> rate = Parameter.parse("learning_rate=1e-4..1e-2:log")
        >>> rate.low, rate.high, rate.is_log, rate.is_whole
        (0.0001, 0.01, True, False)
        """
        name, _sign, told = text.partition("=")
        name, told = name.strip(), told.strip()
        if not re.fullmatch(r"(\w+\.)?\w+", name) or not told:
            raise SetupError(_("--set: expected {forms}; got {text!r}", forms=FORMS, text=text))
        if name.rpartition(".")[2] == "steps":
            raise SetupError(
                _("--set {text}: the number of decisions is set by --steps", text=text)
            )
        algorithm = name.partition(".")[0] if "." in name else ""
        if algorithm and algorithm not in ALGORITHMS:
            raise SetupError(
                _(
                    "--set {text}: expected one of {algorithms} before the point, got "
                    "{algorithm!r}",
                    text=text,
                    algorithms=", ".join(ALGORITHMS),
                    algorithm=algorithm,
                )
            )
        if ".." not in told:
            return cls(name=name, values=tuple(_value(each) for each in told.split(",")))
        ends, _sign, scale = told.partition(":")
        low, _sign, high = ends.partition("..")
        try:
            found = cls(
                name=name,
                low=float(low),
                high=float(high),
                is_log=scale == "log",
                is_whole=all(re.fullmatch(r"-?\d+", end) for end in (low, high)),
            )
        except ValueError:
            raise SetupError(
                _("--set: expected {forms}; got {text!r}", forms=FORMS, text=text)
            ) from None
        is_log_of_positive = scale == "log" and found.low > 0
        if not found.low < found.high or not (scale == "" or is_log_of_positive):
            raise SetupError(
                _(
                    "--set {text}: expected a smaller number, then a larger one, and with :log "
                    "both above 0",
                    text=text,
                )
            )
        return found

    @property
    def is_range(self) -> bool:
        """True if there are more values than can be listed."""
        return not self.values

    def is_for(self, algorithm: str) -> bool:
        """Return True if the setting is one of an algorithm's."""
        return "." not in self.name or self.name.partition(".")[0] == algorithm

    def __str__(self) -> str:
        if not self.is_range:
            return f"{self.name}={','.join(map(text_of, self.values))}"
        return f"{self.name}={self.low:g}..{self.high:g}{':log' if self.is_log else ''}"


def grid(parameters: Sequence[Parameter], algorithm: str) -> Iterable[dict[str, Value]]:
    """Yield all combinations of values for an algorithm.

    >>> [*grid([Parameter.parse("gamma=0.9,0.99"), Parameter.parse("sac.tau=0.01")], "ppo")]
    [{'gamma': 0.9}, {'gamma': 0.99}]
    """
    mine = [each for each in parameters if each.is_for(algorithm)]
    for values in product(*(each.values for each in mine)):
        yield {each.name: value for each, value in zip(mine, values, strict=True)}


def changes_of(algorithm: Algorithm, chosen: Mapping[str, Value]) -> dict[str, Any]:
    """Return chosen values in the form of a settings file.

    >>> changes_of("sac", {"sac.tau": 0.01, "skip_frame": 9})
    {'sac': {'tau': 0.01}, 'skip_frame': 9}
    """
    own: dict[str, Value] = {}
    changes: dict[str, Any] = {algorithm: own}
    for name, value in chosen.items():
        if name in Settings.model_fields:
            changes[name] = value
        else:
            own[name.rpartition(".")[2]] = value
    return changes


def text_of(value: object) -> str:
    """Return a value in a few characters; numbers with four digits."""
    if isinstance(value, list | tuple):
        return "x".join(map(str, value))
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def _value(text: str) -> Value:
    text = text.strip()
    if text in ("true", "false"):
        return text == "true"
    if re.fullmatch(r"\d+(x\d+)+", text):
        return [int(each) for each in text.split("x")]
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text
