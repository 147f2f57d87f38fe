"""Agents that learn: train, evaluate, export.

To train, to evaluate a model and to export it needs ``pip install "ai4u-edu[train]"``
(Stable-Baselines3 and torch); to drive with an exported network, ``"ai4u-edu[onnx]"`` is enough.
Nothing is loaded before it is needed.

A model of Stable-Baselines3 (a .zip) has Python objects in it, and reading one can run any program:
load your own, and share ONNX files.
"""
