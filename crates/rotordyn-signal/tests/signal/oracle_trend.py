"""scipy's Kendall test and Theil-Sen slope, for tests/signal/oracle_trend.rs.

python3 oracle_trend.py > ../data/scipy_trend.json
"""

import json
from math import erfc, sqrt

import numpy as np
from scipy import stats


def noise(seed, n):
    """The generator of tests/signal/main.rs."""
    state, out = seed, []
    for _ in range(n):
        state = (state * 1664525 + 1013904223) % 2**32
        out.append(state / 2.0**31 - 1.0)
    return np.array(out)


def case(x, y, exact):
    found = stats.kendalltau(x, y, method="exact" if exact else "asymptotic")
    p = float(found.pvalue)
    if not exact:
        # scipy has no continuity correction: S from its z, then (|S| - 1).
        n = len(x)
        s = sum(np.sign(x[j] - x[i]) * np.sign(y[j] - y[i]) for i in range(n) for j in range(i + 1, n))
        z = stats.norm.isf(p / 2.0)
        p = erfc(z * (abs(s) - 1.0) / abs(s) / sqrt(2.0))
    slope, _, low, high = stats.theilslopes(y, x, alpha=0.95)
    return {"tau": found.statistic, "p": p, "slope": slope, "low": low, "high": high}


index = np.arange(60.0)
times = np.cumsum(1.0 + 0.5 * noise(3, 60))
print(
    json.dumps(
        {
            "exact": case(times[:12], 0.2 * index[:12] + noise(5, 12), True),
            "none": case(index[:9], noise(6, 9), True),
            "normal": case(times, 0.02 * index + noise(7, 60), False),
            # Loads and values that repeat.
            "ties": case(np.floor(index[:40] / 10.0), np.round(0.03 * index[:40] + noise(8, 40), 1), False),
        },
        indent=1,
    )
)
