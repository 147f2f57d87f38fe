# %% tags=["solution"]
my_few_numbers = [
    BearingSensor(target="box"),  # left or right
    OrientationSensor(target="box", info="distance", visibility_test=True),  # how far, if in sight
]


# %% tags=["right", "an eye to the left: two numbers"]
my_few_numbers = [
    LightSensor(group="target", angle_deg=60),
    OrientationSensor(target="box", info="distance", visibility_test=True),
]


# %% tags=["right", "two eyes"]
my_few_numbers = [
    LightSensor(perception_key="left", group="target", angle_deg=45),
    LightSensor(perception_key="right", group="target", angle_deg=-45),
    OrientationSensor(target="box", info="angle", visibility_test=True),
]


# %% tags=["right", "an eye, and both numbers"]
my_few_numbers = [
    LightSensor(group="target", angle_deg=90),
    OrientationSensor(target="box", visibility_test=True),
]


# %% tags=["wrong", "many", "the bearing, and both numbers"]
my_few_numbers = [
    BearingSensor(target="box"),
    OrientationSensor(target="box", visibility_test=True),
]


# %% tags=["wrong", "many", "many rays"]
my_few_numbers = [
    LinearRayCastingSensor(
        group_code={"target": 1}, field_of_view=180, number_of_rays=181, return_distance=True
    )
]


# %% tags=["wrong", "mirror", "no side"]
my_few_numbers = [OrientationSensor(target="box", visibility_test=True)]


# %% tags=["wrong", "wall", "sees through walls"]
my_few_numbers = [BearingSensor(target="box"), OrientationSensor(target="box", info="distance")]


# %% tags=["wrong", "distance", "no distance"]
my_few_numbers = [BearingSensor(target="box")]


# %% tags=["wrong", "list", "no list"]
my_few_numbers = OrientationSensor(target="box", visibility_test=True)


# %% tags=["wrong", "mirror", "one ray"]
my_few_numbers = [
    LinearRayCastingSensor(group_code={"target": 1}, number_of_rays=1, return_distance=True)
]


# %% tags=["lucky", "nothing"]
my_few_numbers = []


# %% tags=["lucky", "a bumper"]
my_few_numbers = [TouchSensor(target="box"), StepSensor()]


# %% tags=["lucky", "where the robot itself is"]
my_few_numbers = [PositionSensor()]
