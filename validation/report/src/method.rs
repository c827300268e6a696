//! How the results come about, in words, and the terms of the page.

/// A paragraph each: model, suites, arms, estimators, inference, verdicts.
const METHOD: [&str; 6] = [
    "Model. A planar rigid block stands on a rigid base and rocks about \
     either corner without sliding or bouncing (Eq. 1 of the paper). At each \
     impact the angular velocity is multiplied by eta. A Taylor series integrates the motion \
     between impacts.",
    "Suites. Fifteen blocks, p = 1, 3, 4 rad/s and alpha = 0.05 to 0.25 rad, \
     are rocked by every record of an ordinary and of a pulse-type suite. \
     The intensity of a record rises until the block overturns: an \
     incremental dynamic analysis.",
    "Intensity. Each arm is a grid of intensity. Arm A has the paper's steps \
     of 0.01 g. Arm C has the same dimensionless steps for every block, with \
     the first overturning bisected.",
    "Estimators. Ratios are paired: the response of a block over that of the \
     block with alpha = 0.10 to the same record. Overturned counts as \
     infinite. A cell with fewer than 30 usable records is shown and decides \
     nothing. A shifted lognormal has the intensity of uplift as its lower \
     end. The Lilliefors test at 5 % judges whether a sample is lognormal; \
     acceptance is weak evidence, the more so with 44 records.",
    "Inference. Records are resampled, the same ones in all blocks, stripes \
     and measures at once. Over several cells the interval of 95 % holds for \
     all of them together; that of a share counts cells surely inside and \
     not surely outside.",
    "Verdicts. A claim is confirmed where its whole interval lies within the \
     limit, the smallest effect of engineering interest. It is not confirmed \
     where the whole interval lies outside, and inconclusive otherwise.",
];

const GLOSSARY: [(&str, &str); 17] = [
    ("alpha", "slenderness angle of a block, atan(width/height), in rad"),
    (
        "p",
        "frequency parameter of a block, sqrt(3 g/(4 R)) with R half its \
     diagonal, in rad/s",
    ),
    (
        "eta",
        "coefficient of restitution: angular velocity after an impact over \
         that before",
    ),
    (
        "IM",
        "intensity measure of a motion: here PGA/(g tan alpha) or p PGV/(g \
         tan alpha)",
    ),
    ("notch", "95 % interval of the median of a boxplot"),
    ("trimmed", "without the values above the 95 % quantile"),
    (
        "resurrection",
        "a block stands at an intensity above one that overturns it",
    ),
    ("Housner's restitution", "1 - 1.5 sin(alpha)^2, of a rigid impact"),
    (
        "EDP",
        "engineering demand parameter: here the peak of |theta|/alpha; 1 is \
         overturning",
    ),
    ("IM_R", "intensity at which rocking starts: 1 in PGA/(g tan alpha)"),
    ("stripe", "responses of one block to all records at one intensity"),
    (
        "capacity",
        "intensity at which a record brings a block to a demand: the median \
         of those at which its curve crosses the demand; at overturning the \
         least",
    ),
    ("SSFL", "lognormal fitted to the shifted sample"),
    ("USFL", "lognormal fitted to the unshifted sample"),
    (
        "USFL7",
        "the USFL, shifted by Eqs. 5 and 7; the constant c of Eq. 7 sets the \
         two points that are kept",
    ),
    ("cell", "one place of a comparison: a block, a stripe, a demand"),
    (
        "wrong model",
        "a version of the program with a known fault, which a declared case \
         must reject",
    ),
];

/// The paragraphs.
pub fn method() -> Vec<String> {
    METHOD.map(String::from).into()
}

/// Terms and what they mean.
pub fn glossary() -> Vec<(String, String)> {
    GLOSSARY.map(|(term, words)| (term.into(), words.into())).into()
}
