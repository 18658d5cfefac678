//! The subject of a document with its segments, for the command line: generated, or read from local files.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::sync_channel;

use super::args::Common;
use super::error::{CliError, MissingSubject};
use super::output::notice;
use super::progress::Progress;
use super::reading::hint;
use super::stop;
use crate::assets::{Assets, Data, Role, Source, Want, Wanted};
use crate::data::{
    BuildError, Mesh, MeshGrids, Reducer, Resources, Subject, SubjectBuilder, SubjectPart,
    SubjectSink as _, Surface, TimeSlices, VolumeBuilder, VolumeLimits, segment,
};
use crate::document::{Clay, DRAWN_FIGURES, Illustration, Reading, ToolFile};
use crate::figure::builtin_plate;
use crate::load::{FileSet, LabelFile, LoadError, LoadReport, ReadOptions, read_label_file};
use crate::render::{KeptTissue, RenderNotice, lidded};
use crate::shell::clays::{ClayDesk, surface_of_clay};
use crate::shell::figures::read_any;
use crate::shell::files::{Folder, local, mesh_set};
use crate::shell::loading::hash_of;
use crate::subjects::{FINE_RESOLUTION, Generator, SubjectError, mesh};

/// The subject of a document with its segments: those of its own file, those of label volumes that the document names
/// or that are given beside it, and those that its recipes make. `folder` is where relative addresses start; a larger
/// volume than `limits` allow is reduced.
///
/// # Errors
/// [`CliError::Subject`] if a file is not there, cannot be read, or is another one than the document means.
pub(super) fn subject_of(
    illustration: &Illustration,
    common: &Common,
    folder: &Path,
    limits: VolumeLimits,
) -> Result<Subject, CliError> {
    let mut assets = Assets::default();
    let mut given = Vec::new();
    for path in &common.segments {
        given.push((path.clone(), read_segments(path)?));
    }
    for want in Wanted::of(illustration).0 {
        match want.role {
            Role::Subject => take_subject(&mut assets, &want, common, folder, limits)?,
            Role::Segments => take_segments(&mut assets, &want, &mut given, folder)?,
            // Fields come by `fields_of`, as they need the subject's grid only.
            Role::Field => {}
            // Where these lie is known when the subject is there.
            Role::Mesh => {}
            // Objects come by `objects_of`: they are no part of the subject.
            Role::Object => {}
            // Nor are meshes of tools: a clay takes its own when it is shaped.
            Role::Tool => {}
        }
    }
    take_meshes(&mut assets, illustration, common, folder)?;
    for (_, file) in given {
        assets.add_segments(file);
    }
    let (resources, news) = assets.resources(illustration);
    drop(assets);
    news.iter().for_each(notice);
    // A document has a subject, and it was brought.
    let Some(subject) = resources.subject.clone() else {
        return Err(CliError::from(MissingSubject::wanted(&Want::subject(
            &illustration.subject,
        ))));
    };
    let has_own_only = resources.segmentations.is_empty() && resources.own_segments.is_none();
    if subject.values().is_none() || (has_own_only && illustration.recipes.is_empty()) {
        return Ok(subject);
    }
    let recipes = illustration.recipes.clone();
    let made = pollster::block_on(segment(resources, recipes, TimeSlices::unlimited()));
    made.notices.iter().for_each(notice);
    Ok(subject.with_segmentation(made.segmentation.map(Arc::unwrap_or_clone)))
}

/// Names the file of a mesh or of an object if it is not there; what it would be is left out.
pub(super) fn report_missing(what: &str, want: &Want, folder: &Path) {
    let Source::File { src, name, .. } = &want.source else {
        return;
    };
    let called = match name.as_str() {
        "" => String::new(),
        name => format!(" “{name}”"),
    };
    let Some(src) = src else {
        return notice(format!(
            "the document needs the file of the {what}{called} (SHA-256 {}); it is left out",
            want.sha256().unwrap_or_default()
        ));
    };
    match local(folder, src) {
        Some(path) if path.exists() => {}
        Some(path) => notice(format!(
            "the file of the {what}{called} is not there, and it is left out: {}",
            path.display()
        )),
        None => notice(format!(
            "this program reads local files only; the {what}{called} is left out: {src}"
        )),
    }
}

