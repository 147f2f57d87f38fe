"""Exports of episodes for other programs: CSV, GIF, MP4, a web page."""
