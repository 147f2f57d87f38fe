"""Reads, in the process that rooms are forked from, what all of them read.

A room then starts without importing options and reading missions, scenes and scripts, and shares
their memory with the others. They are frozen, so that no room's garbage collector writes to them.
"""

import gc
from contextlib import suppress

from ai4u_edu.base.options import PAGE_OPTIONS, SMALL_TRAINER, MissingOptionError, load_option
from ai4u_edu.missions import mission_map
from ai4u_edu.page.editing.scene_pictures import library_scenes
from ai4u_edu.page.server.web_files import WebFiles

for name in (*PAGE_OPTIONS, SMALL_TRAINER):
    with suppress(MissingOptionError):
        load_option(name, "a room")
mission_map()
library_scenes()
WebFiles().versioned("")  # which reads all scripts
gc.collect()
gc.freeze()
