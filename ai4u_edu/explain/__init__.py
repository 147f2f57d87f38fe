"""Explanations of decisions: arrays in, arrays out.

::

    from ai4u_edu import explain

    explain.occlusion("zoo:maze", agent.percept)
    explain.field("zoo:maze", "maze")
    explain.value_map("zoo:maze", "maze", columns=8)
    explain.first_disagreement("old.onnx", "new.onnx", episode)

:mod:`ai4u_edu.explain.plots` draws the results with matplotlib. See ``docs/explain.md``.
"""

from ai4u_edu.explain.baseline import mean_of, middle_of
from ai4u_edu.explain.disagreement import Disagreement, first_disagreement, percepts_of
from ai4u_edu.explain.errors import NotExplainableError
from ai4u_edu.explain.field import ActionField, field
from ai4u_edu.explain.groups import Group, groups_of_agent
from ai4u_edu.explain.occlusion import LIMITS, Occlusion, occlusion
from ai4u_edu.explain.reward_terms import RewardTerms, reward_terms
from ai4u_edu.explain.sentence import axes_of_agent, explained, sentence
from ai4u_edu.explain.value_map import ValueMap, value_map

__all__ = [
    "LIMITS",
    "ActionField",
    "Disagreement",
    "Group",
    "NotExplainableError",
    "Occlusion",
    "RewardTerms",
    "ValueMap",
    "axes_of_agent",
    "explained",
    "field",
    "first_disagreement",
    "groups_of_agent",
    "mean_of",
    "middle_of",
    "occlusion",
    "percepts_of",
    "reward_terms",
    "sentence",
    "value_map",
]
