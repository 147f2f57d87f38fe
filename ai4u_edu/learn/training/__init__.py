"""Training of agents: train, evaluate, export, clone.

In a notebook or a script::

    from ai4u_edu.learn.training import clone, demonstrate, evaluate, export, train

    run = train("box_chase", algo="ppo", out="runs/first")
    evaluate(run)
    export(run, "policy.onnx")

:func:`q_learning` learns with a table, and needs nothing else.

With ``pip install "ai4u-edu[train]"``, Stable-Baselines3 and torch learn; without it, the small
learner does (:mod:`ai4u_edu.learn.small`). Driving with a network needs no extra.
Imports are lazy. On Linux, pip installs gigabytes of torch for graphics cards; for the CPU build,
install this first::

    pip install torch --index-url https://download.pytorch.org/whl/cpu
    pip install "ai4u-edu[train]"

A Stable-Baselines3 model (.zip) contains pickled objects, and reading one can run any program: load
only your own, and share ONNX files.
"""

from typing import TYPE_CHECKING

from ai4u_edu.learn.training.notebook import clone, demonstrate, evaluate, export, train, vary

if TYPE_CHECKING:
    from ai4u_edu.learn.training.q_table import QTable, grid_state, q_learning, still

__all__ = [
    "QTable",
    "clone",
    "demonstrate",
    "evaluate",
    "export",
    "grid_state",
    "q_learning",
    "still",
    "train",
    "vary",
]


def __getattr__(name: str) -> object:
    # a command line that only tells its commands needs no physics
    if name in __all__:
        from ai4u_edu.learn.training import q_table as tables

        return getattr(tables, name)
    raise AttributeError(f"module 'ai4u_edu.learn.training' has no attribute {name!r}")
