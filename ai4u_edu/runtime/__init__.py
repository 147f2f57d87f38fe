"""Running a world against the wall clock, in a thread of its own."""
