"""Compile the compiled part for other systems, and replay recorded calls there.

``python -m tests.world.vectors`` does so for each target whose tools are here; ``--require`` fails
where some are missing. On Debian: ``apt install gcc-mingw-w64-x86-64 wine64 gcc-aarch64-linux-gnu
libc6-dev-arm64-cross qemu-user musl-tools``.
"""

import argparse
import sys
import tempfile
from pathlib import Path

from tests.world.vectors.targets import TARGETS, missing_tools, replay


def main() -> int:
    """Replay on each target; return the exit status."""
    parser = argparse.ArgumentParser(prog="python -m tests.world.vectors", description=__doc__)
    parser.add_argument("--require", action="store_true", help="fail where tools are missing")
    options = parser.parse_args()
    failed = False
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as made:
        folder = Path(made)
        for name in TARGETS:
            missing = missing_tools(name)
            if missing:
                print(f"{name}: not run, {', '.join(missing)} is not here")
                failed |= options.require
                continue
            has_same_bits, text = replay(name, folder)
            print(f"{name}: {text}")
            failed |= not has_same_bits
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
