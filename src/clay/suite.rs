//! Recipes of strokes that the tests share.

use glam::Vec3;

use crate::displace::ToolShape;
use crate::document::{Clay, ClayKey, ClayMove, ClayShape, ClayStart, ClayStroke, ClayTool};

/// A clay without strokes.
pub(super) fn clay(shape: ClayShape, tools: &[ClayTool]) -> Clay {
    Clay {
        from: ClayStart::Shape(shape),
        tools: tools.to_vec(),
        ..Clay::default()
    }
}

/// A round tool with its coating.
pub(super) fn ball(radius: f32, coat: f64) -> ClayTool {
    ClayTool {
        shape: Some(ToolShape::Ball { radius }),
        coat,
    }
}

/// A key: its place in thousandths, its turn in degrees, its size in per cent.
pub(super) fn key(at: [i32; 3], turn: [i32; 3], percent: i32) -> ClayKey {
    ClayKey { at, turn, percent }
}

/// A key that only moves.
pub(super) fn place(at: [i32; 3]) -> ClayKey {
    key(at, [0; 3], 100)
}

/// A stroke of the first tool through some keys.
pub(super) fn stroke(keys: &[ClayKey]) -> ClayStroke {
    ClayStroke {
        moves: vec![ClayMove {
            tool: 0,
            keys: keys.to_vec(),
            is_straight: false,
        }],
        mirror: [false; 3],
        smooth: None,
        is_off: false,
    }
}

fn mirrored(mut stroke: ClayStroke, axes: [bool; 3]) -> ClayStroke {
    stroke.mirror = axes;
    stroke
}

/// Ten recipes by their names.
pub(super) fn suite() -> Vec<(&'static str, Clay)> {
    let mut all = Vec::new();
    let mut add = |name, mut clay: Clay, strokes: Vec<ClayStroke>| {
        clay.strokes = strokes;
        all.push((name, clay));
    };
    let soft = ball(0.1, 0.1);
    let of_ball = |tool: ClayTool| clay(ClayShape::Ball, &[tool]);
    let push = |from: [i32; 3], to: [i32; 3]| stroke(&[place(from), place(to)]);
    add(
        "push",
        of_ball(soft.clone()),
        vec![
            push([0, 0, 700], [0, 0, 250]),
            push([0, 700, 0], [0, 300, 0]),
            push([500, 500, 0], [250, 250, 50]),
        ],
    );
    add(
        "pull",
        of_ball(soft.clone()),
        vec![
            push([0, 0, 440], [0, 0, 900]),
            push([0, 0, 850], [300, 0, 1000]),
            push([300, 0, 440], [500, 100, 700]),
        ],
    );
    add(
        "pinch",
        of_ball(soft.clone()),
        vec![
            mirrored(push([250, 0, 500], [90, 0, 480]), [true, false, false]),
            mirrored(push([0, 600, 200], [0, 150, 200]), [false, true, false]),
        ],
    );
    let turned = |count: usize, turn: [i32; 3]| {
        let mut keys = vec![place([0, 0, 500])];
        keys.extend((0..count).map(|_| key([0, 0, 500], turn, 100)));
        keys
    };
    add(
        "twist",
        of_ball(ball(0.2, 0.3)),
        vec![ClayStroke {
            moves: vec![ClayMove {
                tool: 0,
                keys: turned(6, [0, 0, 120]),
                is_straight: true,
            }],
            ..stroke(&[])
        }],
    );
    add(
        "curl",
        of_ball(ball(0.1, 0.12)),
        vec![
            push([0, 0, 440], [0, 0, 1000]),
            stroke(&[
                place([0, 0, 950]),
                key([150, 0, 1050], [0, 80, 0], 100),
                key([300, 0, 950], [0, 80, 0], 100),
                key([250, 0, 800], [0, 80, 0], 100),
            ]),
        ],
    );
    add(
        "grow",
        of_ball(ball(0.05, 0.1)),
        vec![stroke(&[place([0, 0, 480]), key([0, 0, 480], [0; 3], 400)])],
    );
    add(
        "punch",
        clay(ClayShape::Plate, &[ball(0.25, 0.15)]),
        vec![
            push([0, 0, 400], [0, 0, 40]),
            push([0, 0, 300], [0, 0, -150]),
        ],
    );
    let grip = ClayTool {
        shape: Some(ToolShape::Box {
            half: Vec3::new(0.2, 0.3, 0.15),
            round: 0.05,
        }),
        coat: 0.3,
    };
    let mut wring = ClayStroke {
        moves: Vec::new(),
        ..stroke(&[])
    };
    for (x, turn) in [(-500, -40), (500, 40)] {
        wring.moves.push(ClayMove {
            tool: 0,
            keys: vec![
                place([x, 0, 0]),
                key([x, 0, 0], [turn, 0, 0], 100),
                key([x, 0, 0], [turn, 0, 0], 100),
            ],
            is_straight: true,
        });
    }
    add("wring", clay(ClayShape::Plate, &[grip]), vec![wring]);
    let mut spiral = vec![place([100, 0, 430])];
    for i in 1..12 {
        let angle = f64::from(i) * 0.8;
        let [x, y] = [libm::cos(angle), libm::sin(angle)].map(|c| (100.0 * c) as i32);
        spiral.push(place([x, y, 430 + 45 * i]));
    }
    add("spiral", of_ball(ball(0.06, 0.08)), vec![stroke(&spiral)]);
    add(
        "sharp",
        of_ball(ball(0.02, 0.1)),
        vec![
            push([0, 0, 480], [0, 0, 1100]),
            push([300, 0, 380], [600, 0, 700]),
            push([0, 0, -600], [0, 100, -300]),
        ],
    );
    all
}
