"""What double precision does not resolve is flagged; `certify` resolves it."""

import numpy as np
import rocking as rk

PGA_G = 0.2184963950029415

# By an integrator of its own in 113-bit arithmetic; double precision finds
# 0.646810.
PEAK = 0.63359223890401529


def graze() -> rk.Record:
    """The first hop after rest grazes the base at 1.3e-8 rad/s; 12 s of
    levels from a linear congruence follow."""
    lobes = [1.0] * 30 + [-0.5] * 20 + [1.0] * 40
    levels, state = [], 10
    for _ in range(300):
        state = (state * 6364136223846793005 + 1442695040888963407) % 2**64
        levels += [1.7 * ((state >> 11) / 2**53 - 0.5)] * 4
    return rk.Record(lobes + levels, 0.01, units="g", name="graze")


def test_a_grazing_first_hop_is_flagged_and_certified_in_an_ida() -> None:
    block = rk.Block(alpha=0.15, p=3.0)
    found = []
    for certify in (False, True):
        ida = rk.ida(
            block,
            graze(),
            step_g=PGA_G,
            refine=None,
            highest_im=2.0,
            certify=certify,
        )
        rows = ida.to_pandas()
        found.append(rows[rows["pga_g"] == PGA_G].iloc[0])
    plain, certified = found
    assert plain["outcome"] == "unresolved"
    assert abs(plain["edp"] - PEAK) > 0.01
    assert certified["outcome"] == "rocked"
    assert abs(certified["edp"] - PEAK) < 1e-14


def test_a_grazing_first_hop_is_unresolved_without_being_asked() -> None:
    block = rk.Block(alpha=0.15, p=3.0)
    response = rk.respond(block, graze(), pga_g=PGA_G)
    assert not response.resolved
    assert response.error_estimate is None
    certified = rk.respond(block, graze(), pga_g=PGA_G, certify=True)
    assert certified.resolved and certified.certified_by == "double-double"
    assert np.isclose(certified.peak_ratio, PEAK, rtol=1e-14, atol=0.0)
