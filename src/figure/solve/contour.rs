use std::collections::BTreeMap;

use glam::{DVec2, dvec2};

use super::line::Target;
use crate::document::figure::Contour;
use crate::figure::complex::{arg, conj_mul, continued, div, mul};
use crate::figure::mesh::{Mesh, Part};

/// Samples along an outline.
const SAMPLES: usize = 128;
/// Of shifts whose sums differ by less than this part, the first is taken.
const SAME: f64 = 1e-12;

/// The outer outline of the largest part of a region: vertices of the mesh, counter-clockwise, from that of smallest x
/// (then y). Empty if the region has no triangle.
pub(crate) fn outline(mesh: &Mesh, region: usize) -> Vec<u32> {
    let triangles =
        (0..mesh.triangle_count()).filter(|t| mesh.tissue(*t).part == Part::Region(region));
    let mut across: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    for t in triangles.clone() {
        let [a, b, c] = mesh.triangles[t];
        for edge in [(a, b), (b, c), (c, a)] {
            across.insert(edge, t);
        }
    }
    let largest = largest_part(mesh, triangles, &across);
    across.retain(|_, t| largest.contains(t));
    let third = |(a, b): (u32, u32)| {
        let t = across.get(&(a, b))?;
        mesh.triangles[*t]
            .into_iter()
            .find(|vertex| *vertex != a && *vertex != b)
    };
    let mut left: Vec<(u32, u32)> = across
        .keys()
        .copied()
        .filter(|(a, b)| !across.contains_key(&(*b, *a)))
        .collect();
    let mut best: (f64, Vec<u32>) = (0.0, Vec::new());
    while let Some(first) = left.first().copied() {
        let mut line = Vec::new();
        let mut edge = first;
        loop {
            line.push(edge.0);
            left.retain(|other| *other != edge);
            // Around the edge's end through the part's triangles, to the next edge with nothing on its other side.
            let mut next = third(edge).map(|c| (edge.1, c));
            while let Some((a, c)) = next.filter(|(a, c)| across.contains_key(&(*c, *a))) {
                next = third((c, a)).map(|d| (a, d));
            }
            match next {
                Some(next) if next != first => edge = next,
                _ => break,
            }
        }
        let places: Vec<DVec2> = line
            .iter()
            .map(|vertex| mesh.vertices[*vertex as usize])
            .collect();
        let area = signed_area(&places);
        if area > best.0 {
            best = (area, line);
        }
    }
    let mut line = best.1;
    let key = |vertex: &u32| mesh.vertices[*vertex as usize];
    let compare = |a: &u32, b: &u32| {
        key(a)
            .x
            .total_cmp(&key(b).x)
            .then(key(a).y.total_cmp(&key(b).y))
    };
    if let Some(start) = (0..line.len()).min_by(|i, j| compare(&line[*i], &line[*j])) {
        line.rotate_left(start);
    }
    line
}

/// The triangles of the part with the largest area; a part hangs together over edges.
fn largest_part(
    mesh: &Mesh,
    triangles: impl Iterator<Item = usize>,
    across: &BTreeMap<(u32, u32), usize>,
) -> std::collections::BTreeSet<usize> {
    let mut left: std::collections::BTreeSet<usize> = triangles.collect();
    let mut best = (0.0, Vec::new());
    while let Some(first) = left.pop_first() {
        let mut part = vec![first];
        let mut next = 0;
        while let Some(t) = part.get(next).copied() {
            next += 1;
            let [a, b, c] = mesh.triangles[t];
            for edge in [(b, a), (c, b), (a, c)] {
                if let Some(other) = across.get(&edge)
                    && left.remove(other)
                {
                    part.push(*other);
                }
            }
        }
        let area = part.iter().map(|t| mesh.area(*t)).sum::<f64>();
        if area > best.0 {
            best = (area, part);
        }
    }
    best.1.into_iter().collect()
}

