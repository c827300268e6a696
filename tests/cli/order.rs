//! Orders that are refused.

use super::support::{folder, refused};

#[test]
fn orders_are_refused_where_there_is_no_choice_of_them() {
    let place = folder("orders", &[]);
    for (flags, words) in [
        ("--order 5", "possible values: 4, 6, 8, 10"),
        ("--order 6 --certify", "cannot be used with"),
        ("--order 6 --forces f.csv", "cannot be used with"),
        ("--order 6 --friction 0.5", "cannot be used with"),
        ("--order 6 --model linearized", "--order is for Eq. 1"),
    ] {
        let ida = "ida --alpha 0.1 --p 3 --suite s --out o.csv";
        let error = refused(&place, &format!("{ida} {flags}"));
        assert!(error.contains(words), "{flags}: {error}");
    }
}
