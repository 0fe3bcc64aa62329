#!/bin/bash
# A Slurm cluster on this one machine: munged, slurmctld and two slurmd (n1, n2), without systemd, for the slow tests.
# All of it lies in DIR, which must be on a file system with Unix sockets and be named by a short absolute path.
#
#   cluster.sh check                 says in one line what is missing and ends with 77; 0 when all is there
#   cluster.sh start DIR [PID]       ends when both nodes are idle; SLURM_CONF=DIR/slurm.conf then leads to it. The
#                                    cluster stops by itself once process PID is gone, however that ends
#   cluster.sh kill-node DIR NODE    a node that dies: slurmd, its slurmstepds and every process of its jobs, kill -9
#   cluster.sh kill-daemon DIR NODE  slurmd alone, kill -9: the node looks dead, its jobs live on
#   cluster.sh start-node DIR NODE   the node comes back
#   cluster.sh hurry DIR             tasks that Slurm requeued start now, not after the two minutes that it makes them wait
#   cluster.sh kill-controller DIR / start-controller DIR
#   cluster.sh stop DIR              ends everything and deletes DIR
set -euo pipefail

readonly verb=${1:?a verb: check, start, stop, …}
readonly dir=${2:-}
readonly conf=$dir/slurm.conf
readonly cpus_per_node=2
export LC_ALL=C PATH=/usr/sbin:/usr/bin:/sbin:/bin

die() { echo "cluster.sh: $*" >&2; exit 1; }

check() {
  [[ $(id -u) == 0 ]] || { echo "not root, and slurmd needs it"; exit 77; }
  local program
  for program in munged slurmctld slurmd sbatch squeue scancel scontrol; do
    command -v "$program" >/dev/null || { echo "no $program: apt-get install -y --no-install-recommends slurm-wlm"; exit 77; }
  done
}

# A port that nobody listens on now: bash's /dev/tcp refuses to connect.
free_port() {
  local port
  for _ in $(seq 100); do
    port=$((20000 + RANDOM % 12000))  # below the ephemeral ports of Linux (32768 and up)
    (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null || { echo "$port"; return; }
  done
  die "no free port"
}

write_configuration() {
  local host; host=$(hostname)
  cat >"$conf" <<END
ClusterName=alula_test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$dir/munge/socket
CryptoType=crypto/munge
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool/%n
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd.%n.pid
SlurmctldLogFile=$dir/slurmctld.log
SlurmdLogFile=$dir/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
SwitchType=switch/none
ReturnToService=2
# A node that is silent for six seconds is down; a queue is looked at every second.
SlurmdTimeout=6
SlurmctldTimeout=10
MessageTimeout=10
KillWait=5
InactiveLimit=0
MinJobAge=300
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=1
SlurmdParameters=config_overrides
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$(free_port) CPUs=$cpus_per_node RealMemory=2000 State=UNKNOWN
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$(free_port) CPUs=$cpus_per_node RealMemory=2000 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
}

# Waits until a command succeeds: $1 seconds at most, the rest is the command.
wait_for() {
  local limit=$1 end; shift
  end=$((SECONDS + limit))
  until "$@" >/dev/null 2>&1; do
    ((SECONDS < end)) || return 1
    sleep 0.2
  done
}

node_is_up() { [[ $(sinfo -h -N -n "$1" -o %T) =~ ^(idle|mixed|allocated)$ ]]; }

# Every daemon carries this mark in its environment and hands it to what it starts (slurmstepd has its node's).
mark() { echo "ALULA_TEST_SLURM=$dir/$1"; }

start_munge() {
  mkdir -p "$dir/munge"
  chmod 0711 "$dir/munge"
  dd if=/dev/urandom of="$dir/munge/key" bs=128 count=1 status=none
  chmod 0400 "$dir/munge/key"
  # --force: the folders above DIR (/tmp) may be written by others.
  env "$(mark munged)" munged --force --key-file="$dir/munge/key" --socket="$dir/munge/socket" \
    --pid-file="$dir/munge/pid" --log-file="$dir/munge/log" --seed-file="$dir/munge/seed" >>"$dir/munge.err" 2>&1 ||
    die "munged: $(tail -1 "$dir/munge.err")"
}

start_controller() {
  env SLURM_CONF="$conf" "$(mark controller)" slurmctld -f "$conf" >/dev/null 2>&1 ||
     die "slurmctld: $(tail -1 "$dir/slurmctld.log")"
  wait_for 30 scontrol ping || die "slurmctld does not answer: see $dir/slurmctld.log"
}

start_node() {
  mkdir -p "$dir/spool/$1"
  env SLURM_CONF="$conf" "$(mark "$1")" slurmd -f "$conf" -N "$1" >/dev/null 2>&1 ||
     die "slurmd $1: $(tail -1 "$dir/slurmd.$1.log")"
  wait_for 30 node_is_up "$1" || die "node $1 does not come up: see $dir/slurmd.$1.log"
}

start() {
  check
  ((${#dir} < 80)) || die "$dir: too long a path for a Unix socket"
  mkdir -p "$dir/state"
  write_configuration
  start_munge
  start_controller
  start_node n1
  start_node n2
  if [[ -n $1 ]]; then stop_after "$1" </dev/null >/dev/null 2>&1 & fi
}

# Stops the cluster when process $1 is gone; ends by itself when somebody else stopped it.
stop_after() {
  while [[ -d $dir && -d /proc/$1 ]]; do sleep 1; done
  stop
}

# Process ids under a mark (slurmd, slurmstepd); zombies have no environment and do not count.
marked() { { grep -lzxF -- "$(mark "$1")" /proc/[0-9]*/environ 2>/dev/null || true; } | cut -d/ -f3; }

# Process ids of the jobs on a node, by what Slurm itself writes into their environment.
jobs_on() {
  local of_cluster
  of_cluster=$(grep -lzxF -- "SLURM_CONF=$conf" /proc/[0-9]*/environ 2>/dev/null || true)
  # shellcheck disable=SC2086  # file names without spaces, one a word
  [[ -z $of_cluster ]] || { grep -lzxF -- "SLURMD_NODENAME=$1" $of_cluster 2>/dev/null || true; } | cut -d/ -f3
}

# Kills until none is left: a process may start another between the look and the blow.
kill_all() {
  local pids
  while pids=$("$@") && [[ -n $pids ]]; do
    # shellcheck disable=SC2086  # numbers, one a word
    kill -9 $pids 2>/dev/null || true
    sleep 0.05
  done
}

kill_node() {
  kill_all marked "$1"
  kill_all jobs_on "$1"
}

kill_daemon() { kill -9 "$(cat "$dir/slurmd.$1.pid")"; }

hurry() {
  local task reason
  squeue -h -r -t PENDING -o '%F_%K %r' | while read -r task reason; do
    [[ $reason != BeginTime ]] || scontrol update "JobId=$task" StartTime=now
  done
}

stop() {
  local node
  for node in n1 n2; do kill_node "$node"; done
  kill_all marked controller
  kill_all marked munged
  rm -rf -- "$dir"
}

[[ $verb == check || $dir == /* ]] || die "$verb: needs the absolute path of the cluster's folder"
export SLURM_CONF=$conf
case $verb in
  check) check ;;
  start) start "${3:-}" ;;
  stop) stop ;;
  kill-node) kill_node "$3" ;;
  kill-daemon) kill_daemon "$3" ;;
  start-node) start_node "$3" ;;
  hurry) hurry ;;
  kill-controller) kill_all marked controller ;;
  start-controller) start_controller ;;
  *) die "no verb $verb" ;;
esac
