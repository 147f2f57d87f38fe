"""The package's exports: lazy, complete, and the same for people and type checkers."""

import subprocess
import sys

import psutil
import pytest

import ai4u_edu
from tests.names import stale
from tests.playing import played
from tests.without import ACT

NAMES: list[str] = vars(ai4u_edu)["__all__"]


def test_every_name_can_be_loaded() -> None:
    for name in NAMES:
        assert getattr(ai4u_edu, name) is not None


def test_derived_files_are_up_to_date() -> None:
    assert stale() == [], "run: python -m tests.names --write"


def test_an_unknown_name() -> None:
    assert not hasattr(ai4u_edu, "Nothing")


def test_importing_the_package_loads_neither_physics_nor_page() -> None:
    heavy = "{'onnxruntime', 'pymunk', 'viser', 'pydantic', 'starlette'}"
    code = f"import sys, ai4u_edu; print(sorted({heavy} & set(sys.modules)))"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


def test_the_core_loads_no_page() -> None:
    code = (
        "import sys; from ai4u_edu import Scene; Scene.load('box_chase').build();"
        "heavy = {'onnxruntime', 'viser', 'starlette', 'uvicorn', 'torch'};"
        "print(sorted(heavy & set(sys.modules)))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(psutil.Process, "memory_maps"), reason="psutil can't see it here")
@pytest.mark.parametrize(("driver", "is_loaded"), [([], False), (["--brain", "zoo"], True)])
def test_a_served_world_loads_what_runs_networks_with_the_first_one(
    driver: list[str], is_loaded: bool
) -> None:
    with played("box_chase", *driver) as world:
        if not driver:
            script = [sys.executable, "-c", ACT.format(url=world.url)]
            assert subprocess.run(script, capture_output=True, check=True).stdout == b"True\n"
        maps = psutil.Process(world.process.pid).memory_maps()
    assert any("onnxruntime" in each.path for each in maps) is is_loaded
