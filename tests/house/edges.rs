//! Which module may name which.

/// Which top-level module may name which: the data flow. A line is a module
/// and what it may name. Tests inside a module count as the module.
pub type Edges = &'static str;

/// The modules of the core.
const CORE: Edges = "
    accelerogram
    block
    capacity names statistics
    excitation accelerogram names number
    floor accelerogram intensity
    fragility intensity statistics stop
    ida accelerogram block capacity excitation integrator names number
    integrator accelerogram block excitation names number stop
    intensity accelerogram names stop units
    names
    number
    procedures block capacity excitation floor fragility ida integrator intensity \
        record statistics stop
    record accelerogram stop units
    statistics names number stop streams
    stop
    streams
    units
";

/// The modules of the texts that other programs read.
const EXCHANGE: Edges = "
    columns
    format columns fragility table
    fragility
    ida columns read table
    read columns
    sample ida read
    table columns
";

/// The modules of the score of answers.
const SCORE: Edges = "
    answers reference
    diagnosis answers reference
    own answers reference
    reference
    score answers diagnosis reference
";

/// The modules of the embedded suites.
const SYNTHESIS: Edges = "
    attenuation pair
    draws
    kind
    moments attenuation draws
    noise draws
    pair noise
    peaks attenuation noise pair
    pulse draws noise pair special
    special
    suites attenuation moments pair peaks targets waves
    targets attenuation draws moments pair peaks pulse
    tests pair suites
    waves attenuation draws noise pair peaks special targets
";

/// The modules that all crates of the harness share. Between those crates the
/// manifests hold the walls.
const COMMON: Edges = "
    curves
    files
    findings json paper words
    json words
    paper words
    suites paper table
    table
    words
";

/// The modules of the drawings.
const DRAW: Edges = "
    axis
    colour
    figures axis colour geometry grid legend markup panel scene text
    geometry
    grid geometry
    legend colour markup panel scene text
    markup
    page colour figures
    panel axis colour geometry markup scene text
    scene colour geometry svg text
    svg colour geometry markup text
    tests axis colour geometry markup scene text
    text colour geometry markup
";

/// The modules of the declared cases.
const PROOF: Edges = "
    arithmetic
    cases references
    edge
    engine arithmetic scene
    methods arithmetic cases edge engine naive oracles references scene \
        trials
    naive cases scene
    oracles scene
    references arithmetic scene
    scene
    trials arithmetic cases engine scene
    verdict cases methods
";

/// The modules of the report.
const REPORT: Edges = "
    answers basis evidence page quantity timings verdicts
    basis
    credibility basis evidence words
    diff answers output verdicts
    evidence
    findings basis page quantity verdicts
    head
    input answers basis credibility evidence findings head ledger page scored \
        timings verdicts words
    lab
    ledger basis evidence
    marked answers basis evidence page scored timings
    output answers basis evidence head input page quantity scored timings
    page basis evidence lab quantity
    quantity
    scored
    speed
    stale diff output
    tests answers basis credibility evidence findings head input ledger output \
        quantity
    timings speed
    verdicts basis
    words
";

/// The modules of the engine of a page.
const WEB: Edges = "
    abi question
    bits
    block bits
    case bits
    question block case
";

/// The modules of the study: results, then fits, stripes and ties, then
/// measures, then claims, questions and figures, then findings.
const STUDY: Edges = "
    analyses certainty runs
    certainty
    claims distances inference measures results
    contents analyses
    distances distributions estimates inference normality results
    distributions analyses normality runs
    estimates analyses results runs sensitivities
    figures analyses claims estimates fits inference measures normality \
        results stripes ties
    findings analyses estimates figures questions results stripes
    fits
    inference
    kept
    measures analyses distances distributions estimates fits inference results \
        runs sensitivities stripes
    normality
    questions analyses contents distributions estimates fits inference kept \
        normality results runs ties
    results analyses distributions inference sensitivities
    runs certainty
    sensitivities analyses runs
    stripes analyses
    ties distributions normality
    whole analyses claims distributions figures findings questions results
";

/// The modules of the command: the commands above, what they share below.
const COMMAND: Edges = "
    cli failure input sweep terminal threads
    failure
    input failure terminal
    sweep failure input
    terminal failure
    threads failure terminal
";

/// Each source folder with its table.
pub const TREES: [(&str, Edges); 11] = [
    ("src", CORE),
    ("crates/exchange/src", EXCHANGE),
    ("crates/score/src", SCORE),
    ("crates/synthesis/src", SYNTHESIS),
    ("validation/common/src", COMMON),
    ("validation/draw/src", DRAW),
    ("validation/proof/src", PROOF),
    ("validation/report/src", REPORT),
    ("validation/command/src", COMMAND),
    ("validation/study/src", STUDY),
    ("validation/web/src", WEB),
];
