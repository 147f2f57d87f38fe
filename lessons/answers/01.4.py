# %% tags=["solution"]
def count_near(distances):
    count = 0
    for distance in distances:
        if distance < 2:
            count = count + 1
    return count


# %% tags=["right", "the length of another list"]
def count_near(distances):
    near = []
    for distance in distances:
        if distance < 2:
            near.append(distance)
    return len(near)


# %% tags=["right", "by the numbers of the places"]
def count_near(distances):
    count = 0
    for place in range(len(distances)):
        if distances[place] < 2:
            count += 1
    return count


# %% tags=["right", "a sum"]
def count_near(distances):
    return sum(1 for distance in distances if distance < 2)


# %% tags=["right", "a while loop that ends"]
def count_near(distances):
    count = 0
    place = 0
    while place < len(distances):
        if distances[place] < 2:
            count = count + 1
        place = place + 1
    return count


# %% tags=["wrong", "early", "returns in the loop"]
def count_near(distances):
    count = 0
    for distance in distances:
        if distance < 2:
            count = count + 1
        return count


# %% tags=["wrong", "reset", "starts again in the loop"]
def count_near(distances):
    for distance in distances:
        count = 0
        if distance < 2:
            count = count + 1
    return count


# %% tags=["wrong", "all", "counts all"]
def count_near(distances):
    count = 0
    for distance in distances:
        count = count + 1
    return count


# %% tags=["wrong", "far", "the wrong way round"]
def count_near(distances):
    count = 0
    for distance in distances:
        if distance > 2:
            count = count + 1
    return count


# %% tags=["wrong", "sum", "adds the distances"]
def count_near(distances):
    count = 0
    for distance in distances:
        if distance < 2:
            count = count + distance
    return count


# %% tags=["wrong", "no-return", "prints"]
def count_near(distances):
    count = 0
    for distance in distances:
        if distance < 2:
            count = count + 1
    print(count)


# %% tags=["wrong", "error", "compares the list"]
def count_near(distances):
    count = 0
    if distances < 2:
        count = count + 1
    return count


# %% tags=["wrong", "endless-loop", "a while loop that never ends"]
def count_near(distances):
    count = 0
    while distances[0] > 0:
        count = count + 1
    return count


# %% tags=["lucky", "always two"]
def count_near(distances):
    return 2


# %% tags=["lucky", "half of them"]
def count_near(distances):
    return len(distances) // 2


# %% tags=["lucky", "looks at the first three"]
def count_near(distances):
    count = 0
    for place in range(3):
        if distances[place] < 2:
            count = count + 1
    return count


# %% tags=["lucky", "by chance"]
import random


def count_near(distances):
    return random.randint(0, 3)


# %% tags=["wrong", "limit", "2 m is near"]
def count_near(distances):
    count = 0
    for distance in distances:
        if distance <= 2:
            count = count + 1
    return count


# %% tags=["wrong", "endless-loop", "counts by adding to the list"]
def count_near(distances):
    count = 0
    for distance in distances:
        if distance < 2:
            distances.append(distance)
            count = count + 1
    return count
