//! Tiles put together.

use std::path::Path;

use rocking::stop;

use super::content::Content;
use super::plan::SweepFolder;
use super::tile;
use crate::failure::{Failure, bail};
use rocking_common::files::Outputs;
use rocking_common::table::body;

/// Tiles that a message names.
const NAMED: usize = 10;

/// Puts the tiles together in the plan's order, one after the other, as CSV.
/// The bytes are the same for any number of tasks.
///
/// # Errors
/// [`Failure`] that names the tiles that are missing, of another plan or
/// another build, or damaged. `out` is then as it was.
pub fn merge(
    planned: &SweepFolder,
    content: Content,
    out: &Path,
) -> Result<(), Failure> {
    let mut output = Outputs::of(planned.files()).open(out)?;
    let mut flaws = Vec::new();
    let tiles = planned.plan.tiles();
    for tile in 0..tiles {
        stop::point();
        let text = tile::read(planned, content, tile);
        match text {
            // The header is written once.
            Ok(text) if tile == 0 => output.add(&text)?,
            Ok(text) => output.add(body(&text))?,
            Err(state) => flaws.push((tile, state)),
        }
    }
    if flaws.is_empty() {
        return Ok(output.finish()?);
    }
    let named = flaws.iter().take(NAMED).map(|(tile, state)| {
        let path = planned.tile_path(content, *tile);
        format!("{}: {}", path.display(), state.name())
    });
    let mut named: Vec<String> = named.collect();
    if flaws.len() > NAMED {
        named.push(format!("and {} more", flaws.len() - NAMED));
    }
    bail!(
        "{} of {tiles} tiles are not done; run the sweep again: {}",
        flaws.len(),
        named.join("; ")
    )
}
