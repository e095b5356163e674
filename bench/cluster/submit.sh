#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Submits a hunt, an audit, the mutants or a set of proofs in shards, and a job that merges them when all have ended.
#   bench/cluster/submit.sh SHARDS FOLDER COMMAND [arguments, for example hunt row-stream --cases 1000000 --seed 7]
set -euo pipefail
shards=$1 folder=$2
shift 2
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$folder"
array=$(sbatch --parsable --array="1-$shards" --output="$folder/shard-%a.log" "$here/shard.sbatch" "$folder" "$@")
sbatch --dependency="afterok:$array" --job-name=limitcheck-merge --output="$folder/merge.log" \
  --wrap "limitcheck merge $(printf "'%s' " $(seq -f "$folder/part%.0f.json" "$shards"))-o '$folder/whole.json' || [ \$? = 1 ]"
