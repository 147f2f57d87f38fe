"""Recorded episodes on the page: list, player, ghosts."""
