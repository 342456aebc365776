"""Runs a remesher on a file and measures it: shared by compare and runs."""

import json
import math
import os
import statistics
import subprocess
import sys
import tempfile
import time


class Run:
    """One finished run: seconds of wall time and bytes of peak resident memory."""

    def __init__(self, status, seconds, peak_bytes):
        self.status = status
        self.seconds = seconds
        self.peak_bytes = peak_bytes


def timed(command):
    """Runs a command without its output; measures it alone, not the runs before it."""
    start = time.monotonic()
    try:
        child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    except OSError as error:
        raise SystemExit(f"{command[0]}: {error.strerror}; is it built?") from None
    err = child.stderr.read()
    _, status, usage = os.wait4(child.pid, 0)
    seconds = time.monotonic() - start
    child.returncode = os.waitstatus_to_exitcode(status)
    # 1: cavea wrote a mesh that misses a target, which the figures will show.
    if child.returncode not in (0, 1):
        sys.stderr.write(err.decode(errors="replace"))
        raise SystemExit(f"{' '.join(command)}: status {child.returncode}")
    return Run(child.returncode, seconds, usage.ru_maxrss * 1024)


def info(cavea, mesh):
    """What `cavea info` says about a mesh."""
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "info.json")
        subprocess.run([cavea, "info", mesh, "--json", name], stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL, check=False)
        with open(name, encoding="utf-8") as file:
            return json.load(file)


def summary(runs, figures):
    """Figures of several runs with one result: median time, largest memory, quality."""
    seconds = statistics.median(run.seconds for run in runs)
    peak = max(run.peak_bytes for run in runs)
    tets = figures["counts"]["tets"]
    return {
        "seconds": seconds,
        "seconds_of_runs": [run.seconds for run in runs],
        "tets": tets,
        "tets_per_second": tets / seconds,
        "peak_bytes": peak,
        "bytes_per_tet": peak / tets,
        "worst_quality": figures["quality"]["worst"],
        "mean_quality": figures["quality"]["mean"],
        "sound": figures["sound"],
    }


HEADER = f"{'':24}{'seconds':>9}{'tets':>12}{'tets/s':>10}{'MB':>8}{'B/tet':>7}{'worst':>8}{'mean':>8}"


def line(name, s):
    """One row under HEADER."""
    return (f"{name:24}{s['seconds']:9.2f}{s['tets']:12,}{s['tets_per_second']:10,.0f}"
            f"{s['peak_bytes'] / 1e6:8.0f}{s['bytes_per_tet']:7.0f}{s['worst_quality']:8.4f}"
            f"{s['mean_quality']:8.4f}" + ("" if s["sound"] else "  NOT SOUND"))


def default_program():
    """The release build of this checkout."""
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    return os.path.join(root, "build", "release", "bin", "cavea")


def box_diagonal(name):
    """Of the vertices of a Medit text file."""
    with open(name, encoding="ascii") as file:
        words = iter(file.read().split())
    next(word for word in words if word == "Vertices")
    points = [[float(next(words)) for _ in range(4)] for _ in range(int(next(words)))]
    axes = list(zip(*points))[:3]
    return math.dist([min(axis) for axis in axes], [max(axis) for axis in axes])


def write_kuhn_cube(name, n):
    """The unit cube in n^3 bricks of six tets each, as a Medit file."""
    m = n + 1
    paths = [(1, 2, 4), (1, 4, 2), (2, 1, 4), (2, 4, 1), (4, 1, 2), (4, 2, 1)]
    even = {(1, 2, 4), (2, 4, 1), (4, 1, 2)}

    def vertex(i, j, k, corner):
        return 1 + i + (corner & 1) + m * (j + (corner >> 1 & 1) + m * (k + (corner >> 2)))

    with open(name, "w", encoding="ascii") as file:
        file.write(f"MeshVersionFormatted 2\nDimension 3\nVertices\n{m**3}\n")
        for k in range(m):
            for j in range(m):
                for i in range(m):
                    file.write(f"{i / n!r} {j / n!r} {k / n!r} 0\n")
        file.write(f"Tetrahedra\n{6 * n**3}\n")
        for k in range(n):
            for j in range(n):
                for i in range(n):
                    for path in paths:
                        a = vertex(i, j, k, 0)
                        b = vertex(i, j, k, path[0])
                        c = vertex(i, j, k, path[0] | path[1])
                        d = vertex(i, j, k, 7)
                        if path not in even:
                            b, c = c, b
                        file.write(f"{a} {b} {c} {d} 1\n")
        file.write("End\n")


def write_sphere_sizes(name, n):
    """Sizes at the vertices of that cube: small at a sphere, and larger by a fifth of the way off."""
    with open(name, "w", encoding="ascii") as file:
        file.write(f"MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n{(n + 1)**3}\n1 1\n")
        for k in range(n + 1):
            for j in range(n + 1):
                for i in range(n + 1):
                    off = abs(math.dist((i / n, j / n, k / n), (0.5, 0.5, 0.5)) - 0.3)
                    file.write(f"{min(0.1, 0.01 + 0.2 * off)!r}\n")
        file.write("End\n")
