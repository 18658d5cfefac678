use super::clock::Clock;
use super::studio::Studio;
use crate::data::{Limited, Resources, Subject, Surface, median};
use crate::displace::Sweeping;
use crate::document::{
    Align, BodyKind, Constrain, ConstrainBy, Document, Illustration, ObjectPlacement, ObjectSource,
    PathKey, PlacedTemplate, SceneObject, Style, SubjectRef, SweepTool, SweepTools, TemplateData,
    TemplateKind, style_preset,
};
use crate::math::Placement;
use crate::render::device::error::RenderError;
use crate::render::device::gpu::Gpu;
use crate::render::device::readback::WorkDone;
use glam::Quat;
use glam::Vec3;
use serde_json::{Value, json};
use std::sync::Arc;

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
    /// Median time to make the scene ready once a template was moved, seconds: the grid, mostly. Nothing while only the
    /// camera moves.
    pub making_seconds: f64,
    /// Median time to make the scene ready from nothing, seconds: distances to kept tissue and its shares too, which
    /// stay as long as the same tissue is kept.
    pub opening_seconds: f64,
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
            "{:<24} {:<8} {:>9.1} ms  {:>5.2} x  edited in {:>6.1} ms, opened in {:>6.1} ms",
            self.name,
            grid,
            self.seconds * 1e3,
            self.ratio,
            self.making_seconds * 1e3,
            self.opening_seconds * 1e3
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
    /// Bytes that the measured mesh takes on the GPU, if one was measured.
    pub mesh_bytes: Option<u64>,
    /// Bytes of the pictures on its triangles, which are not among `mesh_bytes`.
    pub texture_bytes: u64,
    /// Width and height of the measured picture, pixels.
    pub size_px: [u32; 2],
    /// One row per scene, with and without the skip grid.
    pub rows: Vec<BenchRow>,
    /// What a sweep costs, beside its limits; empty if its rows were not measured.
    pub limits: Vec<Limited>,
}

impl BenchReport {
    /// The report as JSON: `adapter`, `voxels`, `bytes` of the mesh and its
    /// `texture_bytes`, `size`, `frames` with times in milliseconds, and `limits`.
    pub fn to_json(&self) -> Value {
        let row = |row: &BenchRow| {
            json!({
                "name": row.name, "templates": row.template_count, "grid": row.has_grid, "ms": row.seconds * 1e3,
                "making_ms": row.making_seconds * 1e3, "opening_ms": row.opening_seconds * 1e3,
                "ratio": row.ratio, "grid_gain": row.grid_gain,
            })
        };
        let frames: Vec<Value> = self.rows.iter().map(row).collect();
        let limits: Vec<Value> = self.limits.iter().map(Limited::to_json).collect();
        json!({ "adapter": self.adapter, "voxels": self.voxels, "bytes": self.mesh_bytes,
            "texture_bytes": self.texture_bytes, "size": self.size_px, "frames": frames, "limits": limits })
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
        self.rows.iter().try_for_each(|row| writeln!(f, "{row}"))?;
        self.limits.iter().try_for_each(|row| writeln!(f, "{row}"))
    }
}

/// How much is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BenchPlan {
    /// Width and height of the pictures, pixels.
    pub size_px: [u32; 2],
    /// Rounds of a frame of each row, one at least.
    pub repeats: usize,
    /// Rows at most, from the first on: one at least.
    pub most_rows: usize,
}

impl Default for BenchPlan {
    /// Small enough for a software GPU to end within a minute or two.
    fn default() -> Self {
        Self {
            size_px: [256, 256],
            repeats: 7,
            most_rows: usize::MAX,
        }
    }
}

impl BenchPlan {
    /// True if rows of meshes are wanted: they come behind all others.
    pub fn wants_meshes(&self) -> bool {
        let others = 2 * CASES.len() + CONSTRAINED.len() + STYLED.len() + SWEPT.len();
        self.most_rows > others
    }
}

