"""A class as a service of a JupyterHub, whose users are its students and teachers."""

from ai4u_edu.classroom.hub.app import hub_class_app
from ai4u_edu.classroom.hub.environment import HubEnvironment

__all__ = ["HubEnvironment", "hub_class_app"]
