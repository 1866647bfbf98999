"""Limbs from a seed: bones, joints, muscles that lie on bones and on each other, and a motion. All lengths in m."""

import math
from dataclasses import dataclass, field

import numpy as np

from tubes import SECTIONS, Sheet, Tube, away_from, pulled_tight, resampled, unit

X, Y, Z = np.eye(3)
FAN_LINES = 9


@dataclass
class Limb:
    rng: np.random.Generator
    crowded: bool
    bones: list = field(default_factory=list)  # name, body, Tube
    joints: list = field(default_factory=list)  # name, parent, child, center, [(coordinate, axis)]
    muscles: list = field(default_factory=list)  # name, shape, (body, points, reach) of origin and insertion
    obstacles: list = field(default_factory=list)  # round tubes of bones
    laid: list = field(default_factory=list)  # round tubes of muscles
    motion: tuple = ()  # coordinates, poses, step, degrees

    def add_bone(self, name, body, tube, flat=False):
        self.bones.append((name, body, tube))
        self.obstacles += list(tube.strips()) if flat else [tube]
        return tube

    def add_joint(self, name, parent, child, center, axes):
        self.joints.append((name, parent, child, center, axes))

    def lay(self, first, last, aside, half):
        return pulled_tight(np.atleast_2d(first), np.atleast_2d(last), aside, half, self.obstacles, self.laid,
                            0.45 if self.crowded else 0.8)

    def add_strand(self, name, origin, insertion, aside, radius, tendon, shares=(0.05, 0.2)):
        """A spindle from a point of a body to one of another. `aside` bends it to a side before it is pulled tight."""
        rng = self.rng
        flat = math.sqrt(rng.uniform(0.4, 1.0))
        half = belly(radius * (1.25 if self.crowded else 1), tendon, *shares)
        line = self.lay(origin[1], insertion[1], aside, half * flat)[:, 0]
        broad = Tube(line, half / flat, half * flat, away_from(line, self.obstacles))
        self.laid.append(Tube(line, 0.9 * half, 0.9 * half, broad.normal))
        reach = max(0.008, 2.2 * tendon)
        self.muscles.append((name, broad, (origin[0], line[:1], reach), (insertion[0], line[-1:], reach)))

    def add_fan(self, name, origin, insertion, aside, half, tendon=0.003):
        """A sheet from a line on a body to one on another."""
        first, last = (resampled(np.asarray(end[1], float), FAN_LINES) for end in (origin, insertion))
        thick = belly(half, tendon, 0.02, 0.13)
        lines = self.lay(first, last, aside, thick)
        lines[1:-1, 1:-1] = 0.5 * lines[1:-1, 1:-1] + 0.25 * (lines[1:-1, :-2] + lines[1:-1, 2:])
        normal = unit(np.cross(np.gradient(lines, axis=0), np.gradient(lines, axis=1)))
        if (normal.reshape(-1, 3) * away_from(lines.reshape(-1, 3), self.obstacles)).sum() < 0:
            normal = -normal
        sheet = Sheet(lines, normal, thick)
        self.laid += list(sheet.tubes())
        self.muscles.append((name, sheet, (origin[0], lines[0], 0.009), (insertion[0], lines[-1], 0.009)))


def belly(radius, tendon, before, behind):
    """Half thickness along a muscle: a tendon, a belly, a tendon; `before` and `behind` are shares of its length."""
    along = np.clip((np.linspace(0, 1, SECTIONS) - before) / (1 - before - behind), 0, 1)
    return tendon + (radius - tendon) * np.sin(math.pi * along) ** 0.7


