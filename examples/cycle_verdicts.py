#!/usr/bin/env python3
"""Verdicts of stability of limit cycles against transients that start on them, on discs drawn at random.

    python3 examples/cycle_verdicts.py [verdicts] [seed] [frictionsim]

Every disc has its own material, radii, friction, interference, speed and damping. `cycle` says whether each of its cycles
is stable; a transient that starts on the cycle, disturbed in harmonics 1 to 8 by some thousandths of the slip speed, runs
for ten e-folds of the leading perturbation, 500 to 4,000 periods. It stays if its edge still is a wave of that frequency
that turns without changing its shape: amplitudes of the edge's harmonics do not waver, and the edge has none but multiples
of the wave's own. Waves that `cycle` itself marks as not confirmed and gives no verdict on are listed, not counted.
Exits with 1 where a verdict is wrong.
"""

import csv
import json
import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path

# Young's modulus, Pa; Poisson's ratio; density, kg/m3.
MATERIALS = {
    "steel": (210e9, 0.30, 7850.0),
    "aluminium": (70e9, 0.33, 2700.0),
    "cast iron": (110e9, 0.27, 7200.0),
    "brass": (100e9, 0.35, 8500.0),
    "titanium": (114e9, 0.34, 4430.0),
    "acrylic": (3.2e9, 0.37, 1190.0),
    "acetal": (2.9e9, 0.35, 1410.0),
    "nylon": (2.0e9, 0.39, 1140.0),
    "alumina": (370e9, 0.22, 3900.0),
}
E_FOLDS = 10  # of the leading perturbation that a run is long, between these periods
PERIODS = (500, 4000)
SAMPLES = 20  # a period
WINDOW = 50  # periods that one deviation is taken over
SEED = 3e-3  # velocity of each disturbance in units of the slip speed
LEFT = 0.05  # deviation, relative to the wave's amplitude, from which on a transient has left


def disc(draw):
    """A case as nested tables, all of them of the disc's own size and frequency."""
    name = draw.choice(sorted(MATERIALS))
    modulus, ratio, density = MATERIALS[name]
    inner = math.exp(draw.uniform(math.log(0.01), math.log(0.12)))
    rim = inner * draw.uniform(0.8, 3.2)
    # A quarter shear wave across the rim: about the first frequency.
    omega = math.pi / (2 * rim) * math.sqrt(modulus / (2 * (1 + ratio) * density))
    interference = inner * math.exp(draw.uniform(math.log(2e-4), math.log(1.5e-3)))
    speed = omega * interference * math.exp(draw.uniform(math.log(0.2), math.log(4.0)))
    return name, {
        "geometry": {"inner_radius": inner, "outer_radius": inner + rim, "thickness": 0.01},
        "mesh": {"circumferential_elements": 72, "radial_elements": max(10, round(72 * rim / inner / 12))},
        "material": {"young_modulus": modulus, "poisson_ratio": ratio, "density": density,
                     "formulation": draw.choice(["plane-stress", "plane-strain"])},
        "damping": {"mass_coefficient": 2 * omega * draw.uniform(0.0, 1e-3),
                    "stiffness_coefficient": 2 / omega * draw.uniform(3e-3, 1.2e-2)},
        "contact": {"friction_coefficient": draw.uniform(0.2, 0.6), "interference": interference,
                    "rotation_speed_rpm": speed / inner * 30 / math.pi},
        "cycle": {"onsets": "lowest"},
    }


def toml(tables):
    def write(value):
        return json.dumps(value)

    return "".join(
        f"[{name}]\n" + "".join(f"{key} = {write(value)}\n" for key, value in table.items())
        for name, table in tables.items()
    )


def run(program, command, folder, tables, name):
    case = folder / f"{name}.toml"
    case.write_text(toml(tables))
    out = folder / name
    done = subprocess.run([program, command, case, "--out", out, "--no-figures", "--force", "-qq"],
                          capture_output=True, text=True)
    summary = out / "summary.json"
    return json.loads(summary.read_text()) if summary.exists() else done.stderr.strip()


def deviations(path, harmonic):
    """How far the edge is from a wave that only turns, in each window of the run, relative to the amplitude in the first."""
    with open(path) as file:
        rows = csv.reader(file)
        names = next(rows)
        columns = [(int(name[1:].split("_")[0]), k) for k, name in enumerate(names) if name.endswith("real_m")]
        table = [[math.hypot(float(row[k]), float(row[k + 1])) for _, k in columns] for row in rows]
    own = next(i for i, (n, _) in enumerate(columns) if n == harmonic)
    found = []
    size = WINDOW * SAMPLES
    for first in range(0, len(table) - size + 1, size):
        window = table[first:first + size]
        means = [sum(column) / size for column in zip(*window)]
        square = 0.0
        for i, (n, _) in enumerate(columns):
            wanted = means[i] if n % harmonic == 0 else 0.0
            square += sum((row[i] - wanted) ** 2 for row in window) / size
        amplitude = means[own] if not found else amplitude
        found.append(math.sqrt(square) / amplitude)
    return found


