//! Figures on the command line: bent for a picture, probed, and written to files.

use std::io::{self, Write as _};
use std::path::Path;
use std::sync::Arc;

use glam::{DVec2, Vec2, Vec3, dvec2};

use super::args::{Common, Moment};
use super::device::open_gpu;
use super::error::CliError;
use super::numbers::read_flat_points;
use super::opening::Opened;
use super::output::{notice, write_whole};
use super::probe::{WHOLE, quoted};
use super::subject::{path_of, subject_of};
use crate::assets::Want;
use crate::data::{Plate, Resources, Sheet, Subject};
use crate::document::{Camera, FIGURE_FRONT, Illustration};
use crate::figure::mesh::Part;
use crate::figure::probe::{Seen, forward};
use crate::figure::svg::{Drawing, Label, bent};
use crate::figure::{Bender, FigureFile, Original, Solved, exported, unwatched};
use crate::load::{LoadError, LoadReport};
use crate::pictures::{PictureHeader, decode, orientation, upright};
use crate::render::{Studio, View, encode_png};
use crate::shell::figures::{figure_bytes, figure_file};
use crate::shell::files::Folder;

/// Samples per pixel of a picture that is written.
const SAMPLES: u32 = 16;
/// Pixels along the longest side of the picture of a drawing.
const DRAWING_PX: u32 = 2048;

/// Bends the figure of a subject, if it is one, for what draws it: the illustration as a figure is seen, and the sheet
/// among the resources. `bender` is made for the first picture of a subject and kept for those after it.
pub(super) fn with_sheet(
    bender: &mut Option<Bender>,
    illustration: Illustration,
    mut resources: Resources,
    subject: &Subject,
) -> Result<(Illustration, Resources), CliError> {
    let Some(plate) = subject.plate() else {
        if illustration.subject.is_figure().is_none() && illustration.figure.is_some() {
            notice("/figure: beside a subject that is no figure this is kept, not drawn");
        }
        return Ok((illustration.of_space(), resources));
    };
    report_beside(&illustration);
    let illustration = illustration.of_figure();
    let figure = illustration.figure.clone().unwrap_or_default();
    let bender = match bender {
        Some(bender) => bender,
        None => bender.insert(bender_of(plate)?),
    };
    // Nobody stops it, so there is a sheet.
    if let Some(bent) = bender.bent(&figure, &mut unwatched) {
        bent.notices.iter().for_each(notice);
        resources.sheet = Some(bent.sheet);
    }
    Ok((illustration, resources))
}

/// Names what is not drawn of a document whose file turns out to be that of a figure. Where the document tells that
/// itself, it has named them.
fn report_beside(illustration: &Illustration) {
    if illustration.subject.is_figure().is_none() {
        for pointer in illustration.left_beside(true) {
            notice(format!(
                "{pointer}: beside a figure this is kept, not drawn"
            ));
        }
    }
}

fn bender_of(plate: &Plate) -> Result<Bender, CliError> {
    Bender::new(plate).map_err(|error| CliError::Field(error.to_string()))
}

/// A figure that was opened and solved.
struct Figure {
    illustration: Illustration,
    plate: Arc<Plate>,
    original: Original,
    solved: Solved,
    /// What is drawn.
    sheet: Option<Sheet>,
}

impl Figure {
    fn of(common: &Common, opened: &Opened, moment: Moment) -> Result<Self, CliError> {
        let (illustration, _) = opened.illustration(moment, common)?;
        let subject = subject_of(&illustration, common, &opened.folder, WHOLE)?;
        let plate = subject.plate().ok_or(NO_FIGURE)?;
        report_beside(&illustration);
        let illustration = illustration.of_figure();
        let mut bender = bender_of(plate)?;
        let figure = illustration.figure.clone().unwrap_or_default();
        // Nobody stops it, so there is a pose.
        let solved = bender.solved(&figure, &mut unwatched).ok_or(NO_FIGURE)?;
        solved.notices.iter().for_each(notice);
        Ok(Self {
            illustration,
            plate: Arc::clone(plate),
            original: bender.original().clone(),
            sheet: bender.drawn(&solved),
            solved,
        })
    }
}

/// `fabrica export-figure`: numbers, shapes or pixels of a bent figure, by the ending of the file's name.
pub(super) fn export_figure(
    common: &Common,
    opened: &Opened,
    output: &Path,
    moment: Moment,
    size: Option<u32>,
) -> Result<(), CliError> {
    let ending = output.extension().and_then(|ending| ending.to_str());
    let ending = ending.unwrap_or_default().to_lowercase();
    if !["json", "svg", "png"].contains(&ending.as_str()) {
        return Err(CliError::Usage(
            "name a file that ends in .json, .svg or .png",
        ));
    }
    let figure = Figure::of(common, opened, moment)?;
    match ending.as_str() {
        "json" => {
            let solved = &figure.solved;
            let numbers = exported(&solved.rig, &solved.figure, &solved.posed);
            write_whole(output, format!("{numbers}\n").as_bytes())
        }
        "svg" => write_whole(output, figure.svg()?.as_bytes()),
        _ => write_whole(output, &figure.png(common, size)?),
    }
}