/// Brings the subject. The file of `--subject` takes the place of the document's, and only a notice says that it is
/// another one.
fn take_subject(
    assets: &mut Assets,
    want: &Want,
    common: &Common,
    folder: &Path,
    limits: VolumeLimits,
) -> Result<(), MissingSubject> {
    if let Some(clay) = want.clay() {
        // What it begins with is the right file, or a notice has said that it is not.
        assets.give_subject(shaped(want, common, folder)?, Some(Arc::clone(clay)));
        return Ok(());
    }
    let reading = common.reading.over(Some(&want.reading));
    let path = file_of(want, common, folder)?;
    let data = match (&want.source, &path) {
        (_, Some(path)) => read(path, &reading, limits, folder, &common.meshes)?,
        (Source::Builtin { name, revision }, None) => Data::Subject {
            subject: generate(name, *revision)?,
            sha256: None,
        },
        (_, None) => return Err(MissingSubject::wanted(want)),
    };
    if common.subject.is_none() {
        let taken = assets.take(want, data);
        return taken.map_err(|other| MissingSubject::other(&path.unwrap_or_default(), other));
    }
    if let Some(Err(other)) = data.sha256().map(|found| want.check(found)) {
        notice(format!("{} is {other}", path.unwrap_or_default().display()));
    }
    assets.give(data);
    Ok(())
}

/// The file of a subject: the one of `--subject`, that at its address, or the one of those given that has its hash;
/// `None` for what is made of no file.
fn file_of(want: &Want, common: &Common, folder: &Path) -> Result<Option<PathBuf>, MissingSubject> {
    if common.subject.is_some() {
        return Ok(common.subject.clone());
    }
    let found = match want.src() {
        Some(src) => local(folder, src).ok_or_else(|| MissingSubject::remote(want))?,
        None if want.is_supplied() => given_of(&common.meshes, want)
            .ok_or_else(|| MissingSubject::wanted(want))?
            .to_owned(),
        None => return Ok(None),
    };
    Ok(Some(found))
}

/// Brings the meshes beside a volume. A notice names those whose files are not there; they are left out.
fn take_meshes(
    assets: &mut Assets,
    illustration: &Illustration,
    common: &Common,
    folder: &Path,
) -> Result<(), MissingSubject> {
    while let Some(want) = assets.meshes_wanted(illustration) {
        let Some(path) = path_of(&want, common, folder) else {
            report_missing("mesh", &want, folder);
            assets.refuse(&want);
            continue;
        };
        let data = mesh_data(
            &path,
            &want,
            folder,
            &common.meshes,
            "a mesh of the subject",
        )?;
        let taken = assets.take(&want, data);
        return taken.map_err(|other| MissingSubject::other(&path, other));
    }
    Ok(())
}

/// The file of a mesh or an object: at its address, or among those given; `None` if it is not there.
pub(super) fn path_of(want: &Want, common: &Common, folder: &Path) -> Option<PathBuf> {
    match want.src() {
        Some(src) => local(folder, src).filter(|path| path.exists()),
        None => given_of(&common.meshes, want).map(Path::to_owned),
    }
}

/// Reads a mesh that is no subject by itself. `what` it is to be, for who gives a scan.
pub(super) fn mesh_data(
    path: &Path,
    want: &Want,
    folder: &Path,
    given: &[PathBuf],
    what: &str,
) -> Result<Data, MissingSubject> {
    let limits = VolumeLimits {
        max_dim: u32::MAX,
        max_voxels: u64::MAX,
    };
    match read(path, &want.reading, limits, folder, given)? {
        Data::Subject {
            subject: Subject::Mesh(mesh),
            sha256,
        } => Ok(Data::Object { mesh, sha256 }),
        _ => Err(MissingSubject::File {
            path: path.display().to_string(),
            source: LoadError::Mesh {
                message: format!(
                    "a scan, not a surface mesh: {what} has to be OBJ, STL, PLY or GLB"
                ),
            },
        }),
    }
}

/// Brings a label volume that the document names: one of those given if it has the hash, else the file at the address.
fn take_segments(
    assets: &mut Assets,
    want: &Want,
    given: &mut Vec<(PathBuf, LabelFile)>,
    folder: &Path,
) -> Result<(), MissingSubject> {
    let is_it = |(_, file): &(PathBuf, LabelFile)| {
        want.sha256().is_some() && want.check(&file.sha256).is_ok()
    };
    let (path, file) = match (given.iter().position(is_it), want.src()) {
        (Some(i), _) => given.remove(i),
        (None, Some(src)) => {
            let path = local(folder, src).ok_or_else(|| MissingSubject::remote(want))?;
            let file = read_segments(&path)?;
            (path, file)
        }
        (None, None) => {
            notice(format!(
                "the document needs a label volume (SHA-256 {}): give it by --segments FILE; its segments are left out",
                want.sha256().unwrap_or_default()
            ));
            return Ok(());
        }
    };
    let taken = assets.take(want, Data::Segments(file));
    taken.map_err(|other| MissingSubject::other(&path, other))
}

