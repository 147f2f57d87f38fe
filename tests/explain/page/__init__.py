"""Tests of the page's panel: its state and its commands."""
