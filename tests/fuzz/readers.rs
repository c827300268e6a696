//! Fuzzes the target that `ROCKING_TARGET` names, or else all of them.

#![no_main]

mod targets;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let wanted = std::env::var("ROCKING_TARGET").ok();
    let wanted = |name: &str| wanted.as_ref().is_none_or(|own| own == name);
    for name in targets::names().filter(|name| wanted(name)) {
        let _ = targets::run(name, bytes);
    }
});
