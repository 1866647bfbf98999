"""How a muscle's volume depends on a setting: the demo's iliacus, by how compliant its volume is, in several processes."""

import gracilis

if __name__ == "__main__":
    scene = gracilis.demo(only=["iliacus_r"])
    compliances = [0, 1e-6, 1e-5, 1e-4]  # m⁶/J; 0 keeps the volume exactly
    poses = [{"hip_flexion_r": angle} for angle in (0, 30, 60)]
    settings = [dict(volume_compliance=compliance) for compliance in compliances]
    swept = gracilis.sweep(scene, poses, settings=settings, fibers=False)
    ratios = swept.volumes[:, :, 0] / swept.volumes[:, :1, 0]
    print("compliance   volume at 30 and 60 degrees over that at 0")
    for compliance, row in zip(compliances, ratios):
        print(f"{compliance:10.0e}   {row[1]:.4f} {row[2]:.4f}")
