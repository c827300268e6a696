//! What was set aside when a suite was read, for machines.

use rocking::record::{AsideCount, SetAside};
use serde_json::{Value, json};

/// The number of files, and for each reason its number and first file.
#[must_use]
pub fn json(set_aside: &SetAside) -> Value {
    let code = |count: AsideCount<'_>| {
        json!({
            "code": count.reason.code(),
            "files": count.files,
            "first": count.first,
        })
    };
    let codes: Vec<Value> = set_aside.counts().into_iter().map(code).collect();
    json!({ "files": set_aside.all().len(), "codes": codes })
}
