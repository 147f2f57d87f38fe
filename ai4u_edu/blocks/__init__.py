"""The blocks that an agent is built from."""

from ai4u_edu.blocks import actuators, brains, rewards, sensors
from ai4u_edu.blocks.actuators import *
from ai4u_edu.blocks.block import Block
from ai4u_edu.blocks.brains import *
from ai4u_edu.blocks.brains import controllers
from ai4u_edu.blocks.brains.brain import Answer as Answer
from ai4u_edu.blocks.brains.controllers import *
from ai4u_edu.blocks.brains.remote_status import RemoteStatus as RemoteStatus
from ai4u_edu.blocks.homeostasis import HomeostaticVariable
from ai4u_edu.blocks.keyboard import Keyboard
from ai4u_edu.blocks.percept import Layout as Layout
from ai4u_edu.blocks.percept import Percept
from ai4u_edu.blocks.rewards import *
from ai4u_edu.blocks.rewards.reward_func import Stages as Stages
from ai4u_edu.blocks.sensors import *
from ai4u_edu.blocks.sensors.pictures import ChannelLegend as ChannelLegend
from ai4u_edu.blocks.sensors.pictures import CodeLegend as CodeLegend
from ai4u_edu.blocks.sensors.pictures import Legend as Legend
from ai4u_edu.blocks.sensors.pictures import SpotPicture as SpotPicture
from ai4u_edu.blocks.sensors.ray_sensor import RayPicture as RayPicture
from ai4u_edu.blocks.sensors.ray_sensor import RaySensor as RaySensor

# ``ai4u_edu`` exports these names. Those imported "as" themselves are for its other packages only.
__all__ = ["Block", "HomeostaticVariable", "Keyboard", "Percept"]
__all__ += actuators.__all__
__all__ += brains.__all__
__all__ += controllers.__all__
__all__ += rewards.__all__
__all__ += sensors.__all__
