//! The lines between regions: traced along pixels, smoothed, simplified, and shared by the two regions beside them
//! (spec/figures.md, "Outlines").

mod line;
mod touch;
mod trace;

use std::collections::BTreeMap;

use glam::DVec2;

use self::line::{Finish, corners, finished};
use self::touch::touching;
use self::trace::Traced;
use super::regions::RegionMap;
use crate::document::figure::Region;

pub(crate) use self::line::distance_squared;
pub(crate) use self::trace::OUTSIDE;

/// Points of all outlines together at most.
const MAX_POINTS: usize = 60_000;
/// How far a line may be from the smoothed one, pixels.
const TOLERANCE: f64 = 0.75;
/// Smoothing of lines that no region lies beside, pixels: that of a region that does not say.
const DEFAULT_SMOOTH: f64 = 1.5;
/// How often smoothing and tolerance are halved at most; one level further a line follows the pixels' edges.
const HALVINGS: u8 = 4;

/// The outlines of all regions as a network: no two lines cross or touch but at their ends.
pub(crate) struct Outlines {
    traced: Traced,
    /// Per line, how it is finished before any halving; none: it follows the picture's edge.
    finish: Vec<Option<Finish>>,
    /// Per line, how often its smoothing and tolerance are halved.
    levels: Vec<u8>,
    /// Per line its points, map space; of a closed one without the first again.
    lines: Vec<Vec<DVec2>>,
    keeps_area: bool,
    size: [usize; 2],
}

/// A segment of an outline, with the labels to its sides as seen on the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Edge {
    /// Indices of its ends among the network's points.
    pub(crate) ends: [u32; 2],
    /// Label to the left when one goes from the first end to the second.
    pub(crate) left: u8,
    /// Label to the right.
    pub(crate) right: u8,
    /// Index of the line that it is a part of.
    pub(crate) line: u32,
}

impl Outlines {
    /// The outlines of a map; none if they have more points than a figure may have. `coarser` is how often the
    /// tolerance is doubled.
    pub(crate) fn new(map: &RegionMap, regions: &[Region], coarser: u32) -> Option<Self> {
        let traced = Traced::new(map, MAX_POINTS)?;
        let tolerance = TOLERANCE * f64::from(1_u32 << coarser.min(26));
        let smooth = |label: u8| regions.get(usize::from(label)).map(|region| region.smooth);
        let finish = traced.lines.iter().map(|line| {
            let is_edge = line.left == OUTSIDE || line.right == OUTSIDE;
            // Regions in front have larger numbers; the rest and what is transparent have none.
            let of = |label: u8| {
                if usize::from(label) < regions.len() {
                    i32::from(label)
                } else {
                    -1
                }
            };
            let front = if of(line.left) > of(line.right) {
                line.left
            } else {
                line.right
            };
            (!is_edge).then(|| Finish {
                smooth: smooth(front).unwrap_or(DEFAULT_SMOOTH),
                tolerance,
            })
        });
        let finish: Vec<_> = finish.collect();
        let n = traced.lines.len();
        let mut outlines = Self {
            levels: vec![0; n],
            lines: vec![Vec::new(); n],
            keeps_area: coarser == 0,
            size: map.size,
            finish,
            traced,
        };
        (0..n).for_each(|i| outlines.draw(i));
        let is_few = |outlines: &Self| {
            outlines.lines.iter().map(Vec::len).sum::<usize>() <= MAX_POINTS + 2 * n
        };
        if !is_few(&outlines) {
            return None;
        }
        outlines.untangle();
        (outlines.point_count() <= MAX_POINTS).then_some(outlines)
    }

    /// Draws a line at its level, or at the first one further at which enough is left of it.
    fn draw(&mut self, i: usize) {
        let line = self.traced.lines[i];
        let points = self.traced.points(&line);
        while let (Some(finish), 0..=HALVINGS) = (self.finish[i], self.levels[i]) {
            let factor = 1.0 / f64::from(1_u32 << self.levels[i]);
            let finish = Finish {
                smooth: finish.smooth * factor,
                tolerance: finish.tolerance * factor,
            };
            if let Some(drawn) = finished(points, line.is_closed, finish, self.keeps_area) {
                self.lines[i] = drawn;
                return;
            }
            self.levels[i] += 1;
        }
        self.lines[i] = corners(points, line.is_closed);
    }

    /// Smooths lines less and less where they cross or touch.
    fn untangle(&mut self) {
        loop {
            let found = touching(&self.lines, |i| self.traced.lines[i].is_closed, self.size);
            if !self.redraw(found) {
                return;
            }
        }
    }

    /// Draws lines with half of their smoothing and tolerance. False if all of them follow the pixels already.
    fn redraw(&mut self, lines: impl IntoIterator<Item = usize>) -> bool {
        let mut is_changed = false;
        for i in lines {
            if self.finish[i].is_some() && self.levels[i] <= HALVINGS {
                self.levels[i] += 1;
                self.draw(i);
                is_changed = true;
            }
        }
        is_changed
    }

    /// Draws lines with half of their smoothing, as what lies beside them has come to their other side. False if
    /// nothing could be changed.
    pub(crate) fn refine(&mut self, lines: impl IntoIterator<Item = usize>) -> bool {
        let is_changed = self.redraw(lines);
        self.untangle();
        is_changed
    }

    /// Number of points of the network.
    fn point_count(&self) -> usize {
        let inner = |(line, points): (&trace::TracedLine, &Vec<DVec2>)| {
            if line.is_closed {
                points.len()
            } else {
                points.len() - 2
            }
        };
        let inner: usize = self.traced.lines.iter().zip(&self.lines).map(inner).sum();
        inner + self.junctions().len()
    }

    /// The ends of lines, in order, with their numbers.
    fn junctions(&self) -> BTreeMap<[u16; 2], u32> {
        let open = self.traced.lines.iter().filter(|line| !line.is_closed);
        let ends = open.flat_map(|line| {
            let points = self.traced.points(line);
            [points[0], points[points.len() - 1]]
        });
        let mut junctions: BTreeMap<[u16; 2], u32> = ends.map(|end| (end, 0)).collect();
        for (number, index) in junctions.values_mut().zip(0..) {
            *number = index;
        }
        junctions
    }

    /// Points (map space) and edges of the network; junctions come first.
    pub(crate) fn network(&self) -> (Vec<DVec2>, Vec<Edge>) {
        let junctions = self.junctions();
        let place = |at: &[u16; 2]| DVec2::new(f64::from(at[0]), f64::from(at[1]));
        let mut points: Vec<DVec2> = junctions.keys().map(place).collect();
        let mut edges = Vec::new();
        for (i, (line, drawn)) in self.traced.lines.iter().zip(&self.lines).enumerate() {
            let traced = self.traced.points(line);
            let mut indices: Vec<u32> = Vec::with_capacity(drawn.len() + 1);
            let inner = if line.is_closed {
                &drawn[..]
            } else {
                &drawn[1..drawn.len() - 1]
            };
            if !line.is_closed {
                indices.push(junctions[&traced[0]]);
            }
            for point in inner {
                indices.push(points.len() as u32);
                points.push(*point);
            }
            indices.push(if line.is_closed {
                indices[0]
            } else {
                junctions[&traced[traced.len() - 1]]
            });
            edges.extend(indices.windows(2).map(|ends| Edge {
                ends: [ends[0], ends[1]],
                left: line.left,
                right: line.right,
                line: i as u32,
            }));
        }
        (points, edges)
    }
}