def shaft(first, last, radius, rng, head=1.7, foot=1.7, bow=0.03):
    """A long bone with thicker ends, bent to any side."""
    along = np.linspace(0, 1, 24)
    length = np.linalg.norm(last - first)
    side = unit(np.cross(last - first, rng.normal(size=3)))
    line = first + along[:, None] * (last - first) + (bow * length * np.sin(math.pi * along))[:, None] * side
    thick = radius * (1 + (head - 1) * np.exp(-(along * length / (1.3 * radius * head)) ** 2)
                      + (foot - 1) * np.exp(-((1 - along) * length / (1.3 * radius * foot)) ** 2))
    thick[[0, -1]] *= 0.75
    return Tube(line, thick, thick, np.tile(unit(np.cross(last - first, side)), (24, 1)))


def plate(first, last, wide, thick, normal):
    line = first + np.linspace(0, 1, 24)[:, None] * (last - first)
    return Tube(line, np.interp(np.linspace(0, 1, 24), np.linspace(0, 1, len(wide)), wide), np.full(24, thick),
                np.tile(normal, (24, 1)))


def around(angle):
    return math.cos(angle) * X + math.sin(angle) * Y


def spread(rng, count):
    return np.linspace(0, 2 * math.pi, count, endpoint=False) + rng.normal(0, 0.15, count)


def count_of(limb, low, high):
    return int(limb.rng.integers(low, high) * (1.7 if limb.crowded else 1))


def hinge(limb):
    """An elbow or a knee with muscles on all sides."""
    rng = limb.rng
    to_front = rng.choice([1, -1])
    thick, thin = rng.uniform(0.009, 0.014), rng.uniform(0.007, 0.012)
    upper = limb.add_bone("upper", "upper", shaft(rng.uniform(0.22, 0.42) * Z, 0.004 * Z, thick, rng))
    lower = limb.add_bone("lower", "lower", shaft(-(1.9 * thick + 0.5 * thin) * Z, -rng.uniform(0.2, 0.38) * Z, thin, rng))
    for k, angle in enumerate(spread(rng, count_of(limb, 4, 9))):
        limb.add_strand(f"muscle_{k}", ("upper", upper.at(rng.uniform(0.05, 0.5), around(angle))),
                        ("lower", lower.at(rng.uniform(0.12, 0.35), around(angle))), 0.05 * around(angle),
                        rng.uniform(0.010, 0.020), rng.uniform(0.003, 0.005))
    limb.add_joint("hinge", "upper", "lower", 0 * X, [("flexion", -to_front * Y)])
    limb.motion = (["flexion"], [[0], [110]], 4)


def ball(limb):
    """A plate over a shaft with a ball joint."""
    rng = limb.rng
    up = unit(np.array([rng.uniform(-0.5, 0.5), rng.uniform(0.3, 0.9), 1]))
    blade = limb.add_bone("blade", "blade", plate(0.035 * up + rng.uniform(0.10, 0.16) * up, 0.035 * up,
                                                  [0.036, 0.03, 0.024], 0.009, unit(np.cross(up, X))), flat=True)
    leg = limb.add_bone("shaft", "shaft", shaft(0 * Z, -rng.uniform(0.28, 0.42) * Z, rng.uniform(0.010, 0.014), rng))
    for k, angle in enumerate(spread(rng, count_of(limb, 4, 8))):
        limb.add_strand(f"muscle_{k}", ("blade", blade.at(rng.uniform(0.1, 0.7), around(angle))),
                        ("shaft", leg.at(rng.uniform(0.15, 0.55), around(angle))), 0.06 * around(angle),
                        rng.uniform(0.010, 0.020), rng.uniform(0.004, 0.008))
    limb.add_joint("ball", "blade", "shaft", 0 * X, [("flexion", -Y), ("abduction", X), ("rotation", Z)])
    pose = [int(rng.integers(20, 70)), int(rng.integers(-20, 30)), int(rng.integers(-30, 30))]
    limb.motion = (["flexion", "abduction", "rotation"], [[0, 0, 0], pose, [-15, 0, 0]], 4)


