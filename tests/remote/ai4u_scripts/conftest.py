"""These run in AI4U's environment, started by tests; they are no tests themselves."""

collect_ignore_glob = ["*.py"]
