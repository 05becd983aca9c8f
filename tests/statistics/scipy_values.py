#!/usr/bin/env python3
"""Writes scipy_values.json: samples and what scipy makes of them, with which src/lab/statistics/tests.rs compares.

    python3 -m venv /tmp/scipy && /tmp/scipy/bin/pip install -r tests/statistics/requirements.txt
    /tmp/scipy/bin/python tests/statistics/scipy_values.py

What scipy has no function for (Newcombe's interval, Noether's number of pairs, the sequential test) is derived here a second time, by
other means than in the program: a root finder, an integral, a sum over all pairs.
"""

import itertools
import json
from pathlib import Path

import numpy as np
from scipy import integrate, optimize, stats
from scipy.stats._resampling import _bca_interval

LARGE = np.random.default_rng(2001)


def samples():
    """Paired differences: without and with ties and zeros, small and large, skewed, integer and not."""
    draw = LARGE
    return {
        "two": [0.5, -0.25],
        "three": [1.0, 2.0, 3.5],
        "without ties": [0.3, -1.2, 2.5, 0.7, -0.1, 1.9, 3.3, -2.2, 0.9, 1.4],
        "all above": [0.1, 0.2, 0.4, 0.8, 1.6, 3.2],
        "ties": [1, 1, -1, 2, 2, -2, 3, 1, -1, 4, 1],
        "ties and zeros": [0, 1, -1, 0, 2, 1, -1, 3, 0, 1, 1, -2],
        "zeros but one": [0, 0, 0, 0, 2],
        "balanced": [1, -1, 2, -2, 3, -3],
        "fifty without ties": draw.normal(0.2, 1.0, 50).round(6).tolist(),
        "goals": (draw.poisson(1.5, 40) - draw.poisson(1.1, 40)).tolist(),
        "many goals": (draw.poisson(1.5, 200) - draw.poisson(1.3, 200)).tolist(),
        "skewed": draw.exponential(1.0, 60).round(6).tolist(),
        "rare": draw.poisson(0.05, 300).tolist(),
        "large": draw.normal(-0.05, 2.0, 1000).round(4).tolist(),
        "far off": (1e6 + draw.normal(0, 1, 30)).round(6).tolist(),
    }


def averages(values):
    x = np.asarray(values, float)
    error = stats.sem(x)
    return {
        "mean": x.mean(),
        "median": np.median(x),
        "quantiles": [[share, np.quantile(x, share)] for share in (0.0, 0.3, 0.95, 1.0)],
        "deviation": x.std(ddof=1),
        "intervals": [[level, *stats.t.interval(level, len(x) - 1, x.mean(), error)] for level in (0.8, 0.95, 0.999)],
    }


def signed_rank(values):
    x = np.asarray(values, float)
    kept = x[x != 0]
    ranks = stats.rankdata(abs(kept))
    above, below = ranks[kept > 0].sum(), ranks[kept < 0].sum()
    found = {
        "count": len(kept),
        "above": above,
        "below": below,
        "rank_biserial": (above - below) / (above + below),
        "normal": stats.wilcoxon(x, correction=True, method="asymptotic").pvalue,
    }
    if 2 <= len(kept) <= 12:
        # All choices of signs; with ties as well.
        found["exact"] = stats.wilcoxon(kept, method=stats.PermutationMethod(n_resamples=np.inf)).pvalue
    elif len(kept) <= 50 and len(set(ranks)) == len(ranks):
        found["exact"] = stats.wilcoxon(kept, method="exact").pvalue
    return found


