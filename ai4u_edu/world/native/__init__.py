"""The compiled part, and all use of Chipmunk below pymunk's public API."""
