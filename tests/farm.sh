#!/usr/bin/env bash
# `aleph farm slurm` on a real cluster: Slurm with two nodes on this host, for as long as the script runs. One task is told
# to stop, as at the end of its time, and one node is killed in the middle of a frame. In the end all frames are there, with
# the bytes of a render by one process.
#   tests/farm.sh [ALEPH]
# Needs root and Slurm (`bash scenes/setup.sh slurm`); without them it is skipped with exit code 77. Touches no
# configuration of the system; uses the ports 16817, 16821 and 16822.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/.." && pwd)
aleph=${1:-$root/build/aleph}

for tool in slurmctld slurmd munged sbatch scontrol; do
  command -v "$tool" >/dev/null 2>&1 || { echo "skipped: $tool is not installed (bash scenes/setup.sh slurm)"; exit 77; }
done
[ "$(id -u)" = 0 ] || { echo "skipped: starting Slurm's daemons needs root"; exit 77; }

work=$(mktemp -d)
chmod 755 "$work"
daemons=()
cleanup() {
  for pid in "${daemons[@]}"; do kill "$pid" 2>/dev/null || true; done
  wait 2>/dev/null || true
  rm -rf "$work"
}
trap cleanup EXIT

# until_true SECONDS WHAT COMMAND...
until_true() {
  local limit=$1 what=$2 start=$SECONDS
  shift 2
  until "$@" >/dev/null 2>&1; do
    if [ $((SECONDS - start)) -gt "$limit" ]; then
      echo "FAILED: waited $limit s for $what"
      squeue -a 2>/dev/null || true
      tail -n 5 "$work"/out/farm/*.log 2>/dev/null || true
      exit 1
    fi
    sleep .2
  done
}

host=$(hostname -s)
mkdir -p "$work"/{state,spool/n1,spool/n2,log,munge}
head -c 1024 /dev/urandom >"$work/munge/key"
chmod 600 "$work/munge/key"
chmod 755 "$work/munge"
chown -R munge:munge "$work/munge"
cat >"$work/slurm.conf" <<CONF
ClusterName=aleph
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=16817
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool/%n
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.%n.pid
SlurmctldLogFile=$work/log/slurmctld.log
SlurmdLogFile=$work/log/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
ReturnToService=2
RequeueExit=75
SlurmdTimeout=5
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=16821 CPUs=1 RealMemory=2000 State=UNKNOWN
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=16822 CPUs=1 RealMemory=2000 State=UNKNOWN
PartitionName=render Nodes=n[1-2] Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$work/slurm.conf
setpriv --reuid=munge --regid=munge --clear-groups munged --foreground --key-file="$work/munge/key" \
  --socket="$work/munge/socket" --pid-file="$work/munge/pid" --log-file="$work/munge/log" \
  --seed-file="$work/munge/seed" >/dev/null 2>&1 &
daemons+=($!)
until_true 20 "munge" test -S "$work/munge/socket"
slurmctld -D >/dev/null 2>&1 &
daemons+=($!)
slurmd -D -N n1 >/dev/null 2>&1 &
daemons+=($!)
slurmd -D -N n2 >/dev/null 2>&1 &
second_node=$!
daemons+=($second_node)
both_idle() { [ "$(sinfo -h -N -t idle | wc -l)" = 2 ]; }
until_true 30 "two nodes" both_idle

words=("$root/scenes/cornell/scene.json" --frames 1-12 --size 96x72 --sampling uniform --spp 32 --guide none --accuracy 0)
"$aleph" render "${words[@]}" -o "$work/whole/" -q
mkdir "$work/out"
"$aleph" farm slurm "${words[@]}" -o "$work/out/" --stats "$work/stats.json" --tasks 4 --time 10:00 --memory 500M \
  --cpus 1 --submit | tee "$work/submitted"
job=$(sed -n 's/.*as job \([0-9]*\),.*/\1/p' "$work/submitted")

# frames N: at least N frames are there.
frames() { [ "$(find "$work/out" -maxdepth 1 -name 'cornell.*.exr' | wc -l)" -ge "$1" ]; }
# render_on NODE: the process that renders there.
render_on() {
  local pid
  for pid in $(pgrep -x aleph); do
    if tr '\0' '\n' <"/proc/$pid/environ" 2>/dev/null | grep -qx "SLURMD_NODENAME=$1"; then echo "$pid" && return; fi
  done
  return 1
}
task_on() { squeue -h -j "$job" -t R -w "$1" -o %i | head -n 1; }

until_true 30 "the first frame" frames 1
stopped=$(task_on n1)
kill -TERM "$(render_on n1)"  # as Slurm does before a task's time is up
echo "stopped task $stopped"

until_true 30 "a task on the second node" render_on n2
lost=$(task_on n2)
render=$(render_on n2)
step=$(ps -o ppid= -p "$render" | tr -d ' ')
disown "$second_node"
kill -9 "$second_node" "$step" "$render"
scontrol update nodename=n2 state=down reason=killed  # Slurm finds that out by itself, after half a minute
echo "killed node n2 with task $lost"

# Requeued tasks wait two minutes by default.
all_done() {
  squeue -h -j "$job" -t PD -o '%i %r' | awk '$2 == "BeginTime" { print $1 }' |
    while read -r waiting; do scontrol update jobid="$waiting" starttime=now; done
  [ -z "$(squeue -h)" ]
}
until_true 90 "all tasks" all_done

cat "$work/out/farm/collate.1.log"
grep -q "frames: 12 of 12 finished" "$work/out/farm/collate.1.log"
for file in "$work"/whole/*; do cmp "$file" "$work/out/$(basename "$file")"; done
leftovers=$(find "$work/out" -maxdepth 1 -name '.*.part' -o -maxdepth 1 -name '.*.lock')
[ -z "$leftovers" ] || { echo "FAILED: left $leftovers"; exit 1; }
grep -q "stopped by SIGTERM" "$work"/out/farm/task.1-*.log
[ "$(grep -c '"frame":' "$work/stats.json")" -ge 12 ]
echo "12 frames by 4 tasks, one stopped and one killed with its node: the bytes of one process"
