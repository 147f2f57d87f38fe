# %% tags=["solution"]
my_clone = clone(my_drives(), "clone.onnx", quiet=True)

# %% tags=["wrong", "sloppy"]
from ai4u_edu.training import demonstrate

wandering = demonstrate("random", "box_chase", episodes=5, quiet=True)
my_clone = clone(wandering, "clone.onnx", quiet=True)
