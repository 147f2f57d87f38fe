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


# %% tags=["right", "without legs"]
watcher = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box"), TouchSensor(target="box")],
)


# %% tags=["right", "names of its own"]
watcher = BasicAgent(
    body="robot",
    sensors=[
        TouchSensor(target="box", perception_key="bump"),
        BearingSensor(target="box", perception_key="where"),
    ],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
)


# %% tags=["right", "several moments"]
watcher = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box", stacked_observations=3), TouchSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
)


# %% tags=["wrong", "bearing", "touch alone"]
watcher = BasicAgent(
    body="robot",
    sensors=[TouchSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
)


# %% tags=["wrong", "touch", "bearing alone"]
watcher = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
)


# %% tags=["wrong", "bearing", "distance for direction"]
watcher = BasicAgent(
    body="robot",
    sensors=[TouchSensor(target="box"), VelocitySensor()],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
)


# %% tags=["wrong", "sensors", "no sensors"]
watcher = BasicAgent(
    body="robot",
    sensors=[],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
)


# %% tags=["lucky", "rays only"]
watcher = BasicAgent(
    body="robot",
    sensors=[LinearRayCastingSensor(group_code={"target": 1}), TouchSensor(target="box")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
)


# %% tags=["lucky", "bearing twice"]
watcher = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box"), BearingSensor(target="box", perception_key="too")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
)


# %% tags=["lucky", "feels the floor"]
watcher = BasicAgent(
    body="robot",
    sensors=[BearingSensor(target="box"), TouchSensor(target="plate")],
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
)
