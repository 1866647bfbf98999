"""What gracilis.moment_arms returns."""

from typing import NamedTuple


class MomentArms(NamedTuple):
    """Moment arms along a range of one coordinate."""

    coordinate: str
    degrees: object  #: (n,) float64; mm where the coordinate is a translation
    arms: dict  #: muscle -> (n,) float64, m, positive where shortening increases the coordinate
    lengths: dict  #: muscle -> (n,) float64, m: mean fiber length
