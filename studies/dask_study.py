"""A study by Dask, a task per shard: python3 studies/dask_study.py STUDY [SHARDS] [SCHEDULER] [--folder FOLDER].

SCHEDULER is that of a cluster (tcp://host:8786) whose workers see the same disk; without one, this machine's processors.
FOLDER is what the study leaves behind.
"""

import argparse
import os
import subprocess
import sys

from dask.distributed import Client, as_completed


def run_shard(command, shard):
    """The exit code of a shard: 0, or 5 where runs have failed (they are in the tables); 128 and more after a signal."""
    code = subprocess.run([*command, "--shard", shard], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
    return code if code >= 0 else 128 - code


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study")
    parser.add_argument("shards", nargs="?", type=int, default=os.cpu_count())
    parser.add_argument("scheduler", nargs="?")
    parser.add_argument("--folder")
    asked = parser.parse_args(arguments)
    command = [os.environ.get("GRACILIS", "gracilis"), "study", "run", asked.study]
    command += ["--folder", asked.folder] if asked.folder else []
    with Client(asked.scheduler) if asked.scheduler else Client(threads_per_worker=1, dashboard_address=None) as client:
        tasks = {client.submit(run_shard, command, f"{i}/{asked.shards}", pure=False): i for i in range(1, asked.shards + 1)}
        codes = []
        for task in as_completed(tasks):
            codes.append(task.result())
            print(f"shard {tasks[task]}/{asked.shards}: exit code {codes[-1]}", flush=True)
    return max(codes)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
