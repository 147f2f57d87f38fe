# %% tags=["solution"]
def claim(first, second):
    difference = np.mean(first) - np.mean(second)
    noise = math.sqrt(np.var(first, ddof=1) / len(first) + np.var(second, ddof=1) / len(second))
    if abs(difference) < 2 * noise:
        return "unclear"
    return "first" if difference > 0 else "second"


# %% tags=["right", "intervals that don't overlap"]
def claim(first, second):
    low, high = zip(
        *[
            (
                np.mean(each) - 2 * np.std(each) / len(each) ** 0.5,
                np.mean(each) + 2 * np.std(each) / len(each) ** 0.5,
            )
            for each in (first, second)
        ]
    )
    if low[0] > high[1]:
        return "first"
    return "second" if low[1] > high[0] else "unclear"


# %% tags=["right", "mixing the results"]
def claim(first, second):
    chance = np.random.default_rng(0)
    difference = np.mean(first) - np.mean(second)
    both, count, as_large = np.array(first + second), len(first), 0
    for _ in range(300):
        mixed = chance.permutation(both)
        as_large += abs(mixed[:count].mean() - mixed[count:].mean()) >= abs(difference)
    if as_large > 15:  # that happens by chance alone, in more than 5 of 100 cases
        return "unclear"
    return "first" if difference > 0 else "second"


# %% tags=["right", "without numpy"]
import statistics


def claim(first, second):
    means = [statistics.mean(each) for each in (first, second)]
    errors = [statistics.stdev(each) ** 2 / len(each) for each in (first, second)]
    if (means[0] - means[1]) ** 2 < 5 * sum(errors):
        return "unclear"
    return ["first", "second"][means[1] > means[0]]


# %% tags=["wrong", "mean", "the larger mean"]
def claim(first, second):
    return "first" if np.mean(first) > np.mean(second) else "second"


# %% tags=["wrong", "mean", "the best run"]
def claim(first, second):
    return "first" if max(first) > max(second) else "second"


# %% tags=["wrong", "timid", "more than two deviations apart"]
def claim(first, second):
    difference = np.mean(first) - np.mean(second)
    if abs(difference) < np.std(first) + np.std(second):
        return "unclear"
    return "first" if difference > 0 else "second"


# %% tags=["wrong", "timid", "no run may overlap"]
def claim(first, second):
    if min(first) > max(second):
        return "first"
    return "second" if min(second) > max(first) else "unclear"


# %% tags=["wrong", "reversed", "the lower one"]
def claim(first, second):
    difference = np.mean(first) - np.mean(second)
    noise = math.sqrt(np.var(first, ddof=1) / len(first) + np.var(second, ddof=1) / len(second))
    if abs(difference) < 2 * noise:
        return "unclear"
    return "first" if difference < 0 else "second"


# %% tags=["wrong", "one-sided", "only the first one"]
def claim(first, second):
    noise = math.sqrt(np.var(first, ddof=1) / len(first) + np.var(second, ddof=1) / len(second))
    return "first" if np.mean(first) - np.mean(second) > 2 * noise else "unclear"


# %% tags=["wrong", "few", "one error apart"]
def claim(first, second):
    difference = np.mean(first) - np.mean(second)
    noise = math.sqrt(np.var(first) / len(first) + np.var(second) / len(second))
    if abs(difference) < noise:
        return "unclear"
    return "first" if difference > 0 else "second"


# %% tags=["wrong", "name", "a number"]
def claim(first, second):
    return np.mean(first) - np.mean(second)


# %% tags=["lucky", "never"]
def claim(first, second):
    return "unclear"


# %% tags=["lucky", "ten points"]
def claim(first, second):
    difference = np.mean(first) - np.mean(second)
    if abs(difference) < 10:
        return "unclear"
    return "first" if difference > 0 else "second"


# %% tags=["lucky", "by chance"]
import random


def claim(first, second):
    return random.choice(["first", "second", "unclear"])