def chain(limb):
    """Two hinges, with muscles over one or both."""
    rng = limb.rng
    length, thick = rng.uniform(0.3, 0.42), rng.uniform(0.011, 0.014)
    bones = {"upper": shaft((length + rng.uniform(0.12, 0.2)) * Z, (length + 0.03) * Z, 0.014, rng, 1.5, 1.5),
             "middle": shaft(length * Z, 0.004 * Z, thick, rng, 1.6, 1.9),
             "lower": shaft(-(2 * thick + 0.004) * Z, -rng.uniform(0.28, 0.38) * Z, rng.uniform(0.009, 0.012), rng, 2)}
    for name, tube in bones.items():
        limb.add_bone(name, name, tube)
    for k, angle in enumerate(spread(rng, count_of(limb, 6, 11))):
        first, last = [("upper", "middle"), ("middle", "lower"), ("upper", "lower")][rng.integers(3)]
        limb.add_strand(f"muscle_{k}", (first, bones[first].at(rng.uniform(0.1, 0.5), around(angle))),
                        (last, bones[last].at(rng.uniform(0.12, 0.4), around(angle))), 0.05 * around(angle),
                        rng.uniform(0.012, 0.022), rng.uniform(0.003, 0.006))
    limb.add_joint("hip", "upper", "middle", length * Z, [("hip", -Y)])
    limb.add_joint("knee", "middle", "lower", 0 * Z, [("knee", Y)])
    limb.motion = (["hip", "knee"], [[0, 0], [int(rng.integers(30, 90)), int(rng.integers(40, 110))]], 4)


def forearm(limb):
    """Two bones beside each other, one of which turns around the other."""
    rng = limb.rng
    length, gap = rng.uniform(0.2, 0.26), rng.uniform(0.010, 0.014)
    ulna = limb.add_bone("ulna", "ulna", shaft(-gap * Y, -gap * Y - length * Z, 0.006, rng, 1.6, 1.2, 0.02))
    radius = limb.add_bone("radius", "radius", shaft(gap * Y, gap * Y - length * Z, 0.006, rng, 1.3, 1.7))
    for k in range(count_of(limb, 3, 7)):
        side = X if k % 2 == 0 else -X
        high = rng.uniform(0.05, 0.5)
        shares = [high, min(0.9, high + rng.uniform(0.15, 0.5))]
        rng.shuffle(shares)
        limb.add_strand(f"muscle_{k}", ("ulna", ulna.at(shares[0], side + 0.2 * Y)),
                        ("radius", radius.at(shares[1], side - 0.2 * Y)), 0.02 * side, rng.uniform(0.006, 0.011),
                        rng.uniform(0.003, 0.005))
    limb.add_joint("radioulnar", "ulna", "radius", radius.line[0], [("pronation", unit(ulna.line[-1] - radius.line[0]))])
    limb.motion = (["pronation"], [[0], [60], [-40]], 4)


def spine(limb):
    """Vertebrae that bend and turn, each a little, between long straps."""
    rng = limb.rng
    count, height, radius = int(rng.integers(4, 7)), rng.uniform(0.025, 0.035), rng.uniform(0.013, 0.020)
    bones = [limb.add_bone(f"vertebra_{k}", f"vertebra_{k}", shaft((k * height + 0.004) * Z, ((k + 1) * height - 0.004) * Z,
                                                                   radius, rng, 1.1, 1.1, 0)) for k in range(count)]
    for k, angle in enumerate(spread(rng, count_of(limb, 4, 8))):
        low, high = int(rng.integers(0, 2)), int(rng.integers(count - 2, count))
        limb.add_strand(f"muscle_{k}", (f"vertebra_{low}", bones[low].at(0.5, around(angle))),
                        (f"vertebra_{high}", bones[high].at(0.5, around(angle))), 0.02 * around(angle),
                        rng.uniform(0.007, 0.012), rng.uniform(0.003, 0.005), (0.05, 0.05))
    for k in range(count - 1):
        limb.add_joint(f"joint_{k}", f"vertebra_{k}", f"vertebra_{k + 1}", (k + 1) * height * Z,
                       [(f"bend_{k}", Y), (f"twist_{k}", Z)])
    pairs = count - 1
    limb.motion = ([f"{word}_{k}" for k in range(pairs) for word in ("bend", "twist")],
                   [[0, 0] * pairs, [10, 0] * pairs, [-6, 6] * pairs], 1)


