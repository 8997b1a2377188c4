"""Jerk-limited least time along a row of straight blocks, by convex programming; shares no code with the planner.

Unknowns are the squares q of the path speed on a grid in s. Between two nodes the acceleration is constant,
a = dq / 2h, and takes the time tau = 2h / (sqrt q1 + sqrt q2), a convex function of q. At a node the acceleration may
change by the jerk times the half intervals on both sides, each with the jerk of its block:

    |a2 - a1| <= (j1 tau1 + j2 tau2) / 2

tau on the right side is replaced by its tangent, which lies below it: every solution keeps the limits of the grid, and
the next tangent is taken there until the time stays (successive convexification). The solver is Clarabel.

The limits are those of the axes (TF5200 look-ahead functions; kink: dv <= w a T, with w T = `jump`; kinks within one cycle together).
"""

import math

import clarabel
import numpy as np
from scipy import sparse


def limits(points, feeds, machine):
    """Length, speed, acceleration and jerk of every block, and the speed allowed at every point."""
    acc, ramp, vmax = (np.array(machine[k], float) for k in ("acc", "ramp", "vmax"))
    jump_s, cycle = machine["jump"], machine["cycle"]
    d = np.diff(np.asarray(points, float), axis=0)
    length = np.sqrt((d * d).sum(1))
    u = d / length[:, None]
    with np.errstate(divide="ignore"):
        share = 1.0 / np.abs(u)
    speed = np.minimum(np.asarray(feeds, float), (vmax * share).min(1))
    a, j = (acc * share).min(1), (acc / ramp * share).min(1)
    n = len(length)
    cap = np.full(n + 1, np.inf)
    cap[0] = cap[n] = 0.0

    def jump(first, last):
        turn = np.abs(u[last] - u[first])
        with np.errstate(divide="ignore"):
            return (acc * jump_s / np.where(turn > 1e-9, turn, 0.0)).min()

    for i in range(1, n):
        cap[i] = 0.0 if u[i - 1] @ u[i] <= -1 + 1e-12 else jump(i - 1, i)
    kink = [i for i in range(1, n) if np.abs(u[i] - u[i - 1]).max() > 1e-9]
    # kinks that fall into one cycle are one jump
    for n2, last in enumerate(kink):
        for first in reversed(kink[:n2]):
            apart = length[first:last].sum() / cycle
            if apart >= min(speed[first - 1 : last + 1].max(), cap[first], cap[last]):
                break
            together = max(jump(first - 1, last), apart)
            cap[first], cap[last] = min(cap[first], together), min(cap[last], together)
    return length, speed, a, j, cap