/// Where a contour takes the vertices of an outline (Chen et al., section 4.1; spec/figures.md, "Contour style").
pub(crate) fn targets(contour: &Contour, outline: &[DVec2]) -> Vec<Target> {
    let (p, spacing) = samples(outline);
    let Some(edges) = edges(contour, &p) else {
        return outline.iter().map(|place| still(*place)).collect();
    };
    let f = summed(&p, &edges, &contour.keep);
    let moves: Vec<DVec2> = f.iter().zip(&p).map(|(f, p)| *f - *p).collect();
    let mut logs: Vec<DVec2> = Vec::with_capacity(SAMPLES + 1);
    for i in 0..=SAMPLES {
        let (before, after) = ((i + SAMPLES - 1) % SAMPLES, (i + 1) % SAMPLES);
        let ratio = div(f[after] - f[before], p[after] - p[before]);
        let turn = logs
            .last()
            .map_or(arg(ratio), |last| continued(arg(ratio), last.y));
        logs.push(dvec2(
            libm::log(ratio.length().max(f64::MIN_POSITIVE)),
            turn,
        ));
    }
    let mut along = 0.0;
    let mut last = outline[0];
    let target = |place: &DVec2| {
        along += place.distance(last);
        last = *place;
        let at = (along / spacing).min(SAMPLES as f64 - 1e-9);
        let (i, part) = (at as usize, at.fract());
        let between = |a: DVec2, b: DVec2| a + part * (b - a);
        let log = between(logs[i], logs[i + 1]);
        Target {
            place: *place + between(moves[i], moves[(i + 1) % SAMPLES]),
            turn: log.y,
            log_scale: log.x,
        }
    };
    outline.iter().map(target).collect()
}

fn still(place: DVec2) -> Target {
    Target {
        place,
        turn: 0.0,
        log_scale: 0.0,
    }
}

/// The edge to each sample from the one before, as the contour wants it; none if the other outline has no length.
fn edges(contour: &Contour, p: &[DVec2]) -> Option<Vec<DVec2>> {
    let mirror = if contour.mirror {
        dvec2(-1.0, 1.0)
    } else {
        DVec2::ONE
    };
    let mut like: Vec<DVec2> = contour.like.iter().map(|point| *point * mirror).collect();
    if signed_area(&like) < 0.0 {
        // The first point stays the first.
        like[1..].reverse();
    }
    let (mut q, _) = samples(&like);
    let mean = |list: &[DVec2]| list.iter().sum::<DVec2>() / SAMPLES as f64;
    let (mean_p, mean_q) = (mean(p), mean(&q));
    let square: f64 = q.iter().map(|q| (*q - mean_q).length_squared()).sum();
    if square <= 0.0 || !square.is_finite() {
        return None;
    }
    let sum = |k: usize| -> DVec2 {
        let product = |i: usize| conj_mul(q[(i + k) % SAMPLES] - mean_q, p[i] - mean_p);
        (0..SAMPLES).map(product).sum()
    };
    let sums: Vec<DVec2> = (0..SAMPLES).map(sum).collect();
    let largest = sums.iter().map(|sum| sum.length()).fold(0.0, f64::max);
    let shift = sums
        .iter()
        .position(|sum| sum.length() >= largest * (1.0 - SAME))?;
    let z = sums[shift] / square;
    q.iter_mut().for_each(|q| *q = mul(z, *q));
    let edge = |i: usize| {
        let (before, like) = ((i + SAMPLES - 1) % SAMPLES, (i + shift) % SAMPLES);
        let like_before = (like + SAMPLES - 1) % SAMPLES;
        (1.0 - contour.amount) * (p[i] - p[before]) + contour.amount * (q[like] - q[like_before])
    };
    Some((0..SAMPLES).map(edge).collect())
}

