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


# %% tags=["right", "another order"]
def senses():
    return [
        OrientationSensor(target="box"),
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
        ActionSensor(perception_key="last_action", action_name="move"),
    ]


# %% tags=["right", "the scene's own"]
def senses():
    return list(Scene.load("box_chase").build().agents[0].sensors)


# %% tags=["wrong", "meaning", "swapped codes"]
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
            group_code={"floor": 2, "target": 1},
            return_distance=True,
            stacked_observations=4,
        ),
        OrientationSensor(target="box"),
        ActionSensor(perception_key="last_action", action_name="move"),
    ]


# %% tags=["wrong", "meaning", "angles left out"]
def senses():
    return [
        RayCastingSensor(
            perception_key="vision",
            rows=3,
            columns=5,
            vision_max_distance=12,
            group_code={"floor": 1, "target": 2},
            return_distance=True,
            stacked_observations=4,
        ),
        OrientationSensor(target="box"),
        ActionSensor(perception_key="last_action", action_name="move"),
    ]


# %% tags=["wrong", "meaning", "no codes"]
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
            group_code={},
            return_distance=True,
            stacked_observations=4,
        ),
        OrientationSensor(target="box"),
        ActionSensor(perception_key="last_action", action_name="move"),
    ]


# %% tags=["wrong", "shape", "one moment"]
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
            stacked_observations=1,
        ),
        OrientationSensor(target="box"),
        ActionSensor(perception_key="last_action", action_name="move"),
    ]


# %% tags=["wrong", "missing", "one sensor"]
def senses():
    return [OrientationSensor(target="box")]


# %% tags=["lucky", "nothing"]
def senses():
    return []


# %% tags=["lucky", "a wider view"]
def senses():
    return [
        RayCastingSensor(
            perception_key="vision",
            rows=3,
            columns=5,
            field_of_view=180,
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


# %% tags=["lucky", "a shorter view"]
def senses():
    return [
        RayCastingSensor(
            perception_key="vision",
            rows=3,
            columns=5,
            field_of_view=120,
            vertical_field_of_view=45,
            vertical_shift=20,
            vision_max_distance=8,
            group_code={"floor": 1, "target": 2},
            return_distance=True,
            stacked_observations=4,
        ),
        OrientationSensor(target="box"),
        ActionSensor(perception_key="last_action", action_name="move"),
    ]
