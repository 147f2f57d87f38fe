"""A new built-in block takes two files: its own and its sample. All lists of names follow."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

ROOT = Path(__file__).parents[1]
COPIED = ("pyproject.toml", "ai4u_edu", "docs", "tests")

SENSOR = '''"""A sensor of the distance to the origin."""

from ai4u_edu.blocks.sensors.sensor import Sensor


class OriginSensor(Sensor):
    """The distance (m) to the world's origin.

    >>> OriginSensor(perception_key="away").perception_key
    'away'
    """

    factor: float
    """Factor of the reading."""

    def space(self):
        """Return any number from 0 on."""
        from gymnasium import spaces

        return spaces.Box(0.0, 1e5, (1,))

    def read(self, body, view):
        """Return the distance."""
        x, y = body.position
        return [self.factor * (x * x + y * y) ** 0.5]
'''

SAMPLE = """from ai4u_edu import OriginSensor

SAMPLES = (OriginSensor(factor=2.0),)
"""


@pytest.fixture
def run(tmp_path: Path) -> Callable[..., str]:
    """Copy the project, and return a function that runs Python modules in the copy."""
    for name in COPIED:
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, tmp_path / name, ignore=shutil.ignore_patterns("__py*"))
        else:
            shutil.copy(ROOT / name, tmp_path / name)
    environment = os.environ | {"PYTHONPATH": str(tmp_path), "PYTHONDONTWRITEBYTECODE": "1"}

    def python(*arguments: str) -> str:
        command = [sys.executable, *arguments]
        run = subprocess.run(
            command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
        )
        return run.stdout + run.stderr

    return python


def test_a_new_sensor_takes_two_files(run: Callable[..., str], tmp_path: Path) -> None:
    (tmp_path / "ai4u_edu/blocks/sensors/origin.py").write_text(SENSOR)
    (tmp_path / "tests/check/samples/origin.py").write_text(SAMPLE)
    written = run("-m", "tests.names", "--write").split()
    assert written == [
        str(tmp_path / "ai4u_edu/blocks/sensors/__init__.py"),
        str(tmp_path / "ai4u_edu/__init__.pyi"),
    ]
    tests = ("tests/test_components.py", "tests/check/test_built_in.py", "tests/test_exports.py")
    told = run("-m", "pytest", "-q", "-p", "no:cacheprovider", "-k", "Origin or derived", *tests)
    assert "3 passed" in told, told
