use super::*;

fn parse(text: &str, options: &HazardOptions) -> Result<Hazard, String> {
    Hazard::parse("h.csv", text, options).map_err(|e| e.to_string())
}

/// As in the manual of OpenQuake, "Outputs from Classical PSHA".
const OPENQUAKE: &str = "\
    #,,,,,\"generated_by='OpenQuake engine 3.18.0', \
    start_date='2023-10-03T06:09:08', checksum=2107362341, kind='mean', \
    investigation_time=1.0, imt='PGA'\"\n\
    lon,lat,depth,poe-0.1000000,poe-0.4000000,poe-0.6000000\n\
    0.00000,0.00000,-0.10000,4.553860E-01,5.754042E-02,6.354511E-03\n\
    0.10000,0.00000,-0.10000,1.522632E-01,0.000000E+00,0.000000E+00\n";

#[test]
fn a_curve_of_openquake_gives_the_frequencies_of_its_site() {
    let site_deg = Some((0.0, 0.0));
    let options = HazardOptions { site_deg, ..HazardOptions::default() };
    let hazard = parse(OPENQUAKE, &options).unwrap();
    assert_eq!(
        (hazard.im.clone(), hazard.unit()),
        (Some(IntensityMeasure::Pga), "g")
    );
    // -log1p(-P) by Python.
    let expected = [
        (0.1, 0.607_677_992_132_021_6),
        (0.4, 0.059_262_246_521_244_07),
        (0.6, 0.006_374_786_846_055_813),
    ];
    for (found, expected) in hazard.curve.points().iter().zip(expected) {
        assert_eq!(found.0, expected.0);
        assert!((found.1 / expected.1 - 1.0).abs() < 1e-14, "{found:?}");
    }
    // In 50 years, by a measure with levels in cm/s.
    let fifty = OPENQUAKE.replace("time=1.0", "time=50").replace("PGA", "PGV");
    let fifty = parse(&fifty, &options).unwrap();
    assert_eq!(
        (fifty.im.clone(), fifty.unit()),
        (Some(IntensityMeasure::Pgv), "cm/s")
    );
    let ratio = hazard.curve.points()[0].1 / fifty.curve.points()[0].1;
    assert!((ratio - 50.0).abs() < 1e-12);
    let one = OPENQUAKE.replace("'PGA'", "'SA(0.3)'");
    assert_eq!(
        parse(&one, &options).unwrap().im,
        Some(IntensityMeasure::Sa(0.3))
    );
}

#[test]
fn what_is_no_curve_is_refused_with_its_line() {
    let none = HazardOptions::default();
    let at = |lon| HazardOptions { site_deg: Some((lon, 0.0)), ..none };
    for (text, options, expected) in [
        (OPENQUAKE.to_owned(), none, "h.csv: found 2 such sites of 2"),
        (OPENQUAKE.to_owned(), at(7.0), "h.csv: found 0 such sites of 2"),
        (
            OPENQUAKE.to_owned(),
            at(0.1),
            "h.csv: 1 points: expected at least two",
        ),
        (OPENQUAKE.replace("PGA", "PGD"), at(0.0), "h.csv:1: found imt 'PGD'"),
        (
            OPENQUAKE.replace(", imt='PGA'", ""),
            at(0.0),
            "h.csv:1: found no imt",
        ),
        (
            OPENQUAKE.replace("investigation_time=1.0, ", ""),
            at(0.0),
            "--years",
        ),
        (
            OPENQUAKE.replace("poe-0.4000000", "x"),
            at(0.0),
            "h.csv:2: found col",
        ),
        (
            OPENQUAKE.replace("poe-0.4000000", "poe-x"),
            at(0.0),
            "h.csv:2: found `x`",
        ),
        (
            OPENQUAKE.replace("5.754042E-02", "1.2"),
            at(0.0),
            "h.csv:3: found probability 1.2",
        ),
        (
            OPENQUAKE.replace("5.754042E-02", "NaN"),
            at(0.0),
            "h.csv:3: found probability NaN",
        ),
        (
            OPENQUAKE.replace("5.754042E-02", "0.9"),
            at(0.0),
            "h.csv:3: annual frequency",
        ),
        (
            "pga_g,annual_frequency\n0.1\n".into(),
            none,
            "h.csv:2: found 1 cells",
        ),
        ("pga_g,annual_frequency\n0.1,x\n".into(), none, "h.csv:2: found `x`"),
        (
            "pga_g,annual_frequency\n".into(),
            at(0.0),
            "h.csv:1: found a curve of no site",
        ),
        (
            "im,annual_frequency\n0.1,1\n".into(),
            none,
            "h.csv:1: found columns",
        ),
        ("".into(), none, "h.csv:1: found columns"),
        // A zero within the curve is no end of it.
        (
            "pga_g,annual_frequency\n0.1,1\n1,0\n2,1\n".into(),
            none,
            "h.csv:3: annual",
        ),
    ] {
        let error = parse(&text, &options).unwrap_err();
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn what_tells_no_frequency_at_the_ends_is_set_aside_and_counted() {
    let text = "intensity,probability_of_exceedance\n\
        0.1,1\n0.2,0.5\n0.4,0.1\n0.8,0\n1.6,0\n";
    let options = HazardOptions { years: Some(50.0), site_deg: None };
    let hazard = parse(text, &options).unwrap();
    assert_eq!(
        hazard.remarks,
        [HazardRemark::Certain(1), HazardRemark::Zeros(2)]
    );
    assert_eq!(hazard.curve.points().len(), 2);
    // The number of a point counts what was set aside.
    let error = parse(&text.replace("0.4,", "0.1,"), &options).unwrap_err();
    assert!(error.starts_with("h.csv:4: intensity 0.1 of point 3"), "{error}");
    for years in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let options = HazardOptions { years: Some(years), site_deg: None };
        assert!(parse(text, &options).is_err());
    }
}
