"""Input that nobody who means well would send, at every place that takes some."""
