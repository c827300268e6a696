//! The results of the tests, in sentences that rules choose.

use rocking_common::findings::Seen;
use rocking_common::table::PlainTable;
use rocking_common::words::{percent, rounded};
use rocking_procedures::ModelError;
use rocking_procedures::shaking::TestComparison;
use rocking_statistics::Estimate;

use super::{RockTests, TestMeasure};
use crate::quantity::{EstimateText, ValueScale};

/// Smallest gain of log-likelihood at which one more parameter of a fit is
/// significant at 5 %.
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

/// A statement beside measured outcomes: its words, the numbers of each rock,
/// and whether they agree with it.
struct TestedSentence {
    words: &'static str,
    rocks: [String; 2],
    seen: Seen,
}

impl RockTests {
    /// A number of each rock.
    fn each<T>(&self, of: impl Fn(usize) -> T) -> [T; 2] {
        [of(0), of(1)]
    }

    /// A number of the fitted block of each rock.
    fn fitted_each(&self, of: impl Fn(&TestComparison) -> String) -> String {
        both(self.each(|k| of(&self.fitted[k])))
    }

    /// A statement, by the numbers of each rock and whether they agree with
    /// it.
    fn tested(
        &self,
        words: &'static str,
        of: impl Fn(usize) -> (String, bool),
    ) -> TestedSentence {
        let [(first, a), (second, b)] = self.each(of);
        let seen = match (a, b) {
            (true, true) => Seen::Yes,
            (false, false) => Seen::No,
            _ => Seen::InPart,
        };
        TestedSentence { words, rocks: [first, second], seen }
    }

    fn shift_at_uplift(&self) -> TestedSentence {
        self.tested("In PGA the fragility starts at uplift", |k| {
            let own = &self.measured[k];
            let numbers = format!(
                "{} of {} overturned up to uplift at {} g; {} expected \
                 without a shift",
                own.overturned_below,
                own.below,
                three(own.onset_g),
                three(own.expected_below)
            );
            let few = (own.overturned_below as f64) < 0.5 * own.expected_below;
            (numbers, few)
        })
    }

    fn no_shift_in_pgv(&self) -> TestedSentence {
        self.tested("In PGV the shift gains less than in PGA", |k| {
            let own = &self.measured[k];
            let pgv = own.pgv_shifted - own.pgv_unshifted;
            let pga = own.pga_shifted - own.pga_unshifted;
            let numbers =
                format!("log-likelihood: PGV {pgv:+.1}, PGA {pga:+.1}");
            (numbers, pgv < pga && pga > GAIN)
        })
    }

    fn best_measure(&self) -> TestedSentence {
        let words = "PGV predicts overturning better than PGA, and average \
                     SA better than both";
        self.tested(words, |k| {
            let found = TestMeasure::ALL.map(|m| {
                let own = m.predictor(&self.fitted[k]);
                own.map_or([f64::NAN; 2], |own| {
                    [own.dispersion.value(), own.log_score.value()]
                })
            });
            let [pga, pgv, average] = found.map(|[_, score]| score);
            let of = |(m, [dispersion, _]): (TestMeasure, [f64; 2])| {
                format!("{} {}", m.name, three(dispersion))
            };
            let all = TestMeasure::ALL.into_iter().zip(found);
            let all: Vec<String> = all.map(of).collect();
            let numbers = format!("dispersion: {}", all.join(", "));
            (numbers, pgv < pga && average < pgv)
        })
    }

    fn first_overturning(&self) -> TestedSentence {
        self.tested("Resurrections may be left out", |k| {
            // Of the fitted block and of the one with a rounded angle.
            let shares = [&self.fitted[k], &self.given[k]].map(|own| {
                let level = own.resurrected.right_at_level;
                [own.computed.right.value(), level]
            });
            let [fitted, rounded] =
                shares.map(|all| all.map(|share| percent(share, 1)));
            let numbers = format!(
                "right: {} by first overturning, {} at the level; alpha \
                 rounded: {}",
                fitted[0],
                fitted[1],
                rounded.join(", ")
            );
            (numbers, shares.iter().all(|[first, level]| first >= level))
        })
    }

    fn restitution(&self) -> TestedSentence {
        self.tested("A restitution below Housner's fits better", |k| {
            let [own, housner] = [&self.fitted[k], &self.housner[k]]
                .map(|own| own.computed.log_likelihood);
            let numbers = format!(
                "log-likelihood {own:.1}, with Housner's {housner:.1}"
            );
            (numbers, own - housner > GAIN)
        })
    }

    /// Statements beside the measured outcomes.
    pub fn sentences(&self) -> PlainTable {
        let all = [
            self.shift_at_uplift(),
            self.no_shift_in_pgv(),
            self.best_measure(),
            self.first_overturning(),
            self.restitution(),
        ];
        let row = |TestedSentence { words, rocks, seen }| {
            let [first, second] = rocks;
            vec![String::from(words), seen.to_string(), first, second]
        };
        PlainTable::new(
            "tested-sentences",
            "Statements and the measured outcomes",
            "Statements 1, 2 and 4 are the paper's; 1 and 2 use all tests. \
             Alpha is refitted for each restitution.",
            &["statement", "seen in these tests", "rock 1", "rock 2"],
            all.map(row).into(),
        )
    }

