//! The committed page that recomputes: it is what the program makes now, and
//! gives in a browser the bits that the program gives here.

use std::fs;

use rocking_report::lab::{LAB, page};
use serde_json::{Value, json};

use super::super::compare::committed;
use super::{CHECKS, VIEWS, axe, lines, root, started};

/// The engine that a page holds.
fn engine_of(page: &str) -> Option<&str> {
    let (_, rest) = page.split_once("id=\"engine\">")?;
    Some(rest.split_once("</script>")?.0)
}

/// Waits until a script says that something is so.
fn until(what: &str) -> String {
    format!(
        "new Promise((done) => {{ const look = () => {what} ? done(true) : \
         setTimeout(look, 50); look(); }})"
    )
}

fn native(question: &Value) -> Value {
    let answer = rocking_web::answer(&question.to_string());
    let answer: Value = serde_json::from_str(&answer).expect("JSON");
    assert_eq!(answer.get("error"), None);
    answer
}

#[test]
fn the_committed_laboratory_is_what_the_program_makes() {
    let path = root().join("reports").join(LAB);
    let kept = fs::read_to_string(path).expect("the page");
    // `.ci/accept` names the engine that it compiled.
    let engine = match std::env::var_os("ROCKING_ENGINE") {
        Some(path) => fs::read_to_string(path).expect("an engine"),
        None => engine_of(&kept).expect("an engine").to_owned(),
    };
    let now = page(&engine).expect("a page");
    assert!(now.len() <= 1_500_000, "{} bytes", now.len());
    if let Some(kept) = committed("reports/lab.html", &now) {
        assert!(now == kept, "stale: `.ci/accept`");
    }
}

#[test]
fn the_laboratory_is_readable() {
    let Some(mut browser) = started("lab") else { return };
    let path = root().join("reports").join(LAB);
    let mut found = Vec::new();
    for (width_px, scheme) in VIEWS {
        browser.open(&path, width_px, scheme);
        browser.evaluate(&until("document.body.dataset.ready"));
        let mut here = lines(&browser.evaluate(CHECKS)["problems"]);
        here.extend(browser.events());
        found.extend(
            here.iter().map(|p| format!("{width_px} px, {scheme}: {p}")),
        );
        found.extend(axe(&mut browser).unwrap_or_default());
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn a_browser_gives_the_bits_of_the_program() {
    let Some(mut browser) = started("bits") else { return };
    browser.open(&root().join("reports").join(LAB), 1400, "light");
    browser.evaluate(&until("document.body.dataset.ready"));
    browser.evaluate("document.getElementById('all').click()");
    browser.evaluate(&until("document.getElementById('stop').disabled"));
    let differing = browser.evaluate(
        "[...document.querySelectorAll('#cases tbody tr')].filter((row) => \
         row.lastElementChild.textContent !== 'equal').map((row) => \
         row.textContent)",
    );
    assert_eq!(differing, json!([]));
    let cases = native(&json!({ "ask": "cases" }));
    let count = cases.as_array().expect("a list").len();
    assert!(count > 200, "{count} cases");
    let rows = "document.querySelectorAll('#cases tbody tr').length";
    assert_eq!(browser.evaluate(rows), count);
}

/// No number of the last block is left beside the message.
#[test]
fn a_wrong_input_clears_the_result() {
    let Some(mut browser) = started("wrong") else { return };
    browser.open(&root().join("reports").join(LAB), 1400, "light");
    browser.evaluate(&until("document.body.dataset.ready"));
    let shown = "[document.getElementById('verdict').textContent, \
                 document.querySelectorAll('#numbers td, #fragility td, \
                 #scene svg, #history svg').length]";
    let whole = browser.evaluate(shown);
    assert!(whole[1].as_u64().expect("a count") > 10, "{whole}");
    for (field, value) in [("width", "0"), ("width", "45"), ("eta", "1.4")] {
        let before = browser.evaluate("document.body.dataset.changed");
        browser.evaluate(&format!(
            "{{ const own = document.getElementById('{field}'); \
             own.value = '{value}'; own.dispatchEvent(new Event('input', \
             {{ bubbles: true }})); }}"
        ));
        let changed = format!("document.body.dataset.changed !== {before}");
        browser.evaluate(&until(&changed));
        let found = browser.evaluate(shown);
        let words = found[0].as_str().expect("words");
        assert!(words.contains("expected a number"), "{value}: {words}");
        assert_eq!(found[1], 0, "{value}");
    }
}

/// A second of shaking, as a column of time and acceleration.
fn record() -> String {
    let sample = |k: u32| {
        let t = 0.01 * f64::from(k);
        format!("{t:.2},{:.6}\n", 0.3 * libm::sin(9.0 * t))
    };
    let rows: String = (0..150).map(sample).collect();
    format!("time (s),acceleration (g)\n{rows}")
}

#[test]
fn a_dropped_record_has_the_bits_of_the_program() {
    let Some(mut browser) = started("drop") else { return };
    browser.open(&root().join("reports").join(LAB), 1400, "light");
    browser.evaluate(&until("document.body.dataset.ready"));
    let text = record();
    let before = browser.evaluate("document.body.dataset.changed");
    browser.evaluate(&format!(
        "{{ const dataTransfer = new DataTransfer(); \
         dataTransfer.items.add(new File([{}], 'dropped.csv')); \
         dispatchEvent(new DragEvent('drop', {{ dataTransfer }})); }}",
        json!(text)
    ));
    let changed = format!("document.body.dataset.changed !== {before}");
    browser.evaluate(&until(&changed));
    let read = native(&json!({
        "ask": "read", "name": "dropped.csv", "text": text, "dt_s": null,
        "unit": null,
    }));
    let scene = json!({
        "block": { "width_m": 0.3, "height_m": 1.5 }, "eta": 0.92,
        "intensity": 1.2,
        "ground": {
            "kind": "record", "dt_s": read[0]["dt_s"],
            "samples_g": read[0]["samples_g"],
        },
    });
    let ask = |what: &str| {
        let mut question = scene.clone();
        question["ask"] = json!(what);
        native(&question)["bits"].as_str().expect("bits").to_owned()
    };
    let shown = browser.evaluate(
        "[...document.querySelectorAll('#numbers tr')].find((row) => \
         row.cells[0].textContent === 'Bits').cells[1].textContent",
    );
    assert_eq!(shown, ask("response"));
    let rows = "document.querySelectorAll('#fragility tbody tr').length";
    browser.evaluate(&until(&format!("{rows} === 4")));
    let mut question = scene.clone();
    question["ask"] = json!("fragility");
    let law = native(&question);
    let probability = law["probability"].as_f64().expect("a number");
    assert!((0.001..0.999).contains(&probability), "{probability}");
    let percent = format!("{:.1} %", 100.0 * probability);
    let cell = "[...document.querySelectorAll('#fragility tr')].find((row) \
                => row.cells[0]?.textContent === 'Probability of \
                overturning').cells[1].textContent";
    assert_eq!(browser.evaluate(cell), percent);
    let words = "document.getElementById('ida-words').textContent";
    browser.evaluate("document.getElementById('ida').click()");
    browser.evaluate(&until(&format!("{words}.includes('Bits')")));
    let shown = browser.evaluate(words);
    let bits = ask("ida");
    assert!(shown.as_str().expect("words").contains(&bits), "{shown} {bits}");
}
