"""One target under atheris: ``python -m tests.fuzz.guided native-said 1000000``.

Inputs are led by the branches that they reach. Ends with an error, and the input, at the first
finding.
"""

import sys
import tempfile
from pathlib import Path


def main() -> None:
    """Fuzz; does not return."""
    import atheris  # not everybody has it

    with atheris.instrument_imports(include=["ai4u_edu.wire"]):
        from tests.fuzz.targets import TARGETS

    name, count = sys.argv[1:]
    target = TARGETS[name]
    with tempfile.TemporaryDirectory() as folder:
        for number, seed in enumerate(target.seeds):
            (Path(folder) / str(number)).write_bytes(seed)
        options = ["-timeout=1", "-rss_limit_mb=2048", "-max_len=4096", "-seed=1"]
        atheris.Setup([sys.argv[0], f"-runs={count}", *options, folder], target.reads)
        atheris.Fuzz()


if __name__ == "__main__":
    main()
