"""All fuzz targets, by name."""

from tests.fuzz import conversations, decoders, files, requests
from tests.fuzz.run import Report, run
from tests.fuzz.target import Target

TARGETS: dict[str, Target] = {
    target.name: target
    for target in (
        decoders.NATIVE_SAID,
        decoders.NATIVE_HEARD,
        decoders.AI4U_REQUEST,
        decoders.AI4U_REPLY,
        decoders.PERCEPT,
        decoders.PAGE,
        files.RECORDING,
        files.SCENE,
        requests.REQUESTS,
        conversations.TALK,
    )
}


def guided_targets() -> tuple[str, ...]:
    """Return the names of targets that suit a coverage-guided fuzzer: bytes, and fast to read."""
    return tuple(name for name, target in TARGETS.items() if target.packages)


def run_named(task: tuple[str, int, int]) -> Report:
    """Feed a target, given its name, the number of inputs, and the seed."""
    name, count, seed = task
    return run(TARGETS[name], count, seed)
