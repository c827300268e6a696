//! Tables of the tests.

use rocking_common::table::PlainTable;
use rocking_procedures::shaking::{Predictor, TestComparison};

use super::sentences::{plain, share};
use super::{RockTests, TestMeasure};

impl RockTests {
    /// The block and measures as predictors of the same outcomes.
    pub fn predictors(&self) -> PlainTable {
        let cells = |name: &str, of: [Option<&Predictor>; 2]| {
            let each = of.map(|own| {
                own.map_or(["no fit"; 3].map(String::from), |own| {
                    [
                        share(&own.right),
                        plain(&own.dispersion),
                        plain(&own.log_score),
                    ]
                })
            });
            let name = name.to_owned();
            [name].into_iter().chain(each.into_iter().flatten()).collect()
        };
        let [first, second] = &self.fitted;
        let block = [first, second].map(|own| Some(&own.computed));
        let measures = TestMeasure::ALL.map(|m| {
            let own = [first, second].map(|own| m.predictor(own));
            cells(m.name, own)
        });
        let rows = [cells("computed block", block)].into_iter();
        PlainTable::new(
            "test-predictors",
            "Predictors of the outcomes",
            "The block is predicted to overturn from its first overturning \
             on, and by a measure if the fitted probability is above one \
             half. Log score: mean of -ln of the probability of the outcome, \
             by a fit without the motion of the test; smaller is better.",
            &[
                "predictor",
                "outcomes right, rock 1",
                "dispersion",
                "log score",
                "outcomes right, rock 2",
                "dispersion",
                "log score",
            ],
            rows.chain(measures).collect(),
        )
    }

    /// Other choices.
    pub fn sensitivity(&self) -> PlainTable {
        let row = |change: &str, rocks: &[TestComparison; 2]| {
            let cells = rocks.iter().flat_map(|own| {
                let all = &own.computed;
                [
                    plain(&own.alpha_rad),
                    share(&all.right),
                    plain(&all.median),
                    plain(&all.dispersion),
                    format!("{:.1}", all.log_likelihood),
                ]
            });
            [change.to_owned()].into_iter().chain(cells).collect()
        };
        let known = [
            ("as above", &self.fitted),
            ("without tests that missed their target", &self.without_targets),
            ("alpha rounded, not fitted", &self.given),
            ("Housner's restitution", &self.housner),
        ];
        let varied = self.varied.iter().map(|v| row(&v.change, &v.rocks));
        let heads = ["alpha (rad)", "right", "bias", "dispersion", "ln L"];
        let header: Vec<String> = ["choice".to_owned()]
            .into_iter()
            .chain((1..=2).flat_map(|rock| {
                heads.map(|head| format!("rock {rock}: {head}"))
            }))
            .collect();
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        PlainTable::new(
            "test-choices",
            "Other choices of the block and the motions",
            format!(
                "Bias: median of measured/computed capacity, 1 if alpha is \
                 fitted (in each row unless rounded). In {} tests the stated \
                 PGA, a target, is more than 10 % off the measured one.",
                self.targets
            ),
            &header,
            known.map(|(c, r)| row(c, r)).into_iter().chain(varied).collect(),
        )
    }

    /// Source, repository and hashes.
    pub fn origin(&self) -> Vec<(String, String)> {
        let source = format!("{}; {}", self.source, self.repository);
        let hash = |(name, sha256): (&String, &String)| {
            (format!("Shaking table, {name}"), format!("sha256 {sha256}"))
        };
        let hashes = self.sha256.iter().map(hash);
        [("Shaking table".into(), source)].into_iter().chain(hashes).collect()
    }
}