const NO_FIGURE: CliError = CliError::Usage("the document's subject is no figure");

impl Figure {
    fn svg(&self) -> Result<String, CliError> {
        let drawing = self.original.drawing.as_ref();
        let drawing = drawing.ok_or(CliError::Usage(
            "the figure has pixels, which an SVG cannot bend: save a PNG",
        ))?;
        let solved = &self.solved;
        let mesh = solved.rig.mesh();
        let seen = Seen::new(mesh, &solved.figure, &solved.posed.places);
        let captions = self.illustration.captions.iter();
        let label = |caption: &crate::document::Caption| {
            let at_rest = caption.at.truncate().as_dvec2();
            let place = forward(mesh, &solved.posed.places, at_rest);
            let found = seen.at(place.place);
            // On an edge of two triangles either may be found.
            let is_seen = found.triangle == place.triangle || found.place.distance(at_rest) < 1e-4;
            (place.triangle.is_some() && is_seen).then(|| Label {
                text: caption.text.trim().to_owned(),
                at: place.place,
            })
        };
        let labels: Vec<Label> = captions
            .filter(|caption| caption.is_drawn())
            .filter_map(label)
            .collect();
        let (plane, places) = (&self.original.plane, &solved.posed.places);
        Ok(bent(drawing, plane, mesh, &solved.figure, places, &labels))
    }

    /// The source's rectangle over the background, a pixel for each of the source.
    fn png(&self, common: &Common, size: Option<u32>) -> Result<Vec<u8>, CliError> {
        let gpu = open_gpu(common)?;
        let longest = match (&self.original.drawing, size) {
            (_, Some(size)) => size,
            (None, None) => self.plate.picture.size[0].max(self.plate.picture.size[1]),
            (Some(_), None) => DRAWING_PX,
        };
        let size = match self.original.drawing {
            None if size.is_none() => self.plate.picture.size,
            _ => sized(self.plate.size, longest),
        };
        let mut illustration = self.illustration.clone();
        illustration.camera = straight(&self.plate);
        let subject = Subject::Figure(Arc::clone(&self.plate));
        let subject = finer(subject, &illustration.camera, size);
        let resources = Resources {
            sheet: self.sheet.clone(),
            ..Resources::default()
        };
        let studio = Studio::new(&gpu, &subject, false)?.with_resources(resources);
        let image = pollster::block_on(studio.render_image(&illustration, size, SAMPLES))?;
        Ok(encode_png(&image)?)
    }
}

/// The subject of a picture of this size: a drawing that is seen closer than its pixels is drawn finer.
pub(super) fn finer(subject: Subject, camera: &Camera, size_px: [u32; 2]) -> Subject {
    let seen_px = 1.0 / View::new(camera, size_px).units_per_pixel(camera.distance);
    let coarse = subject.plate().filter(|plate| plate.is_coarse(seen_px));
    let redrawn = |plate: &Arc<Plate>| Some(plate.redrawn(Original::of(plate).ok()?.finer()?));
    match coarse.and_then(redrawn) {
        Some(plate) => Subject::from(plate),
        None => subject,
    }
}

/// Width and height of a picture of this shape whose longest side has so many pixels.
fn sized(shape: DVec2, longest: u32) -> [u32; 2] {
    let scale = f64::from(longest) / shape.max_element();
    [shape.x, shape.y].map(|side| ((side * scale).round() as u32).max(1))
}

/// A camera in whose picture the plate lies from edge to edge.
fn straight(plate: &Plate) -> Camera {
    let shorter = 2.0 * plate.half_size().min_element() as f32;
    let fov_deg: f32 = 30.0;
    Camera {
        target: Vec3::ZERO,
        rotate: FIGURE_FRONT,
        distance: 0.5 * shorter / (0.5 * fov_deg.to_radians()).tan(),
        fov_deg,
    }
}

/// Whether the subject is a figure, by its name or by the first bytes of its file. A file that is not there is none.
pub(super) fn is_figure(opened: &Opened, common: &Common) -> bool {
    let subject = &opened.document.illustration().subject;
    let path = match (&common.subject, subject.is_figure()) {
        (Some(path), _) => path.clone(),
        (None, Some(is_figure)) => return is_figure,
        (None, None) => match path_of(&Want::subject(subject), common, &opened.folder) {
            Some(path) => path,
            None => return false,
        },
    };
    let (mut folder, name) = Folder::of(&path);
    figure_file(&mut folder, &name).is_ok_and(|file| file.is_some())
}

