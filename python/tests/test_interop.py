"""Objects of other packages, by their shape."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pandas as pd
import pytest
import rocking as rk

ACC = np.array([0.0, 9.80665, -4.903325, 0.0])
SAME = rk.Record([0.0, 1.0, -0.5, 0.0], 0.01, units="g", name="one")
NAMELESS = rk.Record(SAME.acc_g, 0.01, units="g")


def test_an_obspy_trace_is_a_record() -> None:
    stats = SimpleNamespace(delta=0.01)
    trace = SimpleNamespace(data=ACC, stats=stats, id="one")
    assert rk.Record.of(trace, units="m/s2") == SAME


def test_an_eqsig_signal_is_a_record() -> None:
    signal = SimpleNamespace(values=ACC, dt=0.01, label="one")
    assert rk.Record.of(signal, units="m/s2") == SAME


def test_a_trace_of_obspy_itself_is_a_record() -> None:
    obspy: Any = pytest.importorskip("obspy")
    header = {"sampling_rate": 100.0, "network": "CI", "station": "CCC"}
    trace = obspy.Trace(ACC.copy(), {**header, "channel": "HNE"})
    record = rk.Record.of(trace, units="m/s2")
    assert record.name == "CI.CCC..HNE"
    assert (record.dt, record.acc_g.tolist()) == (0.01, SAME.acc_g.tolist())
    # Counts are whole numbers in four bytes.
    counts = obspy.Trace(np.array([0, 2, -1], dtype=np.int32), header)
    found = rk.Record.of(counts, units="g", name="counts")
    assert found.acc_g.tolist() == [0.0, 2.0, -1.0]


def test_a_gap_in_a_trace_of_obspy_is_refused() -> None:
    obspy: Any = pytest.importorskip("obspy")
    header = {"sampling_rate": 100.0, "station": "CCC"}
    later = {**header, "starttime": obspy.UTCDateTime(0) + 0.1}
    stream = obspy.Stream(
        [obspy.Trace(ACC.copy(), header), obspy.Trace(ACC.copy(), later)]
    )
    [gap] = stream.merge()
    assert np.ma.is_masked(gap.data)
    with pytest.raises(ValueError, match="masked"):
        rk.Record.of(gap, units="m/s2")


def test_a_signal_of_eqsig_itself_is_a_record() -> None:
    eqsig: Any = pytest.importorskip("eqsig")
    signal = eqsig.AccSignal(ACC.copy(), 0.01, label="one")
    record = rk.Record.of(signal, units="m/s2")
    assert record == SAME
    # eqsig integrates from rest by the same trapezoid.
    pgv_m_s = rk.intensity_measures(record).pgv_m_s
    assert pgv_m_s == pytest.approx(abs(signal.velocity).max(), rel=1e-12)


def test_a_pandas_series_of_seconds_or_of_time_steps_is_a_record() -> None:
    seconds = np.arange(4) * 0.01
    steps = pd.to_timedelta(np.arange(4) * 10, unit="ms")
    dates = pd.Timestamp("2026-01-01") + steps
    for index in (seconds, steps, dates):
        series = pd.Series(ACC, index=index, name="one")
        assert rk.Record.of(series, units="m/s2") == SAME


def test_the_unit_must_be_said() -> None:
    series = pd.Series(ACC, index=np.arange(4) * 0.01)
    with pytest.raises(TypeError, match="units"):
        rk.Record.of(series)  # type: ignore[call-arg]


def test_an_irregular_index_is_refused_with_its_step() -> None:
    series = pd.Series(ACC, index=[0.0, 0.01, 0.02, 0.04])
    with pytest.raises(ValueError, match="row 3: time 0.04 s: expected 0.03 s"):
        rk.Record.of(series, units="g")
    with pytest.raises(ValueError, match="expected times in s"):
        rk.Record.of(pd.Series(ACC, index=list("abcd")), units="g")


def test_something_else_is_refused() -> None:
    with pytest.raises(TypeError, match="arrays go to Record"):
        rk.Record.of(ACC.tolist(), units="g")


def test_right_censored_data_keep_their_limits() -> None:
    # The fields of scipy.stats.CensoredData.
    data: Any = SimpleNamespace(
        _uncensored=np.array([1.5, 2.0, 3.0]),
        _left=np.array([]),
        _right=np.array([4.0]),
        _interval=np.empty((0, 2)),
    )
    found = rk.fit_fragility(data)
    assert (found.n, found.n_limited) == (4, 1)
    nan, inf = np.nan, np.inf
    own = rk.Sample(
        np.array([1.5, 2.0, 3.0, inf]), np.array([nan, nan, nan, 4.0])
    )
    assert rk.fit_fragility(own) == found
    assert np.quantile(own, 0.0) == 1.5
    data._left = np.array([1.0])
    with pytest.raises(ValueError, match="left- or interval-censored"):
        rk.summarise(data)


def test_scipy_agrees_with_a_fragility_and_takes_a_sample() -> None:
    stats: Any = pytest.importorskip("scipy.stats")
    law = rk.fit_fragility([1.5, 2.0, 3.0, 5.0], shift=1.0).fitted
    own = law.to_scipy()
    x, q = [0.5, 1.2, 2.0, 9.0], [0.01, 0.5, 0.9]
    for name, at in (("cdf", x), ("sf", x), ("pdf", x), ("ppf", q)):
        found = getattr(law, name)(at)
        np.testing.assert_allclose(found, getattr(own, name)(at), rtol=1e-9)
    drawn = law.rvs(20_000, rng=1)
    assert stats.kstest(drawn, own.cdf).pvalue > 1e-3
    assert law.rvs(3, rng=1).tolist() == drawn[:3].tolist()
    sample = rk.Sample(np.array([1.5, np.inf]), np.array([np.nan, 4.0]))
    assert sample.to_scipy()._right.tolist() == [4.0]


def test_results_are_drawn_on_axes_of_matplotlib(
    ida: rk.Ida, suite: rk.Suite, packet: rk.Record
) -> None:
    pyplot: Any = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("agg")
    fit = rk.fit_fragility(
        ida.sample(0.5), shift=1.0, n_resamples=20, band=[1.5, 2.0]
    )
    ranking = rk.rank_ims(ida, suite, ims=["pga", "pgv"], n_resamples=20)
    box = rk.summarise(ida.sample(0.5)).boxplot
    assert isinstance(box, rk.Boxplot)
    response = rk.respond(rk.Block(alpha=0.2, p=3.0), packet, history_dt=0.1)
    drawn = (fit, fit.fitted, ida, ranking, box, response, packet, suite[:4])
    for one in drawn:
        figure, given = pyplot.subplots()
        assert one.plot(given) is given and given.has_data()
        pyplot.close(figure)
    assert fit.fitted.plot().has_data()
    pyplot.close("all")


def test_a_plot_of_a_suite_has_the_median_of_its_spectra() -> None:
    pyplot: Any = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("agg")
    # One record times 1, 2 and 4: the spectra have these ratios too.
    suite = rk.Suite(
        "three",
        tuple(rk.Record(k * ACC, 0.01, units="m/s2") for k in (1, 4, 2)),
    )
    ax = suite.plot()
    once, _, twice, median, low, high = (
        np.asarray(line.get_ydata()) for line in ax.get_lines()
    )
    assert median == pytest.approx(twice) and len(median) == 80
    # Hazen: 16 % of 3 values is at place 0.98, 84 % at place 3.02.
    assert low == pytest.approx(once) and high == pytest.approx(4.0 * once)
    pyplot.close("all")
    with pytest.raises(ValueError, match="no record"):
        suite[:0].plot()


def test_the_sum_of_suites_has_the_records_of_both() -> None:
    near, far = rk.Suite("near", (SAME,)), rk.Suite("far", (NAMELESS,) * 2)
    both = near + far
    assert both.name == "near + far"
    assert both.records == (SAME, NAMELESS, NAMELESS)
    assert (far + far).records == far.records * 2
    with pytest.raises(ValueError, match="near and suite near .* one: expec"):
        near + near
    unknown: Any = [SAME]
    with pytest.raises(TypeError):
        near + unknown


def test_curves_are_an_xarray_dataset_by_record_and_level(
    ida: rk.Ida,
) -> None:
    pytest.importorskip("xarray")
    found = ida.to_xarray()
    longest = max(len(curve) for curve in ida.im)
    assert dict(found.sizes) == {"record": 86, "level": longest}
    assert min(len(curve) for curve in ida.im) < longest
    table = ida.to_pandas()
    table = table[table.outcome != "overturned-refined"]
    for i, (name, rows) in enumerate(table.groupby("record", sort=False)):
        one = found.sel(record=name)
        stands = one.outcome.values != ""
        assert stands.tolist() == [j < len(rows) for j in range(longest)]
        assert one.intensity_pga.values[stands].tolist() == ida.im[i].tolist()
        assert one.edp.values[stands].tolist() == ida.edp[i].tolist()
        for key in found.data_vars:
            if key == "overturning_intensity_pga":
                continue
            values = one[key].values
            assert values[stands].tolist() == rows[key].tolist(), key
            if key != "outcome":
                assert np.isnan(values[~stands]).all(), key
    last = found.overturning_intensity_pga
    assert last.values.tolist() == ida.capacities(np.inf).tolist()
    # Refinement lies within the last step, whose end is the curve's.
    ends = found.intensity_pga.max("level")
    assert bool((last <= ends).all()) and not bool((last == ends).all())
    assert found.attrs["p_rad_s"] == 3.0
    assert found.edp.attrs["units"] == "1"


def test_a_history_is_an_xarray_dataset_over_time(
    block: rk.Block, packet: rk.Record
) -> None:
    pytest.importorskip("xarray")
    response = rk.respond(block, packet, im=1.3, history_dt=0.01)
    found = response.to_xarray()
    history = np.column_stack([found.t, found.theta, found.omega])
    assert history.tolist() == response.history.tolist()
    impacts = np.column_stack([found.impact_time, found.impact_omega])
    assert len(impacts) > 0
    assert impacts.tolist() == response.impacts.tolist()
    assert found.attrs["outcome"] == response.outcome
