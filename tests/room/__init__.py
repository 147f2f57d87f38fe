"""Tests of a room, and of options of its page."""
