use super::clock::Clock;
use super::studio::Studio;
use crate::data::Subject;
use crate::document::{Align, Illustration, PlacedTemplate};
use crate::document::{Document, SubjectRef, TemplateKind};
use crate::math::Placement;
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::readback::WorkDone;
use glam::Quat;
use glam::Vec3;
use serde_json::{Value, json};

/// One line of a [`BenchReport`].
#[derive(Clone, Debug, PartialEq)]
pub struct BenchRow {
    /// Name of the scene that was drawn.
    pub name: &'static str,
    /// Number of templates in the scene.
    pub template_count: usize,
    /// Drawn with the skip grid.
    pub has_grid: bool,
    /// Median time of a frame, seconds: a ready scene drawn and read back.
    pub seconds: f64,
    /// Median time to make the scene ready, seconds: the grid, mostly. Once per edit of a template or of the look,
    /// nothing while only the camera moves.
    pub making_seconds: f64,
    /// Ratio to the time of the undeformed frame with the skip grid.
    pub ratio: f64,
    /// Time without the skip grid divided by the time with it (on rows with the skip grid).
    pub grid_gain: Option<f64>,
}

impl std::fmt::Display for BenchRow {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let grid = if self.has_grid { "grid" } else { "no grid" };
        write!(
            f,
            "{:<16} {:<8} {:>9.1} ms  {:>5.2} x  made ready in {:>6.1} ms",
            self.name,
            grid,
            self.seconds * 1e3,
            self.ratio,
            self.making_seconds * 1e3
        )?;
        match self.grid_gain {
            Some(gain) => write!(f, "  (without the grid {gain:.2} x as long)"),
            None => Ok(()),
        }
    }
}

/// Frame times of one adapter, as `fabrica bench` and the page's `?bench` tell them.
#[derive(Clone, Debug, PartialEq)]
pub struct BenchReport {
    /// Name of the adapter, as the driver or the browser tells it.
    pub adapter: String,
    /// Voxels along each axis of the subject that was drawn.
    pub voxels: [u32; 3],
    /// Width and height of the measured picture, pixels.
    pub size_px: [u32; 2],
    /// One row per scene, with and without the skip grid.
    pub rows: Vec<BenchRow>,
}

impl BenchReport {
    /// The report as JSON: `adapter`, `voxels`, `size`, and `frames` with times in milliseconds.
    pub fn to_json(&self) -> Value {
        let row = |row: &BenchRow| {
            json!({
                "name": row.name, "templates": row.template_count, "grid": row.has_grid, "ms": row.seconds * 1e3,
                "making_ms": row.making_seconds * 1e3, "ratio": row.ratio, "grid_gain": row.grid_gain,
            })
        };
        let frames: Vec<Value> = self.rows.iter().map(row).collect();
        json!({ "adapter": self.adapter, "voxels": self.voxels, "size": self.size_px, "frames": frames })
    }
}

impl std::fmt::Display for BenchReport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let ([x, y, z], [width, height]) = (self.voxels, self.size_px);
        writeln!(
            f,
            "{}, {x} x {y} x {z} voxels, {width} x {height} pixels; ratios to the undeformed frame with the grid",
            self.adapter
        )?;
        self.rows.iter().try_for_each(|row| writeln!(f, "{row}"))
    }
}

/// Size of the measured picture, pixels: small enough for a software GPU to end within a minute or two.
pub const BENCH_SIZE_PX: [u32; 2] = [256, 256];
/// Frames per case; the median counts.
pub const BENCH_REPEATS: usize = 7;

/// The eight templates read from the baked map, as while the camera moves.
const BAKED: &str = "eight, baked";

/// The documents that are measured: nothing, one peel, eight templates of eight kinds.
const CASES: [(&str, usize); 6] = [
    ("undeformed", 0),
    ("one peel", 1),
    ("eight templates", 8),
    ("peel, surface", 1),
    ("peel, segment", 1),
    (BAKED, 8),
];

