"""Nothing that only POSIX systems have is used without a branch for the others."""

from pathlib import Path

import pytest

from tests.posix_only import uses_without_branch

ROOT = Path(__file__).resolve().parent.parent


def test_everything_has_its_branch() -> None:
    files = [*(ROOT / "ai4u_edu").rglob("*.py"), *(ROOT / ".ci").rglob("*.py")]
    assert len(files) > 500
    assert [use for path in sorted(files) for use in uses_without_branch(path)] == []


@pytest.mark.parametrize(
    ("program", "expected"),
    [
        ("import fcntl", ["fcntl"]),
        ("from os import fork", ["os.fork"]),
        ("import os\nos.kill(1, 9)", ["os.kill"]),
        ("run(start_new_session=True)", ["start_new_session"]),
        ("run(start_new_session=sys.platform != 'win32')", []),
        ("loop.add_signal_handler(2, end)", ["add_signal_handler"]),
        ("import multiprocessing\nmultiprocessing.get_context('fork')",
         ["multiprocessing.get_context"]),
        ("if sys.platform == 'win32':\n    pass\nelse:\n    os.nice(1)", []),
        ("def f():\n    if os.name == 'nt':\n        return\n    os.nice(1)", []),
        ("def f():\n    if os.name == 'nt':\n        g()\n    os.nice(1)", ["os.nice"]),
        ("def f():\n    os.nice(1)\n    if os.name == 'nt':\n        return", ["os.nice"]),
        ("HAS = hasattr(os, 'nice')\nif HAS:\n    os.nice(1)", []),
        ("x = os.nice(1) if hasattr(os, 'nice') else 0", []),
        ("try:\n    import resource\nexcept ImportError:\n    pass", []),
        ("try:\n    import resource\nexcept OSError:\n    pass", ["resource"]),
    ],
)  # fmt: skip
def test_a_branch_is_told_from_none(program: str, expected: list[str], tmp_path: Path) -> None:
    path = tmp_path / "program.py"
    path.write_text(program, encoding="utf-8")
    assert [use.partition(" ")[2] for use in uses_without_branch(path)] == expected