def gluteal(limb):
    """A blade of bone over a shaft with a neck: fans from its two sides, one from behind."""
    rng = limb.rng
    blade = limb.add_bone("ilium", "pelvis", plate(np.array([0.01, 0.035, 0.15]), np.array([0, 0.02, 0.028]),
                                                   [0.06, 0.062, 0.025], 0.007,
                                                   unit(np.cross([-0.01, -0.015, -0.122], X))), flat=True)
    femur = limb.add_bone("femur", "femur", shaft(np.array([0, -0.045, 0]), np.array([0, -0.03, -rng.uniform(0.35, 0.42)]),
                                                  0.0125, rng, 1.7, 1.8, 0))
    limb.add_bone("neck", "femur", shaft(np.array([0, 0.002, 0.004]), np.array([0, -0.045, -0.012]), 0.012, rng, 1.8, 1.2, 0))
    limb.add_bone("ischium", "pelvis", shaft(np.array([-0.02, 0.025, 0.01]), np.array([-0.03, 0.03, -0.06]), 0.014, rng, 1, 1.2))
    sacrum = limb.add_bone("sacrum", "pelvis", shaft(np.array([-0.075, 0.09, 0.13]), np.array([-0.07, 0.095, 0.02]), 0.014,
                                                     rng, 1.4, 0.8))
    outer = np.sign(blade.normal[12] @ -Y) * blade.normal[12]
    front = np.sign(blade.across[0] @ X)

    def rim(share, low, high, side):
        k = int(23 * share)
        return [blade.line[k] + front * w * blade.wide[k] * blade.across[k] + 0.008 * side * outer
                for w in np.linspace(low, high, 7)]

    tip = femur.line[0] + np.array([0, -0.012, -0.006])
    limb.add_fan("minimus", ("pelvis", rim(0.5, -0.6, 0.7, 1)), ("femur", [tip + [0.01, 0, 0], tip + [0.014, 0.004, -0.008]]),
                 -0.02 * Y, rng.uniform(0.005, 0.009))
    limb.add_fan("medius", ("pelvis", rim(0.1, -0.8, 0.8, 1)), ("femur", [tip + [-0.012, -0.003, 0], tip + [0, -0.004, -0.006]]),
                 -0.03 * Y, rng.uniform(0.007, 0.012))
    limb.add_fan("maximus", ("pelvis", sacrum.line[2:22:3] + [-0.012, -0.008, 0]),
                 ("femur", [femur.line[3] + [-0.012, -0.010, 0], femur.line[6] + [-0.013, -0.006, 0]]),
                 0.05 * unit(np.array([-1, -0.8, 0])), rng.uniform(0.009, 0.014))
    limb.add_fan("iliacus", ("pelvis", rim(0.1, -0.7, 0.7, -1)),
                 ("femur", [femur.line[4] + [0.002, 0.015, 0], femur.line[3] + [0.006, 0.014, 0]]),
                 0.05 * unit(np.array([1, 0.8, 0])), rng.uniform(0.006, 0.009))
    limb.add_joint("hip", "pelvis", "femur", 0 * X, [("flexion", -Y), ("abduction", X), ("rotation", Z)])
    pose = [int(rng.integers(30, 90)), int(rng.integers(-15, 15)), int(rng.integers(-25, 25))]
    limb.motion = (["flexion", "abduction", "rotation"], [[0, 0, 0], pose, [-20, -25, 0]], 4)


