#!/usr/bin/env bash
# The job array of a sweep on a Slurm of one node, set up for the occasion: nineteen cases end, one is stopped by the signal before its
# time limit, queued again and resumed until it is done, and an array that is cancelled stays so.
# Called as slurm.sh PROGRAM SCENE. It takes minutes and the Debian packages slurmctld, slurmd, slurm-client and munge, so it is
# switched on by GEODROP_TEST_SLURM=1.
set -euo pipefail

skip() {
  echo "skipped: $*"
  exit 77
}

[[ ${GEODROP_TEST_SLURM-} == 1 ]] || skip "GEODROP_TEST_SLURM=1 switches this test on"
PATH=$PATH:/usr/sbin
for command in munged slurmctld slurmd sbatch; do
  command -v "$command" >/dev/null || skip "no $command; the packages are slurmctld, slurmd, slurm-client and munge"
done

program=$(readlink -f -- "$1")
scene=$(readlink -f -- "$2")
here=$(mktemp -d)
export SLURM_CONF=$here/slurm.conf # no command below reaches another Slurm
daemons=()
trap stop_all EXIT

main() {
  start_slurm
  mkdir "$here/my work, 50%" && cd "$here/my work, 50%"
  cases_end
  cancelled_cases_stay_cancelled
  echo "job arrays on $(sinfo --version): all cases done, one of them queued again $restarts times; cancelled cases stay cancelled"
}

# One node, with a key, a socket and ports of its own, all as the user who calls: nothing of the system is touched.
start_slurm() {
  local name user
  name=$(hostname -s)
  user=$(id -un)
  mkdir "$here"/{munge,state,spool}
  chmod 755 "$here" "$here/munge"
  (umask 077 && head -c 128 /dev/urandom >"$here/munge/key")
  # cred_expire is also how long a job that is queued again has to wait [s].
  cat >"$SLURM_CONF" <<CONF
ClusterName=geodrop
SlurmctldHost=$name(127.0.0.1)
SlurmUser=$user
SlurmdUser=$user
SlurmctldPort=$(free_port 16817)
SlurmdPort=$(free_port 26818)
AuthType=auth/munge
AuthInfo=socket=$here/munge/socket,cred_expire=5
StateSaveLocation=$here/state
SlurmdSpoolDir=$here/spool
SlurmctldPidFile=$here/slurmctld.pid
SlurmdPidFile=$here/slurmd.pid
SlurmctldLogFile=$here/slurmctld.log
SlurmdLogFile=$here/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=2
MpiDefault=none
NodeName=$name NodeAddr=127.0.0.1 CPUs=2
PartitionName=all Nodes=$name Default=YES MaxTime=INFINITE
CONF
  start munged --foreground --force --key-file="$here/munge/key" --socket="$here/munge/socket" --pid-file="$here/munge/pid" \
    --seed-file="$here/munge/seed" --log-file="$here/munged.log"
  wait_for 20 test -S "$here/munge/socket"
  start slurmctld -D -c
  wait_for 60 scontrol ping
  start slurmd -D -c
  wait_for 60 node_is_idle
}

start() {
  "$@" >"$here/$1.out" 2>&1 &
  daemons+=($!)
}

# Jobs first, for whoever watches over one outlives the daemons; each daemon by its number, the last one first.
stop_all() {
  if ((${#daemons[@]} == 3)); then
    scancel --user="$(id -un)" --signal=KILL --full || true # so that no script queues itself again
    scancel --user="$(id -un)" || true
    for ((i = 0; i < 60; ++i)); do
      queue_is_empty && break
      sleep 1
    done
  fi
  for ((i = ${#daemons[@]} - 1; i >= 0; --i)); do
    kill "${daemons[i]}" 2>/dev/null || true
    wait "${daemons[i]}" 2>/dev/null || true
  done
  rm -rf "$here"
}

# The first port from this one on that nobody listens on.
free_port() {
  local port=$1
  while (: <"/dev/tcp/127.0.0.1/$port") 2>/dev/null; do ((++port)); done
  echo "$port"
}

# --- What is asked --------------------------------------------------------------------------------------------------

# sweep DIRECTORY ENDS MORE...: cases that end at these times.
sweep() {
  "$program" sweep "$scene" --set output.history_interval=0.05 --set output.frame_interval=5.0 --vary "time.end=$2" --output "$1" \
    "${@:3}" >"$here/sweep.out" 2>&1 || fail "geodrop sweep: $(cat "$here/sweep.out")"
}

# A limit of one minute and a signal 25 s before, which Slurm looks at each 30 s: it comes 5 to 35 s after the start.
cases_end() {
  local ends job wall
  "$program" run "$scene" --set time.end=4.0 --threads 1 --output probe >/dev/null
  wall=$(sed -nE 's/.*"wall_s": ([0-9.]+).*/\1/p' probe/summary.json)
  # The last one takes 45 s, longer where the machine was busier a moment ago than it is then.
  ends=$(seq -s, 0.6 0.1 2.4),$(awk "BEGIN { t = 45 / $wall * 4; printf \"%.1f\", t < 80 ? 80 : t }")

  sweep many "$ends" --no-run
  job=$(cd many && sbatch --parsable --time=1 --signal=B:USR1@25 array.sbatch)
  wait_for 900 queue_is_empty
  restarts=$(restarts_of "$job" 20)
  sweep many "$ends" --no-run
  [[ $(grep -c ',done,0,' many/manifest.csv) == 20 ]] || fail "not all cases are done: $(cat many/manifest.csv)"
  ((restarts > 0)) || fail "the signal before the time limit queued nothing again"
  [[ $(restarts_of "$job" 1) == 0 ]] || fail "a case that was done was queued again"
  grep -q "resumed at t = " many/case_020/run.log || fail "the case that was queued again began anew"

  sweep whole "$ends" --jobs 2
  diff many/manifest.csv whole/manifest.csv || fail "other results than without a queue"
}

cancelled_cases_stay_cancelled() {
  local job
  sweep cancelled 500.0,501.0 --no-run
  job=$(sbatch --parsable cancelled/array.sbatch)
  wait_for 120 test -e cancelled/case_001/particles_000001.vtu
  scancel "$job"
  wait_for 60 queue_is_empty
  grep -q '"status": "stopped"' cancelled/case_001/summary.json || fail "a case that was cancelled has no checkpoint"
  [[ $(restarts_of "$job" 1) == 0 ]] || fail "a case that was cancelled was queued again"
}

node_is_idle() { sinfo --noheader --format=%t | grep -qx idle; }

queue_is_empty() {
  local jobs
  jobs=$(squeue --noheader) && [[ -z $jobs ]]
}

restarts_of() { scontrol show job "$1_$2" --oneliner | sed -nE 's/.* Restarts=([0-9]+).*/\1/p'; }

# --- Helpers --------------------------------------------------------------------------------------------------------

fail() {
  tail -n 20 "$here"/*.log "$here"/*/*/slurm_*.log >&2 || true
  echo "FAILED: $*" >&2
  exit 1
}

# wait_for SECONDS COMMAND...: until it succeeds.
wait_for() {
  local left=$1
  while ! "${@:2}" >/dev/null 2>&1; do
    ((left-- > 0)) || fail "waited $1 s in vain for: ${*:2}"
    sleep 1
  done
}

main
