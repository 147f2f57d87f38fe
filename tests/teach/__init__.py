"""Tests of :mod:`ai4u_edu.teach`."""
