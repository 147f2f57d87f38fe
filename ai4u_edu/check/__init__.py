"""Checks that every built-in block and scene passes, and that you can run on your own.

>>> from ai4u_edu import check_sensor, VelocitySensor
>>> print(check_sensor(VelocitySensor(), decisions=20))
VelocitySensor 'velocity': in order (12 checks)
  passed          documented
  passed          scene file
  passed          setup
  passed          runs
  passed          global chance
  passed          same twice
  passed          forgets
  passed          finite
  passed          in its space
  passed          unshared
  passed          only looks
  passed          changes
"""

from ai4u_edu.check.actuators import check_actuator
from ai4u_edu.check.brains import check_brain, check_controller
from ai4u_edu.check.report import CheckError, Finding, Outcome, Report
from ai4u_edu.check.rewards import check_reward
from ai4u_edu.check.rollout import standard_scene
from ai4u_edu.check.scene import check_scene
from ai4u_edu.check.sensors import check_sensor

__all__ = [
    "CheckError",
    "Finding",
    "Outcome",
    "Report",
    "check_actuator",
    "check_brain",
    "check_controller",
    "check_reward",
    "check_scene",
    "check_sensor",
    "standard_scene",
]
