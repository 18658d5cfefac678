use glam::DVec2;

use super::mask::Mask;
use crate::document::figure::Flood;
use crate::figure::plane::Plane;
use crate::pictures::Picture;

/// Red, green and blue of a picture over white, sRGB bytes, row by row.
pub(crate) fn over_white(picture: &Picture) -> Vec<[u8; 3]> {
    let blend = |[r, g, b, alpha]: &[u8; 4]| {
        let alpha = u32::from(*alpha);
        // (c·α + 255·(255 − α))/255 is never half way between two numbers, as 255 is odd.
        [*r, *g, *b].map(|c| ((u32::from(c) * alpha + 255 * (255 - alpha) + 127) / 255) as u8)
    };
    picture.pixels.iter().map(blend).collect()
}

/// The pixels of a picture (colours over white) that a flood takes: the union over its points.
pub(crate) fn flood(colors: &[[u8; 3]], plane: &Plane, flood: &Flood) -> Mask {
    let size = plane.map.map(|side| side as usize);
    let mut region = Mask::none(size);
    for at in &flood.at {
        let Some([column, row]) = plane.pixel_at(*at) else {
            continue;
        };
        let start = row * size[0] + column;
        let like = like_pixels(colors, size, start, flood.tolerance);
        let taken = if !flood.connected {
            like
        } else if flood.gap > 0.0 {
            flood_with_gap(&like, plane.map_from_figure(*at), flood.gap)
        } else {
            like.reached_from(start)
        };
        region.add(&taken);
    }
    region
}

/// Pixels of which no channel differs by more than the tolerance from that of the first.
fn like_pixels(colors: &[[u8; 3]], size: [usize; 2], start: usize, tolerance: f64) -> Mask {
    let tolerance = tolerance.floor() as u8;
    let first = colors[start];
    let is_like = |color: &[u8; 3]| (0..3).all(|i| color[i].abs_diff(first[i]) <= tolerance);
    Mask {
        size,
        bits: colors.iter().map(is_like).collect(),
    }
}

/// A flood through like pixels that no unlike one is within `gap` of, grown by it again.
fn flood_with_gap(like: &Mask, at: DVec2, gap: f64) -> Mask {
    let room = like.inverted().grown(gap).inverted();
    let Some(start) = nearest(&room, at, 2.0 * gap) else {
        return Mask::none(like.size);
    };
    let mut taken = room.reached_from(start).grown(gap);
    taken.keep(like);
    taken
}

/// The pixel of a set whose centre is nearest to a point of the map, at most `reach` away; of equally near ones the
/// first by row, then by column.
fn nearest(mask: &Mask, at: DVec2, reach: f64) -> Option<usize> {
    let [width, height] = mask.size;
    let range = |middle: f64, side: usize| {
        let first = (middle - reach - 1.0).max(0.0) as usize;
        first..((middle + reach + 1.0) as usize + 1).min(side)
    };
    let mut best = None;
    let mut least = reach * reach;
    for row in range(at.y, height) {
        for column in range(at.x, width) {
            let centre = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
            let distance = centre.distance_squared(at);
            let is_nearer = distance < least || (best.is_none() && distance <= least);
            if mask.bits[row * width + column] && is_nearer {
                least = distance;
                best = Some(row * width + column);
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    /// A room with dark walls; the wall to the right has a hole of `hole` pixels.
    fn room(hole: usize) -> (Picture, Plane) {
        let size = [60, 40];
        let mut pixels = vec![[250, 250, 250, 255]; 60 * 40];
        for row in 0..40 {
            for column in 0..60 {
                let is_hole = (20..20 + hole).contains(&row);
                if !(2..=37).contains(&row) || column < 2 || (30..32).contains(&column) && !is_hole
                {
                    pixels[row * 60 + column] = [10, 10, 10, 255];
                }
            }
        }
        let picture = Picture {
            size,
            pixels,
            is_of_inks: false,
        };
        (picture, Plane::of_picture(size))
    }

    fn taken(hole: usize, gap: f64) -> usize {
        let (picture, plane) = room(hole);
        let mut source = Flood::new(vec![dvec2(-0.25, 0.0)]);
        source.gap = gap;
        flood(&over_white(&picture), &plane, &source).count()
    }

    #[test]
    fn gaps_up_to_twice_the_gap_do_not_leak() {
        let inside = 28 * 36;
        assert_eq!(taken(0, 0.0), inside, "a closed room");
        assert!(
            taken(1, 0.0) > 2 * inside - 200,
            "a hole of one pixel leaks"
        );
        for gap in [1_u8, 2, 3, 5] {
            let hole = 2 * usize::from(gap);
            // Of the room all but what a disk cannot touch in the corners; of the hole what grows back into it.
            let closed = taken(hole, f64::from(gap));
            assert!(
                closed.abs_diff(inside) <= 4 * usize::from(gap).pow(2),
                "gap {gap}: {closed} of {inside}"
            );
            assert!(
                taken(hole + 2, f64::from(gap)) > inside + 500,
                "gap {gap}: a wider hole leaks"
            );
        }
    }

    #[test]
    fn transparency_counts_as_white() {
        let picture = Picture {
            size: [3, 1],
            pixels: vec![[255, 255, 255, 255], [0, 0, 0, 0], [0, 0, 0, 128]],
            is_of_inks: false,
        };
        assert_eq!(
            over_white(&picture),
            [[255; 3], [255; 3], [127; 3]],
            "over white"
        );
    }

    #[test]
    fn a_flood_from_outside_takes_nothing() {
        let (picture, plane) = room(0);
        let source = Flood::new(vec![dvec2(0.7, 0.0), dvec2(0.0, -0.4)]);
        assert_eq!(
            flood(&over_white(&picture), &plane, &source).count(),
            0,
            "outside"
        );
    }
}
