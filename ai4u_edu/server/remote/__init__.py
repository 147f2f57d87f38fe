"""Scripts on other machines drive agents: a socket for each, and who has which agent."""

from ai4u_edu.server.remote.rules import Rules
from ai4u_edu.server.remote.sockets import RemoteSockets

__all__ = ["RemoteSockets", "Rules"]