def transient(program, folder, tables, cycle, name):
    """Whether a transient stays on the cycle, and the deviations of its windows."""
    period = 1 / cycle["main_frequency_hz"]
    leading = cycle["stability"]["leading"] or {}
    rate = abs(leading.get("growth_rate_per_s", math.inf)) * period
    periods = min(max(E_FOLDS / rate, PERIODS[0]), PERIODS[1])
    tables = dict(tables)
    tables["transient"] = {"duration": periods * period, "initial": "limit-cycle",
                           "limit_cycle_harmonic": cycle["harmonic"], "limit_cycle_onset": cycle["onset"]}
    tables["transient.perturbation"] = {"harmonics": list(range(1, 9)), "velocity": SEED, "relative": True,
                                        "phase_deg": [37.0 * n for n in range(1, 9)]}
    tables["output"] = {"sample_interval": period / SAMPLES, "contact_interval": 10 * period}
    end = run(program, "transient", folder, tables, name)
    if isinstance(end, str):
        return None, [], end
    found = deviations(folder / name / "harmonics.csv", cycle["harmonic"])
    frequency = end["main_frequency_hz"] or 0.0
    is_its = end["main_harmonic"] == cycle["harmonic"] and abs(frequency * period - 1) < 0.01
    return is_its and max(found[-len(found) // 5:]) < LEFT, found, frequency * period


def main():
    wanted = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    draw = random.Random(int(sys.argv[2]) if len(sys.argv) > 2 else 1)
    program = sys.argv[3] if len(sys.argv) > 3 else "target/release/frictionsim"
    print(" disc material   a mm  b/a   mu   V/(w d)   n      Hz  verdict    rate 1/s +- 1/s | transient  deviation: start, middle, end")
    counts = {"right": 0, "WRONG": 0, "undecided": 0}
    with tempfile.TemporaryDirectory() as folder:
        number = 0
        while sum(counts.values()) < wanted:
            number += 1
            name, tables = disc(draw)
            found = run(program, "cycle", Path(folder), tables, "cycle")
            if isinstance(found, str):
                print(f"{number:5} {name:10} {found.splitlines()[-1][:120] if found else 'nothing'}")
                continue
            for cycle in found["cycles"]:
                if sum(counts.values()) == wanted:
                    break
                if not cycle.get("stability"):
                    print(f"{number:5} {name:10} n = {cycle['harmonic']}: {cycle.get('absent') or cycle.get('error')}"[:150])
                    continue
                row(program, Path(folder), (number, name, tables), cycle, counts)
    print(", ".join(f"{count} {name}" for name, count in counts.items()))
    return counts["WRONG"] > 0


def row(program, folder, of, cycle, counts):
    number, name, tables = of
    stays, found, end = transient(program, folder, tables, cycle, "transient")
    stability = cycle["stability"]
    verdict, leading = stability["verdict"], stability["leading"] or {}
    expected = {"stable": True, "unstable": False}.get(verdict)
    agrees = (cycle["confirmation"] or {}).get("agrees")
    judged = "undecided" if expected is None else "right" if stays == expected else "WRONG"
    if expected is None and not agrees:
        judged = "no wave of the mesh"
    else:
        counts[judged] += 1
    geometry, contact = tables["geometry"], tables["contact"]
    inner = geometry["inner_radius"]
    slip = contact["rotation_speed_rpm"] * math.pi / 30 * inner
    scale = slip / (2 * math.pi * cycle["main_frequency_hz"] * contact["interference"])
    at = [found[k] for k in (0, len(found) // 2, -1)] if found else []
    print(f"{number:5} {name:10} {1e3 * inner:5.1f} {geometry['outer_radius'] / inner:5.2f} "
          f"{contact['friction_coefficient']:5.3f} {scale:7.3f} {cycle['harmonic']:5} {cycle['main_frequency_hz']:8.0f}  {verdict:9} "
          f"{leading.get('growth_rate_per_s', math.nan):10.1f} {leading.get('uncertainty_per_s', math.nan):6.1f} | "
          f"{'stays' if stays else 'leaves':6} {', '.join(f'{value:.4f}' for value in at)}  {end if isinstance(end, str) else f'{end:.4f}'} "
          f"{judged if judged != 'right' else ''}{'' if agrees else ' (20 periods: not confirmed)'}", flush=True)


if __name__ == "__main__":
    sys.exit(main())
