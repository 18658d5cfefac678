//! What a figure costs: the times and counts of `fabrica bench`.

use serde_json::{Value, json};

use super::bender::Bender;
use super::read::builtin_plate;
use super::solve::Rig;
use super::svg::SvgError;
use crate::document::figure::{Figure, Handle, Hold, Move};
use glam::{DVec2, dvec2};

/// The figure that is measured, and the triangles aimed at.
const NAME: &str = "drawn-arm";
const DETAILS: [u32; 2] = [20_000, 40_000];
/// Frames of the drag that is measured, and rounds of each.
const FRAMES: u32 = 20;
const ROUNDS: u32 = 4;

/// What was measured at one detail.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureRow {
    /// Triangles aimed at.
    pub detail: u32,
    /// Triangles of the mesh.
    pub triangles: usize,
    /// From shapes to the mesh, milliseconds.
    pub mesh_ms: f64,
    /// All factors, and what is held, milliseconds.
    pub factor_ms: f64,
    /// One round of a drag, milliseconds.
    pub round_ms: f64,
    /// A frame of a drag, four rounds, milliseconds.
    pub frame_ms: f64,
    /// The pose at rest, milliseconds.
    pub rest_ms: f64,
    /// Rounds that the pose at rest took.
    pub rest_rounds: u32,
    /// Entries of the largest factor for each of its unknowns.
    pub factor_entries_per_vertex: f64,
    /// Factors that the drag made anew.
    pub factorisations_per_drag: u32,
    /// Memory of the factors.
    pub bytes: usize,
}

/// Measures the arm, bent, at two details. `clock` gives seconds.
///
/// # Errors
/// [`SvgError`] where the drawing of the program cannot be read.
pub fn bench_figures(clock: fn() -> f64) -> Result<Vec<FigureRow>, SvgError> {
    DETAILS
        .into_iter()
        .map(|detail| row(detail, clock))
        .collect()
}

fn row(detail: u32, clock: fn() -> f64) -> Result<FigureRow, SvgError> {
    let plate = builtin_plate(NAME).map_err(|_unknown| SvgError::NoSvg)?;
    let mut bender = Bender::new(&plate)?;
    let held = |hold: Hold, by: DVec2| Handle {
        hold,
        motion: Move {
            by,
            turn: Some(0.0),
            scale: 1.0,
        },
        ..Handle::pin(DVec2::ZERO, DVec2::ZERO)
    };
    let figure = |by: f64| Figure {
        handles: vec![
            held(Hold::Region("humerus".to_owned()), DVec2::ZERO),
            held(Hold::Region("hand".to_owned()), dvec2(0.0, by)),
        ],
        detail,
        ..Figure::default()
    };
    let whole = bender.original().completed(&figure(0.1));
    let mut notices = Vec::new();
    let start = clock();
    let mesh = bender.original().mesh(&whole, &mut notices, &mut |_| true);
    let mesh_ms = 1e3 * (clock() - start);
    let mesh = std::sync::Arc::new(mesh.ok_or(SvgError::NoSvg)?);
    let start = clock();
    let rig = Rig::new(&mesh, &whole, &mut notices);
    let factor_ms = 1e3 * (clock() - start);
    let start = clock();
    let posed = rig.posed(&whole, &mut notices);
    let rest_ms = 1e3 * (clock() - start);
    // By the way that a window goes, whose factors are counted.
    let solved = bender.solved(&figure(0.1), &mut |_| true);
    drop(solved);
    let before = bender.factorisations();
    let start = clock();
    for frame in 0..FRAMES {
        let by = 0.1 + 0.001 * f64::from(frame);
        bender.follow(&figure(by), ROUNDS, &mut |_| true);
    }
    let frame_ms = 1e3 * (clock() - start) / f64::from(FRAMES);
    Ok(FigureRow {
        detail,
        triangles: mesh.triangle_count(),
        mesh_ms,
        factor_ms,
        round_ms: rest_ms / f64::from(posed.rounds.max(1)),
        frame_ms,
        rest_ms,
        rest_rounds: posed.rounds,
        factor_entries_per_vertex: rig.factor_entries_per_unknown(),
        factorisations_per_drag: bender.factorisations() - before,
        bytes: rig.factor_bytes(),
    })
}

impl FigureRow {
    /// The row as JSON, times in milliseconds.
    pub fn to_json(&self) -> Value {
        json!({
            "name": NAME, "detail": self.detail, "triangles": self.triangles, "mesh_ms": self.mesh_ms,
            "factor_ms": self.factor_ms, "round_ms": self.round_ms, "frame_ms": self.frame_ms,
            "rest_ms": self.rest_ms, "rest_rounds": self.rest_rounds,
            "factor_entries_per_vertex": self.factor_entries_per_vertex,
            "factorisations_per_drag": self.factorisations_per_drag, "bytes": self.bytes,
        })
    }
}

impl std::fmt::Display for FigureRow {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "{NAME}, {} triangles: mesh {:.0} ms, factors {:.0} ms, a frame of a drag {:.1} ms ({ROUNDS} rounds, {} \
             factors made anew), at rest {:.0} ms ({} rounds), {:.1} entries of a factor per vertex, {:.1} MB",
            self.triangles,
            self.mesh_ms,
            self.factor_ms,
            self.frame_ms,
            self.factorisations_per_drag,
            self.rest_ms,
            self.rest_rounds,
            self.factor_entries_per_vertex,
            self.bytes as f64 / 1e6,
        )
    }
}
