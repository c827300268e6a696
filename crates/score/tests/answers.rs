//! Our own answers, and those of every wrong model, against the data set.

use std::path::Path;

use rocking_score::{
    Answers, CodeVerdict, codes, own_answers, reference, score,
};

#[test]
fn answers_that_are_refused() {
    for (text, expected) in [
        (
            "scene,value\n",
            "a.csv:1: found columns `scene,value`: expected \
             `scene,quantity,value`",
        ),
        (
            "scene,quantity,value\nfree-half,fate,rocked\nno,fate,rocked\n",
            "a.csv:3: scene `no`: expected a name of scenes.json",
        ),
        (
            "scene,quantity,value\nfree-half,uplift_time_s,0\n",
            "a.csv:2: scene free-half with quantity `uplift_time_s`: expected \
             one of its `quantities` in scenes.json",
        ),
        (
            "scene,quantity,value\nfree-half,rest_time_s,NaN\n",
            "a.csv:2: free-half, rest_time_s: found `NaN`: expected a finite \
             number, or nothing if it is missing",
        ),
        (
            "scene,quantity,value\nfree-half,fate,stands\n",
            "a.csv:2: free-half, fate: found `stands`: expected one of \
             no-uplift, rocked, overturned",
        ),
        (
            "scene,quantity,value\nfree-half,impacts,1.5\n",
            "a.csv:2: free-half, impacts: found `1.5`: expected a count",
        ),
        (
            "scene,quantity,value\nfree-half,impacts,1\nfree-half,impacts,1\n",
            "a.csv:3: free-half, impacts: expected it once",
        ),
    ] {
        let error = Answers::parse(text, Path::new("a.csv")).unwrap_err();
        assert_eq!(error.to_string(), expected);
    }
}

/// Some thirty answers are enough to find a mistake, and eleven are not.
#[test]
fn few_answers_and_missing_ones() {
    let set = reference();
    let model = set.models.iter().position(|m| m == "eta-squared").unwrap();
    let of = |level: u8, most: usize| {
        let mut few = Answers::none();
        let items = set.items.iter().enumerate();
        let items = items
            .filter(|(_, item)| set.scene(item).level == level)
            .filter(|(_, item)| item.value.number().is_some());
        for (place, item) in items.take(most) {
            few.set(place, item.wrong[model].clone());
        }
        score(&few)
    };
    assert_eq!(of(1, 11).diagnosis.verdict, CodeVerdict::TooFew);
    let found = of(1, 30);
    assert_eq!(found.levels[1].median_digits, None);
    let names = found.diagnosis.explanations.iter().map(|one| {
        one.mistakes.iter().map(|m| m.name.clone()).collect::<Vec<_>>()
    });
    assert_eq!(names.collect::<Vec<_>>(), [["eta-squared"]]);
}

#[test]
fn our_own_answers_have_every_digit_that_double_precision_can_get() {
    let found = score(&own_answers().unwrap());
    let lacking: Vec<_> = found
        .quantities
        .iter()
        .filter(|q| !q.attained)
        .map(|q| {
            let (x, c) = (q.value.number(), q.certified.number());
            let e = x.zip(c).map(|(x, c)| ((x - c) / c).abs());
            format!(
                "{} {}: {e:?} of {:?}",
                q.scene, q.quantity, q.attainable_digits
            )
        })
        .collect();
    assert_eq!(found.answered, reference().items.len());
    assert!(lacking.is_empty(), "{}: {lacking:#?}", lacking.len());
    assert_eq!(found.diagnosis.verdict, CodeVerdict::None);
}

#[test]
fn scores_of_known_codes_are_those_of_their_answers() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../fixtures/benchmark/answers");
    let codes = codes();
    for one in
        codes.chunk_by(|a, b| (&a.code, &a.setting) == (&b.code, &b.setting))
    {
        let path = format!("{}-{}.csv", one[0].code, one[0].setting);
        let path = folder.join(path);
        let text = std::fs::read_to_string(&path).unwrap();
        let found = score(&Answers::parse(&text, &path).unwrap());
        for code in one {
            let level = &found.levels[usize::from(code.level) - 1];
            let median = level.median_digits.unwrap();
            assert!((median - code.median_digits).abs() < 0.006, "{path:?}");
            assert_eq!(level.fates_wrong, code.fates_wrong, "{path:?}");
        }
    }
    assert_eq!(codes.iter().filter(|code| code.level == 1).count(), 22);
}