/// The eight templates read from the baked map, as while the camera moves.
const BAKED: &str = "eight, baked";

/// The documents that are measured with and without the grid: nothing, one peel, eight templates of eight kinds, and
/// what the peel may do with kept tissue.
const CASES: [(&str, usize); 6] = [
    ("undeformed", 0),
    ("one peel", 1),
    ("eight templates", 8),
    ("peel, surface", 1),
    ("peel, segment", 1),
    (BAKED, 8),
];
/// Measured with the grid alone: the peel gives way to bone, and takes bone with it as a rigid body.
const CONSTRAINED: [(&str, ConstrainBy); 2] = [
    ("peel, gives way", ConstrainBy::Displacement),
    ("peel, rigid", ConstrainBy::Rigid),
];

/// Measured with the grid alone: one peel in each style.
const STYLED: [(&str, &str); 5] = [
    ("one peel, atlas", "atlas"),
    ("one peel, ink", "ink"),
    ("one peel, pencil", "pencil"),
    ("one peel, textbook", "textbook"),
    ("one peel, blueprint", "blueprint"),
];

/// Measured with the grid alone: a ball that is swept over three coatings, by its formula and from the baked map,
/// beside a twist of the same reach.
const SWEPT: [&str; 3] = [TWISTED, SWEPT_EXACT, SWEPT_BAKED];
const TWISTED: &str = "one twist, as wide";
const SWEPT_EXACT: &str = "one sweep";
const SWEPT_BAKED: &str = "one sweep, baked";
/// Samples along each side of what is looked at where the fields of a sweep are counted.
const COUNTED_SIDE: usize = 32;

/// True if a case is read from the baked map.
fn is_baked(name: &str) -> bool {
    [BAKED, SWEPT_BAKED].contains(&name)
}

/// What is drawn to be measured.
struct Case {
    name: &'static str,
    studio: Studio,
    illustration: Illustration,
}

impl Case {
    /// The illustration before the edit that is measured: its first template is elsewhere, by a hair.
    fn unedited(&self) -> Illustration {
        let mut before = self.illustration.clone();
        if let Some(template) = before.templates.first_mut() {
            template.placement.at.x += 1e-3;
        }
        before
    }
}

/// A mesh to measure beside a subject, and a tool to stand before the subject.
#[derive(Clone, Debug)]
pub struct BenchMeshes {
    /// Drawn as a subject.
    pub surface: Arc<Surface>,
    /// The same of sixteen times as many triangles, if they are to be drawn too.
    pub finer: Option<Arc<Surface>>,
    /// Drawn as an object.
    pub tool: Arc<Surface>,
}

