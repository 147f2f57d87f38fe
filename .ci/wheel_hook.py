"""The build hook of hatchling: the compiled part goes into the wheel, where there is a C compiler.

A wheel with it is tagged ``py3-none-<platform>``; without it, ``py3-none-any``. Both give the same
numbers. An editable installation has it in the checkout. ``AI4U_COMPILED=0`` builds without,
``AI4U_COMPILED=1`` fails where it can't be compiled.
"""

import os
import re
import sys
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

# hatchling runs this file alone
sys.path.insert(0, str(Path(__file__).parent))
from compile_rays import (
    CompileError,
    compile_in_place,
    compile_library,
    target_platform,
)

SWITCH_VARIABLE = "AI4U_COMPILED"
PATH_IN_WHEEL = "ai4u_edu/world/native"


class CompiledPartHook(BuildHookInterface[Any]):
    """Compiles rays.c, and adds the library to the wheel."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile before the files of the wheel are collected; hatchling calls this."""
        wanted = os.environ.get(SWITCH_VARIABLE, "")
        if wanted == "0":
            return
        try:
            self._compile(version, build_data)
        except CompileError as error:
            if wanted == "1":
                raise
            self.app.display_warning(f"Without the compiled part, which is optional. {error}")

    def _compile(self, version: str, build_data: dict[str, Any]) -> None:
        if version == "editable":
            compile_in_place()
            return
        self._folder = tempfile.TemporaryDirectory()
        path = compile_library(Path(self._folder.name))
        build_data["force_include"][str(path)] = f"{PATH_IN_WHEEL}/{path.name}"
        build_data["pure_python"] = False
        build_data["tag"] = "py3-none-" + re.sub(r"[^0-9a-zA-Z]", "_", target_platform())

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Delete the library that is in the wheel now; hatchling calls this."""
        if hasattr(self, "_folder"):
            self._folder.cleanup()
