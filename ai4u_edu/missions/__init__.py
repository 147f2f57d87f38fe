"""Missions: small tasks in the page, one sentence at a time, which the room checks.

A mission is a YAML file (:mod:`ai4u_edu.missions.mission`), its checks follow what happens in the
world (:mod:`ai4u_edu.missions.checks`), and :mod:`ai4u_edu.missions.option` shows them on pages.
"""

from ai4u_edu.missions.mission import mission_schema
from ai4u_edu.missions.option import mission_map, page_option

__all__ = ["mission_map", "mission_schema", "page_option"]
