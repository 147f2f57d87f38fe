"""Numbers as text for people, and their position in a range."""


def number(value: float) -> str:
    """Format a number for the panel.

    >>> [number(x) for x in (0.5, -0.25, 12.3456, 1234.5, 3, -0.0001, 1e9)]
    ['0.50', '-0.25', '12.35', '1234', '3', '0.00', '1.00e+09']
    """
    if isinstance(value, int):
        return str(value)
    size = abs(value)
    text = f"{value:.2f}" if size < 1000 else f"{value:.0f}" if size < 1e6 else f"{value:.2e}"
    return "0.00" if text == "-0.00" else text


def amount(value: float) -> str:
    """Format a reward: like :func:`number`, but small amounts keep two significant digits.

    >>> [amount(x) for x in (100.0, -0.5, -0.0012, 0.0)]
    ['100.00', '-0.50', '-0.0012', '0.00']
    """
    return f"{value:.2g}" if 1e-9 < abs(value) < 0.05 else number(value)


def share(value: float, low: float, high: float) -> float:
    """Return a value's position in its range, clipped to 0 (lower end) .. 1 (upper end).

    >>> share(5, 0, 20), share(-3, -1, 1), share(1, 1, 1)
    (0.25, 0.0, 0.0)
    """
    return min(max((value - low) / (high - low), 0.0), 1.0) if high > low else 0.0
