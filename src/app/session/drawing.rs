//! A tool in hand: what is held, and drags with it that draw a sweep. The hand takes tissue along, and its gesture is
//! one template.

use glam::{Quat, Vec3};

use super::camera;
use super::gesture::{form, gesture};
use super::hand::{HandCommand, HeldTool, StrokeWay, Touch};
use super::selection::Selection;
use super::session::{Session, Tab};
use super::shape::seen_across;
use super::tool::Tool;
use crate::displace::COAT;
use crate::document::{
    Camera, ClayKey, Edit, PathKey, SweepTool, SweepTools, TemplateKind, ToolShape,
};
use crate::math::{Aabb, Placement};

/// Size of the tool and width of its coating when it is first taken in hand, parts of what the picture shows across its
/// shorter side.
const SIZE_SEEN: f32 = 0.05;
const COAT_SEEN: f32 = 0.08;
/// It is no smaller and no larger then, subject units.
const LEAST: f32 = 0.012;
const MOST: f32 = 0.1;
/// Keys are rounded to this, template units, and turns and lengths of tools to a tenth of it: a link holds them.
const ROUNDED: f32 = 1e-3;
/// A click presses the tool in along the normal by so much of its size: it begins outside and ends just inside.
const PRESSED: f32 = 2.0;
/// A smooth path has at most so many keys: its spans are four pieces each, of which a document has a limited number.
const MOST_SMOOTH: usize = 17;

impl Session {
    pub(super) fn run_hand(&mut self, command: HandCommand) {
        match command {
            HandCommand::Hold(hand) => self.hold(hand),
            HandCommand::NextWay(is_next) if self.has_hand() => {
                let hand = self.hand().clone();
                let way = hand.way.beside(self.is_sweeping(), is_next);
                self.hold(HeldTool { way, ..hand });
            }
            HandCommand::Recoat(is_wider) if self.has_hand() => {
                self.hold(self.hand().recoated(is_wider));
            }
            HandCommand::NextWay(_) | HandCommand::Recoat(_) => {}
            HandCommand::Draw {
                way,
                touches,
                is_over,
            } => match self.tool() {
                _ if way == StrokeWay::Form && self.has_hand() => self.draw_form(&touches, is_over),
                Tool::Clay => self.draw_stroke(way, &touches, is_over),
                Tool::Place(TemplateKind::Sweep) => self.draw_sweep(way, &touches, is_over),
                _ => (self.drawn, self.drawn_stroke) = (None, None),
            },
        }
    }

    /// Takes another tool in hand, or uses the same otherwise.
    pub(super) fn hold(&mut self, hand: HeldTool) {
        if self.is_sweeping() {
            self.sweep_hand = Some(hand);
        } else {
            self.hold_clay_tool(hand);
        }
    }

    /// Readies the tool that draws sweeps; at first it has a size that suits what is seen.
    pub(super) fn ready_to_sweep(&mut self) {
        let seen = seen_across(&self.camera);
        let part = |part: f32| ((part * seen).clamp(LEAST, MOST) / ROUNDED).round() * ROUNDED;
        let hand = self.sweep_hand.get_or_insert_with(|| HeldTool {
            size: part(SIZE_SEEN),
            coat: part(COAT_SEEN),
            mirror: [false; 3],
            ..HeldTool::default()
        });
        if !StrokeWay::offered(true).contains(&hand.way) {
            hand.way = StrokeWay::Move;
        }
    }

    /// Takes a tool of this form in hand that draws sweeps.
    pub(super) fn sweep_with(&mut self, shape: ToolShape) {
        if !self.is_sweeping() {
            self.start_placing(TemplateKind::Sweep);
        }
        if let Some(hand) = &mut self.sweep_hand {
            hand.own = Some(shape);
        }
    }

    /// Presses the tool in at a place, as a click does. `normal` points out of the object.
    pub(super) fn press_sweep(&mut self, pos: Vec3, normal: Vec3) {
        let [_, up, _] = camera::axes(self.camera.rotate);
        let begin = Touch {
            pos,
            normal: normal.normalize_or(Vec3::Z),
            force: None,
        };
        let end = Touch {
            pos: pos - PRESSED * self.hand().size * up,
            ..begin
        };
        self.draw_sweep(StrokeWay::Push, &[begin, end], true);
    }

