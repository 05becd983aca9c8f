#!/usr/bin/env bash
# A small experiment in 64 parts by Slurm on two nodes of this machine, and once more in one piece: the tables must be equal.
#
#   cargo build --release --no-default-features
#   sudo tests/by_hand/slurm.sh target/release/touchline
#
# Needs root on a machine that is not for anything else: it installs slurm-wlm and munge. Written for Debian 12 (Slurm 22.05.8, munge
# 0.5.15). What it makes is in a new folder, which it names; the services that it starts end with it.
set -euo pipefail
touchline=$(realpath "$1")
cd "$(dirname "$0")/../.."
here=$PWD
folder=$(mktemp -d /tmp/touchline-slurm.XXXX)
echo "== in $folder"

if ! command -v slurmctld > /dev/null; then
    apt-get update --quiet && DEBIAN_FRONTEND=noninteractive apt-get install --yes --quiet slurm-wlm munge
fi
slurmctld -V

mkdir "$folder/state" "$folder/bin"
ln -s "$touchline" "$folder/bin/touchline"
export PATH="$folder/bin:$PATH" SLURM_CONF="$folder/slurm.conf"
cat > "$SLURM_CONF" <<END
ClusterName=touchline
SlurmctldHost=$(hostname -s)
SlurmUser=root
AuthType=auth/munge
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/linear
ReturnToService=2
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool.%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.%n.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.%n.log
SlurmctldPort=16817
NodeName=one NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=16818 CPUs=1 RealMemory=2000 State=UNKNOWN
NodeName=two NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=16819 CPUs=1 RealMemory=2000 State=UNKNOWN
PartitionName=all Nodes=one,two Default=YES MaxTime=INFINITE State=UP
END

end_services() {
    for service in "$folder"/*.pid; do kill "$(cat "$service")" 2> /dev/null || true; done
}
trap end_services EXIT
if ! munge -n > /dev/null 2>&1; then
    install -d -o munge -g munge /run/munge
    runuser -u munge -- munged
fi
slurmctld
slurmd -N one
slurmd -N two
until [ "$(sinfo --noheader --states=idle --Format=nodes | tr -d ' ')" = 2 ]; do sleep 1; done
sinfo

cat > "$folder/design.ron" <<END
(
    name: "Does loss matter?",
    common: [HalfMinutes(0.1), Home("hammerheads_2001")],
    factors: [(name: "loss", levels: Values(file: "radios/good.ron", path: "loss.Independent[0]", values: [0, 0.5]))],
    blocks: (first: 1, number: 64),
    metrics: [PacketsLost],
)
END
export DESIGN="$folder/design.ron" RESULTS="$folder/results"
mkdir "$RESULTS"
echo "== 64 parts"
# The script finds the shipped assets from where it is submitted.
cd "$here"
job=$(sbatch --parsable --output="$folder/part-%a.log" --array=1-64 assets/cluster/experiment.slurm)
sbatch --wait --output="$folder/merge.log" --dependency="afterok:$job" \
    --wrap "touchline merge $DESIGN --out $RESULTS/all $RESULTS/part-*"
cat "$folder/merge.log"
echo "== in one piece"
touchline experiment "$DESIGN" --out "$folder/whole"
cmp "$folder/whole/rows.csv" "$RESULTS/all/rows.csv"
cmp "$folder/whole/rows.parquet" "$RESULTS/all/rows.parquet"
echo "the merged tables of 64 parts are those of one piece, byte for byte: $(($(wc -l < "$folder/whole/rows.csv") - 1)) rows"
