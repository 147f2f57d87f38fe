"""Foundations that every other package uses: errors, parameters, files, seeds."""