/// Times frames (one sample per pixel at rest quality, read back) of a subject, which documents name as `named`:
/// undeformed, one peel, eight templates, a peel aligned to the surface and to segments, each with and without the
/// grid; a peel that gives way to bone, and one of rigid bone; one peel in each style; a sweep and a twist; and, if
/// there are `meshes`, of these. After a frame of each that warms up come the plan's rounds of a frame of each; the
/// median counts. What is made before a frame is timed apart: from nothing, and after an edit. `on_progress` hears how
/// much is measured, 0 to 1.
///
/// # Errors
/// As [`Studio::render_image`].
pub async fn bench(
    gpu: &Gpu,
    (subject, named): (&Subject, &SubjectRef),
    meshes: Option<&BenchMeshes>,
    plan: BenchPlan,
    clock: Clock,
    on_progress: impl Fn(f32),
) -> Result<BenchReport, RenderError> {
    let studio = Studio::new(gpu, subject, true)?;
    let (size_px, repeats) = (plan.size_px, plan.repeats.max(1));
    let mut cases = Vec::new();
    for has_grid in [true, false] {
        cases.extend(CASES.map(|(name, template_count)| Case {
            name,
            studio: studio.with_grid(has_grid),
            illustration: aligned_case(named, name, template_count),
        }));
    }
    cases.extend(CONSTRAINED.map(|(name, by)| Case {
        name,
        studio: studio.clone(),
        illustration: constrained_case(named, by),
    }));
    cases.extend(STYLED.map(|(name, preset)| Case {
        name,
        studio: studio.clone(),
        illustration: styled_case(named, preset),
    }));
    cases.extend(SWEPT.map(|name| Case {
        name,
        studio: studio.clone(),
        illustration: swept_case(named, name),
    }));
    let (mut bytes, mut texture_bytes) = (None, 0);
    if let Some(meshes) = meshes {
        let drawn = Studio::new(gpu, &Subject::from(Arc::clone(&meshes.surface)), true)?;
        bytes = Some(drawn.subject.bytes());
        texture_bytes = drawn.subject.texture_bytes();
        cases.extend(mesh_cases(gpu, &drawn, meshes)?);
        cases.push(tool_case(&studio, named, &meshes.tool));
    }
    cases.truncate(plan.most_rows.max(1));
    let all = (cases.len() * (1 + repeats)) as f32;
    let mut measured = 0.0;
    let mut tell = || {
        measured += 1.0;
        on_progress(measured / all);
    };
    for case in &cases {
        // Compiles, and fills caches.
        if is_baked(case.name) {
            let baked = case
                .studio
                .render_baked(&case.illustration, size_px, 1, None);
            baked.await?;
        } else {
            case.studio
                .render_image(&case.illustration, size_px, 1)
                .await?;
        }
        tell();
    }
    let mut times = vec![[const { Vec::new() }; 3]; cases.len()];
    // In rounds: whatever else the machine does meets every case alike.
    for _ in 0..repeats {
        for (case, [frames, makings, openings]) in cases.iter().zip(&mut times) {
            let before = case.unedited();
            let start = clock();
            let mut job = case.studio.picture(&before, size_px)?;
            WorkDone::start(gpu).await?;
            let opened = clock();
            job.show((&case.illustration, &case.studio.resources));
            if is_baked(case.name) {
                job.bake(None);
            }
            WorkDone::start(gpu).await?;
            let ready = clock();
            job.draw(1, |_| {}).await?;
            frames.push(clock() - ready);
            makings.push(ready - opened);
            openings.push(opened - start);
            tell();
        }
    }
    let seconds: Vec<[f64; 3]> = (times.iter_mut())
        .map(|of_case| of_case.each_mut().map(|all| median(all)))
        .collect();
    let base = seconds.first().map_or(1.0, |[first, ..]| *first).max(1e-9);
    let row = |(i, case): (usize, &Case)| {
        let [frame, making, opening] = seconds[i];
        let has_grid = case.studio.wants_grid;
        let is_same = |other: &&Case| other.name == case.name && !other.studio.wants_grid;
        let without = cases
            .iter()
            .position(|other| is_same(&other))
            .filter(|_| has_grid);
        BenchRow {
            name: case.name,
            template_count: case.illustration.templates.len(),
            has_grid,
            seconds: frame,
            making_seconds: making,
            opening_seconds: opening,
            ratio: frame / base,
            grid_gain: without.map(|other| seconds[other][0] / frame.max(1e-9)),
        }
    };
    let rows: Vec<BenchRow> = cases.iter().enumerate().map(row).collect();
    Ok(BenchReport {
        limits: sweep_limits(&rows, named),
        adapter: gpu.info.name.clone(),
        voxels: subject.values().map_or([0; 3], |v| v.grid.dims.to_array()),
        mesh_bytes: bytes,
        texture_bytes,
        size_px,
        rows,
    })
}

