"""Deprecated alias of :mod:`ai4u_edu.base.errors`; it will go with the next release."""

import warnings

from ai4u_edu.base.errors import *  # noqa: F403 - all public names, for old imports

warnings.warn(
    "ai4u_edu.errors has moved: import from ai4u_edu.base.errors", DeprecationWarning, stacklevel=2
)
