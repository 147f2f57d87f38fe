"""Parts of the panel: a struct for each, and the function that makes it."""
