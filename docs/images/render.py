#!/usr/bin/env python3
"""Draws meshes side by side, cut open so that their tetrahedra are seen.

Needs numpy and matplotlib. Reads Medit text files. The picture in README.md is the sample and what
tools/quickstart makes of it (written as .mesh): render.py sample.png before=A.mesh after=B.mesh.
docs/implicit.md tells how its picture was made.
"""

import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # noqa: E402

FACES = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))
VIEW = (24, -62)  # elevation and azimuth in degrees
CUT = 0.5  # tets whose centre lies below this share of the width are taken away
SIZE = (14, 7)  # inches
# Of surfaces, by reference of the tet.
COLOURS = {1: (0.55, 0.68, 0.83), 2: (0.93, 0.75, 0.42), 3: (0.55, 0.68, 0.83),
           4: (0.62, 0.78, 0.56)}
# Of faces that the cut laid open.
INSIDE = {1: (0.90, 0.93, 0.97), 2: (0.99, 0.93, 0.80), 3: (0.80, 0.87, 0.95),
          4: (0.83, 0.93, 0.78)}


def read(name):
    """Vertices, tets (from 0) and their references of a Medit text file."""
    with open(name, encoding="ascii") as file:
        words = file.read().split()
    vertices = words.index("Vertices")
    n = int(words[vertices + 1])
    points = np.array(words[vertices + 2 : vertices + 2 + 4 * n], dtype=float).reshape(n, 4)[:, :3]
    tets = words.index("Tetrahedra")
    n = int(words[tets + 1])
    rows = np.array(words[tets + 2 : tets + 2 + 5 * n], dtype=int).reshape(n, 5)
    return points, rows[:, :4] - 1, rows[:, 4]


def surface(tets):
    """(tet, vertices) of all faces that belong to one tet only."""
    faces = np.concatenate([tets[:, f] for f in FACES])
    owner = np.tile(np.arange(len(tets)), 4)
    keys = np.sort(faces, axis=1)
    _, index, counts = np.unique(keys, axis=0, return_index=True, return_counts=True)
    return owner[index[counts == 1]], faces[index[counts == 1]], keys[index[counts == 1]]


def shade(normals):
    light = np.array([0.35, -0.75, 0.56])
    return 0.62 + 0.38 * np.clip(normals @ light, 0, 1)


def draw(axes, name, title, whole):
    points, tets, refs = read(name)
    if whole:
        points = points[:, (0, 2, 1)] * (1, -1, 1)
    outer = {tuple(key) for key in surface(tets)[2]}
    centres = points[tets].mean(axis=1)
    low, high = points.min(axis=0), points.max(axis=0)
    kept = (centres[:, 1] > low[1] + CUT * (high[1] - low[1])) | whole
    tets, refs = tets[kept], refs[kept]
    owner, faces, keys = surface(tets)
    corners = points[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    base = np.array([(COLOURS if tuple(k) in outer else INSIDE)[refs[t]]
                     for t, k in zip(owner, keys)])
    colours = base * shade(normals)[:, None]
    axes.add_collection3d(Poly3DCollection(corners, facecolors=colours, edgecolors=(0.1, 0.15, 0.25),
                                           linewidths=0.25))
    for set_limits, a, b in zip((axes.set_xlim, axes.set_ylim, axes.set_zlim), low, high):
        set_limits(a, b)
    axes.set_box_aspect(high - low, zoom=1.15)
    axes.view_init(*VIEW)
    axes.set_axis_off()
    axes.set_title(title, fontsize=13, y=1.02)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", metavar="OUT.png")
    parser.add_argument("meshes", metavar="TITLE=MESH", nargs="+")
    parser.add_argument("--whole", type=int, nargs="*", default=[], metavar="K",
                        help="the K-th mesh, from 1, stands along y and is not cut open")
    arguments = parser.parse_args()
    figure = plt.figure(figsize=SIZE)
    for place, mesh in enumerate(arguments.meshes, 1):
        title, name = mesh.split("=", 1)
        axes = figure.add_subplot(1, len(arguments.meshes), place, projection="3d")
        draw(axes, name, title, place in arguments.whole)
    figure.tight_layout()
    figure.savefig(arguments.out, dpi=100, facecolor="white", bbox_inches="tight")


if __name__ == "__main__":
    main()
