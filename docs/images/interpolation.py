#!/usr/bin/env python3
"""Draws the interpolation error before and after adaptation, as docs/paper.md shows it.

cavea_paper_adaptation | interpolation.py OUT.png: needs matplotlib.
"""

import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

run = json.load(sys.stdin)
steps = run["steps"]
fig, axes = plt.subplots(1, 2, figsize=(11, 4))
edges = [f"$10^{{{k}}}$" for k in range(-6, 2)]
for step, colour, label in ((steps[0], "#c0504d", "before"), (steps[-1], "#4f81bd", "after 4 steps")):
    bins = step["error"]["histogram"]
    shares = [100 * n / sum(bins) for n in bins]
    shift = -0.2 if step is steps[0] else 0.2
    axes[0].bar([k + shift for k in range(len(bins))], shares, 0.4, color=colour, label=label)
axes[0].set_xticks(range(len(edges)), edges)
axes[0].set_xlabel("largest error in a tetrahedron, from")
axes[0].set_ylabel("tetrahedra, %")
axes[0].legend()
axes[1].semilogy([s["error"]["worst"] for s in steps], "o-", label="largest")
axes[1].semilogy([s["error"]["mean"] for s in steps], "s-", label="mean over the volume")
axes[1].axhline(run["eps_m"], color="grey", ls="--", label="wanted bound")
axes[1].set_xticks(range(len(steps)))
axes[1].set_xlabel("step of adaptation")
axes[1].set_ylabel("interpolation error")
axes[1].legend()
fig.tight_layout()
fig.savefig(sys.argv[1], dpi=110)
