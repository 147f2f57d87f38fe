"""The seam to Chipmunk below pymunk's public API; the rest of the world imports only this module.

Everything here has a twin in pymunk's public API that gives the same bits. The twin is used where
pymunk is not of the expected version, and for the ray loops where the package was built without a
C compiler. Only impulses of contacts have none: without them a copy of a world in which bodies
press on each other goes on a little differently.
"""

from ai4u_edu.world.native.chipmunk import (
    IS_NATIVE,
    Impulses,
    apply_force,
    contact_distances,
    contact_impulses,
    motion_of,
    push_of,
    release_space,
    set_contact_impulses,
    set_push,
    shape_key,
    step_function,
)
from ai4u_edu.world.native.grid import CompiledGrid, GridArrays, compile_grid
from ai4u_edu.world.native.segments import Segments, is_compiled, make_segments

__all__ = [
    "IS_NATIVE",
    "CompiledGrid",
    "GridArrays",
    "Impulses",
    "Segments",
    "apply_force",
    "compile_grid",
    "contact_distances",
    "contact_impulses",
    "is_compiled",
    "make_segments",
    "motion_of",
    "push_of",
    "release_space",
    "set_contact_impulses",
    "set_push",
    "shape_key",
    "step_function",
]
