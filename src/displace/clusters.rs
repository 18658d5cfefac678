//! Which tools of a sweep act together. Tools and images whose reaches stay apart, from the first key to the last, move
//! each their own tissue: what one moves comes into the reach of no other. The flow of each is found without the
//! others, which is the same flow and far less work.

use super::mover::{Ball, Mover, images_of};
use glam::DVec3;

/// A ball about the reach of a tool at a part of its way: its path is parted into so many at most.
const PARTS: usize = 64;
/// Reaches are taken for this part of them larger: the way of a tool leaves the balls about its parts by less.
const SLACK: f64 = 1e-3;

/// Tools and images whose reaches meet, by their places among the tools, and what is their like in mirrors.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cluster {
    /// The tools, in order.
    pub(super) tools: Vec<usize>,
    /// Signs of the axes of each image, and its tool among `tools`.
    pub(super) images: Vec<(DVec3, usize)>,
    /// Signs of the axes by which all of them are mirrored together; the first mirrors nothing.
    pub(super) copies: Vec<DVec3>,
}

/// Parts tools in mirrors into clusters. Every image of every tool is an image of one copy of one cluster.
pub(super) fn clusters(movers: &[Mover<'_>], mirror: [bool; 3]) -> Vec<Cluster> {
    let signs = images_of(mirror);
    let reaches: Vec<Vec<Ball>> = movers.iter().map(reach).collect();
    let count = movers.len();
    let nodes = signs.len() * count;
    // The least of the images that each hangs together with.
    let mut least: Vec<usize> = (0..nodes).collect();
    for one in 0..nodes {
        for other in one + 1..nodes {
            let (from, to) = (least[one], least[other]);
            let between = signs[one / count] * signs[other / count];
            if from != to && meet(&reaches[one % count], &reaches[other % count], between) {
                let (from, to) = (from.max(to), from.min(to));
                for place in &mut least {
                    *place = if *place == from { to } else { *place };
                }
            }
        }
    }
    let image = |sign: DVec3| signs.iter().position(|other| *other == sign).unwrap_or(0);
    let mut is_placed = vec![false; nodes];
    let mut all = Vec::new();
    for first in 0..nodes {
        if is_placed[first] {
            continue;
        }
        let members: Vec<usize> = (0..nodes).filter(|i| least[*i] == least[first]).collect();
        let mut copies = Vec::new();
        for sign in &signs {
            let mirrored = |i: usize| image(*sign * signs[i / count]) * count + i % count;
            if !is_placed[mirrored(first)] {
                copies.push(*sign);
                for member in &members {
                    is_placed[mirrored(*member)] = true;
                }
            }
        }
        let mut tools: Vec<usize> = members.iter().map(|i| i % count).collect();
        tools.sort_unstable();
        tools.dedup();
        let images = members.iter().filter_map(|i| {
            let tool = tools.binary_search(&(i % count)).ok()?;
            Some((signs[i / count], tool))
        });
        all.push(Cluster {
            images: images.collect(),
            tools,
            copies,
        });
    }
    all
}

/// Balls about all that a tool reaches on its way.
fn reach(mover: &Mover<'_>) -> Vec<Ball> {
    let pieces = mover.screws.len().max(1);
    let parts = PARTS.div_ceil(pieces);
    let count = pieces * parts;
    let at = |i: usize| i as f64 / count as f64;
    let balls: Vec<Ball> = (0..count)
        .map(|i| mover.ball(at(i), at(i + 1)))
        .map(|ball| Ball {
            radius: ball.radius * (1.0 + SLACK),
            ..ball
        })
        .collect();
    let chunks = balls.chunks(count.div_ceil(PARTS));
    chunks.filter_map(Ball::around).collect()
}

/// True if a reach meets the other one's image.
fn meet(one: &[Ball], other: &[Ball], image: DVec3) -> bool {
    let meet = |a: &Ball, b: &Ball| a.middle.distance(image * b.middle) < a.radius + b.radius;
    let around = [one, other].map(Ball::around);
    if let [Some(one), Some(other)] = &around
        && !meet(one, other)
    {
        return false;
    }
    one.iter().any(|a| other.iter().any(|b| meet(a, b)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::displace::ToolShape;
    use crate::math::Similarity;
    use glam::DQuat;

    /// Balls of radius 0.1, coated 0.1 wide, on straight ways.
    fn of_ways(ways: &[[DVec3; 2]], mirror: [bool; 3]) -> Vec<Cluster> {
        let ball = ToolShape::Ball { radius: 0.1 };
        let pose = |at: &DVec3| Similarity::new(1.0, DQuat::IDENTITY, *at);
        let mover = |way: &[DVec3; 2]| Mover::new(&ball, 1.0, 0.1, way.iter().map(pose).collect());
        let movers: Vec<Mover<'_>> = ways.iter().map(mover).collect();
        clusters(&movers, mirror)
    }

    const ALONE: [(DVec3, usize); 1] = [(DVec3::ONE, 0)];
    const ACROSS_X: DVec3 = DVec3::new(-1.0, 1.0, 1.0);
    const ACROSS_Y: DVec3 = DVec3::new(1.0, -1.0, 1.0);

    #[test]
    fn a_tool_that_stays_on_its_side_is_alone() {
        let way = [DVec3::new(0.25, 0.0, -1.0), DVec3::new(0.3, 0.0, 1.0)];
        let all = of_ways(&[way], [true, false, false]);
        assert_eq!(all.len(), 1);
        assert_eq!(all[0].images, ALONE);
        assert_eq!(all[0].copies, [DVec3::ONE, ACROSS_X]);
        // Nearer to the plane than tool and coating are wide, at its end alone.
        let to_plane = [way[0], DVec3::new(0.15, 0.0, 1.0)];
        let all = of_ways(&[to_plane], [true, false, false]);
        assert_eq!(all.len(), 1);
        assert_eq!(all[0].images, [(DVec3::ONE, 0), (ACROSS_X, 0)]);
        assert_eq!(all[0].copies, [DVec3::ONE]);
        // In two mirrors it meets the image in one of them.
        let all = of_ways(&[to_plane.map(|at| at + DVec3::Y)], [true, true, false]);
        assert_eq!(all.len(), 1);
        assert_eq!(all[0].images, [(DVec3::ONE, 0), (ACROSS_X, 0)]);
        assert_eq!(all[0].copies, [DVec3::ONE, ACROSS_Y]);
    }

    /// Where one has been before, the other takes what it brought.
    #[test]
    fn ways_that_cross_at_any_time_belong_together() {
        let along = [DVec3::ZERO, DVec3::new(2.0, 0.0, 0.0)];
        let across = [DVec3::new(0.1, 0.3, 0.0), DVec3::new(0.1, 2.0, 0.0)];
        let away = [DVec3::new(0.1, 0.5, 0.0), DVec3::new(0.1, 2.0, 0.0)];
        let none = [false; 3];
        let all = of_ways(&[along, across], none);
        assert_eq!(all.len(), 1);
        assert_eq!(all[0].images, [(DVec3::ONE, 0), (DVec3::ONE, 1)]);
        let all = of_ways(&[along, away], none);
        assert_eq!(
            all.iter().map(|c| &c.tools[..]).collect::<Vec<_>>(),
            [[0], [1]]
        );
        assert!(all.iter().all(|cluster| cluster.images == ALONE));
        // A third one leads from one to the other.
        let between = [DVec3::new(0.1, 0.25, 0.0), DVec3::new(0.1, 0.3, 0.0)];
        assert_eq!(of_ways(&[along, away, between], none).len(), 1);
    }

    /// A tool meets the image of the other, not the other.
    #[test]
    fn a_tool_may_meet_the_image_of_another_alone() {
        let one = [DVec3::new(1.0, 0.0, 0.0); 2];
        let other = [DVec3::new(-1.0, 0.3, 0.0), DVec3::new(-1.0, 0.3, 1.0)];
        let all = of_ways(&[one, other], [true, false, false]);
        assert_eq!(all.len(), 1);
        assert_eq!(all[0].images, [(DVec3::ONE, 0), (ACROSS_X, 1)]);
        assert_eq!(all[0].copies, [DVec3::ONE, ACROSS_X]);
    }
}
