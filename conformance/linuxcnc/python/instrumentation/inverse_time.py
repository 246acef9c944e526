"""F under inverse time, had back from a move: the calls show the speed, which is the length of the move times F."""
import math


def rate_of_line(speed, start, end):
    """F of a straight move; None where it leads nowhere. Only where nothing moves along X, Y and Z do the rotary axes count."""
    between = lambda axes: math.hypot(*(end.get(axis, 0.0) - start.get(axis, 0.0) for axis in axes))
    length = between("xyz") or between("abc")
    return speed / length if length else None


def rate_of_arc(speed, start, end, centre, turns):
    """F of an arc, whose length is that of the helix; points by the first, the second and the normal axis of the plane."""
    angle = lambda point: math.atan2(point[1] - centre[1], point[0] - centre[0])
    part = math.copysign(1, turns) * (angle(end) - angle(start)) % math.tau
    swept = (math.tau if part < 1e-9 else part) + (abs(turns) - 1) * math.tau
    return speed / math.hypot(math.dist(start[:2], centre) * swept, end[2] - start[2])