fn read_segments(path: &Path) -> Result<LabelFile, MissingSubject> {
    let (mut files, name) = Folder::of(path);
    let file = read_label_file(&mut files, &name, &ReadOptions::default());
    file.map_err(|source| MissingSubject::File {
        path: path.display().to_string(),
        source,
    })
}

/// A mesh of the program's own, prepared to be drawn.
///
/// # Errors
/// [`SubjectError::Refused`] if the mesh has no size.
pub(super) fn surface_of(mesh: &Mesh) -> Result<Arc<Surface>, MissingSubject> {
    let surface = Surface::new(mesh, None, &mut |_| true);
    let surface = surface.map_err(|error| SubjectError::Refused(error.to_string()))?;
    Ok(Arc::new(surface))
}

/// A built-in subject in full resolution, with as many threads as there are cores.
///
/// # Errors
/// [`SubjectError::UnknownName`].
pub(super) fn generate(name: &str, revision: u32) -> Result<Subject, MissingSubject> {
    if DRAWN_FIGURES.contains(&name) {
        let plate = builtin_plate(name).map_err(|error| SubjectError::Refused(error.to_string()));
        return Ok(plate?.into());
    }
    if let Some(mesh) = mesh(name) {
        return Ok(surface_of(&mesh)?.into());
    }
    let generator = Generator::of_revision(name, revision, FINE_RESOLUTION)?;
    let mut builder = VolumeBuilder::new();
    builder
        .take(SubjectPart::header(generator.header()))
        .map_err(SubjectError::Refused)?;
    let n_threads = std::thread::available_parallelism().map_or(1, |n| n.get().min(16)) as u32;
    let thickness = Generator::SLAB;
    let n_slabs = generator.slice_count().div_ceil(thickness);
    let made = std::thread::scope(|scope| {
        let outputs: Vec<_> = (0..n_threads)
            .map(|first| {
                // Two slabs ahead, so that little is held.
                let (sender, receiver) = sync_channel(2);
                let generator = &generator;
                scope.spawn(move || {
                    for slab in (first..n_slabs).step_by(n_threads as usize) {
                        let start = slab * thickness;
                        let end = (start + thickness).min(generator.slice_count());
                        if sender.send(generator.slab(start..end)).is_err() {
                            return;
                        }
                    }
                });
                receiver
            })
            .collect();
        for slab in 0..n_slabs {
            let output = outputs.get((slab % n_threads) as usize);
            if let Some(slab) = output.and_then(|output| output.recv().ok()) {
                for part in slab.into_parts() {
                    builder.take(part)?;
                }
            }
        }
        Ok(())
    });
    made.map_err(SubjectError::Refused)?;
    let volume = builder.finish().map_err(|source| MissingSubject::Build {
        path: name.to_owned(),
        source,
    });
    Ok(Subject::from(volume?))
}

/// A clay as its recipe has it. Notices say what of it cannot be done.
fn shaped(want: &Want, common: &Common, folder: &Path) -> Result<Data, MissingSubject> {
    let (mut desk, clay, sha256) = begun(want, common, folder)?;
    let mut progress = Progress::of("shaped");
    let made = surface_of_clay(&mut desk, &clay, &mut |part| {
        progress.tell(part);
        !stop::is_wished()
    });
    let (surface, notices) = made?;
    notices.iter().for_each(notice);
    Ok(Data::Subject {
        subject: surface.into(),
        sha256,
    })
}

/// A desk that has read the file of a clay, if that begins with one, the recipe, and the hash of the file. That of
/// `--subject` takes the place of what the clay begins with; any other has to be the one that the document means.
pub(super) fn begun(
    want: &Want,
    common: &Common,
    folder: &Path,
) -> Result<(ClayDesk, Arc<Clay>, Option<String>), MissingSubject> {
    let mut desk = ClayDesk::default();
    let mut clay = want.clay().cloned().unwrap_or_default();
    desk.take_meshes(&tool_grids(clay.tool_files(), (common, folder), false)?);
    let Some(path) = file_of(want, common, folder)? else {
        return Ok((desk, clay, None));
    };
    let shown = path.display().to_string();
    if common.subject.is_some() {
        clay = Arc::new(clay.with_file(Some(shown.clone()), None));
    }
    let (mut files, name) = Folder::of(&path);
    let mut report = LoadReport::default();
    let file: (&mut dyn FileSet, &str) = (&mut files, &name);
    let read = desk.begin(&clay, file, &mut report, &mut |_| !stop::is_wished());
    for line in report.notices() {
        notice(format!("{shown}: {line}"));
    }
    read.map_err(|source| MissingSubject::File {
        path: shown,
        source,
    })?;
    let sha256 = report.sha256_hex();
    match sha256.as_ref().map(|found| want.check(found)) {
        Some(Err(other)) if common.subject.is_some() => {
            notice(format!("{} is {other}", path.display()));
        }
        Some(Err(other)) => return Err(MissingSubject::other(&path, other)),
        Some(Ok(())) | None => {}
    }
    Ok((desk, clay, sha256))
}

