# %% tags=["solution"]
def paid_most(told):
    sums = [sum(row[n] for row in told.amounts) for n in range(len(told.terms))]
    return told.terms[sums.index(max(sums))]


# %% tags=["right", "with totals"]
def paid_most(told):
    return told.terms[told.totals.argmax()]


# %% tags=["right", "with a dictionary"]
def paid_most(told):
    sums = {}
    for row in told.amounts:
        for name, amount in zip(told.terms, row):
            sums[name] = sums.get(name, 0) + amount
    return max(sums, key=sums.get)


# %% tags=["wrong", "first", "the first one"]
def paid_most(told):
    return told.terms[0]


# %% tags=["wrong", "once", "the largest single amount"]
def paid_most(told):
    return told.terms[told.amounts.max(axis=0).argmax()]


# %% tags=["wrong", "size", "the largest size"]
def paid_most(told):
    return told.terms[abs(told.totals).argmax()]


# %% tags=["wrong", "name", "the number"]
def paid_most(told):
    return int(told.totals.argmax())


# %% tags=["lucky", "always the touch"]
def paid_most(told):
    return "touch"


# %% tags=["lucky", "the last one"]
def paid_most(told):
    return told.terms[-1]


# %% tags=["lucky", "nothing"]
def paid_most(told):
    return ""


# %% tags=["lucky", "always near"]
def paid_most(told):
    return "near"


# %% tags=["wrong", "rows", "rows and columns mixed up"]
def paid_most(told):
    sums = [sum(told.amounts[n]) for n in range(len(told.terms))]
    return told.terms[sums.index(max(sums))]