    /// The tests, and the block with which each rock is compared.
    pub fn introduction(&self) -> String {
        let [first, second] = &self.measured;
        let own = &self.fitted[0];
        format!(
            "Saifullah and Wittich [12] shook two free-standing granite \
             rocks with {} motions at up to {} levels: {} tests, in which \
             rock 1 overturned {} and rock 2 {} times. The records of {} \
             tests, of {} motions, are available. The model of each rock is \
             a block with p = {} rad/s, from the scanned volume, and an \
             assumed eta of {}. One angle of each is fitted to these \
             outcomes: alpha = {} rad. Intervals here (90 %) resample motions \
             with all their tests, not earthquakes.",
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

    /// The share of right outcomes, and whether a measure alone does as well.
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
            "The first overturning of the block predicts {} of the outcomes \
             correctly. By the log score, average SA (0.3 to 1.5 s) by itself \
             predicts them {}, PGV {}, PGA {}. Tests scatter, too: of pairs of \
             tests with the same motion and PGAs within 5 %, {pairs} have \
             different outcomes.",
            self.fitted_each(|own| share(&own.computed.right)),
            words(TestMeasure::AVERAGE_SA),
            words(TestMeasure::PGV),
            words(TestMeasure::PGA),
        )
    }

    /// Dispersions that the model leaves out in a measure, rock by rock.
    fn missing(&self, measure: TestMeasure) -> [Option<Estimate>; 2] {
        self.each(|k| {
            let own = measure.fragilities(&self.fitted[k]);
            own.map(|own| own.missing_dispersion)
        })
    }

    /// The dispersion that the model leaves out, and the one that decisions
    /// assume for it.
    pub fn left_out(&self) -> String {
        let text = |m: TestMeasure| {
            let rocks = self
                .missing(m)
                .map(|own| own.map_or("no fit".into(), |own| plain(&own)));
            format!("{} in {}", both(rocks), m.name)
        };
        let usual = ModelError::default();
        let range = usual.dispersion();
        let own = |of: &Estimate| of.text("", |x| x.to_string());
        let holds = |x: f64| range.interval().is_some_and(|own| own.holds(x));
        let known = [TestMeasure::PGV, TestMeasure::AVERAGE_SA];
        let known = known.map(|m| self.missing(m));
        let each = |of: &dyn Fn(Estimate) -> bool| {
            known.as_flattened().iter().all(|own| own.is_some_and(of))
        };
        let held = match (
            each(&|own| holds(own.value())),
            each(&|own| own.high().is_some_and(holds)),
        ) {
            (true, true) => "contains these values in PGV and average SA",
            (true, false) => {
                "contains these values in PGV and average SA, but not all of \
                 their intervals"
            }
            (false, _) => "does not contain all values in PGV and average SA",
        };
        let onset = self.each(|k| {
            let own = &self.fitted[k].onset;
            [own.whole, own.above].map(|x| x.unwrap_or(f64::NAN))
        });
        let acts = match onset.iter().all(|[whole, above]| whole > above) {
            true => "makes the outcomes more likely than",
            false => "does not make all outcomes more likely than",
        };
        let onset =
            onset.map(|own| format!("{:.1} against {:.1}", own[0], own[1]));
        format!(
            "Lognormals are fitted in the same way to measured and computed \
             outcomes. If the measured one is wider, the root of the \
             difference of the squared dispersions is the dispersion that the \
             model leaves out: {}, {}, {}. Decisions (commands assess, risk, \
             fragility export) \
             therefore multiply each capacity by a lognormal factor of \
             dispersion {} and median {}; the median for a fitted object is \
             {}. The range of the dispersion {held}. The wider range of the \
             median comes from a restitution of 0.85 to 0.97. A factor on the \
             whole capacity {acts} a factor on its part above uplift \
             (log-likelihood {}).",
            text(TestMeasure::PGV),
            text(TestMeasure::AVERAGE_SA),
            text(TestMeasure::PGA),
            own(range),
            own(usual.bias()),
            own(ModelError::fitted().bias()),
            both(onset)
        )
    }

    /// The unknowns of these tests.
    pub fn unknown(&self) -> String {
        format!(
            "Not known: the azimuth of the table, the protocol, the records \
             of the {} longest tests. Both rocks have one shape and a natural \
             base; a flat base was not tested. PGV is as the authors state \
             it. The band of average SA was chosen after the tests. Any other \
             object needs its own tests.",
            self.missing_motions
        )
    }

    /// Whether the tests agree with the answer on fragilities.
    pub fn on_fragility(&self) -> &'static str {
        let both = [self.shift_at_uplift(), self.no_shift_in_pgv()];
        match both.map(|own| own.seen) {
            [Seen::Yes, Seen::Yes] => "tests of two rocks agree",
            [Seen::No, Seen::No] => "tests of two rocks disagree",
            _ => "tests of two rocks agree in part",
        }
    }

    /// The numbers behind that.
    pub fn below_uplift(&self) -> String {
        let of = self.each(|k| {
            let own = &self.measured[k];
            format!("{} of {}", own.overturned_below, own.below)
        });
        format!("overturned below uplift: {}", both(of))
    }

    /// The share of right outcomes, in a sentence.
    pub fn right(&self) -> String {
        let of =
            self.each(|k| percent(self.fitted[k].computed.right.value(), 0));
        format!(
            "the right outcome in {} of their {} tests",
            both(of),
            self.compared()
        )
    }

    /// The share of right outcomes of each rock.
    pub fn right_each(&self) -> String {
        let of = self.fitted_each(|own| share(&own.computed.right));
        format!("Right outcomes: {of}")
    }

    /// The number of tests, in a few words.
    pub fn counted(&self) -> String {
        format!("{} shaking-table tests of two rocks", self.compared())
    }
}
