//! Enough of XML to tell that a drawing is well-formed.

/// Tags nest, attributes are quoted and unique, entities are known.
pub fn check(text: &str) -> Result<(), String> {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = text;
    while let Some(start) = rest.find('<') {
        entities(&rest[..start])?;
        let tag = &rest[start..];
        let end = tag.find('>').ok_or("a tag without an end")?;
        let inside = &tag[1..end];
        rest = &tag[end + 1..];
        if let Some(name) = inside.strip_prefix('/') {
            if open.pop() != Some(name) {
                return Err(format!("</{name}> closes nothing"));
            }
            continue;
        }
        let alone = inside.ends_with('/');
        let inside = inside.trim_end_matches('/');
        let (name, attributes) =
            inside.split_once([' ', '\n']).unwrap_or((inside, ""));
        check_attributes(attributes).map_err(|e| format!("<{name}>: {e}"))?;
        if !alone {
            open.push(name);
        }
    }
    if rest.trim().is_empty() && open.is_empty() {
        Ok(())
    } else {
        Err(format!("left open: {open:?}"))
    }
}

fn check_attributes(mut text: &str) -> Result<(), String> {
    let mut names: Vec<&str> = Vec::new();
    while !text.trim().is_empty() {
        let (name, value) =
            text.split_once("=\"").ok_or(format!("no value in {text}"))?;
        let name = name.trim();
        let (value, after) =
            value.split_once('"').ok_or(format!("no end of {name}"))?;
        entities(value)?;
        if names.contains(&name) || name.contains(' ') {
            return Err(format!("attribute {name}"));
        }
        names.push(name);
        text = after;
    }
    Ok(())
}

fn entities(text: &str) -> Result<(), String> {
    for after in text.split('&').skip(1) {
        let name = after.split(';').next().unwrap_or("");
        if !["amp", "lt", "gt", "quot"].contains(&name) {
            return Err(format!("entity &{name};"));
        }
    }
    Ok(())
}

#[test]
fn sees_what_is_wrong() {
    assert!(check("<a b=\"1\"><c/>x &amp; y</a>").is_ok());
    assert!(check("<a><b></a></b>").is_err());
    assert!(check("<a b=\"1\" b=\"2\"/>").is_err());
    assert!(check("<a>x & y</a>").is_err());
    assert!(check("<a>").is_err());
}
