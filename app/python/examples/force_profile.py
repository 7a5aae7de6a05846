#!/usr/bin/env python3
"""Strokes across a ridge and plots the force against the hand.

    PYTHONPATH=build/release/python python3 app/python/examples/force_profile.py [PICTURE]
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

import dibhr

y, x = np.mgrid[0:120, 0:320]
depth = 0.3 + 0.15 * np.exp(-(((x - 160) / 40) ** 2))  # times the parameter `relief`, 255 px
surface = dibhr.Surface(depth)

x, y = np.linspace(20, 300, 2000), np.full(2000, 60.3)
elevation = dibhr.Renderer(surface).elevation(x, y)
goals = np.column_stack([x, y, elevation - 8])

figure, (relief, profile) = plt.subplots(2, sharex=True, figsize=(8, 6))
relief.plot(x, elevation, "k", label="surface")
relief.plot(x, goals[:, 2], "k:", label="goal")
for friction in (0.0, 0.2, 0.4):
    rows = dibhr.Renderer(surface, friction=friction, stiffness=0.8).run(goals)
    profile.plot(rows["gx"], rows["fx"], label=f"friction {friction}")
relief.set(ylabel="elevation [px]", title="a stroke to the right")
profile.set(xlabel="x of the goal [px]", ylabel="spring force along x [N]")
relief.legend()
profile.legend()
plt.savefig(sys.argv[1]) if len(sys.argv) > 1 else plt.show()
