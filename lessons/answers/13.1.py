# %% tags=["solution"]
def driver(path):
    controller = NeuralNetController(model_path=path)
    return LocalBrain(controller=controller, skip_frame=controller.network.about["skip_frame"])


# %% tags=["right", "the whole rhythm"]
def driver(path):
    controller = NeuralNetController(model_path=path)
    return LocalBrain(controller=controller, **controller.network.rhythm)


# %% tags=["right", "trained_brain"]
def driver(path):
    return trained_brain(path)


# %% tags=["right", "changed afterwards"]
def driver(path):
    controller = NeuralNetController(model_path=path, repeat=False)
    about = controller.network.about
    return LocalBrain(controller=controller).changed(skip_frame=about["skip_frame"])


# %% tags=["wrong", "default", "no skip_frame"]
def driver(path):
    return LocalBrain(controller=NeuralNetController(model_path=path))


# %% tags=["wrong", "fixed", "the first network's"]
def driver(path):
    return LocalBrain(controller=NeuralNetController(model_path=path), skip_frame=9)


# %% tags=["wrong", "fixed", "one tick too many"]
def driver(path):
    controller = NeuralNetController(model_path=path)
    return LocalBrain(controller=controller, skip_frame=controller.network.about["skip_frame"] + 1)


# %% tags=["wrong", "path", "always the same file"]
def driver(path):
    return trained_brain("zoo:box_chase")


# %% tags=["wrong", "controller", "no brain"]
def driver(path):
    return NeuralNetController(model_path=path)


# %% tags=["wrong", "begin", "a function that steers"]
def driver(path):
    return LocalBrain(controller=lambda percept: {"move": [1, 0, 0, 0]})


# %% tags=["wrong", "no-return", "no return"]
def driver(path):
    trained_brain(path)


# %% tags=["lucky", "the file's name"]
def driver(path):
    return path


# %% tags=["lucky", "every tick"]
def driver(path):
    return LocalBrain(controller=NeuralNetController(model_path=path), skip_frame=0)


# %% tags=["lucky", "by chance"]
import random


def driver(path):
    controller = NeuralNetController(model_path=path)
    return LocalBrain(controller=controller, skip_frame=random.randint(5, 8))


# %% tags=["wrong", "fixed", "a table of what the messages said"]
def driver(path):
    ticks = {"zoo:box_chase": 9, "zoo:sample_scene": 14, "zoo:yardstick": 3}
    controller = NeuralNetController(model_path=path)
    return LocalBrain(controller=controller, skip_frame=ticks.get(path, 4))
