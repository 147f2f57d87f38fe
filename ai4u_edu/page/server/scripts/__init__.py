"""The server's side of scripts on other machines: connections, and leases of agents."""

from ai4u_edu.page.server.scripts.report import ScriptLog, ScriptReport
from ai4u_edu.page.server.scripts.settings import Rules
from ai4u_edu.page.server.scripts.sockets import RemoteSockets

__all__ = ["RemoteSockets", "Rules", "ScriptLog", "ScriptReport"]
