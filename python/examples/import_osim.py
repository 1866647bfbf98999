"""A scene of an OpenSim model, and its muscles' own moment arms beside it: python import_osim.py MODEL.osim FOLDER"""

import sys

import numpy as np

import gracilis

# %% A scene of the model
model, folder = sys.argv[1:]
(file,) = gracilis.import_model(model, folder)
scene = gracilis.load(file)
print(f"{len(scene.muscles)} muscles, {len(scene.bones)} bones, coordinates {', '.join(scene.coordinates)}")

# %% The model's own moment arms
angles = np.radians(np.arange(10, 101, 30))
lengths, arms = gracilis.paths(model, dict(time=np.arange(len(angles)) / 100, r_elbow_flex=angles))
for muscle in scene.muscles:
    print(f"{muscle:9}", *(f"{1000 * arm:6.1f}" for arm in arms["r_elbow_flex"][muscle]), "mm about r_elbow_flex")