def bca(values, name, level):
    x = np.asarray(values, float)
    statistic = {"mean": np.mean, "median": np.median}[name]
    resamples = statistic(LARGE.choice(x, (199, len(x))), axis=1)
    with np.errstate(all="ignore"):
        low, high, _ = _bca_interval((x,), statistic, -1, (1 - level) / 2, resamples, None, np)
    if not (np.isfinite(low) and np.isfinite(high)):
        return None
    ends = [np.quantile(resamples, float(np.squeeze(at))) for at in (low, high)]
    tail = (1 - level) / 2
    percentile = np.quantile(resamples, [tail, 1 - tail]).tolist()
    # As texts: readers of JSON may miss the last bit of a number, and resamples that are equal to the statistic count half.
    written = [repr(value) for value in resamples.tolist()]
    return {"statistic": name, "level": level, "resamples": written, "low": ends[0], "high": ends[1], "percentile": percentile}


def equivalence(values, margin):
    x = np.asarray(values, float)
    too_low = stats.ttest_1samp(x, -margin, alternative="greater").pvalue
    too_high = stats.ttest_1samp(x, margin, alternative="less").pvalue
    low, high = stats.ttest_1samp(x, 0).confidence_interval(0.9)
    return {"margin": margin, "p": max(too_low, too_high), "low": low, "high": high}


def newcombe(first, second, level):
    """Newcombe's method 5, by a root finder; the share itself is Mann and Whitney's U."""
    m, n = len(first), len(second)
    share = stats.mannwhitneyu(first, second).statistic / (m * n)
    z = stats.norm.ppf(0.5 + level / 2)

    def off(at, sign):
        star = (m + n) / 2 - 1
        variance = at * (1 - at) * (1 + star * (1 - at) / (2 - at) + star * at / (1 + at)) / (m * n)
        return at + sign * z * variance**0.5 - share

    # Of a share of 0 or 1 the share itself is a root, and not the one that is meant.
    low = optimize.brentq(off, 0, share - 1e-9, (1,), xtol=1e-13) if share > 0 else 0.0
    high = optimize.brentq(off, share + 1e-9, 1, (-1,), xtol=1e-13) if share < 1 else 1.0
    return {"first": first, "second": second, "level": level, "share": share, "low": low, "high": high}


def improvement_of_pairs(values, level):
    """Wilson's interval by a root finder, with a draw as half a win."""
    x = np.asarray(values, float)
    share, z = ((x > 0).sum() + (x == 0).sum() / 2) / len(x), stats.norm.ppf(0.5 + level / 2)

    def off(at, sign):
        return at + sign * z * (at * (1 - at) / len(x)) ** 0.5 - share

    low = optimize.brentq(off, 0, share - 1e-12, (1,), xtol=1e-14) if share > 0 else 0.0
    high = optimize.brentq(off, share + 1e-12, 1, (-1,), xtol=1e-14) if share < 1 else 1.0
    return {"level": level, "share": share, "low": low, "high": high}


def proportions():
    for won, of in [(0, 1), (1, 1), (0, 10), (5, 10), (10, 10), (1, 29), (81, 263), (98, 100), (1999, 2000), (2500, 5000)]:
        for level in (0.8, 0.95, 0.99):
            test = stats.binomtest(won, of)
            wilson, exact = (test.proportion_ci(level, method) for method in ("wilson", "exact"))
            yield {"won": won, "of": of, "level": level, "wilson": list(wilson), "exact": list(exact)}


def t_power(effect, pairs, level):
    reach = stats.t.ppf(0.5 + level / 2, pairs - 1)
    off = effect * pairs**0.5
    return stats.nct.sf(reach, pairs - 1, off) + stats.nct.cdf(-reach, pairs - 1, off)


def powers():
    for effect, pairs, level in itertools.product((0.1, 0.25, 0.5, 1.0, 2.5), (2, 3, 5, 20, 100, 1000), (0.95, 0.99)):
        power = t_power(effect, pairs, level)
        if np.isfinite(power):
            yield {"effect": effect, "pairs": pairs, "level": level, "power": power}


def numbers_of_pairs():
    for effect, power, level in itertools.product((0.1, 0.2, 0.5, 0.8, 1.5), (0.8, 0.95), (0.95, 0.99)):
        pairs = next(n for n in itertools.count(2) if t_power(effect, n, level) >= power)
        yield {"effect": effect, "power": power, "level": level, "pairs": pairs}


