# %% tags=["solution"]
def senses():
    return [
        RayCastingSensor(
            perception_key="vision",
            rows=3,
            columns=5,
            field_of_view=120,
            vertical_field_of_view=45,
            vertical_shift=20,
            vision_max_distance=12,
            group_code={"floor": 1, "target": 2},
            return_distance=True,
            stacked_observations=4,
        ),
        OrientationSensor(target="box"),
        ActionSensor(perception_key="last_action", action_name="move"),
    ]


# %% tags=["wrong", "shape"]
def senses():
    return [
        RayCastingSensor(perception_key="vision", rows=3, columns=5),
        OrientationSensor(target="box"),
        ActionSensor(perception_key="last_action", action_name="move"),
    ]


# %% tags=["wrong", "missing"]
def senses():
    return [
        RayCastingSensor(perception_key="rays", rows=3, columns=5),
        OrientationSensor(target="box"),
        ActionSensor(perception_key="last_action", action_name="move"),
    ]
