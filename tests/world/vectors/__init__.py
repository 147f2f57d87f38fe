"""Recorded calls of the compiled part, to be replayed on a processor or system without Python."""
