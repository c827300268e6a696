//! Our own answers, and those of every wrong model, against the data set.

use rocking_score::{Verdict, own_answers, reference, score};

#[test]
fn our_own_answers_have_every_digit_that_double_precision_can_get() {
    let found = score(&own_answers().unwrap());
    let lacking: Vec<_> = found
        .quantities
        .iter()
        .filter(|q| !q.attained)
        .map(|q| {
            let (x, c) = (q.value.number(), q.certified.number());
            let e = x.zip(c).map(|(x, c)| -((x - c) / c).abs().log10());
            format!("{} {}: {e:?} of {:?}", q.scene, q.quantity, q.attainable_digits)
        })
        .collect();
    assert_eq!(found.answered, reference().items.len());
    assert!(lacking.is_empty(), "{}: {lacking:#?}", lacking.len());
    assert_eq!(found.diagnosis.verdict, Verdict::None);
}