/// The samples of a line whose edges are given and of which those nearest to `keep` stay: running sums, with a
/// correction that is linear along the line between two that stay. If none stays, the mean does.
fn summed(p: &[DVec2], edges: &[DVec2], keep: &[DVec2]) -> Vec<DVec2> {
    let nearest = |place: &DVec2| {
        let distance = |i: &usize| p[*i].distance_squared(*place);
        (0..SAMPLES)
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .unwrap_or(0)
    };
    let mut kept: Vec<usize> = keep.iter().map(nearest).collect();
    kept.sort_unstable();
    kept.dedup();
    let mut f = p.to_vec();
    let first = kept.first().copied().unwrap_or(0);
    let ends = kept.iter().copied().skip(1).chain([first + SAMPLES]);
    let mut begin = first;
    for end in ends {
        let mut sum = p[begin % SAMPLES];
        for i in begin + 1..end {
            sum += edges[i % SAMPLES];
            f[i % SAMPLES] = sum;
        }
        let lack = p[end % SAMPLES] - (sum + edges[end % SAMPLES]);
        for i in begin + 1..end {
            f[i % SAMPLES] += lack * ((i - begin) as f64 / (end - begin) as f64);
        }
        begin = end;
    }
    if kept.is_empty() {
        let shift = p.iter().zip(&f).map(|(p, f)| *p - *f).sum::<DVec2>() / SAMPLES as f64;
        f.iter_mut().for_each(|f| *f += shift);
    }
    f
}

/// Places equally spaced along a closed line, from its first point, and their spacing.
fn samples(line: &[DVec2]) -> (Vec<DVec2>, f64) {
    let n = line.len();
    let length: f64 = (0..n).map(|i| line[i].distance(line[(i + 1) % n])).sum();
    let spacing = length / SAMPLES as f64;
    let mut found = Vec::with_capacity(SAMPLES);
    let (mut i, mut before) = (0, 0.0);
    for k in 0..SAMPLES {
        let wanted = k as f64 * spacing;
        loop {
            let step = line[i % n].distance(line[(i + 1) % n]);
            if wanted <= before + step || i + 1 >= n {
                let part = if step > 0.0 {
                    ((wanted - before) / step).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                found.push(line[i % n] + part * (line[(i + 1) % n] - line[i % n]));
                break;
            }
            before += step;
            i += 1;
        }
    }
    (found, spacing)
}

fn signed_area(points: &[DVec2]) -> f64 {
    let n = points.len();
    let origin = points.first().copied().unwrap_or(DVec2::ZERO);
    let product = |i: usize| (points[i] - origin).perp_dot(points[(i + 1) % n] - origin);
    (0..n).map(product).sum::<f64>() / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::complex::polar;

    fn blob(n: usize) -> Vec<DVec2> {
        let at = |i: usize| {
            let angle = std::f64::consts::TAU * i as f64 / n as f64;
            polar(0.2 + 0.05 * (3.0 * angle).cos() + 0.03 * angle.sin(), angle)
        };
        (0..n).map(at).collect()
    }

    fn contour(like: Vec<DVec2>) -> Contour {
        Contour {
            region: "blob".to_owned(),
            like,
            amount: 1.0,
            mirror: false,
            keep: Vec::new(),
        }
    }

    #[test]
    fn its_own_outline_turned_and_scaled_moves_nothing() {
        let outline = blob(97);
        let like: Vec<DVec2> = outline
            .iter()
            .map(|p| mul(polar(7.0, 2.0), *p) + dvec2(3.0, 4.0))
            .collect();
        for (target, place) in targets(&contour(like), &outline).iter().zip(&outline) {
            assert!(
                (target.place - *place).length() < 1e-12,
                "{} {place}",
                target.place
            );
            assert!(
                target.turn.abs() < 1e-12 && target.log_scale.abs() < 1e-12,
                "{target:?}"
            );
        }
    }

    #[test]
    fn kept_places_stay() {
        let outline = blob(200);
        let mut contour = contour((0..64).map(|i| polar(1.0, f64::from(i) * 0.1)).collect());
        contour.keep = vec![outline[20], outline[150]];
        let targets = targets(&contour, &outline);
        for i in [20, 150] {
            assert!(targets[i].place.distance(outline[i]) < 0.01, "kept");
        }
        let most = targets
            .iter()
            .zip(&outline)
            .map(|(t, p)| t.place.distance(*p))
            .fold(0.0, f64::max);
        assert!(most > 0.02, "others move: {most}");
    }
}
