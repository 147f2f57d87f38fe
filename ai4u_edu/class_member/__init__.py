"""A running world as a member of a class: everything between it and its class link."""

from ai4u_edu.class_member.class_view import ClassView
from ai4u_edu.class_member.link import ClassLinkSettings, Link, Receive
from ai4u_edu.class_member.member import ClassMember

__all__ = ["ClassLinkSettings", "ClassMember", "ClassView", "Link", "Receive"]