/// Times frames (one sample per pixel at rest quality, read back) of a subject, which documents name as `named`:
/// undeformed, one peel, eight templates, a peel aligned to the surface and to segments, each with and without the
/// grid. After a frame of each that warms up come `repeats` rounds of a frame of each; the median counts. What is made
/// once per edit, before a frame, is timed apart. `on_progress` hears how much is measured, 0 to 1.
///
/// # Errors
/// As [`Studio::render_image`].
pub async fn bench(
    gpu: &Gpu,
    (subject, named): (&Subject, &SubjectRef),
    size_px: [u32; 2],
    repeats: usize,
    clock: Clock,
    on_progress: impl Fn(f32),
) -> Result<BenchReport, RenderError> {
    let studio = Studio::new(gpu, subject, true)?;
    let repeats = repeats.max(1);
    let mut cases = Vec::new();
    let all = (2 * CASES.len() * (1 + repeats)) as f32;
    let mut measured = 0.0;
    let mut tell = || {
        measured += 1.0;
        on_progress(measured / all);
    };
    for has_grid in [true, false] {
        let studio = studio.with_grid(has_grid);
        for (name, template_count) in CASES {
            let illustration = aligned_case(named, name, template_count);
            // Compiles, and fills caches.
            if name == BAKED {
                studio.render_baked(&illustration, size_px, 1, None).await?;
            } else {
                studio.render_image(&illustration, size_px, 1).await?;
            }
            tell();
            let row = BenchRow {
                name,
                template_count,
                has_grid,
                seconds: 0.0,
                making_seconds: 0.0,
                ratio: 1.0,
                grid_gain: None,
            };
            cases.push((row, studio.clone(), illustration, Vec::new(), Vec::new()));
        }
    }
    // In rounds: whatever else the machine does meets every case alike.
    for _ in 0..repeats {
        for (row, studio, illustration, times, making_times) in &mut cases {
            let start = clock();
            let mut job = studio.picture(illustration, size_px)?;
            if row.name == BAKED {
                job.bake(None);
            }
            WorkDone::start(gpu).await?;
            let ready = clock();
            job.draw(1, |_| {}).await?;
            times.push(clock() - ready);
            making_times.push(ready - start);
            tell();
        }
    }
    let mut rows: Vec<BenchRow> = cases
        .into_iter()
        .map(|(row, _, _, mut times, mut making_times)| BenchRow {
            seconds: median(&mut times),
            making_seconds: median(&mut making_times),
            ..row
        })
        .collect();
    let seconds: Vec<f64> = rows.iter().map(|row| row.seconds).collect();
    let base = seconds.first().copied().unwrap_or(1.0).max(1e-9);
    for (i, row) in rows.iter_mut().enumerate() {
        row.ratio = row.seconds / base;
        row.grid_gain = seconds
            .get(i + CASES.len())
            .filter(|_| row.has_grid)
            .map(|without| without / row.seconds.max(1e-9));
    }
    Ok(BenchReport {
        adapter: gpu.info.name.clone(),
        voxels: subject.values().map_or([0; 3], |v| v.grid.dims.to_array()),
        size_px,
        rows,
    })
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or_default()
}

/// The document of a case of [`CASES`].
fn aligned_case(subject: &SubjectRef, name: &str, count: usize) -> Illustration {
    let mut illustration = case(subject, count);
    if let Some(template) = illustration.templates.first_mut() {
        template.align = match name {
            "peel, surface" => Align::Surface {
                depth: 0.03,
                thickness: 0.01,
            },
            "peel, segment" => Align::Segment {
                keep: vec!["bone".to_owned(), "brain".to_owned()],
                thickness: 0.01,
            },
            _ => Align::Axis,
        };
    }
    illustration
}

/// So many templates over the subject, seen obliquely from the front.
fn case(subject: &SubjectRef, count: usize) -> Illustration {
    let mut illustration = Document::new().illustration().clone();
    illustration.subject = subject.clone();
    illustration.camera.rotate = Quat::from_rotation_z(0.5) * Quat::from_rotation_x(-0.3);
    illustration.camera.distance = 2.1;
    let place = |kind, at: [f32; 3], size: [f32; 3]| {
        let placement = Placement {
            at: Vec3::from_array(at),
            rotate: Quat::IDENTITY,
            size: Vec3::from_array(size),
        };
        PlacedTemplate::new(kind, placement)
    };
    let all = [
        place(TemplateKind::Peel, [0.0, 0.15, 0.3], [0.4, 0.4, 0.3]),
        place(TemplateKind::Retractor, [0.1, 0.3, 0.1], [0.2, 0.2, 0.2]),
        place(TemplateKind::Twist, [0.0, 0.0, -0.35], [0.5, 0.5, 0.3]),
        place(TemplateKind::Poke, [-0.2, 0.2, 0.1], [0.2, 0.2, 0.2]),
        place(TemplateKind::Cut, [-0.3, 0.1, 0.3], [0.15, 0.2, 0.2]),
        place(TemplateKind::Lens, [0.15, 0.35, 0.0], [0.2, 0.2, 0.2]),
        place(TemplateKind::Wave, [-0.2, -0.1, 0.2], [0.25, 0.25, 0.25]),
        place(TemplateKind::Pull, [0.0, 0.4, -0.1], [0.3, 0.3, 0.3]),
    ];
    illustration.templates = all
        .into_iter()
        .take(count)
        .enumerate()
        .map(|(index, template)| PlacedTemplate { index, ..template })
        .collect();
    illustration
}
