//! Lists the files of cases: each is a family.

use std::path::Path;
use std::{env, fs};

fn main() {
    println!("cargo::rerun-if-changed=cases");
    let entries = fs::read_dir("cases").expect("the folder cases");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut paths: Vec<_> = paths
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .collect();
    paths.sort();
    let mut rows = String::new();
    for path in &paths {
        let family = path.file_stem().expect("a name").to_string_lossy();
        let path = path.canonicalize().expect("a path");
        rows += &format!("({family:?}, include_str!({path:?})),\n");
    }
    let out = env::var_os("OUT_DIR").expect("a folder");
    let list = Path::new(&out).join("families.rs");
    fs::write(list, format!("&[{rows}]")).expect("a list");
}
