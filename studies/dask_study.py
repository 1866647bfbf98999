"""A study by Dask, a task per shard: python3 studies/dask_study.py STUDY [SHARDS] [SCHEDULER].

SCHEDULER is that of a cluster (tcp://host:8786) whose workers see the same disk; without one, this machine's processors.
"""

import os
import subprocess
import sys

from dask.distributed import Client, as_completed


def run_shard(program, study, shard):
    """The exit code of a shard: 0, or 5 where runs have failed (they are in the tables)."""
    return subprocess.run([program, "study", "run", study, "--shard", shard], stdout=subprocess.DEVNULL,
                          stderr=subprocess.DEVNULL).returncode


def main(study, shards=None, scheduler=None):
    program = os.environ.get("GRACILIS", "gracilis")
    count = int(shards or os.cpu_count())
    with Client(scheduler) if scheduler else Client(threads_per_worker=1, dashboard_address=None) as client:
        tasks = {client.submit(run_shard, program, study, f"{i}/{count}", pure=False): i for i in range(1, count + 1)}
        codes = []
        for task in as_completed(tasks):
            codes.append(task.result())
            print(f"shard {tasks[task]}/{count}: exit code {codes[-1]}", flush=True)
    return max(codes)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
