"""Tournaments of a class: networks that students hand in, and the games that they play."""
