"""All of it needs Babel, by which its pages are translated."""

import pytest

pytestmark = pytest.mark.needs("dev")
