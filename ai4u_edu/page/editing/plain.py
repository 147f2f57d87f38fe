"""Types of blocks and agents as plain data, and of paths in it."""

from collections.abc import Mapping
from typing import Any

from ai4u_edu.base.parameters import DataPath

Plain = Mapping[str, Any]
"""Parameters of a block, an agent or a body by name, as a scene file has them."""
BlockPath = DataPath
"""Path in plain data: ``("sensors", 2)``, ``("brains", 0, "controller")``."""
