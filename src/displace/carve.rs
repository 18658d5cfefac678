use super::facts::{Amount, Facts, Grip, Group, Holds, Icon, Mirror, Reach, Shape, aabb};
use super::spec::{TemplateSpec, number};
use glam::Vec3;

/// Tissue closes in by at most this part of the reach.
const MOST_CLOSING: f32 = 0.9;

/// All that is known about carve besides its formula. Its cube is that of its object, about the middle of the object's
/// box and as large as its longest side. It is grabbed beside that middle, on its x, as far out as it pushes.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "carve",
        summary: "Cut by the surface of an object, and push aside what was there",
        params: &[
            number(
                "push",
                "How deep in the object the tissue stood that now lies at its surface, subject units",
                0.0,
                -0.2,
                0.5,
            ),
            number(
                "reach",
                "How far from the object tissue is pushed, subject units",
                0.15,
                0.01,
                1.0,
            ),
        ],
        main_param: Some(0),
    },
    holds: Holds::Object,
    amount: Amount::ParametersOrNone,
    reach: |given| {
        let Some(tool) = &given.tool else {
            return Reach::NONE;
        };
        let [push, reach, ..] = given.p;
        let size = given.size.x.max(1e-30);
        let shift = match push < 0.0 {
            true => -push.max(-MOST_CLOSING * reach) / size,
            false => (push / size).min(tool.room),
        };
        // Nothing moves beyond the reach; the cut is the object, within a cell.
        let around = tool.half + (reach / size).max(tool.cell);
        let bounds = aabb((0.5 - around).to_array(), (0.5 + around).to_array());
        let detail = 2.0 * tool.cell;
        let any = Vec3::splat(shift);
        Reach::shifted(bounds, -any, any).with_detail(detail)
    },
    grip: Grip::Number(
        |given| Vec3::new(0.5 + given.p[0] / given.size.x.max(1e-30), 0.5, 0.5),
        f32::INFINITY,
    ),
    icon: Icon {
        params: &[("push", 0.2), ("reach", 0.4)],
        yaw_pitch_deg: [148.0, 30.0],
        ..Icon::PLAIN
    },
    mirror: Mirror::ACROSS_X,
    catalogue: Some((Group::OpenUp, 6)),
    shape: Shape::CUBE,
};
