//! What a block costs, how blocks make tiles, and how tiles are dealt.
//!
//! The cost is that of the analyses of a block's curves. A curve has its
//! levels from uplift to the first overturning, and the halvings of its
//! bracket. Where it ends is guessed from one number of the record,
//! u = p PGV/PGA: IM - 1 = 0.144/u + 0.0586/u^2. That is a fit to the
//! overturnings of both embedded suites for p from 0.7 to 8 rad/s and alpha
//! from 0.05 to 0.60 rad: the levels of a block are 0.7 to 1.45 times those
//! that it needs.

use libm::log2;
use rocking::ida::{HIGHEST_IM, REFINEMENT};
use rocking::record::Profile;
use serde::{Deserialize, Serialize};

/// Coefficients of the guess of a curve's end.
const END: [f64; 2] = [0.144, 0.0586];

/// Seconds of a core that a sample of one level takes: 14e-9 to 25e-9 on
/// shared cores of a server.
const SAMPLE_S: f64 = 19e-9;

/// Seconds of a core that a value of one bootstrap replicate takes.
const VALUE_S: f64 = 40e-9;

/// Some blocks of a plan, one after the other.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tile {
    /// Number of blocks.
    pub blocks: usize,
    /// Analyses, estimated.
    pub analyses: u64,
    /// Seconds of one core that it takes, estimated.
    pub core_s: f64,
}

/// Analyses and seconds of a block.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cost {
    analyses: f64,
    core_s: f64,
}

impl Cost {
    /// Of a block with frequency parameter `p_rad_s` under the records, with
    /// levels `step_im` apart and `fits` bootstrapped fits of `replicates`.
    pub(super) fn of(
        p_rad_s: f64,
        records: &[&Profile],
        step_im: f64,
        (fits, replicates): (usize, usize),
    ) -> Self {
        let mut cost = Self::default();
        let halvings = log2(step_im / REFINEMENT).ceil().max(0.0);
        for record in records {
            let u = p_rad_s * record.velocity_ratio_s();
            let end = END[0] / u + END[1] / (u * u);
            let levels = end.min(HIGHEST_IM) / step_im + 1.0 + halvings;
            let samples = record.samples() as f64;
            cost.analyses += levels;
            cost.core_s += levels * samples * SAMPLE_S;
        }
        let values = records.len() * fits * replicates;
        cost.core_s += values as f64 * VALUE_S;
        cost
    }
}

/// Puts blocks, in their order, into tiles of about `tile_s` seconds: as many
/// tiles as fit best, each about as costly as the others.
pub(super) fn tiles(costs: &[Cost], tile_s: f64) -> Vec<Tile> {
    let whole: f64 = costs.iter().fold(0.0, |sum, cost| sum + cost.core_s);
    let most = costs.len() as f64;
    let number = (whole / tile_s).round().clamp(1.0, most);
    let mut out: Vec<(f64, Tile)> = Vec::new();
    let mut before = 0.0;
    for cost in costs {
        // The tile in whose share of the whole the middle of the block lies.
        let middle = (before + 0.5 * cost.core_s) / whole;
        let place = (middle * number).floor();
        before += cost.core_s;
        if out.last().is_none_or(|(last, _)| *last != place) {
            let none = Tile { blocks: 0, analyses: 0, core_s: 0.0 };
            out.push((place, none));
        }
        if let Some((_, tile)) = out.last_mut() {
            tile.blocks += 1;
            tile.analyses += cost.analyses as u64;
            tile.core_s += cost.core_s;
        }
    }
    out.into_iter().map(|(_, tile)| tile).collect()
}

/// The tiles of each of `of` tasks, the costliest first: in falling cost,
/// each tile goes to the task that has the least to do so far.
pub(super) fn deal(tiles: &[Tile], of: usize) -> Vec<Vec<usize>> {
    let mut order: Vec<usize> = (0..tiles.len()).collect();
    order.sort_by(|a, b| tiles[*b].core_s.total_cmp(&tiles[*a].core_s));
    let mut tasks: Vec<(f64, Vec<usize>)> = vec![(0.0, Vec::new()); of];
    for tile in order {
        let least = tasks.iter_mut().min_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((sum, own)) = least {
            *sum += tiles[tile].core_s;
            own.push(tile);
        }
    }
    tasks.into_iter().map(|(_, own)| own).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn costs(seconds: &[f64]) -> Vec<Cost> {
        let of = |s: &f64| Cost { analyses: 1.0, core_s: *s };
        seconds.iter().map(of).collect()
    }

    #[test]
    fn tiles_are_about_equal_and_hold_each_block_once() {
        // Costs fall like those of blocks by rising p.
        let seconds: Vec<f64> =
            (1..=300).map(|k| 12.0 / f64::from(k)).collect();
        let tiles = tiles(&costs(&seconds), 4.0);
        let blocks: usize = tiles.iter().map(|tile| tile.blocks).sum();
        assert_eq!(blocks, 300);
        let sum: f64 = tiles.iter().map(|tile| tile.core_s).sum();
        let whole: f64 = seconds.iter().sum();
        assert!((sum - whole).abs() < 1e-9 * whole);
        // Of tiles with equal numbers of blocks the first would cost 45 s.
        // Four blocks cost more than half a tile each.
        for tile in &tiles[6..] {
            assert!((3.5..4.5).contains(&tile.core_s), "{tile:?}");
        }
        assert_eq!(tiles[0].blocks, 1);
        assert_eq!(super::tiles(&costs(&seconds), 1e9).len(), 1);
        assert_eq!(super::tiles(&costs(&[1.0; 7]), 1e-9).len(), 7);
        // One that costs nothing is in a tile, too.
        let tiles = super::tiles(&costs(&[0.0, 1.0, 0.0]), 1e-9);
        assert_eq!(tiles.iter().map(|t| t.blocks).sum::<usize>(), 3);
    }

    #[test]
    fn tasks_end_together_and_share_no_tile() {
        let tile = |s: f64| Tile { blocks: 1, analyses: 1, core_s: s };
        let uneven: Vec<Tile> =
            (0..23).map(|k| tile(10.0 + f64::from(k % 5) * 4.0)).collect();
        for of in [1, 2, 3, 7] {
            let tasks = deal(&uneven, of);
            let mut all: Vec<usize> = tasks.concat();
            all.sort_unstable();
            assert_eq!(all, (0..23).collect::<Vec<_>>());
            let sums: Vec<f64> = tasks
                .iter()
                .map(|own| own.iter().map(|t| uneven[*t].core_s).sum())
                .collect();
            let most = sums.iter().fold(0.0_f64, |m, x| m.max(*x));
            let mean = sums.iter().sum::<f64>() / of as f64;
            // In turn, the first of two tasks has 12 of 23 tiles.
            assert!(mean / most > 0.88, "{of}: {sums:?}");
            if of == 2 {
                assert!(mean / most > 0.98, "{sums:?}");
            }
        }
        assert_eq!(deal(&uneven[..1], 3), [vec![0], vec![], vec![]]);
    }
}
