"""The long fuzz: ``python -m tests.fuzz --frames 1000000``.

Every target gets inputs that are nearly right: a million each for the decoders, a tenth of that for
what reads files or answers requests. With atheris and schemathesis (``pip install -e .[fuzz]``)
the decoders get as many again, led by the branches that they reach, and the API is held against its
own description. ``--only`` names some targets.
"""

import argparse
import multiprocessing
import subprocess
import sys
from importlib.util import find_spec

from tests.fuzz.target import MILLION
from tests.fuzz.targets import TARGETS, guided_targets, run_named


def main() -> None:
    """Read the command line, fuzz, and print the findings."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--frames", type=int, default=MILLION, help="for each decoder")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--only", nargs="*", choices=sorted(TARGETS), default=None)
    parser.add_argument("--processes", type=int, default=1)
    options = parser.parse_args()
    tasks = [
        (name, max(1, target.count * options.frames // MILLION), options.seed)
        for name, target in TARGETS.items()
        if options.only is None or name in options.only
    ]
    wrong = 0
    # a process for each, so that one's memory is its own
    context = multiprocessing.get_context("spawn")
    with context.Pool(options.processes, maxtasksperchild=1) as pool:
        for report in pool.imap(run_named, tasks):
            print(report, flush=True)
            print("".join(f"  {finding}\n" for finding in report.findings), end="", flush=True)
            wrong += len(report.findings)
    if find_spec("atheris") is None:
        print("atheris: not installed; the decoders were fuzzed without it")
    else:
        for name, count, _ in tasks:
            wrong += _guide(name, count) if name in guided_targets() else 0
    if find_spec("schemathesis") is None:
        print("schemathesis: not installed; the API was not held against its description")
    elif options.only is None or "http" in options.only:
        from tests.fuzz.described import hold_against_description

        print(hold_against_description(max(10, options.frames // 2000)), flush=True)
    sys.exit(bool(wrong))


def _guide(name: str, count: int) -> bool:
    """Run atheris; return True if it found something."""
    done = subprocess.run(
        [sys.executable, "-m", "tests.fuzz.guided", name, str(count)],
        capture_output=True,
        text=True,
        check=False,
    )
    lines = (done.stderr + done.stdout).splitlines()
    told = [line for line in lines if "cov:" in line or "Done" in line]
    print(f"{name:<14} atheris: {' / '.join(told[-2:])}", flush=True)
    if done.returncode:
        print("\n".join(lines[-40:]))
    return done.returncode != 0


if __name__ == "__main__":
    main()