def shoulder(limb):
    """An arm beside a chest: fans from the chest, from both sides of a plate behind it and from above."""
    rng = limb.rng
    wide = rng.uniform(0.10, 0.13)
    height = np.linspace(-0.22, 0.06, 24)
    barrel = wide * (1 - ((height + 0.10) / 0.2) ** 4).clip(0.12) ** 0.5
    limb.add_bone("ribs", "torso", Tube(np.outer(height, Z), barrel, 0.95 * barrel, np.tile(X, (24, 1))))
    head = np.array([-0.01, -wide - rng.uniform(0.045, 0.06), -0.01])
    arm = limb.add_bone("humerus", "humerus", shaft(head + 0.012 * Z, head - [0, 0.01, rng.uniform(0.26, 0.33)], 0.0115, rng,
                                                    2, 1.7, 0))
    glenoid, medial = head + [-0.01, 0.028, 0], np.array([-wide - 0.022, -0.45 * wide, -0.03])
    blade = limb.add_bone("scapula", "scapula", plate(glenoid, medial, [0.012, 0.035, 0.045, 0.05], 0.004,
                                                      unit(np.cross(medial - glenoid, Z))), flat=True)
    spine_of_it = limb.add_bone("acromion", "scapula", shaft(blade.line[16] + [-0.008, 0, 0.042], head + [0.012, -0.016, 0.047],
                                                             0.005, rng, 1.2, 1.5, 0))
    collar = limb.add_bone("clavicle", "torso", shaft(head + [0.016, -0.012, 0.046], np.array([0.95 * wide, -0.02, 0.03]), 0.005,
                                                      rng, 1.2, 1.5, 0))
    behind = np.sign(blade.normal[12] @ -X)

    def side_of_blade(low, high, side):
        return [blade.line[21] + w * blade.wide[21] * Z + 0.005 * side * behind * blade.normal[21]
                for w in np.linspace(low, high, 5)]

    limb.add_fan("infraspinatus", ("scapula", side_of_blade(-0.6, 0.3, 1)),
                 ("humerus", [head + [-0.018, -0.012, 0.004], head + [-0.014, -0.014, 0.012]]), -0.02 * X, 0.006)
    limb.add_fan("subscapularis", ("scapula", side_of_blade(-0.7, 0.6, -1)),
                 ("humerus", [head + [0.018, -0.006, -0.006], head + [0.02, -0.008, 0.006]]), 0.02 * X, 0.005)
    above = np.concatenate([spine_of_it.line[4:22:3] + [0, -0.003, 0.006], collar.line[1:14:3] + [0, -0.003, 0.007]])
    aside = np.stack([0.05 * np.linspace(-1, 1, FAN_LINES), np.full(FAN_LINES, -0.06), np.zeros(FAN_LINES)], 1)
    knob = arm.line[10] - 0.013 * Y
    limb.add_fan("deltoid", ("scapula", above), ("humerus", [knob + [-0.008, 0.002, 0.004], knob - 0.004 * Z,
                                                             knob + [0.008, 0.002, 0.004]]), aside, rng.uniform(0.006, 0.010))
    down = np.linspace(0, 1, 6)[:, None]
    limb.add_fan("pectoralis", ("torso", [0.97 * wide, -0.03, 0] - 0.11 * down * Z),
                 ("humerus", [arm.line[5] + [0.014, 0, 0.012], arm.line[8] + [0.012, 0, -0.006]]),
                 0.04 * unit(np.array([1, -0.6, 0])), rng.uniform(0.005, 0.009))
    limb.add_fan("latissimus", ("torso", [-0.97 * wide, -0.03, -0.06] - 0.12 * down * Z),
                 ("humerus", [arm.line[5] + [0.006, 0.013, 0.01], arm.line[7] + [0.006, 0.012, -0.004]]),
                 0.03 * unit(np.array([-0.6, -1, 0])), rng.uniform(0.004, 0.007))
    limb.add_joint("scapulothoracic", "torso", "scapula", np.array([0.8 * wide, -0.02, 0.03]), [("upward_rotation", X)])
    limb.add_joint("shoulder", "scapula", "humerus", head, [("elevation", -X), ("flexion", -Y), ("rotation", Z)])
    pose = [0, int(rng.integers(40, 90)), int(rng.integers(-20, 50)), int(rng.integers(-40, 40))]
    limb.motion = (["upward_rotation", "elevation", "flexion", "rotation"], [[0] * 4, pose], 4)


