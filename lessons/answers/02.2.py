# %% tags=["solution"]
watcher = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box"), TouchSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
)

# %% tags=["wrong", "bearing"]
watcher = BasicAgent(
    body="robot",
    sensors=[OrientationSensor(target="box"), TouchSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
)

# %% tags=["wrong", "touch"]
watcher = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box"), GroundStatusSensor()],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
)
