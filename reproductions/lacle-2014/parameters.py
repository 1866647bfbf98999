"""What the model tells of tibialis anterior, the publication's example: Tables 3.1 to 3.3."""
import math
import xml.etree.ElementTree as xml

from files import read

LINE = "tib_ant_r"


def action_line(folder):
    """Its length, m, and half of its tendon's slack length, m, as import has them."""
    line = read(f"{folder}/model.toml")["muscles"][0]["action_line"]
    return sum(math.dist(a, b) for a, b in zip(line["points_mm"], line["points_mm"][1:])) / 1000, line["tendon_mm"] / 1000


def numbers(element, key):
    found = [float(word) for word in element.find(key).text.split()]
    return found[0] if len(found) == 1 else " ".join(f"{each:.3g}" for each in found)


def tell(page):
    tree = xml.parse(f"{page.data}/opensim/subject01_simbody_adjusted_StaticOp.osim").getroot()
    muscle = next(each for each in tree.iter() if each.get("name") == LINE and each.find("max_isometric_force") is not None)
    tibia = next(each for each in tree.iter("Body") if each.get("name") == "tibia_r")
    for key in ("max_isometric_force", "optimal_fiber_length", "tendon_slack_length", "pennation_angle_at_optimal"):
        page.put(f"parameter_{key}", numbers(muscle, key))
    for key in ("mass", "mass_center"):
        page.put(f"parameter_{key}", numbers(tibia, key))
    for kind in ("PathWrap", "ConditionalPathPoint", "MovingPathPoint"):
        page.put(f"constraint_{kind}", sum(1 for _ in tree.iter(kind)))
    optimal, pennation, slack = (numbers(muscle, key) for key in ("optimal_fiber_length", "pennation_angle_at_optimal", "tendon_slack_length"))
    length, half = action_line(f"{page.out}/tendon/model")
    fitted, half_fitted = action_line(f"{page.out}/tendon/smaller")
    resting = optimal * math.cos(pennation) + slack  # eq. 3.7
    for key, value in {"line_optimal": optimal, "line_pennation": pennation, "line_slack": slack, "line_length": length, "line_length_fitted": fitted,
                       "line_resting": resting, "line_resting_fitted": resting * fitted / length, "line_slack_fitted": 2 * half_fitted,
                       "half_slack": half, "half_slack_fitted": half_fitted}.items():
        page.put(key, value)
