use super::facts::{
    Amount, Arc, Facts, Given, Grip, Group, Holds, INF, Icon, Material, Mirror, Reach, Shape, aabb,
    on_arc,
};
use super::spec::{TemplateSpec, number};
use glam::{Vec2, Vec3};
use std::f32::consts::{FRAC_PI_4, PI};

/// The arc of a bend; `None` where it is not bent.
fn arc(given: &Given) -> Option<Arc> {
    let angle = given.p[0];
    if angle.abs() < 1e-4 {
        return None;
    }
    let end = given.p[2].max(given.p[1] + 0.01).min(1.0);
    let start = given.p[1].min(end - 0.01);
    Some(Arc {
        start: start * given.size.y,
        length: (end - start) * given.size.y,
        turn: angle.abs(),
        side: angle.signum(),
        size: given.size,
    })
}

impl Arc {
    /// Where a point of the middle plane goes, at `along` from the start, `height` above (both metric); as metric (y,
    /// z).
    fn subject(&self, along: f32, height: f32) -> Vec2 {
        let radius = self.length / self.turn;
        let angle = (along / radius).clamp(0.0, self.turn);
        let past = along - angle * radius;
        // `on_arc` measures from straight down and turns towards -u; here the arc starts at the top and turns towards
        // +u.
        let p = -on_arc(angle, radius + height) + Vec2::new(angle.cos(), -angle.sin()) * past;
        Vec2::new(
            self.start + p.x,
            0.5 * self.size.z + self.side * (p.y - radius),
        )
    }

    /// Box of where the material of a box (template space, finite) is after bending, template space.
    pub(crate) fn bounds(&self, material: &crate::math::Aabb) -> crate::math::Aabb {
        let radius = self.length / self.turn;
        let end = (material.max.y * self.size.y - self.start).max(self.length);
        let heights = [material.min.z, material.max.z].map(|z| self.side * (z - 0.5) * self.size.z);
        let mut out = crate::math::Aabb::EMPTY;
        let mut add = |along: f32, height: f32| {
            let p = self.subject(along, height) / Vec2::new(self.size.y, self.size.z);
            let ends = [material.min.x, material.max.x].map(|x| Vec3::new(x, p.x, p.y));
            out = out.union(crate::math::Aabb::from_points(ends));
        };
        for height in heights {
            // The arc ends at the centre of curvature; its extremes are at its ends and where it runs along an axis.
            let quarters = [0.5, 1.0].map(|half| half * std::f32::consts::PI * radius);
            let alongs = quarters.into_iter().filter(|a| *a < self.length);
            for along in alongs.chain([0.0, self.length]) {
                add(along, height.max(-radius));
            }
            // The turned straight part is a box, the centre of curvature or not.
            add(self.length, height);
            add(end, height);
        }
        // The straight part before the arc stays.
        out.union(*material)
    }
}

/// All that is known about bend besides its formula. It is grabbed at the middle of its far end.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "bend",
        summary: "Bend a bar that runs along y",
        params: &[
            number(
                "angle",
                "Towards -z, or +z if negative, radians",
                FRAC_PI_4,
                -PI,
                PI,
            ),
            number("start", "Where along y the bend begins", 0.25, 0.0, 1.0),
            number("end", "Where along y the bend ends", 0.75, 0.0, 1.0),
        ],
        main_param: Some(0),
    },
    holds: Holds::Parameters,
    amount: Amount::Parameters,
    reach: |given| {
        let Some(arc) = arc(given) else {
            return Reach::NONE;
        };
        let start = arc.start / given.size.y;
        // The far side of the centre of curvature, where the nearer end may be the turned one.
        let behind = 0.5 - arc.side * arc.length / arc.turn / given.size.z;
        let far_side = if arc.side > 0.0 {
            aabb([-INF; 3], [INF, INF, behind])
        } else {
            aabb([-INF, -INF, behind], [INF; 3])
        };
        Reach {
            boxes: [aabb([-INF, start, -INF], [INF; 3]), far_side],
            material: Material::Bent(arc),
            ..Reach::NONE
        }
    },
    grip: Grip::Number(
        |given| {
            let end = match arc(given) {
                Some(arc) => arc.subject(given.size.y - arc.start, 0.0),
                None => Vec2::new(given.size.y, 0.5 * given.size.z),
            };
            Vec3::new(0.5, end.x / given.size.y, end.y / given.size.z)
        },
        INF,
    ),
    icon: Icon {
        size: [1.0, 1.0, 1.0],
        params: &[("angle", 1.0), ("start", 0.3), ("end", 0.8)],
        yaw_pitch_deg: [60.0, 25.0],
        ..Icon::PLAIN
    },
    mirror: Mirror::ACROSS_X,
    catalogue: Some((Group::Bend, 0)),
    shape: Shape::WHOLE,
};
