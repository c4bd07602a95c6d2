"""`frictionsim cea` against SLEPc at each friction value: same matrices, same machine, one thread, processor time.

    apt-get install python3-slepc4py-real          # Debian, with the system's own python
    cargo build --release
    /usr/bin/python3 benches/against_slepc.py [BODY ...]

Without arguments all bodies below. SLEPc solves (lambda^2 M + lambda C + K) x = 0 by TOAR, or K x = kappa M x by
Krylov-Schur where damping is proportional, shifted and inverted about zero, with whichever LU of PETSc, MUMPS, SuperLU
and UMFPACK is fastest for the body, factorizations included and nothing else. Ours is the whole command: case, mesh,
steady sliding, modes without friction with the proof that none is missing, branches, onsets, tables. Matrices are
those of `frictionsim matrices --friction`. FRICTIONSIM names another program than target/release/frictionsim.
"""

import csv
import glob
import os
import subprocess
import sys
import tempfile
import time

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "RAYON_NUM_THREADS"):
    os.environ[name] = "1"
# Where Debian keeps its bindings.
sys.path += glob.glob("/usr/lib/*dir/*/*-real/lib/python3/dist-packages")
import numpy as np
from petsc4py import PETSc
from slepc4py import SLEPc

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PROGRAM = os.environ.get("FRICTIONSIM", f"{ROOT}/target/release/frictionsim")
WHOLE = ['cea.method="sparse"']
RIM = ["mesh.circumferential_elements=120", "mesh.radial_elements=24", 'material.formulation="plane-stress"',
       'boundaries.outer.condition="support"', "boundaries.outer.normal_stiffness=2e11",
       "boundaries.outer.tangential_stiffness=2e11"]
ANNULUS = ["mesh.circumferential_elements=180", "mesh.radial_elements=35", 'mesh.element="quad4"',
           "cea.geometric_stiffness=false", "cea.friction_coefficients={ from = 0.0, to = 1.0, count = 21 }"]
BODIES = {
    "annulus": ("polycarbonate-disc", WHOLE + ANNULUS),
    "test-bench": ("test-bench", []),
    "sliding-block": ("sliding-block", []),
    "pad-on-disc": ("pad-on-disc", []),
    "supported-rim": ("polycarbonate-disc", WHOLE + RIM + ["cea.friction_coefficients=[0.3]"]),
    "triangles": ("disc-triangles", []),
    "two-dampings": ("test-bench", ['boundaries.screws={ condition="clamped" }']),
    "dashpots": ("disc-triangles", ["contact.tangential_damping=200.0"]),
    "falling-friction": ("falling-friction", WHOLE),
    # Solid parts: a disc and two pads tied to backplates, damping by part; a block that slides slowly on a floor.
    "brake": ("brake", []),
    "brake-twelve-values": ("brake", ["cea.friction_coefficients={ from = 0.0, to = 0.55, count = 12 }"]),
    "tread-block": ("tread-block", []),
    "ventilated-disc": ("ventilated-disc", []),
    "ventilated-twenty-one-values": ("ventilated-disc",
                                     ["cea.friction_coefficients={ from = 0.0, to = 0.6, count = 21 }"]),
}
PACKAGES = ("petsc", "mumps", "superlu", "umfpack")


