#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Tries submit.sh on a cluster of two nodes on this machine, one of which is killed in the middle: the merged report must be
# that of a hunt in one piece. Needs root and the packages munge, slurmctld, slurmd and slurm-client; without them it says so
# and ends with 77, which ctest takes for skipped.
#   bench/cluster/try.sh PROGRAM (limitcheck)
set -euo pipefail
program=$(realpath "${1:?usage: bench/cluster/try.sh PROGRAM}")
here=$(cd "$(dirname "$0")" && pwd)
for tool in munged slurmctld slurmd sbatch; do
  command -v "$tool" >/dev/null || { echo "skipped: $tool is not installed"; exit 77; }
done
[[ $EUID == 0 ]] || { echo "skipped: slurmd needs root"; exit 77; }

d=$(mktemp -d -t limitcheck-slurm.XXXXXX)
export SLURM_CONF=$d/slurm.conf PATH=$(dirname "$program"):$PATH
declare -A daemons
stop() {
  scancel --full --user=root >"$d/scancel.log" 2>&1 || true
  kill -KILL "${daemons[@]}" 2>/dev/null || true
  pkill -KILL -f "slurmstepd.*$d|limitcheck hunt .*$d" || true
  kill "$(cat "$d/munge.pid")" 2>/dev/null || true
  # What was killed may still be writing its last file.
  for _ in {1..100}; do rm -rf "$d" 2>/dev/null && return; sleep 0.1; done
  echo "left behind: $d" >&2
}
trap stop EXIT
# A port that nobody listens to, and the two after it.
port=17000
while (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null; do port=$((port + 3)); done

chmod 755 "$d"
dd if=/dev/urandom of="$d/key" bs=1024 count=1 status=none
chmod 400 "$d/key"
munged --force --key-file="$d/key" --socket="$d/munge.socket" --pid-file="$d/munge.pid" --log-file="$d/munge.log" \
  --seed-file="$d/munge.seed"
host=$(hostname)
cat >"$SLURM_CONF" <<CONF
ClusterName=limitcheck
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
AuthType=auth/munge
AuthInfo=socket=$d/munge.socket
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SlurmdTimeout=10
KillWait=2
SlurmctldPidFile=$d/ctl.pid
SlurmdPidFile=$d/slurmd-%n.pid
SlurmctldLogFile=$d/ctl.log
SlurmdLogFile=$d/slurmd-%n.log
StateSaveLocation=$d/state
SlurmdSpoolDir=$d/spool-%n
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1
PartitionName=all Nodes=n1,n2 Default=YES State=UP MaxTime=INFINITE
CONF
mkdir -p "$d/state" "$d/spool-n1" "$d/spool-n2"
slurmctld -D >"$d/ctl.out" 2>&1 &
daemons[ctl]=$!
disown
for node in n1 n2; do
  slurmd -D -N "$node" >"$d/$node.out" 2>&1 &
  daemons[$node]=$!
  disown
done
for _ in {1..100}; do [[ $(sinfo -h -t idle -o %D 2>/dev/null) == 2 ]] && break; sleep 0.2; done
[[ $(sinfo -h -t idle -o %D) == 2 ]] || { echo "the cluster does not come up"; tail -n 5 "$d"/*.log >&2; exit 1; }

hunt=(hunt faulty --option fault=adjacent_extraordinary,of=sliding-window --scheme loop --cases 960 --attempts 3 --in-process)
bash "$here/submit.sh" 6 "$d/hunt" "${hunt[@]}"
for _ in {1..600}; do compgen -G "$d/hunt/part*" >/dev/null && break; sleep 0.1; done
victim=$(squeue -h -t R -o %N | head -n 1)
echo "killing node ${victim:=n2} amid $(squeue -h -t R | wc -l) shards"
kill -KILL "${daemons[$victim]}"
pkill -KILL -f "slurmstepd.*" -P "${daemons[$victim]}" || true
unset "daemons[$victim]"
for _ in {1..1800}; do [[ -e $d/hunt/whole.json ]] && break; sleep 0.2; done
[[ -e $d/hunt/whole.json ]] || { echo "no merged report"; squeue; tail -n 20 "$d"/hunt/*.log >&2; exit 1; }

limitcheck "${hunt[@]}" --jobs 1 --json "$d/one.json" --witnesses "$d/one" >"$d/one.txt" || [[ $? == 1 ]]
strip() { sed -E 's/"seconds": .*//; s#"(witness|command)": .*##' "$1"; } # times, and the folder of the witnesses
diff <(strip "$d/one.json") <(strip "$d/hunt/whole.json")
echo "held: six shards, one node lost, and the report of a hunt in one piece"
