"""The seam to Chipmunk below pymunk's public API; the rest of the world imports only this module.

Everything here has a twin in pymunk's public API that gives the same bits. The twin is used where
pymunk is not of the expected version, and for the ray loops where the package was built without a
C compiler.
"""

from ai4u_edu.world.native.chipmunk import (
    IS_NATIVE,
    MOTION,
    contact_distances,
    release_space,
    shape_key,
    step_function,
)
from ai4u_edu.world.native.grid import CompiledGrid, GridArrays, compile_grid
from ai4u_edu.world.native.objects import FastBody, FastCircle, FastPoly
from ai4u_edu.world.native.segments import Segments, is_compiled, make_segments

__all__ = [
    "IS_NATIVE",
    "MOTION",
    "CompiledGrid",
    "FastBody",
    "FastCircle",
    "FastPoly",
    "GridArrays",
    "Segments",
    "compile_grid",
    "contact_distances",
    "is_compiled",
    "make_segments",
    "release_space",
    "shape_key",
    "step_function",
]
