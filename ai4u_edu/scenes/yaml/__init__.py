"""YAML text to plain data and back, with line numbers and readable errors."""
