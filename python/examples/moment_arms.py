"""Moment arms of the built-in hip's muscles about hip flexion."""

import gracilis

# %% Two muscles of the hip
scene = gracilis.demo(only=["iliacus_r", "gluteus_maximus_r"])
arms = gracilis.moment_arms(scene, "hip_flexion_r", range(0, 31, 10), method="skinning")
print("degrees          ", *(f"{angle:6.0f}" for angle in arms.degrees))
for muscle, arm in arms.arms.items():
    print(f"{muscle:17}", *(f"{1000 * value:6.1f}" for value in arm), "mm")

# %% In a notebook they are a chart
arms
