"""Builds the wheel with CMake; a PEP 517 backend that needs nothing but Python, CMake and the packages of packages.txt.

pip wheel .                                          builds in build/wheel
pip wheel . --config-settings build-dir=build/release   builds on in a folder that is configured already
"""

import base64
import hashlib
import os
import re
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

root = Path(__file__).resolve().parent.parent
earliest = (1980, 1, 1, 0, 0, 0)  # of a file in a .zip: the same wheel from the same files


def version():
    return re.search(r"project\(gracilis VERSION (\S+)", (root / "CMakeLists.txt").read_text()).group(1)


def tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def metadata():
    # Without NumPy, which pip would ask the network for: 'import gracilis' says where it is missing.
    return (
        f"Metadata-Version: 2.1\nName: gracilis\nVersion: {version()}\n"
        "Summary: Muscle deformation in musculoskeletal models\nLicense: Apache-2.0\n"
        "Requires-Python: >=3.9\n"
    )


def build(folder):
    """The package as CMake leaves it."""
    if not (folder / "CMakeCache.txt").exists():
        subprocess.run(
            ["cmake", "--preset", "release", "-B", str(folder), f"-DPython_EXECUTABLE={sys.executable}",
             "-DGRACILIS_WITH_PYTHON=ON", "-DGRACILIS_BUILD_TESTS=OFF", "-DGRACILIS_BUILD_BENCHMARKS=OFF"],
            cwd=root, check=True)  # fmt: skip
    jobs = ["--parallel", os.environ["GRACILIS_JOBS"]] if "GRACILIS_JOBS" in os.environ else []
    subprocess.run(["cmake", "--build", str(folder), "--target", "gracilis_python", *jobs], check=True)
    return folder / "python" / "gracilis"


def record_of(name, content):
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}\n"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    folder = (root / (config_settings or {}).get("build-dir", "build/wheel")).resolve()
    package = build(folder)
    info = f"gracilis-{version()}.dist-info"
    files = {f"gracilis/{file.name}": file.read_bytes() for file in sorted(package.iterdir()) if file.is_file()}
    modules = [name for name in files if name.endswith(".so")]
    if modules != ["gracilis/_core" + sysconfig.get_config_var("EXT_SUFFIX")]:
        raise SystemExit(f"{folder} was configured for another Python than {sys.executable}: it has {modules}")
    files[f"{info}/METADATA"] = metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: gracilis\nRoot-Is-Purelib: false\nTag: {tag()}\n".encode()
    files[f"{info}/LICENSE"] = (root / "LICENSE").read_bytes()
    record = "".join(record_of(name, content) for name, content in files.items()) + f"{info}/RECORD,,\n"
    files[f"{info}/RECORD"] = record.encode()
    wheel = f"gracilis-{version()}-{tag()}.whl"
    with zipfile.ZipFile(Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, earliest)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, content)
    return wheel


def get_requires_for_build_wheel(config_settings=None):
    return []


def build_sdist(sdist_directory, config_settings=None):
    raise SystemExit("there is no source package: build the wheel in a checkout, by 'pip wheel .'")
