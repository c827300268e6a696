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
# # One block under one motion
#
# A free-standing block, 0.3 m wide and 1.5 m high, stands on a rigid floor.
# What does it do when the floor moves, and how sure is the answer?

# %%
import matplotlib.pyplot as plt
import numpy as np
import rocking as rk

block = rk.Block.from_dimensions(width_m=0.3, height_m=1.5)
block

# %% [markdown]
# `alpha` is the slenderness angle in rad. `p` is the frequency parameter in
# rad/s: the larger the block, the smaller its `p`.
#
# ## A pulse
#
# The floor makes one sine of acceleration, at three amplitudes. The
# coefficient of restitution is Housner's. Rotations are divided by `alpha`:
# at 1 the centre of mass is above the pivot, and the block overturns.

# %%
sine = rk.Pulse("one-sine", amplitude_g=0.4, omega=12.0)
figure, axes = plt.subplots(figsize=(7, 3.5))
for scale in (0.8, 1.0, 1.2):
    found = rk.respond(
        block, sine, eta="housner", scale=scale, history_dt=0.005
    )
    theta = found.to_pandas()["theta"] / block.alpha
    label = f"{scale * sine.pga_g:.2f} g: {found.outcome}"
    axes.plot(theta.index, theta, label=label)
    print(f"{label}, peak |theta|/alpha {found.peak_ratio:.6g}", end="")
    print("" if found.resolved else " (unresolved)")
axes.set(xlabel="t, s", ylabel="theta/alpha", ylim=(-1.2, 1.2))
axes.legend()
plt.show()

# %% [markdown]
# `resolved` says whether rounding could have changed the outcome or the peak.
# Where it could, `respond(..., certify=True)` decides in wider arithmetic.
#
# ## A record
#
# Records come from arrays, from files (`read_record`) and from objects of
# ObsPy, eqsig and pandas (`Record.of`). Arrays do not say their unit, so you
# do. This one is made here: thirty waves of 1 to 8 Hz that swell and fade.

# %%
dt = 0.01
t = np.arange(0.0, 20.0, dt)
frequencies = np.geomspace(1.0, 8.0, 30)
phases = np.arange(30.0) ** 2
waves = np.sin(2.0 * np.pi * np.outer(t, frequencies) + phases)
swell = (t / 4.0) ** 2 * np.exp(2.0 - t / 2.0)
acc = swell * waves.sum(axis=1)
record = rk.Record(acc, dt, units="m/s2", name="made here")
record

# %% [markdown]
# The block lifts off where the acceleration passes g tan(alpha), the dashed
# lines.

# %%
pga_g = 0.45
shaken = rk.respond(block, record, pga_g=pga_g, history_dt=dt)
time, theta, _ = shaken.history.T
figure, (above, below) = plt.subplots(2, sharex=True, figsize=(7, 4.5))
above.plot(record.t, record.acc_g * pga_g / record.pga_g, "0.4", linewidth=0.7)
for side in (-1.0, 1.0):
    level = side * np.tan(block.alpha)
    above.axhline(level, color="k", linestyle="--", linewidth=0.7)
above.set(ylabel="a/g")
below.plot(time, theta / block.alpha)
below.set(xlabel="t, s", ylabel="theta/alpha")
plt.show()
print(f"{shaken.outcome}, {len(shaken.impacts)} impacts")

# %% [markdown]
# ## A rocking spectrum
#
# This is the peak rotation of blocks of one slenderness and many sizes under
# the same record. Small blocks, on the left, overturn: there is no line. As a
# rule, the larger the block, the less it rotates. Makris and Konstantinidis
# (2003) draw the abscissa as 2 pi/p.

# %%
size = np.linspace(1.0, 6.0, 200)
figure, axes = plt.subplots(figsize=(7, 3.5))
for pga_g in (0.3, 0.45, 0.6):
    peaks = rk.rocking_spectrum(
        record,
        alpha=block.alpha,
        p=2.0 * np.pi / size,
        level=pga_g / record.pga_g,
    )
    peaks[np.isinf(peaks)] = np.nan
    axes.plot(size, peaks, label=f"PGA {pga_g:g} g")
axes.set(xlabel="2 pi/p, s", ylabel="peak |theta|/alpha", ylim=(0.0, 1.0))
axes.legend()
plt.show()