def ankle(limb):
    """Two bones of a shank with malleoli over a talus and a foot, and tendons that bend around them."""
    rng = limb.rng
    length, wide, foot = rng.uniform(0.28, 0.38), rng.uniform(0.018, 0.022), rng.uniform(0.9, 1.15)
    tibia = limb.add_bone("tibia", "shank", shaft(np.array([0, 0, length]), np.array([0, 0, 0.02]), 0.011, rng, 2, 1.5))
    limb.add_bone("medial_malleolus", "shank", shaft(np.array([0, wide - 0.003, 0.03]), np.array([-0.002, wide, -0.012]), 0.006,
                                                     rng, 1.2, 1.2, 0))
    fibula = limb.add_bone("fibula", "shank", shaft(np.array([-0.012, -wide - 0.006, 0.93 * length]),
                                                    np.array([-0.006, -wide - 0.004, -0.018]), 0.006, rng, 1.5, 1.4))
    limb.add_bone("talus", "talus", shaft(np.array([-0.018, 0, -0.012]), foot * np.array([0.03, 0.004, -0.022]), 0.012, rng, 1.1,
                                          1, 0))
    heel = limb.add_bone("calcaneus", "foot", shaft(foot * np.array([0.012, -0.004, -0.037]), foot * np.array([-0.052, 0, -0.048]),
                                                    0.012, rng, 1, 1.3, 0))
    sole = limb.add_bone("metatarsals", "foot", plate(foot * np.array([0.035, 0, -0.034]), foot * np.array([0.14, 0, -0.062]),
                                                      [0.018, 0.03, 0.036], 0.009, Z), flat=True)
    inner, outer = sole.at(0.25, Y + 0.4 * Z), sole.at(0.3, -Y + 0.1 * Z)
    limb.add_strand("tibialis_posterior", ("shank", tibia.at(rng.uniform(0.25, 0.5), -X + 0.2 * Y)),
                    ("foot", sole.at(0.08, Y - 0.5 * Z)), np.array([-0.05, 0.03, 0]), rng.uniform(0.007, 0.010), 0.003, (0.05, 0.45))
    limb.add_strand("tibialis_anterior", ("shank", tibia.at(rng.uniform(0.15, 0.4), X - 0.7 * Y)), ("foot", inner), -0.02 * X,
                    rng.uniform(0.009, 0.013), 0.0035, (0.05, 0.4))
    limb.add_strand("extensor", ("shank", fibula.at(rng.uniform(0.15, 0.5), X + 0.3 * Y)), ("foot", sole.at(0.8, Z)),
                    -0.05 * X, rng.uniform(0.007, 0.010), 0.003, (0.05, 0.5))
    limb.add_strand("peroneus", ("shank", fibula.at(rng.uniform(0.15, 0.5), -Y)), ("foot", outer), np.array([-0.05, -0.04, 0]),
                    rng.uniform(0.007, 0.010), 0.003, (0.05, 0.45))
    limb.add_strand("soleus", ("shank", tibia.at(0.2, -X)), ("foot", heel.at(0.9, -X - 0.3 * Z)), -0.04 * X, rng.uniform(0.014, 0.020),
                    0.005, (0.05, 0.3))
    limb.add_strand("gastrocnemius", ("shank", tibia.at(0.03, -X)), ("foot", heel.at(0.97, -X)), -0.07 * X,
                    rng.uniform(0.013, 0.018), 0.005, (0.05, 0.45))
    limb.add_joint("ankle", "shank", "talus", 0 * X, [("dorsiflexion", -Y)])
    limb.add_joint("subtalar", "talus", "foot", foot * np.array([0.005, 0, -0.026]), [("inversion", unit(0.8 * X + 0.5 * Z))])
    limb.motion = (["dorsiflexion", "inversion"], [[0, 0], [20, 0], [-45, int(rng.integers(-20, 25))]], 4)


