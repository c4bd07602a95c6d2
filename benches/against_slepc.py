"""The sparse sweep against SLEPc at each friction value: same matrices, same machine, one thread, processor time.

    apt-get install python3-slepc4py-real          # Debian, with the system's own python
    /usr/bin/python3 benches/against_slepc.py [BODY ...]

Without arguments all bodies below. SLEPc solves (lambda^2 M + lambda C + K) x = 0 by TOAR, or K x = kappa M x by
Krylov-Schur where damping is proportional, shifted and inverted about zero, with whichever LU of PETSc, MUMPS, SuperLU
and UMFPACK is fastest for the body, factorizations included. Ours does the whole sweep: modes without friction with the
proof that none is missing, branches, onsets. AGAINST_SLEPC_BINARY names a bench that is built already.
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

RIM = ["mesh.circumferential_elements=120", "mesh.radial_elements=24", 'material.formulation="plane-stress"',
       'boundaries.outer.condition="support"', "boundaries.outer.normal_stiffness=2e11",
       "boundaries.outer.tangential_stiffness=2e11"]
ANNULUS = ["mesh.circumferential_elements=180", "mesh.radial_elements=35", 'mesh.element="quad4"',
           "cea.geometric_stiffness=false", "cea.friction_coefficients={ from = 0.0, to = 1.0, count = 21 }"]
BODIES = {
    "annulus": ("polycarbonate-disc", ANNULUS),
    "test-bench": ("test-bench", []),
    "sliding-block": ("sliding-block", []),
    "pad-on-disc": ("pad-on-disc", []),
    "supported-rim": ("polycarbonate-disc", RIM + ["cea.friction_coefficients=[0.3]"]),
    "triangles": ("disc-triangles", []),
    "two-dampings": ("test-bench", ['boundaries.screws={ condition="clamped" }']),
    "dashpots": ("disc-triangles", ["contact.tangential_damping=200.0"]),
    "falling-friction": ("falling-friction", []),
}
PACKAGES = ("petsc", "mumps", "superlu", "umfpack")


def request(folder):
    """What is wanted: the numbers after each word."""
    lines = (line.split() for line in open(f"{folder}/request.txt"))
    return {words[0]: [float(w) for w in words[1:]] for words in lines}


def matrix(folder, name, mu):
    """PETSc reads rows; the files hold columns, so this is the transpose, transposed back."""
    pointers, rows = (np.fromfile(f"{folder}/{n}.i64", dtype=np.int64).astype(PETSc.IntType) for n in ("pointers", "rows"))
    parts = sorted(f for f in os.listdir(folder) if f.startswith(name + "-"))
    values = sum(np.fromfile(f"{folder}/{f}") * mu**p for p, f in enumerate(parts))
    n = len(pointers) - 1
    transposed = PETSc.Mat().createAIJ((n, n), csr=(pointers, rows, values))
    transposed.assemble()
    return transposed.transpose()


def shift_and_invert(transform, package):
    transform.setType(SLEPc.ST.Type.SINVERT)
    linear = transform.getKSP()
    linear.setType("preonly")
    linear.getPC().setType("lu")
    linear.getPC().setFactorSolverType(package)


def solve(folder, mu, modes, package):
    """Processor time, eigenvalues with Im > 0, and the largest relative residual of the quadratic problem."""
    stiffness, damping, mass = (matrix(folder, name, mu) for name in ("stiffness", "damping", "mass"))
    proportional = request(folder).get("proportional")
    if proportional:
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
    shift_and_invert(solver.getST(), package)
    start = time.process_time()
    solver.solve()
    seconds = time.process_time() - start
    norms = [m.norm(PETSc.NormType.NORM_INFINITY) for m in (stiffness, damping, mass)]
    found, worst = [], 0.0
    xr, xi = stiffness.createVecs()
    for i in range(solver.getConverged()):
        value = solver.getEigenpair(i, xr, xi)
        if proportional:
            alpha, beta = proportional
            half = (alpha + beta * value) / 2
            root = 1j * np.sqrt(value - half * half + 0j)
            value = max(root - half, -root - half, key=lambda v: v.imag)
        if value.imag <= 0:
            continue
        x = xr.getArray() + 1j * (xi.getArray() if value.imag else 0.0)
        if proportional and solver.getEigenvalue(i).imag == 0:
            x = xr.getArray() + 0j

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


def fastest(folder, mu, modes):
    """The package of least time, each in a process of its own."""
    times = {}
    for package in PACKAGES:
        one = [sys.executable, os.path.abspath(__file__), "--one", folder, str(mu), str(modes), package]
        done = subprocess.run(one, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        if done.returncode == 0:
            times[package] = float(done.stdout)
    return min(times, key=times.get)


def own(folder):
    found = {}
    for line in open(f"{folder}/eigenvalues.txt"):
        mu, re, im = map(float, line.split())
        found.setdefault(mu, []).append(complex(re, im))
    return found


def compare(body):
    case, overrides = BODIES[body]
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    program = os.environ.get("AGAINST_SLEPC_BINARY")
    command = [program] if program else ["cargo", "bench", "-q", "--bench", "against_slepc", "--"]
    with tempfile.TemporaryDirectory() as folder:
        given = [folder, f"{root}/cases/{case}.toml"] + overrides
        ours = subprocess.run(command + given, cwd=root, check=True, stdout=subprocess.PIPE, text=True).stdout
        words = ours.split()
        number = lambda name: float(words[words.index(name) + 1])
        seconds, residual, difference, package = 0.0, 0.0, 0.0, None
        for state in sorted(glob.glob(f"{folder}/state-*")):
            for mu, modes in own(state).items():
                package = package or fastest(state, mu, len(modes))
                elapsed, found, worst = solve(state, mu, len(modes), package)
                seconds += elapsed
                residual = max(residual, worst)
                for value in found:
                    nearest = min(abs(value - mode) for mode in modes)
                    # Modes at the cut may be in one list alone.
                    if nearest < 1e-3 * abs(value):
                        difference = max(difference, nearest / abs(value))
        print(f"| {body} | {number('unknowns'):.0f} | {number('values'):.0f} | {number('seconds'):.2f} s, {number('residual'):.0e} "
              f"| {seconds:.2f} s, {residual:.0e} ({package}) | {seconds / number('seconds'):.1f} | {difference:.0e} |", flush=True)


def main():
    if sys.argv[1:2] == ["--one"]:
        folder, mu, modes, package = sys.argv[2:]
        print(solve(folder, float(mu), int(modes), package)[0])
        return
    print("| body | unknowns | friction values | here | SLEPc | ratio | largest relative difference |\n|---|---|---|---|---|---|---|")
    for body in sys.argv[1:] or BODIES:
        compare(body)


main()
