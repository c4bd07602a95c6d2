#!/usr/bin/env bash
# Runs a sharded sweep as an array job on a single-node Slurm made from Debian's packages, and
# compares the collected table with that of the unsharded run.
#
#   tests/slurm.sh [frictionsim]        (default target/release/frictionsim)
#
# Needs root on Debian or a relative. Installs slurm-wlm and munge if they are missing, and runs
# their daemons with a configuration, keys and state of its own in a temporary folder; all of it is
# stopped and removed at the end.
set -euo pipefail

repository=$(cd "$(dirname "$0")/.." && pwd)
program=$(realpath "${1:-$repository/target/release/frictionsim}")
[ "$(id -u)" = 0 ] || { echo "slurm.sh: needs root, to install and start Slurm" >&2; exit 2; }
[ -x "$program" ] || { echo "slurm.sh: no $program: cargo build --release" >&2; exit 2; }

if ! command -v slurmctld slurmd munged sbatch > /dev/null; then
    apt-get update -qq
    DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends slurm-wlm munge
fi

work=$(mktemp -d /tmp/frictionsim-slurm.XXXXXX)
daemons=()
stop() {
    for daemon in "${daemons[@]}"; do kill "$daemon" 2> /dev/null || true; done
    wait 2> /dev/null || true
    rm -rf "$work"
}
trap stop EXIT

node=$(hostname -s)
cores=$(nproc)
install -d -m 0755 "$work/state" "$work/spool" "$work/munge"
chmod 0755 "$work"
head -c 1024 /dev/urandom > "$work/munge/munge.key"
chmod 0400 "$work/munge/munge.key"

cat > "$work/slurm.conf" <<CONF
ClusterName=single
SlurmctldHost=$node(127.0.0.1)
SlurmUser=root
SlurmctldPort=16817
SlurmdPort=16818
AuthType=auth/munge
AuthInfo=socket=$work/munge/munge.socket
CryptoType=crypto/munge
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
NodeName=$node NodeAddr=127.0.0.1 CPUs=$cores State=UNKNOWN
PartitionName=all Nodes=$node Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$work/slurm.conf

munged --foreground --force --num-threads=2 --key-file="$work/munge/munge.key" \
    --socket="$work/munge/munge.socket" --pid-file="$work/munge/munged.pid" \
    --log-file="$work/munge/munged.log" --seed-file="$work/munge/munged.seed" &
daemons+=($!)
for _ in $(seq 50); do [ -S "$work/munge/munge.socket" ] && break; sleep 0.1; done
slurmctld -D > /dev/null 2>&1 &
daemons+=($!)
slurmd -D -N "$node" > /dev/null 2>&1 &
daemons+=($!)
for _ in $(seq 120); do
    sinfo --noheader --format=%T 2> /dev/null | grep -qE 'idle|mixed' && break
    sleep 0.5
done
sinfo --version
sinfo

# A coarse disc: twelve points of a moment each.
cat > "$work/study.toml" <<CASE
title = "Coarse disc on a cluster"
[geometry]
inner_radius = 0.0205
outer_radius = 0.0905
thickness = 0.009
[mesh]
circumferential_elements = 60
radial_elements = 12
[material]
young_modulus = 2.5e9
poisson_ratio = 0.3805
density = 1228.0
[damping]
mass_coefficient = 40.0
stiffness_coefficient = 4.5e-7
[contact]
friction_coefficient = 0.3
interference = 25e-6
rotation_speed_rpm = 610.0
[transient]
duration = 0.02
[transient.perturbation]
harmonics = [1, 2]
velocity = 1e-3
[sweep]
"contact.friction_coefficient" = [0.2, 0.3, 0.4]
"contact.rotation_speed_rpm" = [10, 100, 1000, 6000]
CASE

# The job script of the README.
cat > "$work/study.sbatch" <<'JOB'
#!/bin/bash
#SBATCH --array=1-4
#SBATCH --cpus-per-task=1
#SBATCH --requeue
"$FRICTIONSIM" sweep study.toml --out study --resume --quiet --threads "$SLURM_CPUS_PER_TASK" \
    --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT"
JOB

cd "$work"
export FRICTIONSIM=$program
sbatch --wait --chdir="$work" --output="$work/task-%a.log" study.sbatch
for log in "$work"/task-*.log; do
    echo "--- $(basename "$log")"
    cat "$log"
done
echo "--- collect"
"$program" collect study
echo "--- unsharded"
"$program" sweep study.toml --out whole --quiet
cmp study/points.csv whole/points.csv
echo "the array's points.csv is byte for byte that of the unsharded sweep"
