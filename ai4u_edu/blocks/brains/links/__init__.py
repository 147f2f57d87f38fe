"""Transports between a RemoteBrain and its script."""