/// `fabrica probe` of a figure.
pub(super) fn probe_figure(
    common: &Common,
    opened: &Opened,
    points: Option<&Path>,
    (is_object, is_forward): (bool, bool),
    moment: Moment,
) -> Result<(), CliError> {
    let figure = Figure::of(common, opened, moment)?;
    let points = read_flat_points(points, "x,y or x,y,z, finite numbers")?;
    let solved = &figure.solved;
    let mesh = solved.rig.mesh();
    let places = &solved.posed.places;
    let seen = Seen::new(mesh, &solved.figure, places);
    let mut out = io::BufWriter::new(io::stdout().lock());
    for [x, y] in points {
        let point = dvec2(x, y);
        let found = match is_forward {
            true => forward(mesh, places, point),
            false => seen.at(point),
        };
        let DVec2 { x: sx, y: sy } = found.place;
        let a = if found.triangle.is_some() { 1 } else { -1 };
        write!(out, "{x},{y},0,{sx},{sy},0,{a}").map_err(CliError::Output)?;
        if is_object {
            let at_rest = if is_forward { point } else { found.place };
            let (color, name) = match found.triangle {
                Some(triangle) => {
                    let tissue = mesh.tissue(triangle);
                    let color = figure.color(tissue.part, at_rest);
                    (color, quoted(&tissue.name))
                }
                None => (String::new(), String::new()),
            };
            write!(out, ",{color},{name}").map_err(CliError::Output)?;
        }
        writeln!(out).map_err(CliError::Output)?;
    }
    out.flush().map_err(CliError::Output)
}

impl Figure {
    /// The source's colour at a place at rest; none of tissue that the source does not have.
    fn color(&self, part: Part, at_rest: DVec2) -> String {
        if matches!(part, Part::Behind(_)) {
            return String::new();
        }
        let place = Vec2::new(at_rest.x as f32, at_rest.y as f32).extend(0.0);
        let color = self.plate.color_at(place);
        color.map_or_else(String::new, |[r, g, b, a]| {
            format!("#{r:02x}{g:02x}{b:02x}{a:02x}")
        })
    }
}

/// `fabrica info` of a picture; none if the file is none.
///
/// # Errors
/// [`CliError::Load`].
pub(super) fn describe_figure(file: &Path) -> Result<Option<String>, CliError> {
    let (mut folder, name) = Folder::of(file);
    let shown = || file.to_string_lossy().into_owned();
    let kind = match figure_file(&mut folder, &name) {
        Ok(Some(kind)) => kind,
        // What cannot be read at all is told by the reader of scans.
        Ok(None) | Err(_) => return Ok(None),
    };
    let failed = |message: String| {
        let name = name.clone();
        CliError::Load(LoadError::Figure { name, message }, shown())
    };
    let bytes = figure_bytes(&mut folder, &name, &mut LoadReport::default())
        .map_err(|error| CliError::Load(error, shown()))?;
    match kind {
        FigureFile::Picture => {
            let header = PictureHeader::of(&bytes).map_err(|error| failed(error.to_string()))?;
            // Read through, so that a damaged file is told.
            let picture = decode(&bytes).map_err(|error| failed(error.to_string()))?;
            let picture = upright(picture, orientation(&bytes));
            let [width, height] = picture.size;
            if picture.is_of_inks {
                notice("the picture mixes inks (CMYK); its colours are taken by inversion");
            }
            Ok(Some(format!(
                "{} picture\n{width} × {height} px\n{} channels ({}) of {} bits\n",
                header.kind.name(),
                header.channels,
                header.channel_names(),
                header.bits,
            )))
        }
        FigureFile::Drawing => {
            let drawing = Drawing::read(&bytes).map_err(|error| failed(error.to_string()))?;
            Ok(Some(of_drawing(&drawing)))
        }
    }
}

fn of_drawing(drawing: &Drawing) -> String {
    let mut text = format!(
        "SVG drawing\nview box {} × {}\n{} shapes, {} of them filled\n",
        drawing.size.x,
        drawing.size.y,
        drawing.shapes.len(),
        drawing.filled().count(),
    );
    for (number, shape) in drawing.filled() {
        let id = shape.id().map_or_else(String::new, |id| format!(": {id}"));
        text += &format!("  {number}{id}\n");
    }
    if !drawing.words.is_empty() {
        let words: Vec<&str> = drawing.words.iter().map(|word| &*word.text).collect();
        text += &format!("words: {}\n", words.join(", "));
    }
    for kind in &drawing.left_out {
        notice(format!("not drawn of the SVG: {kind}"));
    }
    text
}
