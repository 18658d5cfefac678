use super::facts::{
    Amount, Facts, Grip, Group, Holds, INF, Icon, Mirror, Reach, Shape, Shrinking, aabb,
};
use super::spec::{ParamKind, ParamSpec, ParamValue, TemplateSpec};
use crate::math::Aabb;

/// Index of the sphere among the shapes.
const SPHERE: u32 = 1;

/// All that is known about cut besides its formula. It has no main parameter: it is moved and sized as a whole.
pub(super) const FACTS: Facts = Facts {
    spec: TemplateSpec {
        name: "cut",
        summary: "Remove material, move nothing",
        params: &[ParamSpec {
            name: "shape",
            summary: "What is removed",
            kind: ParamKind::Choice {
                names: &["box", "sphere", "cylinder", "halfspace"],
            },
        }],
        main_param: None,
    },
    holds: Holds::Parameters,
    amount: Amount::Box(|params| match params.first() {
        Some(ParamValue::Choice(SPHERE)) => Shrinking::ToCentre,
        _ => Shrinking::ToTop,
    }),
    reach: |given| Reach {
        boxes: [
            if given.p[0] > 2.5 {
                aabb([-INF, -INF, 0.5], [INF; 3])
            } else {
                Aabb::UNIT
            },
            Aabb::EMPTY,
        ],
        detail: INF,
        ..Reach::NONE
    },
    grip: Grip::None,
    icon: Icon {
        at: [-0.3, -0.3, 0.3],
        size: [0.8, 0.8, 0.8],
        ..Icon::PLAIN
    },
    mirror: Mirror::ACROSS_X,
    catalogue: Some((Group::Carve, 0)),
    shape: Shape::CUBE,
};
