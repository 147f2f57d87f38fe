"""The package's exports: lazy, complete, and the same for people and type checkers."""

import subprocess
import sys

import ai4u_edu
from tests.names import stale

NAMES: list[str] = vars(ai4u_edu)["__all__"]


def test_every_name_can_be_loaded() -> None:
    for name in NAMES:
        assert getattr(ai4u_edu, name) is not None


def test_derived_files_are_up_to_date() -> None:
    assert stale() == [], "run: python -m tests.names --write"


def test_an_unknown_name() -> None:
    assert not hasattr(ai4u_edu, "Nothing")


def test_importing_the_package_loads_neither_physics_nor_page() -> None:
    heavy = "{'pymunk', 'viser', 'pydantic', 'starlette'}"
    code = f"import sys, ai4u_edu; print(sorted({heavy} & set(sys.modules)))"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


def test_the_core_loads_no_page() -> None:
    code = (
        "import sys; from ai4u_edu import Scene; Scene.load('box_chase').build();"
        "print(sorted({'viser', 'starlette', 'uvicorn', 'torch'} & set(sys.modules)))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"
