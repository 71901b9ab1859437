"""Answers against closed forms, and against what the program in the wheel prints, digit for digit."""

import json
import math
import pickle
import shlex
import subprocess
import sysconfig
from pathlib import Path
from typing import Sequence

import numpy as np
import pytest

import hopfscope as hs

PROGRAM = Path(sysconfig.get_path("scripts"), "hopfscope")
OSCILLATOR = hs.Parameters(D=-0.3, D3=0.5, r=0.1)


def printed(command: str, stdin: str = "", file: str = "/dev/null") -> str:
    """What the program prints for a command line, with a text as its standard input, and a file open as number 3."""
    words = [shlex.quote(word) for word in [str(PROGRAM), *shlex.split(command)[1:]]]
    shell = ["bash", "-c", f"{' '.join(words)} 3<{shlex.quote(file)}"]
    return subprocess.run(shell, capture_output=True, text=True, check=True, input=stdin).stdout


def plain(value):
    """A value as JSON has it, without what does not exist."""
    if isinstance(value, hs.Table):
        return [plain(row) for row in value]
    if isinstance(value, (hs.Record, dict)):
        fields = {name: plain(value[name]) for name in value.keys()}
        return {name: it for name, it in fields.items() if it is not None}
    if isinstance(value, (list, np.ndarray)):
        return [plain(one) for one in value]
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and math.isnan(value) else value


def same(answer: hs.Answer, *without: str, times: Sequence[float] = (), file: str = "/dev/null") -> None:
    """Asserts that the program's document has the fields of the answer, digit for digit."""
    stdin = "".join(f"{time!r}\n" for time in map(float, times))
    document = json.loads(printed(answer.provenance.command + " --format json", stdin, file))
    for name in answer.keys():
        if name not in ("cost", "provenance", *without):
            assert plain(answer[name]) == plain(document[name]), name
    assert answer.provenance.version == document["provenance"]["version"]
    assert ("cost" in answer.keys()) == ("cost" in document)


def test_without_damping_a_half_swing_takes_twice_the_friction():
    motion = hs.trajectory(r=0.1, q0=1.05)
    turns = 1.05 - 0.2 * np.arange(1, 6)
    assert motion.outcome.kind == "captured"
    np.testing.assert_allclose(np.abs(motion.events.q), turns, rtol=0, atol=1e-12)
    np.testing.assert_allclose(motion.events.tau, np.pi * np.arange(1, 6), rtol=1e-13)


def test_a_motion_at_times_is_that_of_the_closed_form():
    times = np.array([3.0, 0.0, 1.25])
    found = hs.trajectory(hs.Parameters(r=0.1), q0=1.0, until=50, times=times)
    samples = found.samples
    np.testing.assert_array_equal(samples.tau, times)
    np.testing.assert_allclose(samples.q, 0.1 + 0.9 * np.cos(times), atol=1e-13)
    np.testing.assert_allclose(samples.v, -0.9 * np.sin(times), atol=1e-13)
    same(found, times=times)
    for outside in [50.5, -1.0, math.nan]:
        with pytest.raises(hs.InputError, match="outside of the motion, 0 .. 50.0"):
            hs.trajectory(OSCILLATOR, until=50, times=[1.0, outside])
    escaped = hs.trajectory(D=0.1, D3=-1.0, q0=5.0, until=50, times=[0.0, 40.0]).samples
    assert escaped.q[0] == 5.0 and np.isnan(escaped.q[1])


def test_the_linear_cycle_and_its_margin_have_closed_forms():
    d, r = -0.1, 0.5
    omega = math.sqrt(1 - d * d)
    growth = math.exp(-d * math.pi / omega)
    found = hs.cycles(D=d, r=r)
    assert found.cycles.stable.tolist() == [False] and found.basin.edge == "cycle"
    size = r * (growth + 1) / (growth - 1)
    np.testing.assert_allclose(found.cycles.q_max, [size], rtol=1e-13)
    np.testing.assert_allclose(found.cycles.period, [2 * math.pi / omega], rtol=1e-13)
    np.testing.assert_allclose(found.cycles.multiplier, [growth**2], rtol=1e-13)
    assert hs.margin(D=d, r=r).nominal.displacement == pytest.approx(size, rel=1e-13)


