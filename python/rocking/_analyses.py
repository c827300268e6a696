"""Single responses of blocks, and peaks of many."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from . import _rocking
from ._inputs import (
    Block,
    Eta,
    Floats,
    Frozen,
    Model,
    Overturn,
    Pulse,
    Record,
    floats,
    frozen,
    given,
    number,
    numbers,
    pair_of,
)
from ._results import axes

Progress = Callable[[int, int], object]


def physics(eta: Eta, model: Model, overturn: Overturn) -> _rocking.Physics:
    """Coefficient, equation and criterion, as the native half takes them."""
    if isinstance(eta, str):
        if eta != "housner":
            raise ValueError(f"eta {eta!r}: expected a number, or 'housner'")
        constant = None
    else:
        constant = number(eta, "eta")
    return {"eta": constant, "model": model, "overturn": overturn}


@dataclass(frozen=True, eq=False)
class Response(Frozen):
    """The response of one block to one excitation.

    Times are in s. `repr` leaves the arrays out.
    """

    outcome: Literal["no-uplift", "rocked", "overturned"]
    peak_ratio: float
    """Peak |theta|/alpha, infinite if it overturned."""
    resolved: bool
    """False if rounding may have changed outcome or peak; `certify=True` then
    resolves them in wider arithmetic."""
    fate_margin: float
    """Distance from the other fate, in units of alpha."""
    error_estimate: float | None
    """Bound on the error of the peak; None if a decision is not clear."""
    peak_time: float | None
    uplift_time: float | None
    rest_time: float | None
    overturning_time: float | None
    overturning_side: float | None
    """Sign of theta at overturning."""
    certified_by: str | None
    """Arithmetic that decided, with `certify=True`."""
    impacts: Floats = field(repr=False)
    """(n, 2): time, and angular velocity before it in rad/s."""
    history: Floats = field(repr=False)
    """(n, 3): time, theta in rad, angular velocity in rad/s; empty unless
    `history_dt` was given."""

    @property
    def overturned(self) -> bool:
        """Whether it overturned."""
        return self.outcome == "overturned"

    def to_pandas(self) -> Any:
        """The history as a `pandas.DataFrame`, its index the time."""
        import pandas

        index = pandas.Index(self.history[:, 0], name="t")
        columns = ["theta", "omega"]
        return pandas.DataFrame(self.history[:, 1:], index, columns)

    def to_xarray(self) -> Any:
        """The history as an `xarray.Dataset` over t, with the impacts over
        impact_time."""
        import xarray

        t, theta, omega = self.history.T
        time, before = self.impacts.T
        speed = {"units": "rad s-1"}
        return xarray.Dataset(
            {
                "theta": ("t", theta, {"units": "rad"}),
                "omega": ("t", omega, speed),
                "impact_omega": ("impact_time", before, speed),
            },
            {
                "t": ("t", t, {"units": "s"}),
                "impact_time": ("impact_time", time, {"units": "s"}),
            },
            {"outcome": self.outcome, "peak_ratio": self.peak_ratio},
        )

    def plot(self, ax: Any = None) -> Any:
        """Draws the history; gives the matplotlib axes."""
        ax = axes(ax)
        ax.plot(self.history[:, 0], self.history[:, 1])
        ax.set(xlabel="t, s", ylabel="theta, rad")
        return ax


def respond(
    block: Block,
    excitation: Record | Pulse,
    *,
    eta: Eta = 0.92,
    model: Model = "nonlinear",
    overturn: Overturn = "alpha",
    im: float | None = None,
    pga_g: float | None = None,
    scale: float | None = None,
    history_dt: float | None = None,
    certify: bool = False,
) -> Response:
    """The response of a block to a record or a pulse.

    Parameters
    ----------
    block : Block
    excitation : Record or Pulse
    eta : float or "housner"
        Coefficient of restitution, a ratio of angular velocities.
    model : "nonlinear" (Eq. 1) or "linearized" (Eq. 2)
    overturn : "alpha" (|theta| reaches alpha) or "half-pi"
    im, pga_g, scale : float, at most one of them
        Scale the excitation to PGA/(g tan alpha), to a PGA in g, or by a
        factor.
    history_dt : float
        Interval in s at which the rotation is recorded.
    certify : bool
        Tell outcome and peak in the precision that they need.

    >>> sine = Pulse("one-sine", amplitude_g=0.15, omega=12.0)
    >>> respond(Block(alpha=0.1, p=3.0), sine, im=0.99).outcome
    'no-uplift'
    """
    asked = [
        (name, value)
        for name, value in (("im", im), ("pga_g", pga_g), ("scale", scale))
        if value is not None
    ]
    if len(asked) > 1:
        names = " and ".join(name for name, _ in asked)
        raise ValueError(f"{names}: expected at most one of im, pga_g, scale")
    by, level = asked[0] if asked else ("scale", 1.0)
    found = _rocking.respond(
        pair_of(block),
        given(excitation),
        physics(eta, model, overturn),
        by,
        number(level, by),
        history_dt,
        certify,
    )
    frozen(found["impacts"])
    frozen(found["history"])
    return Response(**found)


def peak(
    blocks: Block | Sequence[Block],
    excitations: Record | Pulse | Sequence[Record | Pulse],
    *,
    levels: ArrayLike,
    by: Literal["im", "pga_g", "scale"] = "im",
    eta: Eta = 0.92,
    model: Model = "nonlinear",
    overturn: Overturn = "alpha",
    threads: int | None = None,
    progress: Progress | None = None,
) -> Floats:
    """Peak |theta|/alpha of each block under each excitation at each level.

    Parameters
    ----------
    blocks : Block or sequence of Block
    excitations : Record, Pulse or sequence of these
    levels : float or array_like
        PGA/(g tan alpha) for `by="im"`, PGA in g for `by="pga_g"`, factors
        for `by="scale"`.
    by : "im", "pga_g" or "scale"
        What `levels` are.
    eta, model, overturn
        As in `respond`.
    threads : int
        All processors unless given; at most eight a processor are started.
    progress : callable
        Called now and then with (done, total), in the calling thread.

    Returns
    -------
    ndarray of shape (block, excitation, level)
        Infinite if the block overturned. As with a ufunc, an axis is missing
        if a single block, excitation or level was given. Peaks that rounding
        may have changed are not marked: `respond` says so.

    Notes
    -----
    Records at `by="im"` and `by="pga_g"` run in the lanes of `ida`, about
    three times as fast as alone. Pulses, and factors, run alone. The bits are
    the same.

    >>> sine = Pulse("one-sine", amplitude_g=0.15, omega=12.0)
    >>> peak(Block(alpha=0.1, p=3.0), sine, levels=[1.2, 1.4]).shape
    (2,)
    """
    one_block = isinstance(blocks, Block)
    one_motion = isinstance(excitations, (Record, Pulse))
    all_blocks = [blocks] if isinstance(blocks, Block) else list(blocks)
    motions = (
        [excitations]
        if isinstance(excitations, (Record, Pulse))
        else list(excitations)
    )
    all_levels = numbers(levels, "levels")
    found = _rocking.peak(
        [pair_of(block) for block in all_blocks],
        [given(motion) for motion in motions],
        np.ravel(all_levels).tolist(),
        by,
        physics(eta, model, overturn),
        threads,
        progress,
    )
    shape = (
        *(() if one_block else (len(all_blocks),)),
        *(() if one_motion else (len(motions),)),
        *all_levels.shape,
    )
    return found.reshape(shape)


def rocking_spectrum(
    record: Record | Pulse,
    *,
    alpha: float,
    p: ArrayLike,
    level: float = 1.0,
    eta: Eta = 0.92,
    model: Model = "nonlinear",
    threads: int | None = None,
) -> Floats:
    """Peak |theta|/alpha of blocks of one slenderness and many sizes.

    Makris and Konstantinidis (2003) draw it against 2 pi/p.

    Parameters
    ----------
    record : Record or Pulse
    alpha : float
        Slenderness angle of all blocks in rad.
    p : array_like
        Frequency parameters in rad/s.
    level : float
        Factor on the record.
    eta, model, threads
        As in `peak`.

    >>> sine = Pulse("one-sine", amplitude_g=1.5 / 9.81, omega=12.0)
    >>> rocking_spectrum(sine, alpha=0.1, p=[3.0]).round(6)
    array([0.493882])
    """
    values = floats(p, "frequency parameters").tolist()
    return peak(
        [Block(alpha=alpha, p=value) for value in values],
        record,
        levels=level,
        by="scale",
        eta=eta,
        model=model,
        threads=threads,
    )
