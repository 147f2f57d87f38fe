"""Print the fields of a request as AI4U's package decodes them."""

import json
import sys

import numpy as np
from ai4u.workers import BMWorker

fields = BMWorker().decode(sys.stdin.buffer.read())
told = {
    name: value.tolist() if isinstance(value, np.ndarray) else value
    for name, value in fields.items()
}
print("RESULT", json.dumps(told))