def test_the_level_curve_of_the_linear_margin_has_a_closed_form():
    found = hs.level(of=("displacement", 2.0), over=[("D", -0.6, -0.1), ("r", 0.1, 3.0)])
    (curve,) = found.curves
    d, r = curve.points.T
    growth = np.exp(-d * np.pi / np.sqrt(1 - d * d))
    np.testing.assert_allclose(r, 2.0 * (growth - 1) / (growth + 1), rtol=1e-9)
    assert len(d) > 10


def test_an_orbit_is_the_motion_from_its_turning_point():
    for cycle in hs.cycles(OSCILLATOR, orbit=50).cycles:
        orbit = cycle.orbit
        half = orbit.tau < cycle.period / 2
        samples = hs.trajectory(OSCILLATOR, q0=cycle.q_max, times=orbit.tau).samples
        np.testing.assert_allclose(orbit.q[half], samples.q[half], rtol=0, atol=1e-11)
        np.testing.assert_allclose([orbit.q[-1], orbit.tau[-1]], [cycle.q_max, cycle.period], atol=1e-11)
    points = hs.branch(OSCILLATOR, over="D=-1:0:10", orbit=9).points
    # One that repels so strongly that it does not close has none.
    closed = [(orbit, q) for orbit, q in zip(points.orbit, points.q_max) if orbit is not None]
    assert closed and all(len(orbit) == 9 and orbit.q[0] == q for orbit, q in closed)


def test_labels_of_a_basin_are_the_ends_of_motions():
    found = hs.basin(OSCILLATOR, window=(-2, 2, -1, 1), grid=(9, 6), labels=True)
    assert found.labels.shape == (6, 9) and found.legend[0] == "captured"
    for (row, column), label in np.ndenumerate(found.labels):
        motion = hs.trajectory(OSCILLATOR, q0=found.q[column], v0=found.v[row], until=400)
        assert (motion.outcome.kind == "captured") == (label == 0)
    for label, name in enumerate(found.legend):
        assert (found.labels == label).sum() == found.counts[name]


def test_a_table_without_rows_has_its_columns():
    found = hs.cycles(D=0.3)
    assert found.cycles.q_max.shape == (0,) and len(found.cycles) == 0
    assert list(found.cycles.to_dataframe().columns)[:3] == ["stable", "q_min", "q_max"]


@pytest.mark.parametrize(
    "answer",
    [
        lambda: hs.cycles(OSCILLATOR),
        lambda: hs.cycles(OSCILLATOR, certify=True, harmonics=3),
        lambda: hs.cycles(D=(-0.31, -0.3), D3=0.5, r=0.1),
        lambda: hs.margin(OSCILLATOR),
        lambda: hs.margin(OSCILLATOR, disturbance=0.02),
        lambda: hs.margin(OSCILLATOR, r=(0.09, 0.11)),
        lambda: hs.trajectory(OSCILLATOR, q0=0.3, v0=-0.1, until=40),
        lambda: hs.trajectory(OSCILLATOR, q0=0.2, method="dop853", tol=1e-8, sample=0.5),
        lambda: hs.trajectory("supercritical", certify=True),
        lambda: hs.branch(OSCILLATOR, over=("D", -1, 0, 30)),
        lambda: hs.branch(OSCILLATOR, over="D=-1:0:20", certify=True),
        lambda: hs.border(OSCILLATOR, over=("r", 0.05, 0.2, 3)),
        lambda: hs.basin(OSCILLATOR, window=(-2, 2, -1.5, 1.5), grid=(30, 20), certify=True),
        lambda: hs.kicks(OSCILLATOR, kicks="q=0+-0.1,v=0+-0.05"),
        lambda: hs.cycles(OSCILLATOR, orbit=7),
        lambda: hs.branch(OSCILLATOR, over="D=-1:0:6", orbit=5),
        lambda: hs.basin(OSCILLATOR, grid=(7, 5), labels=True, curves=True),
        lambda: hs.level(OSCILLATOR, of=("impulse", 0.2), over=[("D", -0.9, -0.1), ("r", 0.05, 0.4)]),
        lambda: hs.level(
            OSCILLATOR, of=("guaranteed_impulse", 0.15), over=["D=-0.9:-0.1", "D3=0:1"], half_width=("r", 0.01)
        ),
        lambda: hs.level(OSCILLATOR, of="captured_part=0.05", over=["D=-0.9:-0.1", "D3=0:1"], window=(-2, 2, -2, 2)),
    ],
)
def test_an_answer_is_that_of_the_program(answer):
    found = answer()
    # The library alone proves nothing.
    same(found, *([] if "count" in found.keys() else ["cycles"] if isinstance(found, hs.Cycles) else []))


