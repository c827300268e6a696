#!/usr/bin/env bash
# `rocking sweep` under SLURM's own daemons: a controller and two nodes on this
# machine, with a key, ports and folders of their own. An array of six tasks of
# which one is killed and requeued, then srun with two ranks; both must give
# the bytes of a run without SLURM. Needs root and Debian's packages
# slurmctld, slurmd, slurm-client and munge. `tests/slurm.sh ROCKING`
set -euo pipefail
rocking=$(realpath "$1")
page=$(realpath "$(dirname "$0")/../docs/cluster.md")
for tool in munged slurmctld slurmd sbatch srun scontrol; do
    command -v "$tool" >/dev/null || {
        echo "$tool not found: apt-get install slurmctld slurmd slurm-client" \
            "munge" >&2
        exit 2
    }
done
[[ $(id -u) -eq 0 ]] || { echo "expected root" >&2; exit 2; }
place=$(mktemp -d)
daemons=()
stop() {
    local status=$?
    if [[ $status -ne 0 ]]; then
        squeue -a >&2 2>/dev/null || true
        tail -n 20 "$place"/*.log "$place"/*.out >&2 2>/dev/null || true
    fi
    for ((k = ${#daemons[@]} - 1; k >= 0; k--)); do
        kill "${daemons[k]}" 2>/dev/null || true
        wait "${daemons[k]}" 2>/dev/null || true
    done
    rm -rf "$place"
    exit "$status"
}
trap stop EXIT

fail() {
    echo "slurm: $*" >&2
    exit 1
}

# Waits up to a minute for a command to succeed.
until_true() {
    for ((k = 0; k < 300; k++)); do
        "$@" && return 0
        sleep 0.2
    done
    fail "waited in vain: $*"
}

chmod 755 "$place"
mkdir "$place/munge" "$place/state" "$place/spool"
dd if=/dev/urandom of="$place/munge/key" bs=128 count=1 status=none
chmod 400 "$place/munge/key"
munged --foreground --force --num-threads=2 --key-file="$place/munge/key" \
    --socket="$place/munge/socket" --pid-file="$place/munge/pid" \
    --log-file="$place/munged.log" --seed-file="$place/munge/seed" \
    2>"$place/munged.err.log" &
daemons+=($!)
until_true test -S "$place/munge/socket"
host=$(hostname -s)
export SLURM_CONF=$place/slurm.conf
cat >"$SLURM_CONF" <<END
ClusterName=gate
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=27117
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$place/munge/socket
CredType=cred/munge
StateSaveLocation=$place/state
SlurmdSpoolDir=$place/spool/%n
SlurmctldPidFile=$place/slurmctld.pid
SlurmdPidFile=$place/slurmd-%n.pid
SlurmctldLogFile=$place/slurmctld.log
SlurmdLogFile=$place/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
MpiDefault=none
JobRequeue=1
MinJobAge=3600
ReturnToService=2
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=27118 CPUs=1
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=27119 CPUs=1
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=60 State=UP
END
slurmctld -D -f "$SLURM_CONF" >"$place/controller.log" 2>&1 &
daemons+=($!)
for node in n1 n2; do
    mkdir "$place/spool/$node"
    slurmd -D -N "$node" -f "$SLURM_CONF" >"$place/$node.log" 2>&1 &
    daemons+=($!)
done
idle() { [[ $(sinfo -h -t idle -o %D 2>/dev/null) == 2 ]]; }
until_true idle
echo "two nodes are up after $SECONDS s"

# Twelve blocks in as many tiles of about a second.
blocks=$place/blocks.csv
echo alpha,p >"$blocks"
for ((k = 0; k < 12; k++)); do
    echo "0.$((10 + k)),1.8" >>"$blocks"
done
"$rocking" suite export --out "$place/suites" >/dev/null
plan() {
    "$rocking" sweep plan --blocks "$blocks" --tile-blocks 1 \
        --suite "$place/suites/ordinary.csv" --out "$place/$1" >/dev/null
}
merged() {
    "$rocking" sweep merge "$place/$1" --out "$place/$1.csv"
    sha256sum <"$place/$1.csv"
}
plan direct
"$rocking" sweep run "$place/direct" >/dev/null 2>&1
expected=$(merged direct)
echo "run without SLURM after $SECONDS s"

# The array, by the script of the documentation.
plan array
PATH=$(dirname "$rocking"):$PATH
sed -n '/^#!/,/^```$/{/^```$/!p}' "$page" >"$place/job.sh"
job=$(sbatch --parsable --array=0-5 --output="$place/array-%a.out" \
    "$place/job.sh" "$place/array")
# Process of task 3, by SLURM's own account.
process() {
    pid=
    local found
    for found in /proc/[0-9]*; do
        if [[ $(readlink "$found/exe" 2>/dev/null) == "$rocking" ]] &&
            tr '\0' '\n' <"$found/environ" 2>/dev/null |
            grep -qx SLURM_ARRAY_TASK_ID=3; then
            pid=${found#/proc/}
            return 0
        fi
    done
    return 1
}
until_true process
kill -9 "$pid"
state() { scontrol -o show job "${job}_3" | sed 's/.*JobState=\([A-Z]*\).*/\1/'; }
failed() { [[ $(state) == FAILED ]]; }
until_true failed
scontrol requeue "${job}_3"
# SLURM waits two minutes otherwise.
scontrol update JobId="${job}_3" StartTime=now
left() {
    [[ -z $(squeue -h -j "$job" -t pending,running,completing -o %i \
        2>/dev/null) ]]
}
until_true left
[[ $(state) == COMPLETED ]] || fail "task 3 is $(state)"
[[ $(merged array) == "$expected" ]] || fail "the array gave other bytes"
[[ -z $(find "$place/array/tiles" -name '.*' -type f) ]] ||
    fail "an unfinished file is left"
echo "array of six, one killed and requeued, after $SECONDS s"

# One allocation, two ranks.
plan ranks
srun -N 2 -n 2 --output="$place/ranks-%t.out" \
    "$rocking" sweep run "$place/ranks" --threads 1
for rank in 0 1; do
    grep -q "task $rank of 2: all" "$place/ranks-$rank.out" ||
        fail "rank $rank did not take its part"
done
[[ $(merged ranks) == "$expected" ]] || fail "srun gave other bytes"
echo "srun with two ranks after $SECONDS s; ${expected%% *}"
