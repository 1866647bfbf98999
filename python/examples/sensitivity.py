"""How a muscle's volume depends on a setting: the demo's iliacus by more and more iterations, in several processes."""

import gracilis

if __name__ == "__main__":
    scene = gracilis.demo(only=["iliacus_r"])
    iterations = [1, 3, 10, 30]
    poses = [{"hip_flexion_r": angle} for angle in (0, 15, 30)]
    swept = gracilis.sweep(scene, poses, settings=[dict(iterations=count) for count in iterations], fibers=False)
    ratio = swept.volumes[:, :, 0] / swept.volumes[:, :1, 0]
    for count, row in zip(iterations, ratio):
        print(f"{count:2d} iterations: volume at 15 and 30 degrees over that at rest {row[1]:.4f} {row[2]:.4f}")