@pytest.mark.parametrize(
    "answer",
    [
        lambda it: hs.cycles(it),
        lambda it: hs.margin(it, disturbance="1 N"),
        lambda it: hs.trajectory(it, x=1e-4, until=0.5),
        lambda it: hs.basin(it, grid=(20, 20)),
    ],
)
@pytest.mark.parametrize("name", ["clutch", "slideway"])
def test_an_answer_about_a_machine_is_that_of_the_program(answer, name):
    found = answer(hs.Machine(name, R="55 N"))
    assert found.machine == name
    same(found)


def test_cycles_without_a_proof_are_those_with_one():
    found, proved = hs.cycles(OSCILLATOR).cycles, hs.cycles(OSCILLATOR, certify=True).cycles
    assert all(np.array_equal(found[name], proved[name]) for name in found.keys() if name != "errors")
    assert proved.proved.all() and (proved.enclosure.q_max[:, 0] <= found.q_max).all()


def test_a_machine_of_a_text_is_that_of_its_file(tmp_path):
    text = 'm = "2 kg"\nc = 800\nF = "60 N"\nR = 1.5\nv0 = "0.25 m/s"\n[friction.polynomial]\ncoefficients = [0.5, -0.6]\n'
    file = tmp_path / "own.toml"
    file.write_text(text)
    of_file, of_text = hs.Machine(str(file), v0=0.3), hs.Machine("own", text=text, v0=0.3)
    assert of_file.numbers == of_text.numbers and of_text.numbers["v0"] == 0.3
    assert plain(hs.margin(of_file).nominal) == plain(hs.margin(of_text).nominal)
    assert of_text.replace(R=2).numbers["R"] == 2 and of_text.replace(R=2).numbers["v0"] == 0.3
    assert of_text.replace().numbers == of_text.numbers and of_text.name == "own"
    same(hs.trajectory(of_text, until=0.5, times=[0.1, 0.2]), "machine", "title", times=[0.1, 0.2], file=str(file))


def test_a_scan_has_the_rows_of_the_program():
    found = hs.scan(OSCILLATOR, over=[("D", -0.9, 0.1, 5), "r=0.05:0.3:4"], measure=["margin", "cycles", "border"])
    lines = printed(found.provenance.command + " --format json").splitlines()
    assert plain(found) == [plain(json.loads(line)) for line in lines]
    frame, grid = found.to_dataframe(), found.to_xarray()
    assert len(frame) == 20 and frame["r"].iloc[:4].tolist() == grid.r.values.tolist()
    assert grid.impulse.dims == ("D", "r") and grid.sizes == {"D": 5, "r": 4}
    at = grid.impulse.sel(D=-0.9, r=0.3).item()
    assert at == hs.margin(OSCILLATOR, D=-0.9, r=0.3).nominal.impulse


def test_answers_and_what_they_are_about_pickle():
    again = pickle.loads(pickle.dumps(OSCILLATOR))
    assert again == OSCILLATOR and hash(again) == hash(OSCILLATOR) and again.replace(r=0.2) != again
    found = hs.branch(OSCILLATOR, over="D=-1:0:20")
    read = pickle.loads(pickle.dumps(found))
    assert plain(read) == plain(found) and isinstance(read, hs.Answer)
    machine = pickle.loads(pickle.dumps(hs.Machine("clutch", R="55 N")))
    assert machine.numbers["R"] == 55.0


def test_the_annotations_of_answers_name_what_they_have():
    motion = hs.trajectory(OSCILLATOR, q0=1.0, times=[1.0])
    found = [motion, hs.cycles(OSCILLATOR), hs.branch(OSCILLATOR, over="D=-1:0:20"), hs.basin(OSCILLATOR, grid=(9, 9))]
    for answer in [*found, hs.margin(OSCILLATOR)]:
        for name in type(answer).__annotations__.keys() - {"_kinds"}:
            held = answer[name]
            if isinstance(held, hs.Table):
                assert set(type(held).__annotations__) <= set(held.keys()), (type(answer), name)
