"""A job: the name of a function, and what it is called with."""

import hashlib
import importlib
import json
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Self

from ai4u_edu.locale import gettext as _


@dataclass(frozen=True)
class Job:
    """A call of a function, as data: so it can be sent to another machine and kept in a file.

    >>> Job.of(json.dumps, obj=[1, 2]).run()
    '[1, 2]'
    """

    function: str
    """The function's module and name, such as ``ai4u_edu.learn.training.evaluating:evaluate``."""
    arguments: dict[str, Any] = field(default_factory=dict)
    """Keyword arguments: data that JSON can hold."""

    @classmethod
    def of(cls, function: Callable[..., Any], /, **arguments: Any) -> Self:
        """Return a job that calls a function of a module.

        Args:
            function: can be imported by its name; its result is data that JSON can hold.
            **arguments: data that JSON can hold.

        Raises:
            ValueError: the function has no such name, or an argument is other data.
        """
        name = f"{function.__module__}:{function.__qualname__}"
        job = cls(name, arguments)
        if "." in function.__qualname__ or function.__module__ == "__main__":
            raise ValueError(_("expected a function that a module defines, got {name}", name=name))
        try:
            is_plain = json.loads(json.dumps(arguments, allow_nan=False)) == arguments
        except (TypeError, ValueError):
            is_plain = False
        if not is_plain:
            raise ValueError(
                _(
                    "{name}: expected arguments that JSON can hold, got {arguments}",
                    name=name,
                    arguments=repr(arguments),
                )
            )
        return job

    @cached_property
    def key(self) -> str:
        """Hash of function and arguments; equal jobs have equal keys, on every machine."""
        text = json.dumps([self.function, self.arguments], sort_keys=True, allow_nan=False)
        return hashlib.sha256(text.encode()).hexdigest()[:32]

    def run(self) -> Any:
        """Import the function, call it, and return its result."""
        module, _, name = self.function.partition(":")
        return getattr(importlib.import_module(module), name)(**self.arguments)


@dataclass(frozen=True)
class JobOutcome:
    """End of a job."""

    job: Job
    result: Any = None
    """Return value of the function; None after an error."""
    error: str = ""
    """Sentence on why there is no result; empty if there is one."""
    tries: int = 1
    seconds: float = 0.0
    """Duration of the latest try, where it ran."""

    @property
    def is_done(self) -> bool:
        """True if there is a result."""
        return not self.error