def grid(blocks, density):
    """Nodes closer to the ends of a block, where the speed may be low: s ~ t^3; `density` of them per ramp."""
    length, speed, acc, jerk, cap = blocks
    ends = np.minimum(cap, np.minimum(np.append(speed, np.inf), np.insert(speed, 0, np.inf)))
    q = second_order(ends**2, acc, length)
    steps, block = [], []
    for i in range(len(length)):
        # least time of the block without a jerk limit
        top = min(speed[i] ** 2, 0.5 * (q[i] + q[i + 1]) + acc[i] * length[i])
        time = length[i] / math.sqrt(top)
        count = density * time * jerk[i] / acc[i]
        slow = min(q[i], q[i + 1]) < 0.25 * top
        count = int(np.clip(math.ceil(count), density // 2 if slow else density // 6, 4 * density))
        x = np.linspace(0, 1, count + 1)
        s = length[i] * (x**3 * (10 - 15 * x + 6 * x * x) if slow else x)
        steps.append(np.diff(s))
        block.append(np.full(count, i))
    return np.concatenate(steps), np.concatenate(block)


def second_order(limit, a, h):
    """Squares of the fastest speeds without a jerk limit."""
    q = limit.copy()
    for k in range(len(h) - 1, -1, -1):
        q[k] = min(q[k], q[k + 1] + 2 * a[k] * h[k])
    for k in range(len(h)):
        q[k + 1] = min(q[k + 1], q[k] + 2 * a[k] * h[k])
    return q


def solve(blocks, density, rounds=40, tol=2e-6, profile=False):
    """Least time in s with about `density` intervals per ramp."""
    length, speed, acc, jerk, cap = blocks
    h, block = grid(blocks, density)
    n = len(h)
    a, j = acc[block], jerk[block]
    ends = np.concatenate([[0], np.flatnonzero(np.diff(block)) + 1, [n]])
    limit = np.full(n + 1, np.inf)
    limit[:-1] = speed[block] ** 2
    limit[1:] = np.minimum(limit[1:], speed[block] ** 2)
    limit[ends] = np.minimum(limit[ends], cap**2)
    q = second_order(limit, a, h)
    scale = max(q.max(), 1e-12)
    last = math.inf
    for _ in range(rounds):
        q = step(q, limit, h, a, j, scale)
        time = (2 * h / (np.sqrt(q[:-1]) + np.sqrt(q[1:]))).sum()
        if last - time <= tol * time and time <= last * (1 + tol):
            break
        last = time
    return (time, np.concatenate([[0], np.cumsum(h)]), np.sqrt(q)) if profile else time


def step(qbar, limit, h, a, j, scale):
    """Solution of the problem with the tangents at `qbar`."""
    n = len(h)
    floor = 1e-14 * scale
    v = np.sqrt(np.maximum(qbar, floor))
    tau = 2 * h / (v[:-1] + v[1:])
    # unknowns: q / scale, r = sqrt(q / scale), T / tau, acceleration / limit
    root = math.sqrt(scale)
    iq, ir, it = np.arange(n + 1), n + 1 + np.arange(n + 1), 2 * (n + 1) + np.arange(n)
    ia = 3 * n + 2 + np.arange(n)
    m = 4 * n + 2
    rows, cols, vals, rhs, cones = [], [], [], [], []
    top = 0

    def put(r, c, x):
        rows.append(np.broadcast_to(np.asarray(r), np.broadcast(r, c).shape).ravel())
        cols.append(np.broadcast_to(np.asarray(c), np.broadcast(r, c).shape).ravel())
        vals.append(np.broadcast_to(np.asarray(x, float), np.broadcast(r, c).shape).ravel())

    def need(count, b, cone):
        nonlocal top
        at = top + np.arange(count)
        rhs.append(np.broadcast_to(np.asarray(b, float), (count,)))
        top += count
        cones.append(cone(count))
        return at

    # fixed ends
    fixed = np.array([0, n])
    at = need(2, limit[fixed] / scale, clarabel.ZeroConeT)
    put(at, iq[fixed], 1.0)
    inner = np.arange(1, n)
    at = need(n - 1, limit[inner] / scale, clarabel.NonnegativeConeT)
    put(at, iq[inner], 1.0)
    # dq = 2 a h
    size = 2 * a * h / scale
    weight = np.maximum(size, np.maximum(qbar[1:], floor) / scale)
    at = need(n, 0.0, clarabel.ZeroConeT)
    put(at, iq[1:], 1 / weight)
    put(at, iq[:-1], -1 / weight)
    put(at, ia, -size / weight)
    for sign in (1.0, -1.0):
        at = need(n, 1.0, clarabel.NonnegativeConeT)
        put(at, ia, sign)
        # jerk: sign (a2 - a1) - tangents of (j1 tau1 + j2 tau2) / 2 <= 0; a = 0 beyond the ends
        half = 0.5 * j * tau
        slope = -0.5 * j * h / (v[:-1] + v[1:]) ** 2  # times 1/v: derivative by q of either end
        d0, d1 = slope / v[:-1], slope / v[1:]
        const = half - d0 * np.maximum(qbar[:-1], floor) - d1 * np.maximum(qbar[1:], floor)
        k = np.arange(n + 1)
        size = np.zeros(n + 1)
        size[:-1] += half
        size[1:] += half
        b = np.zeros(n + 1)
        b[:-1] += const
        b[1:] += const
        at = need(n + 1, b / size, clarabel.NonnegativeConeT)
        right, left = k[:-1], k[1:]
        # interval k is to the right of node k and to the left of node k + 1
        for node, way in ((right, 1.0), (left, -1.0)):
            put(at[node], iq[:-1], -d0 * scale / size[node])
            put(at[node], iq[1:], -d1 * scale / size[node])
            put(at[node], ia, sign * way * a / size[node])
    linear = top
    # r^2 <= q: |(2 r, q - 1)| <= q + 1, scaled by the present value
    w = np.maximum(qbar, floor) / scale
    at = linear + 3 * np.arange(n + 1)
    b = np.stack([w, -w, np.zeros(n + 1)], 1).ravel()
    put(at, iq, -1.0)
    put(at + 1, iq, -1.0)
    put(at + 2, ir, -2 * np.sqrt(w))
    rhs.append(b)
    cones += [clarabel.SecondOrderConeT(3)] * (n + 1)
    top += 3 * (n + 1)
    # T (r1 + r2) >= 2 h, T in tau and r1 + r2 in its present value: x y >= 1
    pair = (v[:-1] + v[1:]) / root
    at = top + 3 * np.arange(n)
    for k, y in ((0, 1.0), (1, -1.0)):
        put(at + k, it, -1.0)
        put(at + k, ir[:-1], -y / pair)
        put(at + k, ir[1:], -y / pair)
    rhs.append(np.tile([0.0, 0.0, 2.0], n))
    cones += [clarabel.SecondOrderConeT(3)] * n
    top += 3 * n
    matrix = sparse.csc_matrix(
        (np.concatenate(vals), (np.concatenate(rows), np.concatenate(cols))), shape=(top, m)
    )
    cost = np.zeros(m)
    cost[it] = tau / tau.sum()
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.tol_gap_abs = settings.tol_gap_rel = 1e-8
    solution = clarabel.DefaultSolver(
        sparse.csc_matrix((m, m)), cost, matrix, np.concatenate(rhs), cones, settings
    ).solve()
    if str(solution.status) not in ("Solved", "AlmostSolved"):
        raise ArithmeticError(f"{solution.status}")
    q = np.maximum(np.array(solution.x[: n + 1]) * scale, 0.0)
    q[0], q[n] = limit[0], limit[n]
    return q
