#!/bin/bash
# A study as a Slurm array, a shard per task:  sbatch --array=1-16 studies/slurm.sh studies/hip.toml [--folder FOLDER ...]
# Tasks may be requeued, repeated or cancelled at any time: the same line again does what is left. Some tasks alone need to
# know how many shards the whole has:  SHARDS=16 sbatch --array=3,5 studies/slurm.sh studies/hip.toml
#SBATCH --job-name=gracilis-study
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --mem=1500M
#SBATCH --time=04:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=study-%A-%a.log
# SIGTERM 60 s before the end to this shell (B:), which is gracilis by then: the frame under way is dropped, and the run goes on
# from there next time.
#SBATCH --signal=B:TERM@60
whole=$((SLURM_ARRAY_TASK_MAX - SLURM_ARRAY_TASK_MIN + 1))
shards=${SHARDS:-$whole}
if [[ -z ${SHARDS:-} && $SLURM_ARRAY_TASK_COUNT -ne $whole ]]; then
  echo "tasks $SLURM_ARRAY_TASK_MIN to $SLURM_ARRAY_TASK_MAX are not all there: SHARDS=N says how many shards the study has" >&2
  exit 2
fi
# Arrays may begin at 0: every task has one shard, the same one whenever it comes again.
shard=$(((SLURM_ARRAY_TASK_ID + shards - 1) % shards + 1))
exec "${GRACILIS:-gracilis}" study run "$@" --shard "$shard/$shards"
