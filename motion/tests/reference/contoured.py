"""Writes least times over contoured corners: python contoured.py [COUNT] > ../data/contoured.csv

Needs what optimum.py needs. COUNT random contours of lines (default 60) on two machines, each corner replaced by the curve of
G261 with PATH_DEV: two polynomials of fourth order per axis, P = C - d alpha u1 + d beta u2 with alpha = 1 - x + x^3/4 - x^4/16
and beta = x^3/4 - x^4/16 up to the middle, mirrored behind it; d = 8/3 PATH_DEV / sin(theta / 2), at most half a block. The
limits of the axes hold at every point of it: v |q'| <= vmax, v^2 |q''| <= acc, v^3 |q'''| <= acc / geom, a |q'| <= acc and
j |q'| <= acc / ramp. One row per contour: its name, the machine, the commanded speed in mm/s, PATH_DEV in mm, the points in mm,
the least time in s.
"""

import math
import sys

import numpy as np

from optimum import limits, solve
from table import CYCLE, DENSITY, MACHINES, log

# geometric ramp time in s
GEOM = 0.01
# parts of each half of a curve with limits of their own
CELLS = 40


def half(corner, d, u1, u2):
    """Lengths of the cells of the first half, and the first three derivatives by path length at their middles."""
    edges = np.linspace(0, 1, CELLS + 1)

    def slopes(x):
        beta = [0.75 * x**2 - 0.25 * x**3, 1.5 * x - 0.75 * x**2, 1.5 - 1.5 * x]
        alpha = [beta[0] - 1, beta[1], beta[2]]
        return [-d * np.outer(a, u1) + d * np.outer(b, u2) for a, b in zip(alpha, beta)]

    nodes, weights = np.polynomial.legendre.leggauss(6)
    length = np.zeros(CELLS)
    for node, weight in zip(nodes, weights):
        x = edges[:-1] + 0.5 * (1 + node) / CELLS
        length += 0.5 * weight / CELLS * np.linalg.norm(slopes(x)[0], axis=1)
    p1, p2, p3 = slopes(0.5 * (edges[:-1] + edges[1:]))
    r2 = (p1 * p1).sum(1)[:, None]
    p12, p22, p13 = ((a * b).sum(1)[:, None] for a, b in ((p1, p2), (p2, p2), (p1, p3)))
    first = p1 / np.sqrt(r2)
    second = p2 / r2 - p1 * p12 / r2**2
    third = p3 / r2 - 3 * p2 * p12 / r2**2 - p1 * (p22 + p13) / r2**2 + 4 * p1 * p12**2 / r2**3
    return length, first, second, third / np.sqrt(r2)


def contoured(points, feed, dev, machine):
    """The blocks of `solve`: lines, and the curves in cells."""
    acc, ramp, vmax = (np.array(machine[k], float) for k in ("acc", "ramp", "vmax"))
    points = np.asarray(points, float)
    ways = np.diff(points, axis=0)
    lines = np.linalg.norm(ways, axis=1)
    u = ways / lines[:, None]
    cut = np.zeros(len(points))
    for i in range(1, len(points) - 1):
        theta = math.acos(np.clip(u[i - 1] @ u[i], -1, 1))
        cut[i] = min(8 / 3 * dev / math.sin(theta / 2), 0.5 * lines[i - 1], 0.5 * lines[i])
    rows = []
    for i, line in enumerate(lines):
        left = line - cut[i] - cut[i + 1]
        if left > 1e-9:
            length, speed, a, j, _ = limits([[0, 0, 0], left * u[i]], [feed], machine)
            rows.append((length, speed, a, j))
        if i + 1 < len(lines):
            there = half(points[i + 1], cut[i + 1], u[i], u[i + 1])
            back = half(points[i + 1], cut[i + 1], -u[i + 1], -u[i])
            for h, way in ((there, 1), (back, -1)):
                length, first, second, third = (x[::way] for x in h)
                with np.errstate(divide="ignore"):
                    of = lambda limit, share: (limit / np.abs(share)).min(1)
                    speed = np.minimum(feed, of(vmax, first))
                    speed = np.minimum(speed, np.sqrt(of(acc, second)))
                    speed = np.minimum(speed, np.cbrt(of(acc / GEOM, third)))
                    rows.append((length, speed, of(acc, first), of(acc / ramp, first)))
    length, speed, a, j = (np.concatenate(x) for x in zip(*rows))
    cap = np.full(len(length) + 1, np.inf)
    cap[0] = cap[-1] = 0.0
    return length, speed, a, j, cap


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 60
    print("contour,machine,feed_mm_s,path_dev_mm,points_mm,least_s")
    rng = np.random.default_rng(17)
    for n in range(count):
        heading, at, points = rng.uniform(0, 6), np.zeros(3), [np.zeros(3)]
        for _ in range(rng.integers(2, 7)):
            heading += rng.choice([-1, 1]) * rng.uniform(0.2, 2.6)
            way = np.array([math.cos(heading), math.sin(heading), 0.3 * rng.uniform(-1, 1)])
            at = at + log(rng, 0.5, 30) * way / np.linalg.norm(way)
            points.append(at)
        points = np.round(points, 4)
        feed, dev = round(log(rng, 15, 400), 3), round(log(rng, 0.005, 1), 4)
        name = ("even", "mill")[n % 2]
        least = solve(contoured(points, feed, dev, {**MACHINES[name], "cycle": CYCLE}), DENSITY)
        text = ";".join(" ".join(f"{c:.4f}".rstrip("0").rstrip(".") for c in p) for p in points)
        print(f"{n},{name},{feed:g},{dev:g},{text},{least:.6f}", flush=True)


if __name__ == "__main__":
    main()
