"""A suite to a fragility: IDA, capacities, fit, test, the best measure.

usage: suite_to_fragility.py SUITE    (a folder of records, or an index)
"""

import sys

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt
import numpy as np
import rocking as rk

suite = rk.read_suite(sys.argv[1])
block = rk.Block(alpha=0.2, p=3.0)
ida = rk.ida(block, suite)
capacities = ida.capacities(np.inf)
fragility = rk.fit_fragility(capacities, shift=1.0, n_resamples=1000)
test = rk.lilliefors(capacities, shift=1.0)
low, high = fragility.confidence_interval("median")
print(f"{len(suite)} records, {ida.analyses} analyses")
print(f"median {fragility.median:.4f} ({low:.4f} to {high:.4f})")
print(f"beta {fragility.beta:.4f} above the shift {fragility.shift}")
print(f"lognormal: {test.verdict}, p {test.pvalue:.4f}")
for im in rk.rank_ims(ida, suite)[:3]:
    print(f"{im.name:>12}: beta {im.beta:.3f}")

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4))
for im, edp in zip(ida.im, ida.edp):
    left.plot(edp, im, color="0.6", linewidth=0.6)
left.set(xlabel="peak |theta|/alpha", ylabel="PGA/(g tan alpha)")
x = np.linspace(1.0, capacities.max(), 200)
steps = np.arange(1, len(suite) + 1) / len(suite)
right.step(np.sort(capacities), steps, color="0.6", where="post")
right.plot(x, fragility.cdf(x))
right.set(xlabel="PGA/(g tan alpha)", ylabel="P(overturning)")
figure.savefig("fragility.png")
