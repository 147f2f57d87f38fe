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
