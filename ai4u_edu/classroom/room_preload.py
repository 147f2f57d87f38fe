"""Imports of the process that rooms are forked from, and what all of them read.

A room then starts without importing options and reading missions, scenes and scripts, and shares
their memory with the others. They are frozen, so that no room's garbage collector writes to them.
"""

import gc
from contextlib import suppress

import filelock  # noqa: F401 - a file that is locked imports it when it is needed

from ai4u_edu.base.options import PAGE_OPTIONS, MissingOptionError, load_option
from ai4u_edu.classroom import room_process  # noqa: F401 - for the processes that are forked
from ai4u_edu.missions import mission_map
from ai4u_edu.page.editing.scene_pictures import library_scenes
from ai4u_edu.page.server.web_files import WebFiles

for name in PAGE_OPTIONS:
    with suppress(MissingOptionError):
        load_option(name, "a room")
mission_map()
library_scenes()
WebFiles().version  # noqa: B018 - reads them
gc.collect()
gc.freeze()
