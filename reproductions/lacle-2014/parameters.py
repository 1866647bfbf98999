"""What the model tells of its muscles: Tables 3.1 to 3.3."""
import math
import tomllib
import xml.etree.ElementTree as xml

LINE = "tib_ant_r"  # the publication's example


def length(points):
    return sum(math.dist(a, b) for a, b in zip(points, points[1:]))


def action_line(folder):
    with open(f"{folder}/model.toml", "rb") as file:
        return tomllib.load(file)["muscles"][0]["action_line"]


def add_to(ours, remarks, out, model):
    tree = xml.parse(model).getroot()
    muscle = next(each for each in tree.iter() if each.get("name") == LINE and each.find("max_isometric_force") is not None)
    body = next(each for each in tree.iter("Body") if each.get("name") == "tibia_r")
    for key, where in (("max_isometric_force", muscle), ("optimal_fiber_length", muscle), ("tendon_slack_length", muscle),
                       ("pennation_angle_at_optimal", muscle), ("mass", body), ("mass_center", body)):
        text = where.find(key).text.split()
        ours[f"parameter_{key}"] = float(text[0]) if len(text) == 1 else " ".join(f"{float(each):.3g}" for each in text)
        remarks[f"parameter_{key}"] = "read by import" if where is muscle else "read by static-optimization"
    for kind in ("PathWrap", "ConditionalPathPoint", "MovingPathPoint"):
        ours[f"constraint_{kind}"] = sum(1 for _ in tree.iter(kind))
        remarks[f"constraint_{kind}"] = "of this model; followed in every pose, where the publication holds each point on"
    full, smaller = action_line(f"{out}/tendon/model"), action_line(f"{out}/tendon/smaller")
    optimal, pennation, slack = (ours[f"parameter_{key}"] for key in ("optimal_fiber_length", "pennation_angle_at_optimal", "tendon_slack_length"))
    resting = optimal * math.cos(pennation) + slack  # eq. 3.7
    line, scaled = length(full["points_mm"]) / 1000, length(smaller["points_mm"]) / 1000
    ours.update(line_optimal=optimal, line_pennation=pennation, line_slack=slack, line_length=line, line_length_fitted=scaled, line_resting=resting,
                line_resting_fitted=resting * scaled / line, line_slack_fitted=2 * smaller["tendon_mm"] / 1000)
    remarks["line_length_fitted"] = "this skeleton is 0.292/0.303 as large"
