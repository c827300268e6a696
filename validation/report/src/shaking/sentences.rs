//! What the tests say, in sentences that rules choose.

use rocking_common::findings::Seen;
use rocking_common::table::PlainTable;
use rocking_common::words::{percent, rounded};
use rocking_procedures::ModelError;
use rocking_procedures::shaking::TestComparison;
use rocking_statistics::Estimate;

use super::{RockTests, TestMeasure};
use crate::quantity::{EstimateText, ValueScale};

/// What a log-likelihood gains at least if one more number of a fit matters,
/// at a level of 5 %.
const GAIN: f64 = 1.92;

/// An estimate with its interval.
pub(super) fn plain(estimate: &Estimate) -> String {
    EstimateText::of(estimate, ValueScale::Plain, None).whole()
}

/// A share with its interval.
pub(super) fn share(estimate: &Estimate) -> String {
    EstimateText::of(estimate, ValueScale::Percent, None).whole()
}

/// A number with three digits.
fn three(x: f64) -> String {
    rounded(x, 3).to_string()
}

/// A number of each rock.
fn both(rocks: [String; 2]) -> String {
    rocks.join(" and ")
}

/// What a sentence is, by what holds of each rock.
fn seen(holds: [bool; 2]) -> Seen {
    match holds {
        [true, true] => Seen::Yes,
        [false, false] => Seen::No,
        _ => Seen::InPart,
    }
}

/// A sentence beside measured fates: its words, the numbers of each rock, and
/// whether they agree with it.
struct TestedSentence {
    words: &'static str,
    rocks: [String; 2],
    seen: Seen,
}

impl RockTests {
    /// The facts of each rock, and what holds of them.
    fn each<T>(&self, of: impl Fn(usize) -> T) -> [T; 2] {
        [of(0), of(1)]
    }

    /// A number of the fitted block of each rock.
    fn fitted_each(&self, of: impl Fn(&TestComparison) -> String) -> String {
        both(self.each(|k| of(&self.fitted[k])))
    }

    fn shift_at_uplift(&self) -> TestedSentence {
        TestedSentence {
            words: "In PGA the fragility starts at uplift",
            rocks: self.each(|k| {
                let own = &self.measured[k];
                format!(
                    "{} of {} overturned up to uplift at {} g; {} \
                     expected without a shift",
                    own.overturned_below,
                    own.below,
                    three(own.onset_g),
                    three(own.expected_below)
                )
            }),
            seen: seen(self.each(|k| {
                let own = &self.measured[k];
                (own.overturned_below as f64) < 0.5 * own.expected_below
            })),
        }
    }

    fn no_shift_in_pgv(&self) -> TestedSentence {
        let gains = self.each(|k| {
            let own = &self.measured[k];
            [
                own.pgv_shifted - own.pgv_unshifted,
                own.pga_shifted - own.pga_unshifted,
            ]
        });
        TestedSentence {
            words: "In PGV the shift gains less than in PGA",
            rocks: gains.map(|[pgv, pga]| {
                format!("log-likelihood: PGV {pgv:+.1}, PGA {pga:+.1}")
            }),
            seen: seen(gains.map(|[pgv, pga]| pgv < pga && pga > GAIN)),
        }
    }

    fn best_measure(&self) -> TestedSentence {
        let found = self
            .each(|k| TestMeasure::ALL.map(|m| m.predictor(&self.fitted[k])));
        TestedSentence {
            words: "PGV predicts overturning better than PGA, and average SA \
                    better than both",
            rocks: found.map(|all| {
                let of = |k: usize| {
                    let name = TestMeasure::ALL[k].names()[0];
                    let value =
                        all[k].map_or(f64::NAN, |own| own.dispersion.value());
                    format!("{name} {}", three(value))
                };
                format!("dispersion: {}, {}, {}", of(0), of(1), of(2))
            }),
            seen: seen(found.map(|all| {
                let score = |k: usize| {
                    all[k].map_or(f64::NAN, |own| own.log_score.value())
                };
                score(1) < score(0) && score(2) < score(1)
            })),
        }
    }

