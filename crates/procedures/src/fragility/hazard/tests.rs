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
    let site = Some(Site::Degrees(0.0, 0.0));
    let options = HazardOptions { site, ..HazardOptions::default() };
    let hazard = parse(OPENQUAKE, &options).unwrap();
    assert_eq!(
        (hazard.im.clone(), hazard.unit()),
        (HazardMeasure::Of(IntensityMeasure::PGA), "g")
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
        (HazardMeasure::Of(IntensityMeasure::PGV), "cm/s")
    );
    let ratio = hazard.curve.points()[0].1 / fifty.curve.points()[0].1;
    assert!((ratio - 50.0).abs() < 1e-12);
    let one = OPENQUAKE.replace("'PGA'", "'SA(0.3)'");
    assert_eq!(
        parse(&one, &options).unwrap().im,
        HazardMeasure::Of(IntensityMeasure::Sa(0.3))
    );
}

#[test]
fn what_is_no_curve_is_refused_with_its_line() {
    let of = |site| HazardOptions { site, years: None };
    let none = of(None);
    let at = |lon| of(Some(Site::Degrees(lon, 0.0)));
    for (text, options, expected) in [
        (
            OPENQUAKE.to_owned(),
            none.clone(),
            "h.csv: found 2 sites, such as 0.00000,0.00000, 0.10000,0.00000: \
             expected one site",
        ),
        // A degree of the equator is 111.195 km.
        (
            OPENQUAKE.to_owned(),
            at(1.1),
            "h.csv: found no site 1.1,0 among 2: the nearest one is \
             0.10000,0.00000, 111.195 km away",
        ),
        (
            OPENQUAKE.to_owned(),
            of(Some(Site::Degrees(37.9, 123.7))),
            "h.csv: found site 37.9,123.7: expected a longitude from -360",
        ),
        (
            OPENQUAKE.to_owned(),
            at(f64::NAN),
            "h.csv: found site NaN,0: expected a longitude from -360",
        ),
        (
            OPENQUAKE.to_owned(),
            of(Some(Site::Id("x".into()))),
            "h.csv: found no site x, and no column custom_site_id",
        ),
        (
            OPENQUAKE.replacen("0.00000,", "nan,", 1),
            at(0.0),
            "h.csv:3: found site NaN,",
        ),
        (OPENQUAKE.replace("depth", "lon"), at(0.0), "found column `lon`"),
        (OPENQUAKE.replace("depth", "lat"), at(0.0), "found column `lat`"),
        (
            OPENQUAKE.replace("'PGA'", "'AvgSA(2.0)'"),
            at(0.0),
            "h.csv:1: found imt 'AvgSA(2.0)'",
        ),
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
            none.clone(),
            "h.csv:2: found 1 cells",
        ),
        (
            "pga_g,annual_frequency\n0.1,x\n".into(),
            none.clone(),
            "h.csv:2: found `x`",
        ),
        (
            "pga_g,annual_frequency\n".into(),
            at(0.0),
            "h.csv:1: found a curve of no site",
        ),
        (
            "im,annual_frequency\n0.1,1\n".into(),
            none.clone(),
            "h.csv:1: found columns",
        ),
        ("".into(), none.clone(), "h.csv:1: found columns"),
        // No hazard analysis gives such a frequency.
        (
            "pga_g,annual_frequency\n0.1,1\n1,5e-324\n".into(),
            none.clone(),
            "h.csv:3: annual frequency 5e-324 of point 2: expected a number \
             from 1e-150 to 1e150",
        ),
        // A zero within the curve is no end of it.
        (
            "pga_g,annual_frequency\n0.1,1\n1,0\n2,1\n".into(),
            none.clone(),
            "h.csv:3: annual",
        ),
    ] {
        let error = parse(&text, &options).unwrap_err();
        assert!(error.contains(expected), "{error}");
    }
}

/// As `openquake/calculators/export/hazard.py` of 3.26 writes where the site
/// model has such ids: the ids first, and two soils at one place.
const WITH_IDS: &str = "\
    #,,,,,\"generated_by='OpenQuake engine 3.26.2', kind='mean', \
    investigation_time=50.0, imt='AvgSA'\"\n\
    custom_site_id,lon,lat,depth,poe-1.00000e-01,poe-4.00000e-01\n\
    0:CD,15.20000,37.50000,0.00000,4.0E-01,5.0E-02\n\
    0:BC,15.20000,37.50000,0.00000,3.0E-01,4.0E-02\n\
    1:BC,180.00000,-10.00000,0.00000,2.0E-01,3.0E-02\n";

#[test]
fn columns_of_openquake_are_found_by_name_and_sites_by_id() {
    let of = |site: &str| {
        let site = Some(site.parse().unwrap());
        parse(WITH_IDS, &HazardOptions { site, years: None })
    };
    let hazard = of("0:BC").unwrap();
    let (im, frequency) = hazard.curve.points()[0];
    assert_eq!(im, 0.1);
    // -log1p(-0.3)/50 by Python.
    assert!((frequency / 0.007_133_498_878_774_648 - 1.0).abs() < 1e-14);
    // OpenQuake does not write the periods of AvgSA.
    assert_eq!(hazard.unit(), "g");
    assert_eq!(hazard.im, HazardMeasure::AverageSa);
    assert_eq!(hazard.remarks, [HazardRemark::Periods]);
    // A site on the date line has two longitudes.
    let points = |site| of(site).map(|hazard| hazard.curve.points().to_vec());
    assert_eq!(points("1:BC"), points("-179.999998,-10"));
    let two = of("15.2,37.5").unwrap_err();
    let words = "found several sites 15.2,37.5: 15.20000,37.50000 (0:CD), \
                 15.20000,37.50000 (0:BC): expected one site";
    assert!(two.contains(words), "{two}");
    // However many other sites come before them.
    let other = "9:BC,1.00000,2.00000,0.00000,4.0E-01,5.0E-02\n";
    let rows = other.repeat(6) + "0:CD,15.2";
    let text = WITH_IDS.replace("0:CD,15.2", &rows);
    let site = Some(Site::Degrees(15.2, 37.5));
    let two = parse(&text, &HazardOptions { site, years: None });
    assert!(two.unwrap_err().contains(words));
    let none = of("BC").unwrap_err();
    assert!(none.contains("found no site BC among 3, such as"), "{none}");
    assert!(none.contains("(0:CD)"), "{none}");
}

/// In a time that is not their number squared.
#[test]
fn many_comments_are_read() {
    let text = "# a comment\n".repeat(400_000)
        + "pga_g,annual_frequency\n0.1,0.01\n1,0.001\n";
    let hazard = parse(&text, &HazardOptions::default()).unwrap();
    assert_eq!(hazard.curve.points().len(), 2);
}

#[test]
fn what_tells_no_frequency_at_the_ends_is_set_aside_and_counted() {
    let text = "intensity,probability_of_exceedance\n\
        0.1,1\n0.2,0.5\n0.4,0.1\n0.8,0\n1.6,0\n";
    let options = HazardOptions { years: Some(50.0), site: None };
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
        let options = HazardOptions { years: Some(years), site: None };
        assert!(parse(text, &options).is_err());
    }
}