def wilcoxon_pairs(values, power, level):
    x = np.asarray(values, float)
    sums = [a + b for a, b in itertools.combinations(x.tolist(), 2)]
    share = np.mean([1.0 if s > 0 else 0.5 if s == 0 else 0.0 for s in sums])
    z = stats.norm.ppf(0.5 + level / 2) + stats.norm.ppf(power)
    pairs = z**2 / (3 * (share - 0.5) ** 2) if share != 0.5 else np.inf
    return {"share": share, "power": power, "level": level, "pairs": int(np.ceil(pairs)) if pairs <= 1e6 else None}


def sequential(met, of, threshold):
    """The logarithms of both ratios of the sequential test, by integrals."""

    def ratio(low, high):
        def weight(q):
            return stats.beta.pdf(q, 0.5, 0.5)

        def likelihood(q):
            log = met * np.log(q / threshold) + (of - met) * np.log((1 - q) / (1 - threshold))
            return np.exp(log) * weight(q)

        points = [at for at in (met / of,) if low < at < high]
        top = integrate.quad(likelihood, low, high, points=points or None, limit=500, epsabs=0, epsrel=1e-11)[0]
        return np.log(top / (stats.beta.cdf(high, 0.5, 0.5) - stats.beta.cdf(low, 0.5, 0.5)))

    is_above = met > threshold * of
    return {
        "met": met,
        "of": of,
        "threshold": threshold,
        "log_ratio": ratio(threshold, 1.0) if is_above else ratio(0.0, threshold),
    }


def plain(value):
    if isinstance(value, dict):
        return {key: plain(part) for key, part in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(part) for part in value]
    return value.item() if isinstance(value, np.generic) else value


def main():
    cases = []
    for name, values in samples().items():
        case = {"name": name, "values": [float(value) for value in values], "average": averages(values)}
        case["d_z"] = case["average"]["mean"] / case["average"]["deviation"]
        case["signed_rank"] = signed_rank(values)
        case["equivalence"] = [equivalence(values, margin) for margin in (0.3, 1.0)]
        case["wilcoxon_pairs"] = [wilcoxon_pairs(values, power, level) for power, level in ((0.8, 0.95), (0.9, 0.99))]
        case["improvement_of_pairs"] = [improvement_of_pairs(values, level) for level in (0.9, 0.95)]
        drawn = [bca(values, "mean", 0.95), bca(values, "median", 0.9)] if 3 <= len(values) <= 300 else []
        case["bca"] = [found for found in drawn if found]
        cases.append(case)
    groups = [
        ([1, 2, 3], [1, 2, 3]),
        ([3, 4, 5], [0, 1, 2]),
        ([0, 1], [2, 3, 4]),
        (LARGE.poisson(1.5, 30).tolist(), LARGE.poisson(1.1, 25).tolist()),
        (LARGE.normal(0, 1, 80).round(5).tolist(), LARGE.normal(0.4, 2, 60).round(5).tolist()),
    ]
    written = {
        "samples": cases,
        "improvements": [newcombe(a, b, level) for (a, b), level in itertools.product(groups, (0.9, 0.95))],
        "proportions": list(proportions()),
        "powers": list(powers()),
        "numbers_of_pairs": list(numbers_of_pairs()),
        "sequential": [
            sequential(met, of, threshold)
            for (met, of), threshold in itertools.product(
                [(1, 1), (0, 1), (9, 10), (10, 10), (50, 50), (45, 50), (190, 200), (400, 400), (3, 20)], (0.5, 0.9, 0.95)
            )
        ],
    }
    path = Path(__file__).with_name("scipy_values.json")
    rows = ",\n".join(
        f'"{group}": [\n' + ",\n".join(json.dumps(plain(row)) for row in rows) + "\n]" for group, rows in written.items()
    )
    path.write_text("{\n" + rows + "\n}\n")


main()
