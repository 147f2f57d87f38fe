"""Sweeps: trainings with many settings and seeds, as jobs; see ``docs/sweeps-and-tournaments.md``.

A trial (:func:`~ai4u_edu.learn.training.sweep.trial.trial`) is a pure function of data, so a
sweep's table is the same on every engine, and a sweep that was interrupted goes on.
"""
