"""Deprecated alias of :mod:`ai4u_edu.agent.cycle`; it will go with the next release."""

import warnings

from ai4u_edu.agent.cycle import *  # noqa: F403 - all public names, for old imports

warnings.warn(
    "ai4u_edu.cycle has moved: import from ai4u_edu.agent.cycle", DeprecationWarning, stacklevel=2
)
