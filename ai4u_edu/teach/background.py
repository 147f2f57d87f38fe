"""Processes that learn beside a world that must not wait for them."""

import os
import sys

from ai4u_edu.base.process_family import end_with_parent

NICENESS = 19
MAX_MEMORY_BYTES = 512 * 2**20


def leave_the_processor_to_others() -> None:
    """Give this process the lowest priority and little memory, and end it with its parent."""
    if sys.platform == "win32":
        return
    end_with_parent(os.getppid())
    import resource

    os.nice(NICENESS)
    _, hard = resource.getrlimit(resource.RLIMIT_DATA)
    resource.setrlimit(resource.RLIMIT_DATA, (MAX_MEMORY_BYTES, hard))
