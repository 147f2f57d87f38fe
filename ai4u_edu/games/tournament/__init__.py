"""Tournaments: entries play each other in a scene, as jobs; see ``docs/sweeps-and-tournaments.md``.

A game is a pure function of data (:func:`~ai4u_edu.games.tournament.game.game`), and its result a
recorded episode, so all games of a tournament can be played again and compared bit for bit.
"""
