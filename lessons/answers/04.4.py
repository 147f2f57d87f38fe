# %% tags=["solution"]
my_sensors = [
    BearingSensor(target="box"),  # left or right
    LinearRayCastingSensor(  # what is in sight, and how far away
        group_code={"target": 1},
        field_of_view=180,
        number_of_rays=61,
        return_distance=True,
    ),
]

# %% tags=["wrong", "mirror"]
my_sensors = [OrientationSensor(target="box", visibility_test=True)]

# %% tags=["wrong", "distance"]
my_sensors = [BearingSensor(target="box")]

# %% tags=["wrong", "wall"]
my_sensors = [BearingSensor(target="box"), OrientationSensor(target="box")]


# %% tags=["right", "rays alone"]
my_sensors = [
    LinearRayCastingSensor(
        group_code={"target": 1}, field_of_view=180, number_of_rays=181, return_distance=True
    )
]


# %% tags=["right", "distance that needs sight"]
my_sensors = [BearingSensor(target="box"), OrientationSensor(target="box", visibility_test=True)]


# %% tags=["wrong", "narrow", "five rays"]
my_sensors = [
    BearingSensor(target="box"),
    OrientationSensor(target="box"),
    LinearRayCastingSensor(group_code={"target": 1}, number_of_rays=5, field_of_view=60),
]


# %% tags=["wrong", "wall", "knows all and sees nothing"]
my_sensors = [OrientationSensor(target="box"), BearingSensor(target="box")]


# %% tags=["wrong", "many", "three sensors"]
my_sensors = [
    BearingSensor(target="box"),
    OrientationSensor(target="box"),
    LinearRayCastingSensor(group_code={"target": 1}, number_of_rays=61, field_of_view=180),
]


# %% tags=["wrong", "distance", "rays without distances"]
my_sensors = [
    LinearRayCastingSensor(group_code={"target": 1}, number_of_rays=21, field_of_view=40),
    BearingSensor(target="box"),
]


# %% tags=["lucky", "everything twice"]
my_sensors = [BearingSensor(target="box"), BearingSensor(target="box", perception_key="too")]


# %% tags=["lucky", "its own speed"]
my_sensors = [VelocitySensor()]


# %% tags=["lucky", "touch"]
my_sensors = [TouchSensor(target="box"), BearingSensor(target="box")]
