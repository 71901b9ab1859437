"""The package in its process: wrong input, Ctrl-C, threads, children; and the program."""

import multiprocessing
import os
import signal
import subprocess
import sys
import sysconfig
import threading
from pathlib import Path

import pytest

import hopfscope as hs

PROGRAM = Path(sysconfig.get_path("scripts"), "hopfscope")
OSCILLATOR = hs.Parameters(D=-0.3, D3=0.5, r=0.1)


@pytest.mark.parametrize(
    "wrong, line",
    [
        (lambda: hs.Parameters(r=-1), "r = -1 is outside its range 0 .. 1e150"),
        (lambda: hs.Parameters(D=float("nan")), "D = NaN is outside its range -1e6 .. 1e6"),
        (lambda: hs.trajectory(OSCILLATOR, q0=1e200), "q0 = 1e200 is outside its range"),
        (lambda: hs.trajectory(OSCILLATOR, method="euler"), "euler"),
        (lambda: hs.margin(OSCILLATOR, disturbance=-1), "disturbance = -1 is outside its range"),
        (lambda: hs.branch(OSCILLATOR, over="D=1"), "expected NAME=FROM:TO:COUNT"),
        (lambda: hs.branch(OSCILLATOR, over=("x", 0, 1, 5)), "invalid value 'x=0:1:5' for '--over'"),
        (lambda: hs.basin(OSCILLATOR, grid=(0, 5)), "is not a grid"),
        (lambda: hs.scan(OSCILLATOR, over="D=0:1:3", measure="nothing"), "nothing"),
        (lambda: hs.scan(OSCILLATOR, over="q0=0:1:3", measure="margin"), "margin does not depend on q0"),
        (lambda: hs.Machine("nix"), "the machines of the program are"),
        (lambda: hs.Machine("clutch", R=-1), "R = -1 N is outside its range"),
        (lambda: hs.Machine("own", text="m = 1 kg"), "own:1"),
        (lambda: hs.cycles("nix"), "nix"),
        (lambda: hs.fit("/no/such/record.csv"), "/no/such/record.csv"),
    ],
)
def test_wrong_input_is_refused_in_the_line_of_the_program(wrong, line):
    with pytest.raises(hs.InputError) as refused:
        wrong()
    assert line in str(refused.value) and "\n" not in str(refused.value)
    assert isinstance(refused.value, ValueError) and isinstance(refused.value, hs.Error)


@pytest.mark.parametrize(
    "long",
    [
        lambda: hs.scan(OSCILLATOR, over=["D=-0.9:-0.1:10000", "r=0.01:0.3:10000"], measure="cycles"),
        lambda: hs.trajectory(OSCILLATOR, q0=1.0, until=1e9, tol=1e-15),
    ],
)
def test_ctrl_c_interrupts(long):
    timer = threading.Timer(0.3, os.kill, [os.getpid(), signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        long()
    timer.join()
    assert len(hs.cycles(OSCILLATOR).cycles) == 2


# Were the lock held, the first thread would not go on before the scan ends, in some hours.
THREADS = """
import os, threading, time
import hopfscope as hs
begun = threading.Event()
def scan():
    begun.set()
    hs.scan(over=["D=-0.9:-0.1:10000", "r=0.01:0.3:10000"], measure="cycles")
def move():
    begun.set()
    hs.trajectory(hs.Parameters(D=-0.3, D3=0.5), q0=1.0, until=1e9, tol=1e-15)
for work in (scan, move):
    begun.clear()
    threading.Thread(target=work, daemon=True).start()
    begun.wait()
    for _ in range(10):
        time.sleep(0.01)
        hs.cycles(D=-0.3, D3=0.5, r=0.1)
print("went on", flush=True)
os._exit(0)
"""


def test_other_threads_go_on():
    done = subprocess.run([sys.executable, "-c", THREADS], capture_output=True, text=True, timeout=300)
    assert done.stdout == "went on\n", done.stderr


def found_in_child(_):
    return hs.branch(OSCILLATOR, over="D=-1:0:20").points.q_max.sum()


@pytest.mark.skipif("fork" not in multiprocessing.get_all_start_methods(), reason="no fork here")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_forked_children_compute():
    here = found_in_child(0)
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map_async(found_in_child, range(3)).get(300) == [here] * 3


def test_an_incomplete_answer_warns():
    for options in ({}, {"sample": 0.1}):
        with pytest.warns(hs.IncompleteWarning, match="where the friction law ends"):
            found = hs.trajectory(hs.Machine("slideway"), x=0.003, until=0.5, **options)
        assert found.outcome.kind == "gave-up"


def test_the_program_is_in_the_wheel(tmp_path):
    run = lambda *words: subprocess.run([PROGRAM, *words], capture_output=True, text=True)  # noqa: E731
    version = run("--version")
    assert version.returncode == 0 and version.stdout.startswith("hopfscope ")
    wrong = run("cycles", "--set", "r=-1")
    assert wrong.returncode == 2 and "r = -1 is outside its range" in wrong.stderr
    rows = tmp_path / "rows.csv"
    assert run("scan", "--over", "D=-1:0:3", "--measure", "margin", "--output", str(rows)).returncode == 0
    assert f"scan --over D=-1:0:3 --measure margin --output {rows}" in Path(f"{rows}.provenance").read_text()


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_ctrl_c_ends_a_scan_of_the_program():
    words = ["scan", "--over", "D=-0.9:-0.1:1000000", "--measure", "cycles"]
    with subprocess.Popen([PROGRAM, *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE) as scan:
        # Its first rows say that it is at work.
        scan.stdout.read(100)
        scan.send_signal(signal.SIGINT)
        _, said = scan.communicate(timeout=300)
    assert scan.returncode == 128 + signal.SIGINT and b"stopped: " in said
