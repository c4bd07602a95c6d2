"""The sparse sweep against a general shift-invert Krylov-Schur iteration (SLEPc), same matrices, same machine.

    apt-get install python3-slepc4py-real          # Debian, with the system's own python
    /usr/bin/python3 benches/against_slepc.py [circumferential radial modes values]

Both solve K(mu) x = kappa M(mu) x for the lowest modes at every friction value, on one thread, in processor time,
factorizations included; SLEPc with whichever LU of PETSc, MUMPS, SuperLU and UMFPACK is fastest. Default: 180 35 30 21.
"""

import glob
import os
import subprocess
import sys
import tempfile
import time

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# Where Debian keeps its bindings.
sys.path += glob.glob("/usr/lib/*dir/*/*-real/lib/python3/dist-packages")
import numpy as np
from petsc4py import PETSc
from slepc4py import SLEPc

ALPHA, BETA = 40.0, 4.5e-7


def peak_megabytes():
    with open("/proc/self/status") as status:
        return int(next(line for line in status if line.startswith("VmHWM")).split()[1]) / 1024


def polynomial(folder, name, mu):
    parts = sorted(f for f in os.listdir(folder) if f.startswith(name + "-"))
    return sum(np.fromfile(f"{folder}/{f}") * mu**p for p, f in enumerate(parts))


def matrix(folder, name, mu):
    """PETSc reads rows; the files hold columns, so this is the transpose, transposed back."""
    pointers = np.fromfile(f"{folder}/pointers.i64", dtype=np.int64).astype(PETSc.IntType)
    rows = np.fromfile(f"{folder}/rows.i64", dtype=np.int64).astype(PETSc.IntType)
    n = len(pointers) - 1
    transposed = PETSc.Mat().createAIJ((n, n), csr=(pointers, rows, polynomial(folder, name, mu)))
    transposed.assemble()
    return transposed.transpose()


def solve(folder, mu, modes, package, tolerance):
    """Processor time and the eigenvalues of the quadratic problem with their residuals."""
    stiffness, mass = (matrix(folder, name, mu) for name in ("stiffness", "mass"))
    start = time.process_time()
    solver = SLEPc.EPS().create()
    solver.setOperators(stiffness, mass)
    solver.setProblemType(SLEPc.EPS.ProblemType.GNHEP)
    solver.setWhichEigenpairs(SLEPc.EPS.Which.TARGET_MAGNITUDE)
    solver.setTarget(0.0)
    solver.setDimensions(modes)
    solver.setTolerances(tolerance, 500)
    transform = solver.getST()
    transform.setType(SLEPc.ST.Type.SINVERT)
    linear = transform.getKSP()
    linear.setType("preonly")
    linear.getPC().setType("lu")
    linear.getPC().setFactorSolverType(package)
    solver.solve()
    seconds = time.process_time() - start
    norms = [m.norm(PETSc.NormType.NORM_INFINITY) for m in (stiffness, mass)]
    found = []
    xr, xi = stiffness.createVecs()
    for i in range(min(modes, solver.getConverged())):
        kappa = solver.getEigenpair(i, xr, xi)
        p = ALPHA + BETA * kappa
        root = 1j * np.sqrt(kappa - p * p / 4 + 0j)
        eigenvalue = max(root - p / 2, -root - p / 2, key=lambda v: v.imag)
        x = xr.getArray() + 1j * xi.getArray() if kappa.imag else xr.getArray() + 0j

        def times(m):
            return sum(
                factor * (m * PETSc.Vec().createWithArray(np.ascontiguousarray(part))).getArray()
                for factor, part in ((1, x.real), (1j, x.imag))
            )

        size = abs(eigenvalue)
        force = abs(1 + BETA * eigenvalue) * np.linalg.norm(times(stiffness) - kappa * times(mass))
        damped = ALPHA * norms[1] + BETA * norms[0]
        scale = (size**2 * norms[1] + size * damped + norms[0]) * np.linalg.norm(x)
        found.append((eigenvalue, force / scale))
    # Python would keep them, and the peak be that of all values together.
    for thing in (solver, stiffness, mass, xr, xi):
        thing.destroy()
    return seconds, found


def seconds_of(folder, mu, modes, package):
    """Processor time of one value in a process of its own, whose memory is not counted here."""
    one = [sys.executable, os.path.abspath(__file__), "--one", folder, str(mu), str(modes), package]
    done = subprocess.run(one, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return float(done.stdout) if done.returncode == 0 else None


def main():
    if sys.argv[1:2] == ["--one"]:
        folder, mu, modes, package = sys.argv[2:]
        print(solve(folder, float(mu), int(modes), package, 1e-10)[0])
        return
    given = sys.argv[1:5] + ["180", "35", "30", "21"][len(sys.argv) - 1 :]
    modes, count = int(given[2]), int(given[3])
    values = [0.3] if count == 1 else [i / (count - 1) for i in range(count)]
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    program = os.environ.get("AGAINST_SLEPC_BINARY")
    command = [program] if program else ["cargo", "bench", "-q", "--bench", "against_slepc", "--"]
    with tempfile.TemporaryDirectory() as folder:
        ours = subprocess.run(command + [folder] + given, cwd=root, check=True, stdout=subprocess.PIPE, text=True)
        print("frictionsim:", ours.stdout.strip())
        words = ours.stdout.split()
        own_seconds = float(words[words.index("seconds") + 1])
        own = {}
        for line in open(f"{folder}/eigenvalues.txt"):
            mu, re, im = map(float, line.split())
            own.setdefault(mu, []).append(complex(re, im))
        trial = {}
        for package in ("petsc", "mumps", "superlu", "umfpack"):
            seconds = seconds_of(folder, values[len(values) // 2], modes, package)
            if seconds is not None:
                trial[package] = seconds
        print("SLEPc, one value:", ", ".join(f"{name} {t:.3f} s" for name, t in trial.items()))
        package = min(trial, key=trial.get)
        seconds, residual, difference = 0.0, 0.0, 0.0
        for mu in values:
            elapsed, found = solve(folder, mu, modes, package, 1e-10)
            seconds += elapsed
            residual = max(residual, max(r for _, r in found))
            for value, _ in found:
                nearest = min(abs(value - mode) for mode in own[mu])
                # A pair at the cut may be in one list alone.
                if nearest < 1e-3 * abs(value):
                    difference = max(difference, nearest / abs(value))
        print(f"SLEPc, {package}: seconds {seconds:.3f} residual {residual:.2e} peak_mb {peak_megabytes():.0f}")
        print(f"largest relative difference {difference:.1e}; ratio {seconds / own_seconds:.2f}")


main()
