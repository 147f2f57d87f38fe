"""Many runs of a world: jobs on several engines, and tournaments."""
