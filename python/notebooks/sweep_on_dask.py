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
# # A sweep over many blocks on a Dask cluster
#
# Blocks do not depend on one another, so that a cluster can share them out.
# The package needs no code of its own for that: its functions are tasks as
# they are, and its results can be sent.
#
# Here the cluster is two processes on one machine. One of them will be killed
# in mid-run, and the answer will be the same, to the last bit.

# %%
import os
import signal

import matplotlib.pyplot as plt
import numpy as np
import rocking as rk
from distributed import Client, LocalCluster, as_completed

alphas, ps = (0.1, 0.15, 0.2, 0.25), (1.5, 3.0, 4.5)
blocks = [rk.Block(alpha=alpha, p=p) for alpha in alphas for p in ps]

# %% [markdown]
# ## On this process alone
#
# This is all that there is to a sweep without a cluster. Each IDA uses all
# processors.

# %%
suite = rk.embedded_suite("ordinary")
alone = [rk.ida(block, suite).capacities(np.inf) for block in blocks]
fits_alone = [rk.fit_fragility(sample, shift=1.0) for sample in alone]

# %% [markdown]
# ## On the cluster
#
# The same three calls as tasks. `threads=1`, because each worker has one
# processor. The suite is made by a task: a worker that lost it makes it again.

# %%
cluster = LocalCluster(
    n_workers=2, threads_per_worker=1, dashboard_address=None
)
client = Client(cluster)
workers = client.run(os.getpid)

read = client.submit(rk.embedded_suite, "ordinary")
idas = client.map(rk.ida, blocks, suite=read, threads=1)
samples = client.map(rk.Ida.capacities, idas, edp=np.inf)
fits = client.map(rk.fit_fragility, samples, shift=1.0)

# %% [markdown]
# As soon as the first block is done, the worker that did it is killed. What
# it held and what it was doing is lost. Dask starts another worker and makes
# the lost parts again.

# %%
first = next(as_completed(idas))
[victim, *_] = client.who_has([first])[first.key]
os.kill(workers[victim], signal.SIGKILL)
done = sum(future.done() for future in idas)
print(f"worker killed after {done} of {len(blocks)} blocks")
assert done < len(blocks)

swept = client.gather(samples)
fits_swept = client.gather(fits)
assert workers[victim] not in client.run(os.getpid).values()
client.close()
cluster.close()

# %%
same = all(a.tobytes() == b.tobytes() for a, b in zip(alone, swept))
same = same and fits_alone == fits_swept
print("same bits" if same else "DIFFERENT")
assert same

# %% [markdown]
# ## What it shows
#
# By the fit, half of the records overturn a block at its median PGA. Larger
# blocks (smaller p) and stockier ones (larger alpha) need more.

# %%
figure, axes = plt.subplots(figsize=(6, 4))
for alpha in alphas:
    medians = [
        fit.fitted.median * np.tan(alpha)
        for block, fit in zip(blocks, fits_swept)
        if block.alpha == alpha
    ]
    axes.plot(ps, medians, "o-", label=f"alpha {alpha:g}")
axes.set(xlabel="p, rad/s", ylabel="median PGA of overturning, g")
axes.legend()
plt.show()

# %% [markdown]
# Without Dask, or on a cluster with SLURM, `rocking sweep` of the command line
# does the same with files: `rocking sweep plan`, `run`, `merge`.
