"""One block under one pulse: what it does, and how sure that is."""

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt
import rocking as rk

block = rk.Block.from_dimensions(width_m=0.3, height_m=1.5)
sine = rk.Pulse("one-sine", amplitude_g=0.4, omega=12.0)
figure, axes = plt.subplots()
for scale in (0.8, 1.0, 1.2):
    found = rk.respond(
        block, sine, eta="housner", scale=scale, history_dt=0.005
    )
    history = found.to_pandas()["theta"] / block.alpha
    label = f"{scale * sine.pga_g:.2f} g: {found.outcome}"
    axes.plot(history.index, history, label=label)
    print(f"{label}, peak |theta|/alpha {found.peak_ratio:.6g}", end="")
    print("" if found.resolved else " (unresolved)")
axes.set(xlabel="t, s", ylabel="theta/alpha", ylim=(-1.2, 1.2))
axes.legend()
figure.savefig("one-block.png")