/// The grids of tools that are meshes, by the keys of their files. What is not there is left out; notices name it, and
/// what has no inside, if `is_told`.
///
/// # Errors
/// If a file cannot be read, is no mesh, or is another one than the document means.
pub(super) fn tool_grids<'a>(
    files: impl Iterator<Item = &'a ToolFile>,
    (common, folder): (&Common, &Path),
    is_told: bool,
) -> Result<MeshGrids, MissingSubject> {
    let mut grids = MeshGrids::new();
    let mut missing = Vec::new();
    for file in files {
        let (Some(key), Some(want)) = (file.key(), Want::tool(file)) else {
            continue;
        };
        if missing.contains(&key) || grids.iter().any(|(known, _)| known == key) {
            continue;
        }
        let Some(path) = path_of(&want, common, folder) else {
            missing.push(key);
            if is_told {
                report_missing("tool", &want, folder);
            }
            continue;
        };
        let data = mesh_data(&path, &want, folder, &[], "a tool")?;
        let found = data.sha256().map(|found| want.check(found));
        found
            .transpose()
            .map_err(|other| MissingSubject::other(&path, other))?;
        if let Data::Object { mesh, .. } = data
            && let Some((_, grid)) = mesh.grids.first()
        {
            if is_told && grid.is_open() {
                let shown = path.display();
                notice(format!(
                    "{shown}: the mesh is open and has no inside: as a tool it is a sheet"
                ));
            }
            grids.push((key.to_owned(), Arc::clone(grid)));
        }
    }
    Ok(grids)
}

/// The given file that has the hash of a want.
fn given_of<'a>(given: &'a [PathBuf], want: &Want) -> Option<&'a Path> {
    let is_it = |path: &&PathBuf| {
        let (mut files, name) = Folder::of(path);
        hash_of(&mut files, &name).is_some_and(|hash| want.check(&hash).is_ok())
    };
    given.iter().find(is_it).map(PathBuf::as_path)
}

/// Reads a subject from a file, reduced to these limits. Further meshes of it lie at their addresses from `folder`, or
/// are among those given.
pub(super) fn read(
    path: &Path,
    reading: &Reading,
    limits: VolumeLimits,
    folder: &Path,
    given: &[PathBuf],
) -> Result<Data, MissingSubject> {
    let mut builder = SubjectBuilder::default();
    let mut reducer = Reducer::new(&mut builder, limits);
    let mut report = LoadReport::default();
    let shown = path.display().to_string();
    let name = Folder::of(path).1;
    let result = if reading.meshes.is_empty() {
        let mut files = Folder::of(path).0;
        read_any(&mut files, &name, reading, &mut reducer, &mut report)
    } else {
        let given = given.iter().cloned();
        let (mut files, name) = mesh_set(folder, path, &reading.meshes, given);
        read_any(&mut files, &name, reading, &mut reducer, &mut report)
    };
    if let Some(reduction) = reducer.reduction() {
        notice(reduction);
    }
    for line in report.notices() {
        notice(format!("{shown}: {line}"));
    }
    if let Err(source) = result {
        if let Some(hint) = hint(&name, &source) {
            notice(hint);
        }
        return Err(MissingSubject::File {
            path: shown,
            source,
        });
    }
    let whole = builder.finish().unwrap_or(Err(BuildError::Nothing));
    let (subject, _) = whole.map_err(|source| MissingSubject::Build {
        path: shown,
        source,
    })?;
    Ok(Data::Subject {
        subject,
        sha256: report.sha256_hex(),
    })
}

/// Names what `keep` asks for and the subject has not, and the open segments that are to be solid.
pub(super) fn report_drawing(
    illustration: &Illustration,
    resources: &Resources,
    subject: &Subject,
) {
    let (segments, bounds) = (subject.segments(), subject.frame().bounds);
    let templates = &illustration.templates;
    for line in KeptTissue::of(templates, resources, segments, bounds).notices() {
        notice(line);
    }
    let is_beside = subject.values().is_some();
    for name in lidded(&illustration.look, &subject.mesh_segments(), is_beside) {
        notice(RenderNotice::Lid(name));
    }
}