    fn first_overturning(&self) -> TestedSentence {
        TestedSentence {
            words: "Resurrections may be left out",
            rocks: self.each(|k| {
                let shares = |own: &TestComparison| {
                    [
                        own.computed.right.value(),
                        own.resurrected.right_at_level,
                    ]
                    .map(|share| percent(share, 1))
                };
                let [first, level] = shares(&self.fitted[k]);
                let rounded = shares(&self.given[k]).join(", ");
                format!(
                    "right: {first} by first overturning, {level} at the \
                     level; alpha rounded: {rounded}"
                )
            }),
            // Neither of the fitted block nor of the rounded one is the fate
            // at the level right more often.
            seen: seen(self.each(|k| {
                [&self.fitted[k], &self.given[k]].iter().all(|own| {
                    own.computed.right.value()
                        >= own.resurrected.right_at_level
                })
            })),
        }
    }

    fn restitution(&self) -> TestedSentence {
        let found = self.each(|k| {
            [&self.fitted[k], &self.housner[k]]
                .map(|own| own.computed.log_likelihood)
        });
        TestedSentence {
            words: "A restitution below Housner's serves better",
            rocks: found.map(|[own, housner]| {
                format!("log-likelihood {own:.1}, with Housner's {housner:.1}")
            }),
            seen: seen(found.map(|[own, housner]| own - housner > GAIN)),
        }
    }

    fn tested(&self) -> [TestedSentence; 5] {
        [
            self.shift_at_uplift(),
            self.no_shift_in_pgv(),
            self.best_measure(),
            self.first_overturning(),
            self.restitution(),
        ]
    }

    /// Sentences beside the measured fates.
    pub fn sentences(&self) -> PlainTable {
        let row = |one: TestedSentence| {
            let [first, second] = one.rocks;
            vec![one.words.into(), one.seen.to_string(), first, second]
        };
        PlainTable::new(
            "tested-sentences",
            "Statements beside the measured fates",
            "Statements 1, 2 and 4 are the paper's; 1 and 2 rest on all tests. \
             Alpha is fitted to each restitution.",
            &["sentence", "seen in these tests", "rock 1", "rock 2"],
            self.tested().into_iter().map(row).collect(),
        )
    }

    /// Who tested what, and with which block it is compared.
    pub fn introduction(&self) -> String {
        let [first, second] = &self.measured;
        let own = &self.fitted[0];
        format!(
            "Saifullah and Wittich [12] shook two free-standing granite \
             rocks with {} motions at up to {} levels: {} tests, in which \
             rock 1 overturned {} and rock 2 {} times. The records of {} \
             tests, of {} motions, are at hand. The model of each rock is a \
             block with p = {} rad/s, from the scanned volume, and an assumed \
             eta of {}. One angle of each is fitted to these fates: alpha = \
             {} rad. Intervals here (90 %) draw motions with all their tests, not earthquakes.",
            self.motions,
            self.levels,
            first.tests,
            first.overturned,
            second.overturned,
            self.compared(),
            own.motions,
            own.p_rad_s,
            own.eta,
            self.fitted_each(|own| plain(&own.alpha_rad)),
        )
    }

    /// How many fates are right, and whether a measure alone does as well.
    pub fn fates(&self) -> String {
        // Against the interval of the block's score; small is good.
        let words = |m: TestMeasure| {
            let [first, second] = self.each(|k| {
                let (low, high) = self.fitted[k].computed.log_score.ends();
                let found = m.predictor(&self.fitted[k]);
                match found.map(|own| own.log_score.value()) {
                    Some(score) if score < low => "better",
                    Some(score) if score > high => "less well",
                    Some(_) => "about as well",
                    None => "not",
                }
            });
            match first == second {
                true => first.to_owned(),
                false => format!("{first} on rock 1, {second} on rock 2"),
            }
        };
        let pairs = self.fitted_each(|own| {
            let own = &own.repeatability;
            format!("{} of {}", own.different, own.pairs)
        });
        format!(
            "The first overturning of the block gets {} of the fates right. \
             By the log score average SA (0.3 to 1.5 s) alone predicts them \
             {}, PGV {}, PGA {}. Tests scatter, too: of pairs of one motion \
             within 5 % in PGA, {pairs} have different fates.",
            self.fitted_each(|own| share(&own.computed.right)),
            words(TestMeasure::AverageSa),
            words(TestMeasure::Pgv),
            words(TestMeasure::Pga),
        )
    }