/// The cases of a mesh (spec/surfaces.md, "The command line"). The cuts are measured without the grid too.
fn mesh_cases(gpu: &Gpu, drawn: &Studio, meshes: &BenchMeshes) -> Result<Vec<Case>, RenderError> {
    let named = Document::new().illustration().subject.clone();
    let shown = |count: usize, body: BodyKind| {
        let mut illustration = case(&named, count);
        illustration.look.surface.body = body;
        illustration
    };
    let mut poked = shown(8, BodyKind::Auto);
    poked.templates.retain(|t| t.kind == TemplateKind::Poke);
    let of = |name, studio: &Studio, illustration| Case {
        name,
        studio: studio.clone(),
        illustration,
    };
    let no_grid = drawn.with_grid(false);
    let mut cases = vec![
        of("surface", drawn, shown(0, BodyKind::Auto)),
        of("surface, one poke", drawn, poked),
        of("surface, hollow cut", drawn, shown(1, BodyKind::Hollow)),
        of("surface, solid cut", drawn, shown(1, BodyKind::Solid)),
        of("surface, hollow cut", &no_grid, shown(1, BodyKind::Hollow)),
        of("surface, solid cut", &no_grid, shown(1, BodyKind::Solid)),
        of("surface, eight templates", drawn, shown(8, BodyKind::Auto)),
    ];
    if let Some(finer) = &meshes.finer {
        let finer = Studio::new(gpu, &Subject::from(Arc::clone(finer)), true)?;
        cases.push(of("surface, 16 x", &finer, shown(0, BodyKind::Auto)));
    }
    Ok(cases)
}

/// A ball that is swept into the subject from the front over three coatings, or a twist of the box that it reaches.
fn swept_case(named: &SubjectRef, name: &str) -> Illustration {
    const SIDE: f32 = 0.4;
    let mut illustration = case(named, 0);
    let kind = match name {
        TWISTED => TemplateKind::Twist,
        _ => TemplateKind::Sweep,
    };
    // z of the box points to the front.
    let placement = Placement {
        at: Vec3::new(0.0, 0.3, 0.05),
        rotate: Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2),
        size: Vec3::splat(SIDE),
    };
    let mut template = PlacedTemplate::new(kind, placement);
    let mut tool = SweepTool::default();
    tool.path = [1.15, 1.15 - 3.0 * tool.coat]
        .map(|z| PathKey::at(Vec3::new(0.5, 0.5, z)))
        .to_vec();
    template.data = match kind {
        TemplateKind::Sweep => TemplateData::Tools(SweepTools {
            tools: vec![tool],
            ..SweepTools::default()
        }),
        _ => {
            let reach = 0.15 + tool.coat;
            let [from, to] = [tool.path[0].at.z, tool.path[1].at.z];
            template.placement.at.y += SIDE * (0.5 * (from + to) - 0.5);
            template.placement.size =
                SIDE * Vec3::new(2.0 * reach, 2.0 * reach, from - to + 2.0 * reach);
            TemplateData::None
        }
    };
    illustration.templates = vec![template];
    illustration
}

/// What a sweep costs, by the frames that were measured and by counting: to a twist of the same reach, and fields for
/// each coating that a tool travels.
fn sweep_limits(rows: &[BenchRow], named: &SubjectRef) -> Vec<Limited> {
    let seconds = |name: &str| {
        let row = rows.iter().find(|row| row.name == name)?;
        Some(row.seconds)
    };
    let [Some(twisted), Some(exact), Some(baked)] = SWEPT.map(seconds) else {
        return Vec::new();
    };
    let limited = |name, value, limit| Limited { name, value, limit };
    let mut limits = vec![
        limited("one sweep, to one twist as wide", exact / twisted, 5.0),
        limited(
            "one sweep, baked, to one twist as wide",
            baked / twisted,
            1.3,
        ),
    ];
    for template in swept_case(named, SWEPT_EXACT).templates {
        let TemplateData::Tools(alone) = template.data else {
            continue;
        };
        let mut pair = alone.clone();
        pair.mirror[0] = true;
        let size = template.placement.size;
        let [within, beyond] = most_fields(&alone, size);
        let [of_pair, _] = most_fields(&pair, size);
        limits.extend([
            limited("fields of a sample, a coating of one tool", within, 24.0),
            limited("fields of a sample, of two that overlap", of_pair, 32.0),
            limited("fields of a sample beyond the reach", beyond, 0.0),
        ]);
    }
    limits
}