def trunk(limb):
    """A chest over a pelvis on five vertebrae, with straps and sheets before, behind and beside them."""
    rng = limb.rng
    height, wide, back = rng.uniform(0.030, 0.036), rng.uniform(0.11, 0.13), -0.035 * X
    top = 0.06 + 5 * height
    sacrum = limb.add_bone("sacrum", "pelvis", shaft(back + 0.055 * Z, back - 0.02 * X - 0.05 * Z, 0.02, rng, 1.2, 0.7, 0))
    limb.add_bone("pubis", "pelvis", shaft(np.array([0.075, -0.045, -0.03]), np.array([0.075, 0.045, -0.03]), 0.009, rng, 1, 1, 0))
    sides = (("left", 1), ("right", -1))
    crests = [limb.add_bone(f"ilium_{name}", "pelvis", plate(np.array([0, 0.045 * side, -0.01]), np.array([0.005, side * wide, 0.09]),
                                                             [0.03, 0.05, 0.06], 0.006, unit(np.array([0, 1, -0.8 * side]))), flat=True)
              for name, side in sides]
    for k in range(5):
        limb.add_bone(f"vertebra_{k}", f"vertebra_{k}", shaft(back + (0.06 + k * height + 0.003) * Z,
                                                              back + (0.06 + (k + 1) * height - 0.003) * Z, 0.019, rng, 1.1, 1.1, 0))
    rise = np.linspace(0.005, 0.26, 24)
    barrel = wide * (1 - ((rise - 0.11) / 0.2) ** 4).clip(0.12) ** 0.5
    ribs = limb.add_bone("ribs", "chest", Tube(np.outer(rise + top, Z) + 0.02 * X, barrel, 0.8 * barrel, np.tile(X, (24, 1))))
    for (name, side), crest in zip(sides, crests):
        limb.add_strand(f"erector_{name}", ("pelvis", sacrum.at(0.5, side * Y - X)), ("chest", ribs.at(0.5, 0.35 * side * Y - X)),
                        np.array([-0.03, 0.02 * side, 0]), rng.uniform(0.012, 0.017), 0.005, (0.05, 0.1))
        limb.add_strand(f"quadratus_{name}", ("pelvis", crest.line[-2] - 0.035 * X), ("chest", ribs.at(0.02, 0.5 * side * Y - X)),
                        0.01 * side * Y, rng.uniform(0.008, 0.011), 0.005, (0.05, 0.05))
        limb.add_fan(f"rectus_{name}", ("pelvis", np.array([[0.08, side * y, -0.02] for y in (0.008, 0.02, 0.032)])),
                     ("chest", [ribs.at(0.15, X + side * y * Y, 0.003) for y in (0.1, 0.3, 0.5)]), 0.03 * X, rng.uniform(0.004, 0.007))
        limb.add_fan(f"oblique_{name}", ("pelvis", [crest.line[-1] + [x, 0, 0.004] for x in (0.05, 0.02, -0.01, -0.03)]),
                     ("chest", [ribs.at(0.1, side * Y + x * X, 0.003) for x in (0.7, 0.3, -0.1, -0.4)]), 0.02 * side * Y,
                     rng.uniform(0.004, 0.006))
    bodies = ["pelvis", *(f"vertebra_{k}" for k in range(5)), "chest"]
    for k in range(6):
        limb.add_joint(f"joint_{k}", bodies[k], bodies[k + 1], back + (0.057 + k * height) * Z, [(f"flexion_{k}", Y), (f"twist_{k}", Z)])
    limb.motion = ([f"{word}_{k}" for k in range(6) for word in ("flexion", "twist")],
                   [[0, 0] * 6, [int(rng.integers(3, 7)), 0] * 6, [-3, int(rng.integers(-5, 6))] * 6], 1)


KINDS = {make.__name__: make for make in (hinge, ball, chain, forearm, spine, gluteal, shoulder, ankle, trunk)}
