"""A Slurm of one's own: munged, slurmctld and slurmd with their own configuration and spool folders, on loopback.

They live in namespaces of their own (processes, mounts, network), which the kernel empties when the process that made
them ends, however it ends: no daemon, job or file of theirs outlives a test that is killed, and no Slurm of the machine
is seen or touched.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import time

ALONE = "BILLOW_TEST_ALONE"  # in the environment of the process in its namespaces
NEEDED = ("munged", "slurmctld", "slurmd", "sbatch", "unshare", "ip")
PROGRAMS = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"

CONFIGURATION = """ClusterName=test
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=5
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=100000
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=2
NodeName=localhost NodeAddr=127.0.0.1 NodeHostname={host} CPUs={cpus} State=UNKNOWN
PartitionName=test Nodes=localhost Default=YES MaxTime=60 State=UP
"""


def is_alone():
    """Whether this process is in its namespaces."""
    return ALONE in os.environ


def alone():
    """Goes on in a process in namespaces of its own; the one that called ends as that one ends."""
    if not is_alone():
        command = command_alone(sys.argv)
        os.execvpe(command[0], command, environment_alone("yes"))
    if os.getpid() == 1:
        wait_for_all(os.fork())


def command_alone(arguments):
    """The command that runs a program of ours in namespaces. Ends this one where that cannot be done."""
    missing = [name for name in NEEDED if not shutil.which(name, path=PROGRAMS)]
    if missing:
        sys.exit(f"not found: {', '.join(missing)}; install slurm-wlm, munge, util-linux and iproute2")
    namespaces = ["unshare", "--pid", "--fork", "--kill-child", "--mount", "--mount-proc", "--net"]
    if subprocess.run([*namespaces, "true"], stderr=subprocess.DEVNULL, check=False).returncode != 0:
        print("skipped: here no process may have namespaces of its own", file=sys.stderr)
        sys.exit(77)
    return [*namespaces, sys.executable, *arguments]


def environment_alone(mark):
    return {**os.environ, ALONE: mark, "PATH": PROGRAMS}


def processes_marked(mark):
    """Those on the machine that live in namespaces with this mark."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        try:
            if entry.name.isdigit() and f"{ALONE}={mark}".encode() in (entry / "environ").read_bytes().split(b"\0"):
                found.append(int(entry.name))
        except OSError:
            pass
    return found


def wait_for_all(worker):
    """The first process of the namespaces: those whose parents have ended are its to wait for. Ends as `worker` ends,
    and everything else with it."""
    while worker:
        process, status = os.wait()
        if process == worker:
            os._exit(os.waitstatus_to_exitcode(status) & 255)


class Slurm:
    """The daemons, from `with` to its end. Everything of theirs lies in `folder`."""

    def __init__(self, folder, cpus):
        self.folder, self.cpus, self.daemons = pathlib.Path(folder), cpus, []

    def __enter__(self):
        subprocess.run(["ip", "link", "set", "lo", "up"], check=True)
        # Without an address besides 127.0.0.1 Slurm finds no address of any kind (AI_ADDRCONFIG).
        subprocess.run(["ip", "address", "add", "192.0.2.1/32", "dev", "lo"], check=True)
        for name in ("state", "spool"):
            (self.folder / name).mkdir(parents=True)
        (self.folder / "slurm.conf").write_text(
            CONFIGURATION.format(folder=self.folder, host=os.uname().nodename.split(".")[0], cpus=self.cpus))
        (self.folder / "munge.key").write_bytes(os.urandom(128))
        (self.folder / "munge.key").chmod(0o400)
        os.environ["SLURM_CONF"] = str(self.folder / "slurm.conf")
        try:
            self.start("munged", "--foreground", "--force", *(f"--{name}={self.folder}/munge.{ending}" for name, ending in (
                ("key-file", "key"), ("socket", "socket"), ("pid-file", "pid"), ("log-file", "log"), ("seed-file", "seed"))))
            wait_until(lambda: (self.folder / "munge.socket").exists(), "munged does not answer", 20)
            self.start("slurmctld", "-D", "-c")
            self.start("slurmd", "-D", "-c")
            wait_until(lambda: answer("sinfo", "--noheader", "-o", "%T") == "idle", "the node does not come up", 20)
        except BaseException:
            self.__exit__()
            raise
        return self

    def start(self, *words):
        log = open(self.folder / f"{words[0]}.out", "wb")
        self.daemons.append(subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=log, stderr=log))

    def __exit__(self, *_):
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in reversed(self.daemons):
            try:
                daemon.wait(5)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()


def answer(*words):
    """What a command says; nothing when it fails."""
    ended = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    return ended.stdout.strip() if ended.returncode == 0 else ""


def logs(folder):
    """The ends of what the daemons have written."""
    return "\n".join(f"--- {file.name}\n{file.read_text(errors='replace')[-3000:]}"
                     for file in [*sorted(folder.glob("*.log")), *sorted(folder.glob("*.out"))])


def wait_until(is_so, complaint, seconds):
    end = time.monotonic() + seconds
    while not is_so():
        if time.monotonic() > end:
            raise TimeoutError(f"{complaint}: after {seconds} s")
        time.sleep(0.05)
