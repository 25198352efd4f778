"""Poincaré sections of the two equations of models/varying_compliance.toml, by classical Runge-Kutta with 200 steps a
ball passage: m x'' + c x' = -K sum <d_j>^1.5 cos psi_j, m y'' + c y' = -K sum <d_j>^1.5 sin psi_j - m g,
d_j = x cos psi_j + y sin psi_j - clearance/2. Independent of the program: nothing here comes from it.

    python3 varying_compliance.py > varying_compliance.json
"""

import json

import numpy as np

BALLS, STIFFNESS, MASS, DAMPING, GRAVITY, CLEARANCE = 8, 1.334e10, 20.0, 200.0, 9.8, 40e-6
CAGE = 0.385577
STEPS = 200


def sections(rpm, settle, points):
    passage = 2 * np.pi / BALLS
    h = passage / (CAGE * rpm * 2 * np.pi / 60) / STEPS
    at = 2 * np.pi * np.arange(BALLS) / BALLS

    def rate(psi, s):
        cos, sin = np.cos(psi + at), np.sin(psi + at)
        load = STIFFNESS * np.maximum(s[0] * cos + s[1] * sin - CLEARANCE / 2, 0.0) ** 1.5
        return np.array([
            s[2], s[3],
            (-(load @ cos) - DAMPING * s[2]) / MASS,
            (-(load @ sin) - DAMPING * s[3]) / MASS - GRAVITY,
        ])

    s, out = np.array([0.0, -CLEARANCE / 2 - 6e-6, 0.0, 0.0]), []
    for n in range(settle + points):
        if n >= settle:
            out.append(s[:2].tolist())
        for k in range(STEPS):
            psi, d = k * passage / STEPS, passage / STEPS
            a = rate(psi, s)
            b = rate(psi + d / 2, s + h / 2 * a)
            c = rate(psi + d / 2, s + h / 2 * b)
            e = rate(psi + d, s + h * c)
            s = s + h / 6 * (a + 2 * b + 2 * c + e)
    return out


if __name__ == "__main__":
    cases = {}
    for rpm, settle, points in [(1600, 500, 16), (1800, 600, 16), (3300, 1000, 16), (3500, 1000, 16), (2300, 400, 300)]:
        cases[str(rpm)] = sections(rpm, settle, points)
    print(json.dumps({"numpy": np.__version__, "sections": cases}))
