#!/bin/bash
# A study as a Slurm array, a shard per task:  sbatch --array=1-16 studies/slurm.sh studies/hip.toml
# Tasks may be requeued, repeated or cancelled at any time: the same line again does what is left.
#SBATCH --job-name=gracilis-study
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --mem=1500M
#SBATCH --time=04:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=study-%A-%a.log
# SIGTERM 60 s before the end: the frame under way is dropped, and the run goes on from there next time.
#SBATCH --signal=TERM@60
exec gracilis study run "$1" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT"