    /// Dispersions that the model leaves out in a measure, rock by rock.
    fn missing(&self, measure: TestMeasure) -> [Option<Estimate>; 2] {
        self.each(|k| {
            let own = measure.fragilities(&self.fitted[k]);
            own.map(|own| own.missing_dispersion)
        })
    }

    /// What the model leaves out, and what decisions take for it.
    pub fn left_out(&self) -> String {
        let text = |m: TestMeasure| {
            let rocks = self
                .missing(m)
                .map(|own| own.map_or("no fit".into(), |own| plain(&own)));
            format!("{} in {}", both(rocks), m.names()[0])
        };
        let usual = ModelError::default();
        let range = usual.dispersion();
        let own = |of: &Estimate| of.text("", |x| x.to_string());
        let known = [TestMeasure::Pgv, TestMeasure::AverageSa];
        let known = known.into_iter().flat_map(|m| self.missing(m));
        let known: Vec<Estimate> = known.flatten().collect();
        let holds = |x: f64| range.interval().is_some_and(|own| own.holds(x));
        let each = |of: &dyn Fn(&Estimate) -> bool| {
            known.len() == 4 && known.iter().all(of)
        };
        let held = match (
            each(&|own| holds(own.value())),
            each(&|own| own.high().is_some_and(holds)),
        ) {
            (true, true) => "holds these values in PGV and average SA",
            (true, false) => {
                "holds these values in PGV and average SA, not all of their \
                 intervals"
            }
            (false, _) => "does not hold all values in PGV and average SA",
        };
        let onset = self.each(|k| {
            let own = &self.fitted[k].onset;
            [own.whole, own.above].map(|x| x.unwrap_or(f64::NAN))
        });
        let acts = match onset.iter().all(|[whole, above]| whole > above) {
            true => "makes the fates more likely than",
            false => "does not make all fates more likely than",
        };
        let onset =
            both(onset.map(|[whole, above]| {
                format!("{whole:.1} against {above:.1}")
            }));
        format!(
            "Lognormals are fitted in the same way to measured and computed \
             fates. Where the measured one is wider, the root of the \
             difference of the squares is the dispersion that the model \
             leaves out: {}, {}, {}. Decisions (assess, risk, export) \
             therefore multiply each capacity by a lognormal factor of \
             dispersion {} and median {}; the median of a fitted object is \
             {}. The range of the dispersion {held}. The wider range of the median is of a restitution \
             from 0.85 to 0.97. A factor on the whole capacity {acts} one on \
             its part above uplift (log-likelihood {onset}).",
            text(TestMeasure::Pgv),
            text(TestMeasure::AverageSa),
            text(TestMeasure::Pga),
            own(range),
            own(usual.bias()),
            own(ModelError::fitted().bias()),
        )
    }

    /// What is not known of these tests.
    pub fn unknown(&self) -> String {
        format!(
            "Not known: the azimuth of the table, the protocol, the records \
             of the {} longest tests. Both rocks have one shape and a natural base; a \
             flat base was not tested. PGV is the authors'. The band of \
             average SA was chosen after the tests. Another object needs tests \
             of its own.",
            self.missing_motions
        )
    }

    /// How the answer on fragilities stands beside the tests.
    pub fn on_fragility(&self) -> &'static str {
        let both = [self.shift_at_uplift(), self.no_shift_in_pgv()];
        match both.map(|own| own.seen) {
            [Seen::Yes, Seen::Yes] => "tests of two rocks agree",
            [Seen::No, Seen::No] => "tests of two rocks disagree",
            _ => "tests of two rocks agree in part",
        }
    }

    /// The numbers behind it.
    pub fn below_uplift(&self) -> String {
        let of = self.each(|k| {
            let own = &self.measured[k];
            format!("{} of {}", own.overturned_below, own.below)
        });
        format!("overturned below uplift: {}", both(of))
    }

    /// How many fates are right, in a sentence.
    pub fn right(&self) -> String {
        let of =
            self.each(|k| percent(self.fitted[k].computed.right.value(), 0));
        format!(
            "the right outcome in {} of their {} tests",
            both(of),
            self.compared()
        )
    }

    /// The share of right fates of each rock.
    pub fn right_each(&self) -> String {
        let of = self.fitted_each(|own| share(&own.computed.right));
        format!("Right outcomes: {of}")
    }

    /// What was compared, in a few words.
    pub fn counted(&self) -> String {
        format!("{} shaking-table tests of two rocks", self.compared())
    }
}