def run(*arguments):
    """Processor time of a command of the program, s."""
    process = subprocess.Popen([PROGRAM, *arguments, "-qq"], stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    if status:
        sys.exit(f"{' '.join(arguments)} failed")
    return used.ru_utime + used.ru_stime


def matrix(folder, name):
    """A file of Matrix Market, and its entries."""
    with open(f"{folder}/{name}.mtx") as file:
        line = file.readline()
        while line.startswith("%"):
            line = file.readline()
        size = int(line.split()[0])
        rows, columns, values = np.fromstring(file.read(), sep=" ").reshape(-1, 3).T
    order = np.lexsort((columns, rows))
    rows, columns = (part[order].astype(PETSc.IntType) - 1 for part in (rows, columns))
    pointers = np.searchsorted(rows, np.arange(size + 1)).astype(PETSc.IntType)
    found = PETSc.Mat().createAIJ((size, size), csr=(pointers, columns, values[order]))
    found.assemble()
    return found


def proportional(stiffness, damping, mass):
    """`alpha` and `beta` of `C = alpha M + beta K`, where that is what it is."""
    def product(a, b):
        x = a.createVecRight()
        x.setArray(np.cos(np.arange(x.getSize())))
        return (a * x).dot(b * x)

    square, cross, other = product(mass, mass), product(mass, stiffness), product(stiffness, stiffness)
    alpha, beta = np.linalg.solve([[square, cross], [cross, other]],
                                  [product(mass, damping), product(stiffness, damping)])
    left = damping.copy()
    left.axpy(-alpha, mass, PETSc.Mat.Structure.DIFFERENT)
    left.axpy(-beta, stiffness, PETSc.Mat.Structure.DIFFERENT)
    return (alpha, beta) if left.norm() < 1e-9 * damping.norm() else None


def solve(folder, modes, package):
    """Processor time, eigenvalues with Im > 0, and the largest relative residual of the quadratic problem."""
    stiffness, damping, mass = (matrix(folder, name) for name in "KCM")
    coefficients = proportional(stiffness, damping, mass)
    if coefficients:
        solver = SLEPc.EPS().create()
        solver.setOperators(stiffness, mass)
        solver.setProblemType(SLEPc.EPS.ProblemType.GNHEP)
        solver.setWhichEigenpairs(SLEPc.EPS.Which.TARGET_MAGNITUDE)
        solver.setDimensions(modes)
    else:
        solver = SLEPc.PEP().create()
        solver.setOperators([stiffness, damping, mass])
        solver.setType(SLEPc.PEP.Type.TOAR)
        solver.setWhichEigenpairs(SLEPc.PEP.Which.TARGET_MAGNITUDE)
        solver.setScale(SLEPc.PEP.Scale.SCALAR)
        solver.setDimensions(2 * modes)
    solver.setTarget(0.0)
    solver.setTolerances(1e-8, 500)
    transform = solver.getST()
    transform.setType(SLEPc.ST.Type.SINVERT)
    transform.getKSP().setType("preonly")
    transform.getKSP().getPC().setType("lu")
    transform.getKSP().getPC().setFactorSolverType(package)
    start = time.process_time()
    solver.solve()
    seconds = time.process_time() - start
    norms = [m.norm(PETSc.NormType.NORM_INFINITY) for m in (stiffness, damping, mass)]
    found, worst = [], 0.0
    xr, xi = stiffness.createVecs()
    for i in range(solver.getConverged()):
        value = solver.getEigenpair(i, xr, xi)
        is_real = value.imag == 0
        if coefficients:
            alpha, beta = coefficients
            half = (alpha + beta * value) / 2
            root = 1j * np.sqrt(value - half * half + 0j)
            value = max(root - half, -root - half, key=lambda v: v.imag)
        if value.imag <= 0:
            continue
        x = xr.getArray() + (0j if is_real else 1j * xi.getArray())

        def times(m):
            parts = ((1, np.ascontiguousarray(x.real)), (1j, np.ascontiguousarray(x.imag)))
            return sum(f * (m * PETSc.Vec().createWithArray(p)).getArray() for f, p in parts)

        force = np.linalg.norm(times(stiffness) + value * times(damping) + value**2 * times(mass))
        size = abs(value)
        scale = (size**2 * norms[2] + size * norms[1] + norms[0]) * np.linalg.norm(x)
        worst = max(worst, force / scale)
        found.append(value)
    found.sort(key=abs)
    return seconds, found[:modes], worst


def fastest(folder, modes):
    """The package of least time, each tried in a process of its own."""
    times = {}
    for package in PACKAGES:
        one = [sys.executable, os.path.abspath(__file__), "--one", folder, str(modes), package]
        done = subprocess.run(one, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        if done.returncode == 0:
            times[package] = float(done.stdout)
    return min(times, key=times.get)


def compare(body):
    case, overrides = BODIES[body]
    given = [f"{ROOT}/cases/{case}.toml"] + [word for text in overrides for word in ("--set", text)]
    with tempfile.TemporaryDirectory() as folder:
        ours = run("cea", *given, "--no-figures", "--out", f"{folder}/cea")
        modes = {}
        for row in csv.DictReader(open(f"{folder}/cea/eigenvalues.csv")):
            value = complex(float(row["growth_rate_per_s"]), 2 * np.pi * float(row["frequency_hz"]))
            modes.setdefault(row["friction_coefficient"], []).append((value, float(row["residual"])))
        own_residual = max(residual for all in modes.values() for _, residual in all)
        seconds, residual, difference, package = 0.0, 0.0, 0.0, None
        for friction, own in modes.items():
            place = f"{folder}/{friction}"
            run("matrices", *given, "--friction", friction, "--out", place)
            if package is None:
                package = fastest(place, len(own))
            elapsed, found, worst = solve(place, len(own), package)
            seconds, residual = seconds + elapsed, max(residual, worst)
            for value in found:
                nearest = min(abs(value - mode) for mode, _ in own)
                # Modes at the cut may be in one list alone.
                if nearest < 1e-3 * abs(value):
                    difference = max(difference, nearest / abs(value))
            unknowns = matrix(place, "M").getSize()[0]
    print(f"| {body} | {unknowns} | {len(modes)} | {ours:.2f} s, {own_residual:.0e} | {seconds:.2f} s, "
          f"{residual:.0e} ({package}) | {seconds / ours:.1f} | {difference:.0e} |", flush=True)


def main():
    if sys.argv[1:2] == ["--one"]:
        folder, modes, package = sys.argv[2:]
        print(solve(folder, int(modes), package)[0])
        return
    print("| body | unknowns | friction values | here, residual | SLEPc, residual | ratio | largest relative difference |\n|---|---|---|---|---|---|---|")
    for body in sys.argv[1:] or BODIES:
        compare(body)


main()
