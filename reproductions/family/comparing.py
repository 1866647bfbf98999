"""Whether ours differs from what was published."""
import itertools
import math

READING = 0.03  # of a chart's height: how far off a curve may be read from a printed plot


def number(text):
    try:
        return float(text)
    except (TypeError, ValueError):
        return None


def differs(published, ours):
    """By more than half a percent, or in words."""
    a, b = number(published), number(ours)
    return abs(b - a) > 0.005 * abs(a) if a is not None and b is not None else published != ours


def beyond(published, ours):
    """Whether ours is outside of the bar that published.csv has for it in `least` and `most`."""
    value, least, most = number(ours), number(published.get("least")), number(published.get("most"))
    return value is not None and not ((least is None or value >= least) and (most is None or value <= most))


def crossings(points, x):
    """Where a line through the points is at x."""
    return [y0 + (y1 - y0) * (x - x0) / (x1 - x0) if x1 != x0 else y0
            for (x0, y0), (x1, y1) in itertools.pairwise(points) if min(x0, x1) <= x <= max(x0, x1)]


def unfollowed(series):
    """Names of published curves of a chart that leave every curve of ours by more than can be read, at an angle that ours have."""
    ours = [s.points for s in series if not s.published and not s.band and len(s.points) > 1]
    heights = [y for s in series for _, y in s.points if math.isfinite(y)]
    room = READING * (max(heights) - min(heights)) if heights else 0
    found = []
    for s in series:
        if s.published and len(s.points) > 1:
            among = [(y, [at for points in ours for at in crossings(points, x)]) for x, y in s.points]
            if any(at and min(abs(each - y) for each in at) > room for y, at in among):
                found.append(s.name)
    return found
