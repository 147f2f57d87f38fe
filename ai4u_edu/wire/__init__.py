"""Bytes and messages: what goes over a network to a brain, and comes back. Knows no world."""
