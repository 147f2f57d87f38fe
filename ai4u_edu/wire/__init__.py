"""The protocols of remote brains: messages and their bytes, without a world or a socket."""
