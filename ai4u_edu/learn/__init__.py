"""Learning: Gymnasium environments of scenes, and training."""
