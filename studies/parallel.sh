#!/bin/sh
# A study by GNU parallel, a shard per processor:  studies/parallel.sh studies/hip.toml
# On other machines that see the same disk:  studies/parallel.sh studies/hip.toml --sshlogin node1,node2 --workdir .
study=$1
shift
shards=${SHARDS:-$(nproc)}
# --quote: paths may have spaces.
seq "$shards" | parallel --will-cite --halt never --line-buffer --quote --tagstring 'shard {}' "$@" \
  "${GRACILIS:-gracilis}" study run "$study" --shard "{}/$shards"
