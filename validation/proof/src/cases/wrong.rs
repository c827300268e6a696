//! Names of the wrong models that cases must reject.

use rocking::names::named;

named! {
    /// A named mistake.
    #[derive(PartialOrd, Ord)]
    pub enum WrongModel: "wrong model" {
        /// Ground acceleration of the other sign.
        GroundSign = "ground-sign",
        /// Energy ratio used as velocity ratio.
        EtaSquared = "eta-squared",
        /// Eq. 2 for Eq. 1, or Eq. 1 for Eq. 2.
        OtherEquation = "other-equation",
        /// `p` 1 % too high.
        POnePercentHigh = "p-one-percent-high",
        /// `p` 1 % too low.
        POnePercentLow = "p-one-percent-low",
        /// `alpha` 1 % too low.
        AlphaOnePercentLow = "alpha-one-percent-low",
        /// `alpha` 1 % too high.
        AlphaOnePercentHigh = "alpha-one-percent-high",
        /// 9.80665 for 9.81 m/s2.
        OtherGravity = "other-gravity",
        /// Amplitude over g tan(alpha) in Eq. 2.
        TangentForAngle = "tangent-for-angle",
        /// Sample i taken at (i + 1) dt.
        OneSampleLate = "one-sample-late",
        /// A record of any size scaled to 1 g.
        RecordNormalised = "record-normalised",
        /// cm/s2 read as m/s2.
        CmReadAsM = "cm-read-as-m",
        /// Record one sample short.
        LastSampleLost = "last-sample-lost",
        /// The first impact has no loss.
        MissedImpact = "missed-impact",
        /// Impacts at the end of a step, only by the sign.
        SignOnlyEvents = "sign-only-events",
        /// Impact at the end of a step with the rotation found there.
        RotationKeptAtImpact = "rotation-kept-at-impact",
        /// Rest below a tenth of p alpha, under any ground acceleration.
        CrudeRest = "crude-rest",
        /// No change of pivot while the ground pushes back.
        SuppressedHop = "suppressed-hop",
        /// Acceleration constant between samples.
        ZeroOrderHold = "zero-order-hold",
        /// `g alpha` in Eq. 1, g tan(alpha) in Eq. 2.
        OtherThreshold = "other-threshold",
        /// No motion after the last sample.
        StopsWithTheRecord = "stops-with-the-record",
        /// One bisection over the whole range of amplitudes.
        PlainBisection = "plain-bisection",
        /// Energy of Eq. 2 along Eq. 1, or of Eq. 1 along Eq. 2.
        EnergyOfTheOtherEquation = "energy-of-the-other-equation",
        /// The condition of a sine that never ends for one that does.
        SemiInfiniteSine = "semi-infinite-sine",
        /// Overturning whenever the energy exceeds that of the saddle.
        EnergyWhicheverWay = "energy-whichever-way",
        /// Overturning whenever |theta| exceeds alpha.
        AngleAlone = "angle-alone",
        /// Energy times eta at an impact, not eta^2.
        EtaOnceInEnergy = "eta-once-in-energy",
        /// No centripetal acceleration in the forces.
        WithoutCentripetal = "without-centripetal",
        /// All mass at the centre: R = g/p^2.
        InertiaOfAPoint = "inertia-of-a-point",
        /// The series stops two terms early.
        OrderTooLow = "order-too-low",
        /// `pi/2` for `alpha`, or alpha for pi/2.
        OtherCriterion = "other-criterion",
        /// An error estimate 100 times too small.
        EstimateHundredth = "estimate-hundredth",
        /// Only the decision on the outcome counts.
        WithoutBranches = "without-branches",
        /// The end of observation decides nothing.
        WithoutEnd = "without-end",
        /// An overturned run is certain whatever its error.
        MarginInfinity = "margin-infinity",
        /// Every error divided by ten.
        TenthOfTheError = "tenth-of-the-error",
        /// Every error divided by a hundred.
        HundredthOfTheError = "hundredth-of-the-error",
        /// The rounding of a flight by its landing speed, not by its largest
        /// speed.
        RoundingAtTheLanding = "rounding-at-the-landing",
        /// Coefficients and pi of a wider engine rounded to double precision.
        F64Constants = "f64-constants",
        /// `a/g` of a wider engine rounded to double precision.
        F64Inputs = "f64-inputs",
        /// Variance in one pass, sum x^2 - (sum x)^2/n.
        SumOfSquares = "sum-of-squares",
        /// `n` for `n - 1`, `n - 1` for `n`, or the whole sample.
        OtherDivisor = "other-divisor",
        /// D+, or the smaller side.
        UpperSideOnly = "upper-side-only",
        /// Critical values of a known distribution.
        PlainKolmogorov = "plain-kolmogorov",
        /// Critical values linear in n between sizes.
        InterpolatedInN = "interpolated-in-n",
        /// An expansion that stops at 1/n.
        TwoTerms = "two-terms",
        /// The stream of another index.
        NextStream = "next-stream",
        /// Type 7 for 5, or 5 for 7.
        OtherQuantileType = "other-quantile-type",
        /// Half of IM_R subtracted.
        HalfTheShift = "half-the-shift",
        /// The values for their logarithms.
        NoLogarithm = "no-logarithm",
        /// 6 % for 5 %.
        OtherMargin = "other-margin",
        /// A level touched does not count as reached.
        OpenCrossings = "open-crossings",
        /// Interpolation to pi/2 at overturning.
        OverturningAsAnAngle = "overturning-as-an-angle",
        /// The first crossing for the median one.
        FirstForMedian = "first-for-median",
        /// Eq. 7 as printed, which loses digits by cancellation.
        Equation7AsPrinted = "equation-7-as-printed",
        /// Eq. 7's limit for every c.
        DeltaMethod = "delta-method",
        /// The fragility of the same median and dispersion from 0.
        WithoutShift = "without-shift",
        /// The error of the model on the part of a capacity above the shift.
        ErrorAboveTheShift = "error-above-the-shift",
        /// No motion beyond the last point of a hazard curve.
        NothingBeyond = "nothing-beyond",
        /// The hazard at the median for the annual frequency.
        HazardAtTheMedian = "hazard-at-the-median",
        /// An interval of a probability as if the dispersion were known.
        KnownDispersion = "known-dispersion",
        /// Eq. 7 extended beyond its end.
        Clamped = "clamped",
        /// McGill's notch as 95 % interval.
        NotchForInterval = "notch-for-interval",
        /// Wilson's interval for the exact one.
        WilsonInterval = "wilson-interval",
        /// Another interval, too narrow.
        OtherInterval = "other-interval",
        /// An interval for each cell instead of one for all cells.
        PointwiseIntervals = "pointwise-intervals",
        /// Percentiles of the draws as ends of an interval.
        Percentiles = "percentiles",
        /// The normal quantile for Student's t.
        NormalForStudent = "normal-for-student",
        /// Records of one earthquake taken as independent.
        RecordsAsUnit = "records-as-unit",
        /// Shaking-table tests of one motion taken as independent.
        TestsAsUnit = "tests-as-unit",
        /// Replicates with replacement for a test that ties invalidate.
        TiedReplicates = "tied-replicates",
        /// Oscillators 1 % too slow.
        PeriodOnePercentLong = "period-one-percent-long",
        /// Oscillators without damping, or with the least that is allowed.
        NoDamping = "no-damping",
        /// Acceleration of a floor over the ground.
        RelativeForAbsolute = "relative-for-absolute",
        /// Absolute acceleration of the mode's mass times the height ratio.
        MassForFloor = "mass-for-floor",
        /// Measures of the velocity.
        VelocityForAcceleration = "velocity-for-acceleration",
        /// The integral of a^2 over g.
        AriasWithoutItsFactor = "arias-without-its-factor",
        /// Sqrt of the product.
        GeometricMeanForRotd50 = "geometric-mean-for-rotd50",
        /// The median over directions.
        Rotd50ForGeometricMean = "rotd50-for-geometric-mean",
        /// The second component left out.
        OneComponent = "one-component",
        /// PGV in m/s where cm/s are meant.
        VelocityInMS = "velocity-in-m-s",
        /// No criterion of time.
        LatePulsesKept = "late-pulses-kept",
        /// The limit for many values, doubled.
        OneSideDoubled = "one-side-doubled",
        /// The table in spite of an estimated shift.
        KnownShift = "known-shift",
        /// The null by the dispersion above the smallest value.
        DispersionAboveTheSmallest = "dispersion-above-the-smallest",
        /// Tilts of similar blocks for their displacements.
        TiltForDisplacement = "tilt-for-displacement",
        /// A block overturns as soon as it uplifts.
        UpliftForOverturning = "uplift-for-overturning",
    }
}
