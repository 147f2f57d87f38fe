"""Sweeps: trainings with many settings and seeds, as jobs; see ``docs/sweeps-and-tournaments.md``.

A trial is a pure function of data (:func:`~ai4u_edu.training.sweep.trial.trial`), so a sweep's
table is the same on every engine, and a sweep that was interrupted goes on.
"""
