"""Parts of the panel: each function returns the JSON of one part."""
