"""Writes the table of least times: python table.py [COUNT] > ../data/optimum.csv

Needs numpy, scipy and clarabel. COUNT random contours of lines (default 200) on two machines, then surfaces, spirals and
polygons of a circle at F3000 to F30000. One row per contour: its name, the machine, the commanded speeds in mm/s (one
for all blocks, or one each), the points in mm, the least time in s.
"""

import math
import sys

import numpy as np

from optimum import limits, solve

# acceleration in mm/s2, ramp time in s, velocity in mm/s of X, Y, Z; `jump`: velocity jump of a kink over acceleration
MACHINES = {
    "even": {"acc": [1000.0] * 3, "ramp": [0.05] * 3, "vmax": [1000.0] * 3, "jump": 1e-3},
    "mill": {"acc": [4000.0, 3000.0, 800.0], "ramp": [0.02, 0.03, 0.08], "vmax": [1000.0, 1000.0, 300.0], "jump": 1e-3},
}
DENSITY = 32
# cycle time in s
CYCLE = 1e-4


def log(rng, low, high):
    return low * (high / low) ** rng.random()


def walk(rng, count, turn, low, high, slope):
    """Lines of random length that turn by at most `turn` and climb by at most `slope`."""
    heading, at, out = 0.0, np.zeros(3), [np.zeros(3)]
    for _ in range(count):
        heading += turn * rng.uniform(-1, 1)
        way = np.array([math.cos(heading), math.sin(heading), slope * rng.uniform(-1, 1)])
        at = at + log(rng, low, high) * way / np.linalg.norm(way)
        out.append(at)
    return out


def chamfered(rng):
    """Long lines with a tiny block between any two of them."""
    out = walk(rng, rng.integers(2, 6), 0.6, 2, 20, 0.3)
    points = [out[0]]
    for p in out[1:]:
        points += [p, p + log(rng, 0.005, 0.1) * rng.uniform(-1, 1, 3)]
    return points


def rounded(rng):
    """Lines whose corners are arcs in chords."""
    out, heading, at = [np.zeros(3)], 0.0, np.zeros(2)
    for _ in range(rng.integers(2, 5)):
        at = at + rng.uniform(1, 15) * np.array([math.cos(heading), math.sin(heading)])
        out.append([*at, 0.0])
        r, sweep = log(rng, 0.5, 8), rng.choice([-1, 1]) * rng.uniform(0.3, 2.5)
        n = max(2, math.ceil(r * abs(sweep) / log(rng, 0.1, 0.8)))
        for _ in range(min(n, 25)):
            heading += 0.5 * sweep / n
            at = at + 2 * r * math.sin(0.5 * abs(sweep) / n) * np.array([math.cos(heading), math.sin(heading)])
            heading += 0.5 * sweep / n
            out.append([*at, 0.0])
    return out


def random_contour(rng, n):
    kind = ("walk", "gentle", "chamfered", "rounded", "feeds")[n % 5]
    if kind == "walk":
        points = walk(rng, rng.integers(2, 10), 2.8, 0.05, 30, 0.3)
    elif kind == "gentle":
        points = walk(rng, rng.integers(4, 20), 0.2, 0.03, 8, 0.3)
    elif kind == "feeds":
        points = walk(rng, rng.integers(4, 15), 0.05, 0.1, 15, 0.1)
    else:
        points = chamfered(rng) if kind == "chamfered" else rounded(rng)
    points = np.round(points, 4)
    # no block without length
    points = points[np.insert(np.abs(np.diff(points, axis=0)).max(1) > 0, 0, True)]
    speed = log(rng, 15, 400)
    feeds = [speed]
    if kind == "feeds":
        feeds = [speed * log(rng, 0.1, 1) for _ in points[1:]]
    return kind, points, np.round(feeds, 3)


def spiral():
    phi, out = 0.0, []
    while 2 + phi < 9:
        r = 2 + phi
        out.append([r * math.cos(phi), r * math.sin(phi), 0.0])
        phi += 0.3 / r
    return out


def surface():
    """Two rows over a wavy surface, joined by a half circle."""
    z = lambda x, y: 1.5 * math.sin(0.4 * x) * math.cos(0.3 * y)
    out = [[0.25 * k, 0, z(0.25 * k, 0)] for k in range(81)]
    for k in range(1, 20):
        phi = math.pi * k / 20
        x, y = 20 + math.sin(phi), 1 - math.cos(phi)
        out.append([x, y, z(x, y)])
    return out + [[20 - 0.25 * k, 2, z(20 - 0.25 * k, 2)] for k in range(81)]


def circle(count):
    phi = np.linspace(0, 2 * math.pi, count + 1)
    return np.stack([8 * np.cos(phi), 8 * np.sin(phi), 0 * phi], 1)


def row(name, machine, points, feeds):
    m = MACHINES[machine]
    every = np.broadcast_to(feeds, (len(points) - 1,))
    least = solve(limits(points, every, {**m, "cycle": CYCLE}), DENSITY)
    if not math.isfinite(least):
        return  # a rest inside, on both sides of which the grid has no speed
    text = ";".join(" ".join(f"{c:.4f}".rstrip("0").rstrip(".") for c in p) for p in points)
    print(f"{name},{machine},{' '.join(f'{f:g}' for f in feeds)},{text},{least:.6f}", flush=True)


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    print("contour,machine,feeds_mm_s,points_mm,least_s")
    rng = np.random.default_rng(11)
    for n in range(count):
        kind, points, feeds = random_contour(rng, n)
        row(f"{kind} {n}", "even" if n // 5 % 2 else "mill", points, feeds)
    for name, points in (("spiral", spiral()), ("surface", surface()), ("circle 100", circle(100)), ("circle 400", circle(400))):
        for machine in MACHINES:
            for feed in (50.0, 100.0, 200.0, 500.0):
                row(f"{name} F{60 * feed:g}", machine, np.round(points, 4), [feed])


if __name__ == "__main__":
    main()
