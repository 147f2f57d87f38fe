# %% tags=["solution"]
my_clone = clone(my_drives(), "clone.onnx", quiet=True)

# %% tags=["wrong", "sloppy", "learns from wandering"]
from ai4u_edu.learn.training import demonstrate

wandering = demonstrate("random", "box_chase", episodes=5, quiet=True)
my_clone = clone(wandering, "clone.onnx", quiet=True)


# %% tags=["right", "some more"]
my_clone = clone(my_drives() + one_drive(), "clone.onnx", quiet=True)


# %% tags=["right", "in another order"]
my_clone = clone(my_drives()[::-1], "clone.onnx", quiet=True)


# %% tags=["wrong", "few", "one drive"]
my_clone = clone(one_drive(), "clone.onnx", quiet=True)


# %% tags=["wrong", "unknown", "the function itself"]
my_clone = clone


# %% tags=["wrong", "unknown", "the drives alone"]
my_clone = my_drives()


# %% tags=["wrong", "unknown", "the file's name"]
my_clone = "clone.onnx"


# %% tags=["lucky", "a path"]
from pathlib import Path

my_clone = Path("clone.onnx")


# %% tags=["lucky", "a number"]
my_clone = 60


# %% tags=["lucky", "the network of the package"]
my_clone = best_network()
