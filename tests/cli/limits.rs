//! Runs without end are refused, and the limit can be raised.

use super::support::{at2, folder, json, refused_for};

#[test]
fn a_run_beyond_its_limit_says_which_flag_raises_it() {
    let place = folder("limits", &[]);
    let free = "respond --alpha 0.2 --p 2 --free --initial-ratio 0.5";
    refused_for(
        &place,
        &format!("{free} --eta 0.999999"),
        &["more than 1000000 impacts by ", "raised by --most-impacts"],
    );
    let few = format!("{free} --eta 0.9 --most-impacts 10");
    refused_for(&place, &few, &["more than 10 impacts by "]);
    let enough = format!("{free} --eta 0.9 --most-impacts 1000 --json");
    assert_eq!(json(&place, &enough)["outcome"], "rocked");
    refused_for(
        &place,
        "respond --alpha 0.2 --p 2 --pulse rectangle --duration-s 1e9 \
         --amplitude-m-s2 1 --history h.csv --most-steps 1000",
        &["more than 1000 history points by ", "raised by --most-steps"],
    );
}

#[test]
fn a_level_beyond_its_limit_is_named() {
    let samples = [0.0, 0.3, 0.3, 0.3, 0.0, -0.3, 0.0, 0.0, 0.0, 0.0];
    let push = at2("0.02", samples.len(), &samples);
    let place = folder("limits-ida", &[("suite/push.at2", &push)]);
    refused_for(
        &place,
        "ida --alpha 0.2 --p 2 --suite suite --out o.csv --most-impacts 1",
        &["push", " at IM ", "more than 1 impacts by ", "by --most-impacts"],
    );
}