    /// Takes the way of a hand that draws a tool. At its end the tool is in the hand; on a clay it is among the tools
    /// of the document, too.
    fn draw_form(&mut self, touches: &[Touch], is_over: bool) {
        if !is_over {
            return;
        }
        let Some(form) = form(self.hand(), touches, &self.camera) else {
            return;
        };
        let hand = self.hand().formed(form.half_side());
        if self.is_sweeping() {
            self.hold(HeldTool {
                own: Some(form),
                ..hand
            });
        } else {
            self.clay_hand = hand;
            self.take_own_tool(form, "Draw a tool");
        }
    }

    /// Takes the way of a hand that draws a sweep, as far as it has come. At its end the tool is put away and the
    /// template is selected. The whole gesture is one step of undo.
    fn draw_sweep(&mut self, way: StrokeWay, touches: &[Touch], is_over: bool) {
        let drawn = self.drawn.take();
        let Some((placement, tools)) = swept(self.hand(), way, touches, &self.camera) else {
            self.drawn = drawn.filter(|_| !is_over);
            return;
        };
        let template = drawn.unwrap_or_else(|| self.template_count());
        let begin = match drawn {
            Some(_) => Edit::SetPlacement {
                template,
                placement,
            },
            None => Edit::AddTemplate {
                index: template,
                kind: TemplateKind::Sweep,
                placement,
            },
        };
        let edit = Edit::All {
            name: "Draw a sweep".to_owned(),
            edits: vec![begin, Edit::SetTools { template, tools }],
        };
        if !self.apply(&edit, true) {
            self.tool = Tool::Look;
            return;
        }
        if is_over {
            self.end_drag();
            self.tool = Tool::Look;
            self.selection = Selection::Template(template);
            self.side_tab = Tab::Templates;
        } else {
            self.drawn = Some(template);
        }
    }
}

/// The box and the tool of the sweep that a gesture is; `None` where it has come to nothing yet. The box holds all that
/// the tool reaches, with its mirror images, but where a document could not tell the tool's lengths in its sides.
fn swept(
    hand: &HeldTool,
    way: StrokeWay,
    touches: &[Touch],
    camera: &Camera,
) -> Option<(Placement, SweepTools)> {
    let gesture = gesture(hand, way, touches, camera)?;
    let poses = ClayKey::poses(&gesture.keys);
    let (shape, coat) = (hand.shape(), hand.coat);
    let ends = poses.iter().flat_map(|pose| {
        let reach = pose.scale as f32 * shape.farthest() + coat;
        [-reach, reach].map(|reach| pose.place.as_vec3() + reach)
    });
    let mut reached = Aabb::from_points(ends);
    for axis in (0..3).filter(|&axis| hand.mirror[axis]) {
        reached.max[axis] = reached.max[axis].max(-reached.min[axis]);
        reached.min[axis] = -reached.max[axis];
    }
    let at = reached.center();
    let size = told_in_sides(reached.size(), &shape, coat);
    let part = 1.0 / size.min_element();
    let rounded = |x: f32| (x / (0.1 * ROUNDED)).round() * (0.1 * ROUNDED);
    let mut shape = shape.scaled(part);
    shape
        .numbers_mut()
        .into_iter()
        .for_each(|x| *x = rounded(*x));
    let path = poses.iter().map(|pose| {
        let q = (pose.place.as_vec3() - at) / size + 0.5;
        let turn = pose.turn.as_quat().to_array().map(rounded);
        PathKey {
            at: (q / ROUNDED).round() * ROUNDED,
            rotate: Quat::from_array(turn).normalize(),
            scale: pose.scale as f32,
        }
    });
    let tool = SweepTool {
        shape: Some(shape),
        coat: rounded(coat * part),
        spline: !gesture.is_straight && (3..=MOST_SMOOTH).contains(&poses.len()),
        path: path.collect(),
        ..SweepTool::default()
    };
    let placement = Placement {
        at,
        rotate: Quat::IDENTITY,
        size,
    };
    let tools = SweepTools {
        mirror: hand.mirror,
        tools: vec![tool],
        ..SweepTools::default()
    };
    Some((placement, tools))
}

