"""Writes fixtures/benchmark/tools.csv: which code answered the benchmark, in
which version and setting, and what is left out. Prints how to score."""

import csv
import subprocess
from importlib.metadata import version

from benchmark import FOLDER

EXACT = "11 scenes of the linearized equation: a rigid body has the exact one"
RATIO = "a ratio of rates below the rectangle's is set by the driver at each impact"
BODY = f"{EXACT}; {RATIO}"

# Code, package, licence, left out, default setting, best found.
TOOLS = [
    ("scipy", "scipy", "BSD-3-Clause", "",
     "solve_ivp RK45 with its tolerances; terminal events; the whole record one function; at rest below 1e-3 p alpha",
     "DOP853; rtol 3e-14; atol 1e-16 alpha; stops at each kink; a fifth of a hop as first step; at rest below 1e-6 p alpha with the rest of the hops summed"),
    ("odeint", "apt:libboost-dev", "BSL-1.0", "",
     "dopri5 with dense output; 1e-6; no limit of steps; rest as SciPy's default",
     "dopri5; 1e-13; steps of at most 10 ms; stops and rest as SciPy's best"),
    ("cvode", "apt:libsundials-dev", "BSD-3-Clause", "",
     "Adams with root finding; rtol 1e-4 and atol 1e-8 as in its examples; rest as SciPy's default",
     "Adams; rtol 1e-13; atol 1e-16 alpha; steps of at most 10 ms; stops and rest as SciPy's best"),
    ("heyoka", "heyoka", "MPL-2.0", "",
     "batch integrator of four scenes a call; tolerance as shipped; own events; stops at each kink; rest as SciPy's default",
     "the same with high_accuracy and rest as SciPy's best"),
    ("octave", "apt:octave", "GPL-3.0-or-later", "",
     "ode45 with its tolerances; own events: linear interpolation; rest as SciPy's default",
     "RelTol 1e-10; AbsTol 1e-15; steps of at most 20 ms; events improved by Newton's method with ode45; stops and rest as SciPy's best"),
    ("opensees", "openseespy", "free for research, education and internal use", BODY,
     "element RockingBC; strain 5e-6 under own weight; 5 % of damping; Newmark; 1 ms",
     "the same with 50 % of damping; no better over all; 0.1 ms with 5 % was tried on one scene only, for its time"),
    ("penalty", "", "this project's own script", BODY,
     "springs and dashpots at the corners; semi-implicit Euler; 0.1 ms; a tenth of critical damping",
     "20 microseconds; critical damping"),
    ("mujoco", "mujoco", "Apache-2.0", BODY,
     "2 ms; Euler; pyramidal cone; friction 1; soft contacts as shipped",
     "20 microseconds; elliptic cone; impratio 100; friction 10; solref two steps; solimp 0.99 0.9999 1e-6"),
    ("pybullet", "pybullet", "Zlib", BODY,
     "1/240 s; damping 0.04 as shipped; friction 10",
     "0.1 ms; 200 iterations; no damping; no slop; contactERP 0.1"),
    ("pymunk", "pymunk", "MIT", BODY,
     "1/60 s; 10 iterations; slop 0.1 m as shipped; friction 10",
     "20 microseconds; 50 iterations; slop 1e-7 m; collision_bias 0.9"),
    ("box2d", "Box2D", "Zlib", BODY,
     "1/60 s; 8 and 3 iterations; metres; asleep after half a second at rest",
     "0.3 ms; 50 and 50 iterations; never asleep; lengths times 1000 against the slop of 5 mm; single precision"),
]


def version_of(package):
    if package.startswith("apt:"):
        return subprocess.check_output(
            ["dpkg-query", "-W", "-f", "${Version}", package[4:]], text=True)
    return version(package) if package else ""


with open(FOLDER / "tools.csv", "w", newline="") as out:
    rows = csv.writer(out, lineterminator="\n")
    rows.writerow(["code", "setting", "version", "licence", "how", "left_out"])
    for code, package, licence, left_out, *how in TOOLS:
        for setting, words in zip(("default", "best"), how):
            name = f"{code}-{setting}.csv"
            if (FOLDER / "answers" / name).exists():
                rows.writerow([code, setting, version_of(package), licence,
                               words, left_out])
