"""How free-standing rigid blocks rock and overturn under earthquakes.

>>> import rocking as rk
>>> block = rk.Block(alpha=0.1, p=3.0)
>>> sine = rk.Pulse("one-sine", amplitude_g=1.5 / 9.81, omega=12.0)
>>> response = rk.respond(block, sine)
>>> round(response.peak_ratio, 6)
0.493882

========================  ==================================================
you have                  call
========================  ==================================================
a size                    `Block.from_dimensions`
an array or a trace       `Record`, `Record.of`
a file, a folder          `read_record`, `read_suite`
none of these             `embedded_suite`, `recorded_suite`
a block and a motion      `respond`: what the block does
many of both              `peak`, `rocking_spectrum`
a suite                   `ida`, then `Ida.capacities` and `Ida.demands`
unscaled records          `cloud`: fragilities without an IDA
capacities                `fit_fragility`, `test_normality`, `summarise`,
                          `compare`, `contrast`
counts of stripes         `fit_stripes`
a record                  `response_spectrum`, `intensity_measures`,
                          `average_sa`, `rotd`, `velocity_pulse`
an IDA                    its `fit`, `levels`, `stripes`, `summarise`,
                          `pivot_forces`; `rank_ims`
a table of `rocking ida`  `read_ida`
a result                  its `to_json`, `to_pandas`, `plot`
a block, and no analysis  `law_fragility`
fragilities of blocks     `export`
a hazard curve            `read_hazard`, then `risk`
objects to decide about   `Object`, `Floor`, then `assess`: one page
shaking-table tests       `read_tests`, then `compare_with_tests`
========================  ==================================================

Angles are in rad, times in s, `alpha` is the slenderness angle atan(b/h) and
`p` the frequency parameter sqrt(3 g/(4 R)) in rad/s. Accelerations are in
multiples of gravity once they are in a `Record`; what unit an array or a file
has must be said (`units="g"`, `"m/s2"` or `"cm/s2"`) unless the file states
it. The response (EDP) is the peak of |theta|/alpha, infinite if the block
overturns. Invalid input raises `ValueError`, a missing file
`FileNotFoundError`. Every result is the same, to the last bit, as the result
of the command line `rocking`, for any number of threads. Suspicious data of a
record are reported in its `remarks` and in a `UserWarning`.
"""

from ._analyses import Response, peak, respond, rocking_spectrum
from ._assess import AssessedObject, Assessment, Floor, Object, assess
from ._fragility import (
    BlockFragility,
    Hazard,
    LawFragility,
    Risk,
    export,
    law_fragility,
    read_hazard,
    risk,
)
from ._ida import Ida, ImCurves, cloud, ida, rank_ims, read_ida
from ._inputs import (
    STANDARD_GRAVITY,
    Block,
    Pulse,
    Record,
    Suite,
    embedded_suite,
    read_record,
    read_suite,
    recorded_suite,
)
from ._measures import (
    average_sa,
    intensity_measures,
    response_spectrum,
    rotd,
    velocity_pulse,
)
from ._results import (
    Boxplot,
    Comparison,
    Contrast,
    IdaSummary,
    LevelCapacities,
    LevelCrossings,
    Measures,
    Normality,
    PivotForces,
    Ranking,
    Reason,
    StripeResponses,
    Summary,
    VelocityPulse,
)
from ._rocking import __version__
from ._score import Score, score
from ._shaking import (
    ShakingTest,
    TestComparison,
    compare_with_tests,
    read_tests,
)
from ._statistics import (
    CloudFragility,
    CloudLevel,
    CountsFragility,
    Fragility,
    FragilityFit,
    LevelFit,
    Sample,
    compare,
    contrast,
    fit_fragility,
    fit_stripes,
    summarise,
    test_normality,
)

__all__ = [
    "AssessedObject",
    "Assessment",
    "Block",
    "BlockFragility",
    "Boxplot",
    "CloudFragility",
    "CloudLevel",
    "Comparison",
    "Contrast",
    "CountsFragility",
    "Floor",
    "Fragility",
    "FragilityFit",
    "Hazard",
    "Ida",
    "IdaSummary",
    "ImCurves",
    "LawFragility",
    "LevelCapacities",
    "LevelCrossings",
    "LevelFit",
    "Measures",
    "Normality",
    "Object",
    "PivotForces",
    "Pulse",
    "Ranking",
    "Reason",
    "Record",
    "Response",
    "Risk",
    "STANDARD_GRAVITY",
    "Sample",
    "Score",
    "ShakingTest",
    "StripeResponses",
    "Suite",
    "Summary",
    "TestComparison",
    "VelocityPulse",
    "__version__",
    "assess",
    "average_sa",
    "cloud",
    "compare",
    "compare_with_tests",
    "contrast",
    "embedded_suite",
    "export",
    "fit_fragility",
    "fit_stripes",
    "ida",
    "intensity_measures",
    "law_fragility",
    "peak",
    "rank_ims",
    "read_hazard",
    "read_ida",
    "read_record",
    "read_suite",
    "read_tests",
    "recorded_suite",
    "respond",
    "response_spectrum",
    "risk",
    "rotd",
    "rocking_spectrum",
    "score",
    "summarise",
    "test_normality",
    "velocity_pulse",
]
