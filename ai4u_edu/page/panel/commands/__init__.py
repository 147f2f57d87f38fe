"""Commands of a page, by topic."""
