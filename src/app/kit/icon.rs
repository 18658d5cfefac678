//! The icons of buttons, drawn as lines on a grid of 24: no icon font, no pictures, sharp at every scale.

use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, pos2};

/// What a button's picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Icon {
    Undo,
    Redo,
    Link,
    Download,
    Picture,
    Folder,
    Plus,
    Eye,
    EyeOff,
    Copy,
    Trash,
    Up,
    Down,
    Close,
    Help,
    Contrast,
    Home,
    Magnifier,
    Panes,
    Expand,
    Ghost,
    Wires,
    Ruler,
    Cube,
    More,
    Layers,
    Tissue,
    Look,
    Text,
    Check,
    Warning,
    Info,
    ChevronDown,
    ChevronRight,
    Previous,
    Next,
    Reset,
    Grip,
    Cut,
    Paste,
    Mirror,
    Snap,
    Book,
    Play,
    Stop,
    Brush,
    Eraser,
    Pin,
    Bend,
    Marks,
    Drop,
}

/// A piece of an icon, on the grid of 24.
enum Part {
    /// An open polyline through these points.
    Line(&'static [(f32, f32)]),
    /// A closed polyline through these points.
    Ring(&'static [(f32, f32)]),
    /// A circle: centre and radius.
    Circle(f32, f32, f32),
    /// A filled circle: centre and radius.
    Dot(f32, f32, f32),
    /// A filled half circle, its right half.
    Half(f32, f32, f32),
    /// Part of a circle: centre, radius, from and to in degrees, clockwise from the right.
    Arc(f32, f32, f32, f32, f32),
}

impl Icon {
    fn parts(self) -> &'static [Part] {
        use Part::{Arc, Circle, Dot, Half, Line, Ring};
        match self {
            Self::Pin => &[Circle(12.0, 8.0, 4.5), Line(&[(12.0, 12.5), (12.0, 21.0)])],
            Self::Bend => &[
                Line(&[(4.0, 18.0), (10.0, 8.0), (20.0, 6.0)]),
                Dot(4.0, 18.0, 2.0),
                Dot(10.0, 8.0, 2.0),
                Dot(20.0, 6.0, 2.0),
            ],
            Self::Marks => &[
                Dot(6.0, 7.0, 2.0),
                Dot(18.0, 7.0, 2.0),
                Dot(12.0, 18.0, 2.0),
                Ring(&[(6.0, 7.0), (18.0, 7.0), (12.0, 18.0)]),
            ],
            Self::Drop => &[
                Arc(12.0, 15.0, 5.5, -30.0, 210.0),
                Line(&[(7.2, 12.2), (12.0, 3.5), (16.8, 12.2)]),
            ],
            Self::Undo => &[
                Line(&[(8.5, 5.0), (4.0, 9.5), (8.5, 14.0)]),
                Line(&[(4.0, 9.5), (14.5, 9.5)]),
                Arc(14.5, 14.5, 5.0, -90.0, 90.0),
                Line(&[(14.5, 19.5), (10.0, 19.5)]),
            ],
            Self::Redo => &[
                Line(&[(15.5, 5.0), (20.0, 9.5), (15.5, 14.0)]),
                Line(&[(20.0, 9.5), (9.5, 9.5)]),
                Arc(9.5, 14.5, 5.0, 90.0, 270.0),
                Line(&[(9.5, 19.5), (14.0, 19.5)]),
            ],
            Self::Link => &[
                Line(&[(9.0, 15.0), (15.0, 9.0)]),
                Line(&[(11.0, 7.0), (13.5, 4.7)]),
                Arc(16.3, 7.7, 4.1, -135.0, 45.0),
                Line(&[(19.2, 10.6), (16.8, 13.0)]),
                Line(&[(13.0, 17.0), (10.5, 19.3)]),
                Arc(7.7, 16.3, 4.1, 45.0, 225.0),
                Line(&[(4.8, 13.4), (7.2, 11.0)]),
            ],
            Self::Download => &[
                Line(&[(12.0, 4.0), (12.0, 15.0)]),
                Line(&[(7.5, 10.5), (12.0, 15.0), (16.5, 10.5)]),
                Line(&[(4.5, 16.0), (4.5, 19.5), (19.5, 19.5), (19.5, 16.0)]),
            ],
            Self::Picture => &[
                Ring(&[(4.0, 5.0), (20.0, 5.0), (20.0, 19.0), (4.0, 19.0)]),
                Circle(9.0, 9.7, 1.6),
                Line(&[
                    (4.5, 18.0),
                    (10.0, 13.0),
                    (13.0, 15.8),
                    (16.5, 12.0),
                    (20.0, 15.5),
                ]),
            ],
            Self::Folder => &[Ring(&[
                (3.5, 18.5),
                (3.5, 6.0),
                (9.0, 6.0),
                (11.2, 8.5),
                (20.5, 8.5),
                (20.5, 18.5),
            ])],
            Self::Plus => &[
                Line(&[(12.0, 5.0), (12.0, 19.0)]),
                Line(&[(5.0, 12.0), (19.0, 12.0)]),
            ],
            Self::Eye => &[
                Ring(&[
                    (2.5, 12.0),
                    (5.5, 8.4),
                    (8.7, 6.5),
                    (12.0, 6.0),
                    (15.3, 6.5),
                    (18.5, 8.4),
                    (21.5, 12.0),
                    (18.5, 15.6),
                    (15.3, 17.5),
                    (12.0, 18.0),
                    (8.7, 17.5),
                    (5.5, 15.6),
                ]),
                Circle(12.0, 12.0, 2.8),
            ],
            Self::EyeOff => &[
                Line(&[
                    (2.5, 12.0),
                    (5.5, 15.6),
                    (8.7, 17.5),
                    (12.0, 18.0),
                    (15.3, 17.5),
                    (18.5, 15.6),
                    (21.5, 12.0),
                ]),
                Line(&[(6.8, 17.0), (5.4, 19.3)]),
                Line(&[(12.0, 18.5), (12.0, 21.0)]),
                Line(&[(17.2, 17.0), (18.6, 19.3)]),
            ],
            Self::Copy => &[
                Ring(&[(9.0, 9.0), (19.5, 9.0), (19.5, 19.5), (9.0, 19.5)]),
                Line(&[
                    (5.5, 15.0),
                    (4.5, 15.0),
                    (4.5, 4.5),
                    (15.0, 4.5),
                    (15.0, 5.5),
                ]),
            ],
            Self::Trash => &[
                Line(&[(4.5, 6.5), (19.5, 6.5)]),
                Line(&[(9.0, 6.0), (9.5, 3.8), (14.5, 3.8), (15.0, 6.0)]),
                Line(&[(6.3, 7.0), (7.2, 20.0), (16.8, 20.0), (17.7, 7.0)]),
                Line(&[(10.3, 10.5), (10.5, 16.3)]),
                Line(&[(13.7, 10.5), (13.5, 16.3)]),
            ],
            Self::Up => &[Line(&[(6.0, 14.5), (12.0, 8.5), (18.0, 14.5)])],
            Self::Down | Self::ChevronDown => &[Line(&[(6.0, 9.5), (12.0, 15.5), (18.0, 9.5)])],
            Self::Previous => &[Line(&[(14.5, 5.0), (7.5, 12.0), (14.5, 19.0)])],
            Self::Next => &[Line(&[(9.5, 5.0), (16.5, 12.0), (9.5, 19.0)])],
            Self::Play => &[Ring(&[(8.0, 5.0), (18.5, 12.0), (8.0, 19.0)])],
            Self::Stop => &[Ring(&[(6.5, 6.5), (17.5, 6.5), (17.5, 17.5), (6.5, 17.5)])],
            Self::ChevronRight => &[Line(&[(9.5, 6.0), (15.5, 12.0), (9.5, 18.0)])],
            Self::Close => &[
                Line(&[(6.5, 6.5), (17.5, 17.5)]),
                Line(&[(17.5, 6.5), (6.5, 17.5)]),
            ],
            Self::Help => &[
                Circle(12.0, 12.0, 8.8),
                Arc(12.0, 9.8, 2.6, 180.0, 390.0),
                Line(&[(14.3, 11.0), (12.0, 12.6), (12.0, 14.0)]),
                Dot(12.0, 16.7, 1.0),
            ],
            Self::Contrast => &[Circle(12.0, 12.0, 8.0), Half(12.0, 12.0, 8.0)],
            Self::Home => &[
                Line(&[(3.5, 11.8), (12.0, 4.5), (20.5, 11.8)]),
                Line(&[(6.0, 10.5), (6.0, 19.5), (18.0, 19.5), (18.0, 10.5)]),
            ],
            Self::Magnifier => &[
                Circle(10.5, 10.5, 6.0),
                Line(&[(15.0, 15.0), (20.5, 20.5)]),
                Line(&[(7.8, 10.5), (13.2, 10.5)]),
                Line(&[(10.5, 7.8), (10.5, 13.2)]),
            ],
            Self::Panes => &[
                Ring(&[(4.0, 4.0), (20.0, 4.0), (20.0, 20.0), (4.0, 20.0)]),
                Line(&[(12.0, 4.0), (12.0, 20.0)]),
                Line(&[(4.0, 12.0), (20.0, 12.0)]),
            ],
            Self::Expand => &[
                Line(&[(13.5, 4.5), (19.5, 4.5), (19.5, 10.5)]),
                Line(&[(10.5, 19.5), (4.5, 19.5), (4.5, 13.5)]),
                Line(&[(19.5, 4.5), (13.5, 10.5)]),
                Line(&[(4.5, 19.5), (10.5, 13.5)]),
            ],
            Self::Wires => &[
                Ring(&[(12.0, 3.5), (20.0, 12.0), (12.0, 20.5), (4.0, 12.0)]),
                Line(&[(4.0, 12.0), (20.0, 12.0)]),
                Line(&[(12.0, 3.5), (9.0, 12.0), (12.0, 20.5)]),
            ],
            Self::Ghost => &[
                Circle(9.5, 12.0, 5.5),
                Arc(14.5, 12.0, 5.5, -125.0, -55.0),
                Arc(14.5, 12.0, 5.5, -25.0, 25.0),
                Arc(14.5, 12.0, 5.5, 55.0, 125.0),
            ],
            Self::Ruler => &[
                Ring(&[(3.0, 15.5), (15.5, 3.0), (21.0, 8.5), (8.5, 21.0)]),
                Line(&[(7.0, 11.5), (9.5, 14.0)]),
                Line(&[(10.5, 8.0), (12.0, 9.5)]),
                Line(&[(14.0, 4.5), (16.5, 7.0)]),
            ],
            Self::Cube => &[
                Ring(&[
                    (12.0, 3.5),
                    (19.5, 7.5),
                    (19.5, 16.5),
                    (12.0, 20.5),
                    (4.5, 16.5),
                    (4.5, 7.5),
                ]),
                Line(&[(4.5, 7.5), (12.0, 11.5), (19.5, 7.5)]),
                Line(&[(12.0, 11.5), (12.0, 20.5)]),
            ],
            Self::More => &[
                Dot(5.5, 12.0, 1.6),
                Dot(12.0, 12.0, 1.6),
                Dot(18.5, 12.0, 1.6),
            ],
            Self::Layers => &[
                Ring(&[(12.0, 3.8), (20.5, 8.3), (12.0, 12.8), (3.5, 8.3)]),
                Line(&[(3.5, 12.2), (12.0, 16.7), (20.5, 12.2)]),
                Line(&[(3.5, 16.0), (12.0, 20.5), (20.5, 16.0)]),
            ],
            Self::Tissue => &[
                Ring(&[
                    (8.0, 4.0),
                    (16.5, 3.8),
                    (20.5, 10.5),
                    (18.0, 18.5),
                    (9.0, 20.3),
                    (3.6, 13.5),
                ]),
                Dot(11.6, 12.0, 3.0),
            ],
            Self::Look => &[
                Line(&[(4.0, 7.0), (20.0, 7.0)]),
                Line(&[(4.0, 12.0), (20.0, 12.0)]),
                Line(&[(4.0, 17.0), (20.0, 17.0)]),
                Dot(9.0, 7.0, 2.4),
                Dot(15.5, 12.0, 2.4),
                Dot(7.5, 17.0, 2.4),
            ],
            Self::Text => &[
                Line(&[(5.0, 8.0), (5.0, 5.0), (19.0, 5.0), (19.0, 8.0)]),
                Line(&[(12.0, 5.0), (12.0, 19.0)]),
                Line(&[(9.0, 19.0), (15.0, 19.0)]),
            ],
            Self::Check => &[Line(&[(5.0, 12.5), (10.0, 17.5), (19.5, 7.0)])],
            Self::Warning => &[
                Ring(&[(12.0, 4.0), (21.0, 19.5), (3.0, 19.5)]),
                Line(&[(12.0, 10.0), (12.0, 14.3)]),
                Dot(12.0, 16.9, 1.0),
            ],
            Self::Info => &[
                Circle(12.0, 12.0, 8.8),
                Line(&[(12.0, 11.0), (12.0, 16.5)]),
                Dot(12.0, 7.7, 1.1),
            ],
            Self::Reset => &[
                Arc(12.0, 12.0, 7.5, -150.0, 150.0),
                Line(&[(4.3, 4.5), (5.4, 8.6), (9.5, 7.6)]),
            ],
            Self::Cut => &[
                Circle(7.0, 17.5, 2.6),
                Circle(17.0, 17.5, 2.6),
                Line(&[(8.5, 15.3), (16.5, 4.0)]),
                Line(&[(15.5, 15.3), (7.5, 4.0)]),
            ],
            Self::Paste => &[
                Ring(&[(5.5, 5.5), (18.5, 5.5), (18.5, 20.5), (5.5, 20.5)]),
                Ring(&[(9.0, 3.5), (15.0, 3.5), (15.0, 7.5), (9.0, 7.5)]),
            ],
            Self::Mirror => &[
                Line(&[(12.0, 3.5), (12.0, 6.5)]),
                Line(&[(12.0, 10.5), (12.0, 13.5)]),
                Line(&[(12.0, 17.5), (12.0, 20.5)]),
                Ring(&[(9.0, 7.0), (9.0, 17.0), (3.0, 17.0)]),
                Ring(&[(15.0, 7.0), (15.0, 17.0), (21.0, 17.0)]),
            ],
            Self::Snap => &[
                Line(&[(5.5, 4.5), (5.5, 12.5)]),
                Line(&[(10.0, 4.5), (10.0, 12.5)]),
                Line(&[(14.0, 4.5), (14.0, 12.5)]),
                Line(&[(18.5, 4.5), (18.5, 12.5)]),
                Line(&[(5.5, 4.5), (10.0, 4.5)]),
                Line(&[(14.0, 4.5), (18.5, 4.5)]),
                Line(&[(5.5, 8.0), (10.0, 8.0)]),
                Line(&[(14.0, 8.0), (18.5, 8.0)]),
                Arc(12.0, 12.5, 6.5, 0.0, 180.0),
                Arc(12.0, 12.5, 2.0, 0.0, 180.0),
            ],
            Self::Book => &[
                Line(&[(12.0, 6.5), (12.0, 19.5)]),
                Ring(&[
                    (12.0, 6.5),
                    (8.5, 5.0),
                    (3.5, 5.0),
                    (3.5, 18.0),
                    (8.5, 18.0),
                    (12.0, 19.5),
                    (15.5, 18.0),
                    (20.5, 18.0),
                    (20.5, 5.0),
                    (15.5, 5.0),
                ]),
            ],
            Self::Brush => &[
                Line(&[(20.0, 4.0), (11.0, 13.0)]),
                Ring(&[
                    (4.0, 20.0),
                    (5.5, 15.5),
                    (8.5, 13.0),
                    (11.5, 15.5),
                    (9.0, 18.5),
                ]),
            ],
            Self::Eraser => &[
                Ring(&[
                    (4.0, 14.5),
                    (13.5, 5.0),
                    (19.0, 10.5),
                    (10.0, 19.5),
                    (9.0, 19.5),
                ]),
                Line(&[(9.0, 9.5), (14.5, 15.0)]),
                Line(&[(9.0, 19.5), (20.0, 19.5)]),
            ],
            Self::Grip => &[
                Dot(9.0, 6.0, 1.4),
                Dot(15.0, 6.0, 1.4),
                Dot(9.0, 12.0, 1.4),
                Dot(15.0, 12.0, 1.4),
                Dot(9.0, 18.0, 1.4),
                Dot(15.0, 18.0, 1.4),
            ],
        }
    }

    /// Draws the icon as large as fits into the middle of the rectangle.
    pub(crate) fn paint(self, painter: &Painter, rect: Rect, color: Color32) {
        let side = rect.width().min(rect.height());
        let scale = side / 24.0;
        let origin = rect.center() - egui::Vec2::splat(side * 0.5);
        let at = |(x, y): (f32, f32)| -> Pos2 { pos2(origin.x + x * scale, origin.y + y * scale) };
        let stroke = Stroke::new((1.7 * scale).max(1.2), color);
        for part in self.parts() {
            match *part {
                Part::Line(points) => {
                    painter.add(Shape::line(points.iter().map(|&p| at(p)).collect(), stroke));
                }
                Part::Ring(points) => {
                    painter.add(Shape::closed_line(
                        points.iter().map(|&p| at(p)).collect(),
                        stroke,
                    ));
                }
                Part::Circle(x, y, r) => {
                    painter.circle_stroke(at((x, y)), r * scale, stroke);
                }
                Part::Dot(x, y, r) => {
                    painter.circle_filled(at((x, y)), r * scale, color);
                }
                Part::Half(x, y, r) => {
                    let points = arc_points(x, y, r, -90.0, 90.0).map(at).collect();
                    painter.add(Shape::convex_polygon(points, color, Stroke::NONE));
                }
                Part::Arc(x, y, r, from, to) => {
                    painter.add(Shape::line(
                        arc_points(x, y, r, from, to).map(at).collect(),
                        stroke,
                    ));
                }
            }
        }
    }
}

fn arc_points(x: f32, y: f32, r: f32, from: f32, to: f32) -> impl Iterator<Item = (f32, f32)> {
    const SEGMENTS: u16 = 16;
    (0..=SEGMENTS).map(move |i| {
        let angle = (from + (to - from) * f32::from(i) / f32::from(SEGMENTS)).to_radians();
        (x + r * angle.cos(), y + r * angle.sin())
    })
}
