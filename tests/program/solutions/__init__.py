"""Programs that solve the scenes of the library, as a beginner writes them: no numpy.

One file a scene, by the scene's name; each runs in the page and with ``--brain`` alike.
"""

import ast
from pathlib import Path

HERE = Path(__file__).parent


def solution(scene: str) -> str:
    """Return the program that solves a scene."""
    return (HERE / f"{scene}.py").read_text(encoding="utf-8")


def entry_of(scene: str) -> str:
    """Return the name of the function or class that ``--brain FILE.py:NAME`` names.

    >>> entry_of("maze"), entry_of("donut")
    ('Explorer', 'decide')
    """
    names = [
        each.name for each in ast.parse(solution(scene)).body if isinstance(each, ast.ClassDef)
    ]
    return names[0] if names else "decide"