/// The sides of a box, the shortest of them so short that the lengths of a tool are no smaller parts of it than a
/// document can hold.
fn told_in_sides(sides: Vec3, shape: &ToolShape, coat: f32) -> Vec3 {
    let shortest = sides.min_position();
    let mut side = sides[shortest];
    let is_told =
        |side: f32| shape.scaled(1.0 / side).is_in_range() && f64::from(coat / side) >= COAT[0];
    for _ in 0..8 {
        if is_told(side) {
            break;
        }
        side *= 0.5;
    }
    let mut told = sides;
    told[shortest] = side;
    told
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::session::Command;
    use crate::document::{Document, TemplateData};
    use crate::math::Similarity;

    const AT: Touch = Touch {
        pos: Vec3::new(0.1, 0.2, 0.3),
        normal: Vec3::Z,
        force: None,
    };

    fn moved(by: Vec3) -> [Touch; 2] {
        let pos = AT.pos + by;
        [AT, Touch { pos, ..AT }]
    }

    /// The poses of the only tool, subject space.
    fn poses((placement, tools): &(Placement, SweepTools)) -> Vec<Similarity> {
        let path = tools.tools[0].path.iter();
        path.map(|key| {
            let at = placement.subject_from_template(key.at);
            Similarity::new(f64::from(key.scale), key.rotate.as_dquat(), at.as_dvec3())
        })
        .collect()
    }

    #[test]
    fn the_box_holds_the_reach_and_the_keys_are_on_the_way() {
        let camera = Camera::DOCUMENT_DEFAULT;
        let hand = HeldTool {
            size: 0.05,
            coat: 0.08,
            mirror: [false; 3],
            ..HeldTool::default()
        };
        let way = moved(Vec3::new(0.2, 0.0, 0.05));
        for mirror in [[false; 3], [true, false, false], [false, true, true]] {
            let hand = HeldTool {
                mirror,
                ..hand.clone()
            };
            let sweep = swept(&hand, StrokeWay::Move, &way, &camera).expect("a sweep");
            let (placement, tools) = &sweep;
            for (touch, pose) in way.iter().zip(poses(&sweep)) {
                assert!(pose.place.as_vec3().distance(touch.pos) < 2e-3);
            }
            let tool = &tools.tools[0];
            let shortest = placement.size.min_element();
            let Some(ToolShape::Ball { radius }) = tool.shape else {
                panic!("a ball")
            };
            assert!((radius * shortest - 0.05).abs() < 1e-3 * shortest);
            assert!((tool.coat * shortest - 0.08).abs() < 1e-3 * shortest);
            for key in &tool.path {
                let inside = (key.at - 0.5).abs() * placement.size + 0.13;
                assert!(inside.cmple(0.5 * placement.size + 2e-3).all(), "{inside}");
            }
            // Images stand beyond the middle planes of the subject.
            for (is_on, at) in mirror.iter().zip(placement.at.to_array()) {
                assert!(!is_on || at.abs() < 1e-6);
            }
        }
        assert!(swept(&hand, StrokeWay::Move, &[AT; 5], &camera).is_none());
    }

    #[test]
    fn each_way_draws_a_sweep_of_its_own() {
        let camera = Camera::DOCUMENT_DEFAULT;
        let seen = seen_across(&camera);
        let [right, up, _] = super::super::camera::axes(camera.rotate);
        let hand = HeldTool {
            form: 3,
            mirror: [false; 3],
            ..HeldTool::default()
        };
        let drawn = |way, by: Vec3| {
            let sweep = swept(&hand, way, &moved(by), &camera)?;
            Some(poses(&sweep))
        };
        let pulled = drawn(StrokeWay::Push, 0.2 * up).expect("a pull");
        let gone = pulled[1].place - pulled[0].place;
        assert!((gone.z - 0.2).abs() < 2e-3 && gone.x.hypot(gone.y) < 2e-3);
        let turned = drawn(StrokeWay::Turn, 0.5 * seen * right).expect("a turn");
        let ends = [turned[0].turn, turned[turned.len() - 1].turn];
        let angle = ends[0].angle_between(ends[1]).to_degrees();
        assert!((angle - 180.0).abs() < 1.0 && turned.len() == 3, "{angle}");
        let grown = drawn(StrokeWay::Grow, 0.25 * seen * up).expect("growth");
        assert!((grown[1].scale - 2.0).abs() < 0.01);
        assert!(drawn(StrokeWay::Along, 0.2 * right).is_some());
        for &way in StrokeWay::offered(true) {
            assert!(drawn(way, Vec3::ZERO).is_none(), "{way:?}: at rest");
        }
    }

    #[test]
    fn a_document_can_hold_whatever_a_hand_draws() {
        let [sizes, coats] = HeldTool::RANGES;
        let forms = 0..HeldTool::FORMS.len();
        for form in forms {
            for (size, coat) in [
                (sizes[0], coats[0]),
                (sizes[0], coats[1]),
                (sizes[1], coats[0]),
                (sizes[1], coats[1]),
            ] {
                let hand = HeldTool {
                    form,
                    size,
                    coat,
                    ..HeldTool::default()
                };
                let mut session = Session::new(Document::new());
                session.run(Command::StartPlacing(TemplateKind::Sweep), 0.0);
                session.hold(hand);
                session.draw_sweep(StrokeWay::Move, &moved(Vec3::splat(1.5)), true);
                let shown = &session.shown().templates;
                assert_eq!(shown.len(), 1, "form {form}, {size}, {coat}");
                assert_eq!(session.tool(), Tool::Look);
                let notices: Vec<_> = session.notices.shown().collect();
                assert!(notices.is_empty(), "{notices:?}");
            }
        }
    }

    /// A click is a press of what is in the hand, straight into the surface, wherever the camera stands.
    #[test]
    fn a_click_presses_the_tool_in_hand() {
        let mut session = Session::new(Document::new());
        session.run(Command::StartPlacing(TemplateKind::Sweep), 0.0);
        session.hold(HeldTool {
            form: 3,
            size: 0.06,
            ..session.hand().clone()
        });
        let (pos, normal) = (AT.pos, Vec3::X);
        session.run(Command::PlaceAt { pos, normal }, 0.0);
        assert_eq!(session.tool(), Tool::Look);
        let template = &session.shown().templates[0];
        let TemplateData::Tools(tools) = &template.data else {
            panic!("a sweep")
        };
        assert!(matches!(tools.tools[0].shape, Some(ToolShape::Box { .. })));
        let poses = poses(&(template.placement, tools.clone()));
        let [first, last] = [0, 1].map(|k| poses[k].place.as_vec3());
        assert!(first.distance(pos + 0.06 * Vec3::X) < 3e-3, "{first}");
        assert!(last.distance(pos - 0.06 * Vec3::X) < 3e-3, "{last}");
        session.run(Command::Undo, 0.0);
        assert!(session.shown().templates.is_empty(), "one step of undo");
    }

    #[test]
    fn a_drawn_form_sweeps() {
        let mut session = Session::new(Document::new());
        session.run(Command::StartPlacing(TemplateKind::Sweep), 0.0);
        let hand = session.hand().clone();
        assert!(hand.mirror == [false; 3] && hand.size < 0.11, "{hand:?}");
        let draw = HandCommand::Draw {
            way: StrokeWay::Form,
            touches: moved(Vec3::new(0.3, 0.0, 0.1)).to_vec(),
            is_over: true,
        };
        session.run(Command::Hand(draw), 0.0);
        let own = session.hand().own.clone();
        assert!(matches!(own, Some(ToolShape::Curve { .. })), "{own:?}");
        assert!(session.shown().templates.is_empty(), "only a tool");
        assert_eq!(session.hand().way, StrokeWay::Move);
        session.draw_sweep(StrokeWay::Move, &moved(Vec3::new(0.0, 0.0, 0.2)), true);
        let document = session.document().to_json();
        assert!(document.contains("\"curve\""), "{document}");
        // Taken again, the hand is as it was.
        session.run(Command::StartPlacing(TemplateKind::Sweep), 0.0);
        assert_eq!(session.hand().own, own);
    }
}
