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
