# %% tags=["solution"]
walker = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=3)],
)

# %% tags=["wrong", "speed"]
walker = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator()],
)

# %% tags=["wrong", "turn"]
walker = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2)],
)


# %% tags=["right", "an actuator with its own name"]
walker = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(action_name="legs", move_amount=2, turn_amount=3)],
)


# %% tags=["right", "made before"]
legs = RBMoveActuator(turn_amount=3.0, move_amount=2.0)
walker = BasicAgent(body="robot", actuators=[legs])


# %% tags=["wrong", "speed", "both swapped"]
walker = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=3, turn_amount=2)],
)


# %% tags=["wrong", "turn", "a full turn"]
walker = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=6.28)],
)


# %% tags=["wrong", "actuator", "two wheels"]
walker = BasicAgent(
    body="robot",
    actuators=[DifferentialDriveActuator(max_wheel_speed=2)],
)


# %% tags=["lucky", "half of each"]
walker = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=1, turn_amount=1.5)],
)


# %% tags=["lucky", "turns the other way"]
walker = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2.5, turn_amount=3)],
)


# %% tags=["lucky", "nearly"]
walker = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=2.7)],
)


# %% tags=["wrong", "turn", "degrees for radians"]
walker = BasicAgent(
    body="robot",
    actuators=[RBMoveActuator(move_amount=2, turn_amount=57.3)],
)
