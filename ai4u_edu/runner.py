"""Deprecated alias of :mod:`ai4u_edu.runtime.runner`; it will go with the next release."""

import warnings

from ai4u_edu.runtime.runner import *  # noqa: F403 - all public names, for old imports

warnings.warn(
    "ai4u_edu.runner has moved: import from ai4u_edu.runtime.runner",
    DeprecationWarning,
    stacklevel=2,
)
