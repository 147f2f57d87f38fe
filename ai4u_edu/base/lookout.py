"""For those who look out for something without going to sleep: to be woken takes longer."""

import os
import time
from collections.abc import Callable
from functools import partial

give_way: Callable[[], object] = getattr(os, "sched_yield", partial(time.sleep, 0))
"""Lets others on this processor go first."""
