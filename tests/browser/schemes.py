"""Colour schemes of pages: what is light is tested each time, what is dark also at night.

Whether all can be read in the dark is tested each time in test_feel.py.
"""

import pytest

SCHEMES = ["light", pytest.param("dark", marks=pytest.mark.nightly)]
