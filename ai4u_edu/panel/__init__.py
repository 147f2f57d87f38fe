"""The page's panel: its state as JSON, and the commands that a page may send."""
