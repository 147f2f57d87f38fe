"""Scripts on other machines drive agents: a socket for each, and who has which agent."""

from ai4u_edu.server.scripts.settings import Rules
from ai4u_edu.server.scripts.sockets import RemoteSockets

__all__ = ["RemoteSockets", "Rules"]
