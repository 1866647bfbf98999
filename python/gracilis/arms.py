"""What gracilis.moment_arms returns."""

from typing import NamedTuple

from ._core import muscle_curves_svg


class MomentArms(NamedTuple):
    """Moment arms along a range of one coordinate. In a notebook they show themselves as a chart."""

    coordinate: str
    degrees: object  #: (n,) float64; mm where the coordinate is a translation
    arms: dict  #: muscle -> (n,) float64, m, positive where shortening increases the coordinate
    lengths: dict  #: muscle -> (n,) float64, m: mean fiber length
    unit: str = "degrees"  #: of `degrees`: "degrees" or "mm"

    def _repr_svg_(self):
        in_mm = {muscle: 1000 * arm for muscle, arm in self.arms.items()}
        of = f"about {self.coordinate}" if self.unit == "degrees" else f"along {self.coordinate}"
        return muscle_curves_svg(f"Moment arms {of}", f"{self.coordinate} ({self.unit})", "moment arm (mm)", self.degrees,
                                 in_mm)  # fmt: skip
