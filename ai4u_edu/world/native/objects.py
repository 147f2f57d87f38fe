"""pymunk's bodies and shapes with a faster constructor."""

import pymunk


class _PlainAttributes:
    # pymunk sets attributes through a Python method that adds nothing for ours; a reset of the
    # world would call it some two hundred times
    __setattr__ = object.__setattr__


class FastBody(_PlainAttributes, pymunk.Body):
    """A pymunk body that is constructed faster."""


class FastCircle(_PlainAttributes, pymunk.Circle):
    """A pymunk circle that is constructed faster."""


class FastPoly(_PlainAttributes, pymunk.Poly):
    """A pymunk polygon that is constructed faster."""