/// The most fields that are evaluated for a sample, for each coating that a tool travels, images counted: in reach of
/// the tools, and beyond it.
fn most_fields(tools: &SweepTools, size: Vec3) -> [f64; 2] {
    let sweeping = Sweeping::new(tools, size);
    let coats = sweeping.longest(1.0) / sweeping.least_coat().unwrap_or(1.0);
    let travelled = f64::from(coats) * (tools.images() * tools.acting().count()) as f64;
    let reach = sweeping.bounds(1.0);
    let middle = 0.5 * (reach.min + reach.max);
    let mut most = [0.0_f64; 2];
    for i in 0..COUNTED_SIDE.pow(3) {
        let along = |axis: u32| (i / COUNTED_SIDE.pow(axis) % COUNTED_SIDE) as f32;
        let part = Vec3::from_array([0, 1, 2].map(along)) / (COUNTED_SIDE - 1) as f32;
        // Half as large again as the reach.
        let at = middle + 1.5 * reach.size() * (part - 0.5);
        let is_beyond = at.cmplt(reach.min).any() || at.cmpgt(reach.max).any();
        let fields = sweeping.fields_at(at) as f64 / travelled;
        let most = &mut most[usize::from(is_beyond)];
        *most = most.max(fields);
    }
    most
}

/// One peel in a style.
fn styled_case(named: &SubjectRef, preset: &str) -> Illustration {
    let mut illustration = case(named, 1);
    illustration.look.style = style_preset(preset).map_or(Style::PLAIN, |preset| preset.style);
    illustration
}

/// The undeformed subject with a tool before its middle.
fn tool_case(studio: &Studio, named: &SubjectRef, tool: &Arc<Surface>) -> Case {
    let mut illustration = case(named, 0);
    let object = SceneObject {
        index: 0,
        name: "tool".to_owned(),
        source: ObjectSource::Builtin(SceneObject::BUILTINS[0]),
        placement: Some(ObjectPlacement {
            at: Vec3::new(0.1, 0.6, 0.1),
            ..ObjectPlacement::DOCUMENT_DEFAULT
        }),
        color_srgb: None,
        inside_srgb: None,
        opacity: 1.0,
        gloss: SceneObject::DEFAULT_GLOSS,
        enabled: true,
    };
    let resources = Resources {
        objects: vec![(object.source.clone(), Arc::clone(tool))],
        ..Resources::default()
    };
    illustration.objects.push(object);
    Case {
        name: "head and tool",
        studio: studio.clone().with_resources(resources),
        illustration,
    }
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

/// The peel with a constraint.
fn constrained_case(subject: &SubjectRef, by: ConstrainBy) -> Illustration {
    let mut illustration = case(subject, 1);
    if let Some(template) = illustration.templates.first_mut() {
        template.constrain = Some(Constrain {
            by,
            keep: vec!["bone".to_owned()],
        });
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sweep_takes_the_fields_that_its_steps_allow() {
        let named = Document::new().illustration().subject.clone();
        let rows = SWEPT.map(|name| BenchRow {
            name,
            template_count: 1,
            has_grid: true,
            seconds: 1.0,
            making_seconds: 0.0,
            opening_seconds: 0.0,
            ratio: 1.0,
            grid_gain: None,
        });
        let limits = sweep_limits(&rows, &named);
        assert!(limits.iter().all(Limited::holds), "{limits:?}");
        let values: Vec<f64> = limits.iter().map(|row| row.value.round()).collect();
        assert_eq!(values, [1.0, 1.0, 24.0, 32.0, 0.0]);
        assert!(sweep_limits(&rows[1..], &named).is_empty());
    }
}
