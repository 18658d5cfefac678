//! Clays, from their recipes to the events that the app waits for.

use std::sync::Arc;

use glam::DVec3;

#[cfg(not(target_arch = "wasm32"))]
use super::loading::slabs_in_threads as slabs;
#[cfg(target_arch = "wasm32")]
use super::loading::slabs_in_turn as slabs;
use super::loading::{Post, PostingSink, hash_of};
use super::loading::{is_mesh_file, read_scan};
use crate::assets::{LoadEvent, Want};
use crate::clay::{ClayError, Form, MAX_FILE_TRIANGLES, Shaping, States, Writing};
use crate::data::{
    DistanceGrid, Mesh, MeshGrids, SubjectPart, SubjectSink, Surface, SurfaceError, Volume,
    VolumeBuilder,
};
use crate::document::{Clay, ClayStart, Reading, SubjectRef, VoxelSource};
use crate::load::{
    Aside, FileSet, LoadError, LoadReport, MeshOptions, MeshReport, Warning, read_mesh,
};
use crate::math::hex;
use crate::subjects::{FINE_RESOLUTION, Generator, SubjectError};

/// Makes a surface of meshes: with their crease angles, within a box, told how far it is.
type Prepare = fn(
    &[(&Mesh, Option<f32>)],
    Option<[DVec3; 2]>,
    &mut dyn FnMut(f32) -> bool,
) -> Result<Surface, SurfaceError>;

/// Part of the work that is done when all strokes are.
const STROKES: f32 = 0.8;
/// Part of beginning with a file or a volume that is done when that is read or made.
pub const READING: f32 = 0.5;
/// Part of the work on a clay that is done when the volume that it begins with is.
const BEGINNING: f32 = 0.5;

/// Bytes of the differences of earlier states that are kept at most, and strokes before the last that they are of. Of
/// those before one in as many is kept, where there is room.
const MOST_KEPT: usize = 64 << 20;
const LAST_STROKES: usize = 50;

/// Shapes clays, and keeps what the last strokes left, so that another last stroke, or one less, does not begin anew.
#[derive(Debug, Default)]
pub struct ClayDesk {
    /// What the last one begins with, if that is a file or a part of a volume.
    start: Option<MadeStart>,
    last: Option<Arc<Clay>>,
    /// The grids of its tools that are meshes, by the keys of their files.
    meshes: MeshGrids,
    /// The clay of `last` before some of its strokes.
    kept: States,
    /// The clay of `last` after all of them, unless it was stopped.
    now: Option<Shaping>,
}

/// What a clay is shaped for.
#[derive(Clone, Debug, PartialEq)]
pub enum Purpose {
    /// To be drawn.
    Show,
    /// To be drawn soon, while a hand goes on shaping it.
    Sketch,
    /// To be written to a file.
    Write(Writing),
}

impl Purpose {
    /// What a clay that is asked for is for.
    pub fn of(want: &Want) -> Self {
        match want.is_sketch {
            true => Self::Sketch,
            false => Self::Show,
        }
    }
}

/// A file or a volume that was read, and the clay of it that no stroke has touched.
#[derive(Debug)]
struct MadeStart {
    /// What it begins with, without the name that a reader sees.
    from: ClayStart,
    /// That of the file's bytes, if there is a file.
    sha256: Option<[u8; 32]>,
    shaping: Shaping,
    detail: f64,
}

impl MadeStart {
    fn new(clay: &Clay, sha256: Option<[u8; 32]>, shaping: Shaping) -> Self {
        Self {
            from: nameless(&clay.from),
            sha256,
            shaping,
            detail: clay.detail,
        }
    }

    /// True if a clay begins with this, should its file be the same.
    fn is_of(&self, clay: &Clay) -> bool {
        self.from == nameless(&clay.from) && self.detail == clay.detail
    }
}

/// How far a start is when this part of it is made of what was read.
fn behind_reading(part: f32) -> f32 {
    READING + (1.0 - READING) * part
}

/// How a clay begins, whatever its file is called and wherever it lies: the bytes tell which one it is.
fn nameless(from: &ClayStart) -> ClayStart {
    let mut from = from.clone();
    match &mut from {
        ClayStart::Mesh(mesh) => {
            (mesh.src, mesh.sha256) = (None, None);
            mesh.name.clear();
        }
        ClayStart::Volume(volume) => {
            if let VoxelSource::File {
                src, sha256, name, ..
            } = &mut volume.of
            {
                (*src, *sha256) = (None, None);
                name.clear();
            }
        }
        ClayStart::Shape(_) | ClayStart::Unknown(_) => {}
    }
    from
}

impl ClayDesk {
    /// Takes the grids of tools that are meshes, as far as they are there, in place of those before.
    pub fn take_meshes(&mut self, meshes: &[(String, Arc<DistanceGrid>)]) {
        if self.meshes != meshes {
            self.meshes = meshes.to_vec();
            self.kept = States::default();
            self.now = None;
        }
    }

    /// Reads the file that a clay begins with, unless that is here already: the same address may lead to another file
    /// by now, so that its bytes tell, or the hash that the document gives. The report gets the hash.
    ///
    /// # Errors
    /// [`LoadError`] if it is no mesh or scan, or none that a clay can be made of; also where `go_on` stops it.
    pub fn begin(
        &mut self,
        clay: &Clay,
        (files, name): (&mut dyn FileSet, &str),
        report: &mut LoadReport,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Result<(), LoadError> {
        if let Some(here) = self.begun(clay, || hash_of(files, name)) {
            report.sha256 = Some(here);
            return Ok(());
        }
        self.forget();
        let mesh = match clay.volume() {
            #[cfg(not(target_arch = "wasm32"))]
            Some(meant) => {
                let mut builder = VolumeBuilder::with_progress(|part| go_on(READING * part));
                let reading = match &meant.of {
                    VoxelSource::Builtin { .. } => &Reading::default(),
                    VoxelSource::File { reading, .. } => reading,
                };
                read_voxels((files, name), reading, &mut builder, report)?;
                let volume = whole(builder, name)?;
                return self.begin_with_volume(clay, (&volume, name), report.sha256, go_on);
            }
            _ => read_surface((files, name), clay, report, &mut |part| {
                go_on(READING * part)
            })?,
        };
        let shaping = Shaping::of_mesh(clay, &mesh, &mut |part| go_on(behind_reading(part)));
        self.begin_anew(clay, shaping, report.sha256, name)
    }

    /// Begins with a scan that was read; `name` and hash are its file's.
    ///
    /// # Errors
    /// [`LoadError`] if no clay can be made of it; also where `go_on` stops it.
    pub fn begin_with_volume(
        &mut self,
        clay: &Clay,
        (volume, name): (&Volume, &str),
        sha256: Option<[u8; 32]>,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Result<(), LoadError> {
        self.forget();
        let made = match clay.volume() {
            Some(meant) => {
                Shaping::of_volume(clay, meant, volume, &mut |part| go_on(behind_reading(part)))
            }
            None => Err(ClayError::NoFile),
        };
        self.begin_anew(clay, made, sha256, name)
    }

    /// Strokes on another start are no strokes on this one, though its address may be the same.
    fn forget(&mut self) {
        *self = Self {
            meshes: std::mem::take(&mut self.meshes),
            ..Self::default()
        };
    }

    fn begin_anew(
        &mut self,
        clay: &Clay,
        made: Result<Shaping, ClayError>,
        sha256: Option<[u8; 32]>,
        name: &str,
    ) -> Result<(), LoadError> {
        let shaping = made.map_err(|error| match error {
            ClayError::Stopped => LoadError::Cancelled,
            other => LoadError::Mesh {
                message: format!("{other} ({name})"),
            },
        })?;
        self.start = Some(MadeStart::new(clay, sha256, shaping));
        Ok(())
    }

    /// The hash of the file that a clay begins with, if that has been read. The document tells which file is wanted; if
    /// it does not, `hash` is that of the file at hand.
    pub fn begun(&self, clay: &Clay, hash: impl FnOnce() -> Option<String>) -> Option<[u8; 32]> {
        let here = self.start_of(clay)?.sha256?;
        let given = clay.file().and_then(|file| file.sha256);
        let wanted = given.map(str::to_owned).or_else(hash)?;
        wanted.eq_ignore_ascii_case(&hex(&here)).then_some(here)
    }

    /// The start that is here, if a clay begins with it.
    fn start_of(&self, clay: &Clay) -> Option<&MadeStart> {
        self.start.as_ref().filter(|start| start.is_of(clay))
    }

    /// A clay that no stroke has touched. That of a built-in subject is made, unless it is here.
    fn untouched(
        &mut self,
        clay: &Clay,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Result<Shaping, ClayError> {
        if let Some(start) = self.start_of(clay) {
            return Ok(start.shaping.clone());
        }
        let Some(meant) = clay.volume() else {
            return Shaping::new(clay);
        };
        let VoxelSource::Builtin { name, revision } = &meant.of else {
            return Err(ClayError::NoFile);
        };
        let volume = builtin_voxels((name, *revision), &mut |part| go_on(READING * part))?;
        let make = &mut |part| go_on(behind_reading(part));
        let shaping = Shaping::of_volume(clay, meant, &volume, make)?;
        self.start = Some(MadeStart::new(clay, None, shaping.clone()));
        Ok(shaping)
    }

    /// The hash of the file that a clay begins with, if that was read.
    fn sha256_of(&self, clay: &Clay) -> Option<String> {
        let start = self.start_of(clay)?;
        start.sha256.map(|hash| hex(&hash))
    }

    /// The bytes of the file that a clay becomes. `go_on` hears how far it is, 0 to 1, and stops it by `false`.
    ///
    /// # Errors
    /// [`ClayError`].
    pub fn file(
        &mut self,
        clay: &Arc<Clay>,
        writing: &Writing,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Result<Vec<u8>, ClayError> {
        let shaped = self.shape(clay, go_on)?.shaped();
        Ok(shaped.file(writing.format, Form::Binary, &writing.title))
    }

    /// The clay as its recipe has it. `go_on` hears how far it is, 0 to 1, and stops it by `false`.
    ///
    /// # Errors
    /// [`ClayError`].
    pub fn shape(
        &mut self,
        clay: &Arc<Clay>,
        go_on: &mut dyn FnMut(f32) -> bool,
    ) -> Result<&Shaping, ClayError> {
        let common = self
            .last
            .as_ref()
            .and_then(|last| last.strokes_shared(clay));
        let is_early = |done: usize| common.is_some_and(|common| done <= common);
        let is_stale = |state: &Shaping| !is_early(state.done()) || state.lacks(clay);
        while self.kept.newest().is_some_and(is_stale) {
            self.kept.pop();
        }
        self.now.take_if(|now| is_stale(now));
        self.start.take_if(|start| !start.is_of(clay));
        self.last = Some(Arc::clone(clay));
        let all = clay.strokes.len();
        let mut begun = 0.0;
        let earlier = || self.kept.newest().cloned();
        let mut shaping = match self.now.take().or_else(earlier) {
            Some(shaping) => shaping,
            None => self.untouched(clay, &mut |part| {
                begun = BEGINNING;
                go_on(BEGINNING * part)
            })?,
        };
        shaping = shaping.with_meshes(&self.meshes);
        while shaping.done() < all {
            self.keep(&shaping, all);
            let done = shaping.done() as f32;
            shaping.stroke(clay, &mut |part| {
                go_on(begun + (1.0 - begun) * (done + part) / all as f32)
            })?;
        }
        Ok(self.now.insert(shaping))
    }

    /// Bytes of the states that are kept, of the start and of the grids of tools.
    pub fn bytes(&self) -> usize {
        let start = self.start.iter().map(|start| &start.shaping);
        let states = self.now.iter().chain(start).map(Shaping::bytes);
        let grids = self.meshes.iter().map(|(_, grid)| grid.values().len() * 4);
        states.chain(grids).sum::<usize>() + self.kept.bytes()
    }

    /// Keeps a state before its next stroke, in place of the earliest ones where there is no room.
    fn keep(&mut self, shaping: &Shaping, all: usize) {
        let is_here = self
            .kept
            .newest()
            .is_some_and(|kept| kept.done() == shaping.done());
        let is_last = shaping.done() + LAST_STROKES >= all;
        if is_here || !(is_last || shaping.done().is_multiple_of(LAST_STROKES)) {
            return;
        }
        self.kept.push(shaping);
        self.kept.keep_to(MOST_KEPT);
    }
}

/// Reads the mesh that a clay begins with. The report gets what was repaired and what is left aside.
fn read_surface(
    (files, name): (&mut dyn FileSet, &str),
    clay: &Clay,
    report: &mut LoadReport,
    go_on: &mut dyn FnMut(f32) -> bool,
) -> Result<Mesh, LoadError> {
    let reading = clay.mesh().map(|mesh| mesh.reading).unwrap_or_default();
    let options = MeshOptions {
        max_triangles: MAX_FILE_TRIANGLES as u64,
        ..MeshOptions::from(&reading)
    };
    let (mesh, found) = read_mesh(files, name, &options, go_on)?;
    report.sha256 = Some(found.sha256);
    warn(&mesh, &found, report);
    Ok(mesh)
}

/// Reads the scan that a clay begins with, whole, whatever a device could hold.
///
/// # Errors
/// [`LoadError`] if it is no scan, or `sink` takes no more.
pub fn read_voxels(
    (files, name): (&mut dyn FileSet, &str),
    reading: &Reading,
    sink: &mut dyn SubjectSink,
    report: &mut LoadReport,
) -> Result<(), LoadError> {
    if is_mesh_file(files, name, reading)? {
        return Err(LoadError::Unsupported {
            name: name.to_owned(),
            what:
                "a mesh, and this clay begins with a part of a scan: name a mesh by `from` itself"
                    .to_owned(),
        });
    }
    read_scan(files, name, reading, sink, report)
}

/// The scan of a file that was read.
///
/// # Errors
/// [`LoadError::Unsupported`] if pieces are missing, or do not go together.
pub fn whole<P: FnMut(f32) -> bool>(
    builder: VolumeBuilder<P>,
    name: &str,
) -> Result<Volume, LoadError> {
    builder.finish().map_err(|error| LoadError::Unsupported {
        name: name.to_owned(),
        what: error.to_string(),
    })
}

/// A built-in subject as finely as it is normally shown, whatever this device could hold.
fn builtin_voxels(
    (name, revision): (&str, u32),
    go_on: &mut dyn FnMut(f32) -> bool,
) -> Result<Volume, ClayError> {
    let cannot = |error: SubjectError| ClayError::NoSurface(error.to_string());
    let generator = Generator::of_revision(name, revision, FINE_RESOLUTION).map_err(cannot)?;
    let mut builder = VolumeBuilder::new();
    let header = SubjectPart::header(generator.header());
    builder.take(header).map_err(ClayError::NoSurface)?;
    let whole = generator.header().grid.voxel_count() as f32;
    let (mut done, mut refused) = (0, None);
    let is_whole = slabs(&generator, Generator::SLAB, &mut |slab| {
        done += slab.values.len();
        let mut parts = slab.into_parts().into_iter();
        refused = parts.find_map(|part| builder.take(part).err());
        refused.is_none() && go_on(done as f32 / whole)
    });
    match refused {
        Some(why) => Err(ClayError::NoSurface(why)),
        None if !is_whole => Err(ClayError::Stopped),
        None => {
            let built = builder.finish();
            built.map_err(|error| ClayError::NoSurface(error.to_string()))
        }
    }
}

/// Says what of a file was repaired, and what a clay has no use for.
fn warn(mesh: &Mesh, found: &MeshReport, report: &mut LoadReport) {
    let mut say = |what: String| report.warn(Warning::Mesh { what });
    let repaired = found.repair.phrases().join(", ");
    if !repaired.is_empty() {
        say(format!("the mesh was repaired: {repaired}"));
    }
    let is_colored = mesh.colors.is_some()
        || !mesh.textures.is_empty()
        || mesh.materials.iter().any(|material| material.has_color);
    if is_colored || found.aside.iter().any(Aside::is_of_colors) {
        say("the colours and textures of the file are left aside: a clay has none".to_owned());
    }
    for aside in found.aside.iter().filter(|aside| !aside.is_of_colors()) {
        say(aside.to_string());
    }
}

/// Shapes a clay and prepares it to be drawn.
///
/// # Errors
/// [`ClayError`].
pub fn surface_of_clay(
    desk: &mut ClayDesk,
    clay: &Arc<Clay>,
    go_on: &mut dyn FnMut(f32) -> bool,
) -> Result<(Arc<Surface>, Vec<String>), ClayError> {
    prepared(desk, clay, Surface::of, go_on)
}

/// As [`surface_of_clay`], by [`Surface::of`] or [`Surface::sketch_of`].
fn prepared(
    desk: &mut ClayDesk,
    clay: &Arc<Clay>,
    prepare: Prepare,
    go_on: &mut dyn FnMut(f32) -> bool,
) -> Result<(Arc<Surface>, Vec<String>), ClayError> {
    let shaping = desk.shape(clay, &mut |part| go_on(STROKES * part))?;
    let shaped = shaping.shaped();
    let mesh = shaped.mesh();
    let within = Some(shaped.space.box_mm());
    let surface = prepare(&[(&mesh, None)], within, &mut |part| {
        go_on(STROKES + (1.0 - STROKES) * part)
    });
    match surface {
        Ok(mut surface) => {
            surface.grids.clone_from(&shaping.grids().baked);
            Ok((Arc::new(surface), shaping.notices()))
        }
        Err(SurfaceError::Stopped) => Err(ClayError::Stopped),
        Err(why) => Err(ClayError::NoSurface(why.to_string())),
    }
}

/// As [`make_clay`], of a clay that begins with a file. One of another hash than the document gives is not shaped: its
/// own, with which the load ends, tells.
pub fn make_clay_of_file(
    desk: &mut ClayDesk,
    clay: &Arc<Clay>,
    file: (&mut dyn FileSet, &str),
    purpose: &Purpose,
    post: &mut dyn Post,
) {
    let mut sink = PostingSink::new(post);
    let mut report = LoadReport::default();
    let begun = desk.begin(clay, file, &mut report, &mut |part| sink.progress(part));
    if begun.is_err() || !is_wanted(clay, report.sha256) {
        return sink.end(begun, &report, None);
    }
    for warning in &report.warnings {
        post.post(LoadEvent::Notice(warning.to_string()));
    }
    make_clay(desk, clay, purpose, post);
}

/// As [`make_clay_of_file`], of a clay that begins with a scan that was read elsewhere; `name` and hash are its file's.
pub fn make_clay_of_volume(
    desk: &mut ClayDesk,
    clay: &Arc<Clay>,
    volume: (&Volume, &str),
    sha256: Option<[u8; 32]>,
    purpose: &Purpose,
    post: &mut dyn Post,
) {
    let mut sink = PostingSink::new(post);
    let report = LoadReport {
        sha256,
        ..LoadReport::default()
    };
    let begun = match is_wanted(clay, sha256) {
        true => desk.begin_with_volume(clay, volume, sha256, &mut |part| sink.progress(part)),
        false => return sink.end(Ok(()), &report, None),
    };
    match begun {
        Ok(()) => make_clay(desk, clay, purpose, post),
        Err(_) => sink.end(begun, &report, None),
    }
}

/// False for a file of another hash than the document gives.
fn is_wanted(clay: &Arc<Clay>, sha256: Option<[u8; 32]>) -> bool {
    let want = Want::subject(&SubjectRef::Clay(Arc::clone(clay)));
    sha256.is_none_or(|hash| want.check(&hex(&hash)).is_ok())
}

/// Shapes a clay and posts it, or its file if that is its purpose, what there is to say, and how it ended.
pub fn make_clay(desk: &mut ClayDesk, clay: &Arc<Clay>, purpose: &Purpose, post: &mut dyn Post) {
    let made = match purpose {
        Purpose::Write(writing) => post_file(desk, clay, writing, post),
        Purpose::Sketch => post_surface(desk, clay, Surface::sketch_of, post),
        Purpose::Show => post_surface(desk, clay, Surface::of, post),
    };
    post.post(match made {
        Ok(sha256) => LoadEvent::Done { sha256 },
        Err(ClayError::Stopped) => LoadEvent::Cancelled,
        Err(error) => LoadEvent::Failed {
            message: error.to_string(),
            details: String::new(),
            fault: None,
        },
    });
}

/// Posts the file of a clay. Gives no hash, since no file is shown anew.
fn post_file(
    desk: &mut ClayDesk,
    clay: &Arc<Clay>,
    writing: &Writing,
    post: &mut dyn Post,
) -> Result<Option<String>, ClayError> {
    let mut sink = PostingSink::of(post, "Shaping");
    let bytes = desk.file(clay, writing, &mut |part| sink.progress(part))?;
    post.post(LoadEvent::Written(bytes));
    Ok(None)
}

/// Posts a clay and what there is to say. Gives the hash of the file that it begins with.
fn post_surface(
    desk: &mut ClayDesk,
    clay: &Arc<Clay>,
    prepare: Prepare,
    post: &mut dyn Post,
) -> Result<Option<String>, ClayError> {
    let mut sink = PostingSink::of(post, "Shaping");
    let (surface, notices) = prepared(desk, clay, prepare, &mut |part| sink.progress(part))?;
    let taken = sink.take(SubjectPart::Surface(surface));
    taken.map_err(|_nobody_wants_it| ClayError::Stopped)?;
    for notice in notices {
        post.post(LoadEvent::Notice(notice));
    }
    Ok(desk.sha256_of(clay))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clay::Check;
    use crate::document::{ClayTool, Document, ToolShape};
    use crate::load::MemoryFiles;

    const PULLED: &str = r#"{ "fabrica": 1, "subject": { "clay": { "detail": 0.05, "tools": [{ "radius": 0.1 }],
        "strokes": [{ "path": [0, 0, 440, 0, 0, 300] }, { "path": [440, 0, 0, 200, 0, 0] }] } } }"#;

    fn pulled() -> Arc<Clay> {
        let document = Document::from_json(PULLED).unwrap();
        match &document.illustration().subject {
            SubjectRef::Clay(clay) => Arc::clone(clay),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_clay_goes_on_where_it_was() {
        let clay = pulled();
        let mut desk = ClayDesk::default();
        let mut heard = Vec::new();
        desk.shape(&clay.cut(1), &mut |part| {
            heard.push(part);
            true
        })
        .unwrap();
        assert!(heard.is_sorted());
        heard.clear();
        let went_on = desk.shape(&clay, &mut |part| {
            heard.push(part);
            true
        });
        let went_on = went_on.unwrap().shaped();
        assert!(heard[0] >= 0.5, "the first stroke is not done again");
        let anew = ClayDesk::default()
            .shape(&clay, &mut |_| true)
            .unwrap()
            .shaped();
        assert_eq!(went_on, anew);
        let back = desk.shape(&clay.cut(1), &mut |_| true).unwrap().shaped();
        assert_ne!(back.positions, anew.positions);
    }

    /// The last stroke taken back, and another drawn: nothing before it is done again, and all is as if made anew.
    #[test]
    fn another_last_stroke_does_no_other_again() {
        let clay = pulled();
        let mut desk = ClayDesk::default();
        desk.shape(&clay, &mut |_| true).unwrap();
        let mut others = Vec::new();
        for (moved, percent) in [(100, 100), (150, 120)] {
            let mut other = Clay::clone(&clay);
            let key = &mut other.strokes[1].moves[0].keys[1];
            (key.at[0], key.percent) = (key.at[0] + moved, percent);
            others.push(Arc::new(other));
        }
        // With one more tool, which no stroke before names.
        let mut other = Clay::clone(&clay);
        other.tools.push(ClayTool::default());
        other.strokes[1].moves[0].tool = 1;
        others.push(Arc::new(other));
        others.push(clay.cut(1));
        for other in others {
            let mut heard = Vec::new();
            let mut hear = |part| {
                heard.push(part);
                true
            };
            let shaped = desk.shape(&other, &mut hear).unwrap().shaped();
            assert!(heard.first().is_none_or(|first| *first >= 0.5), "{heard:?}");
            let anew = ClayDesk::default()
                .shape(&other, &mut |_| true)
                .unwrap()
                .shaped();
            assert_eq!(shaped, anew);
        }
        // Another tool under the first stroke begins anew.
        let mut other = Clay::clone(&clay);
        other.tools[0].coat = 0.2;
        let mut is_first = false;
        let mut hear = |part: f32| {
            is_first |= part < 0.5;
            true
        };
        desk.shape(&Arc::new(other), &mut hear).unwrap();
        assert!(is_first);
    }

    /// A tool made of an earlier state, which nobody kept: the desk goes back to it.
    #[test]
    fn what_is_baked_late_is_as_if_made_anew() {
        let clay = pulled();
        let mut desk = ClayDesk::default();
        desk.shape(&clay, &mut |_| true).unwrap();
        let mut other = Clay::clone(&clay);
        other.tools.push(ClayTool {
            shape: Some(ToolShape::Clay {
                strokes: 1,
                longest: 0.3,
            }),
            coat: 0.1,
        });
        let mut stroke = other.strokes[0].clone();
        stroke.moves[0].tool = 1;
        stroke.moves[0]
            .keys
            .iter_mut()
            .for_each(|key| key.at.reverse());
        other.strokes.push(stroke);
        let other = Arc::new(other);
        let late = desk.shape(&other, &mut |_| true).unwrap();
        assert_eq!(late.left_out(), []);
        let late = late.shaped();
        let anew = ClayDesk::default()
            .shape(&other, &mut |_| true)
            .unwrap()
            .shaped();
        assert_eq!(late, anew);
        let (surface, _) = surface_of_clay(&mut desk, &other, &mut |_| true).unwrap();
        assert_eq!(surface.grids.len(), 1, "captions go with the tool");
    }

    /// Another clay takes the place of one that began with a file, and of its strokes.
    #[test]
    fn another_clay_leaves_nothing_of_the_one_before() {
        let mut desk = ClayDesk::default();
        let clay = of_file(r#""src": "a.obj""#);
        assert!(surface(&make(&mut desk, &clay, tetrahedron(30))).is_some());
        desk.shape(&pulled(), &mut |_| true).unwrap();
        let mut anew = ClayDesk::default();
        anew.shape(&pulled(), &mut |_| true).unwrap();
        assert_eq!(desk.bytes(), anew.bytes());
    }

    #[test]
    fn a_surface_comes_and_then_the_end() {
        let mut events = Vec::new();
        make_clay(
            &mut ClayDesk::default(),
            &pulled(),
            &Purpose::Show,
            &mut |event: LoadEvent| {
                events.push(event);
                true
            },
        );
        let parts = events
            .iter()
            .filter(|event| matches!(event, LoadEvent::Part(_)));
        assert_eq!(parts.count(), 1);
        assert!(matches!(
            events.last(),
            Some(LoadEvent::Done { sha256: None })
        ));
        let mut stopped = Vec::new();
        make_clay(
            &mut ClayDesk::default(),
            &pulled(),
            &Purpose::Show,
            &mut |event: LoadEvent| {
                stopped.push(event);
                false
            },
        );
        assert!(matches!(stopped.last(), Some(LoadEvent::Cancelled)));
    }

    /// The unit stays that of the starting shape, however far a clay is pulled.
    #[test]
    fn strokes_move_no_unit() {
        let clay = pulled();
        let mut desk = ClayDesk::default();
        let mut frame = |strokes| {
            let made = surface_of_clay(&mut desk, &clay.cut(strokes), &mut |_| true);
            made.unwrap().0.frame
        };
        let (start, end) = (frame(0), frame(2));
        assert_eq!(start.mm_per_unit, 100.0);
        assert_eq!(start.mm_per_unit, end.mm_per_unit);
        assert!(start.middle_mm.distance(end.middle_mm) < 1e-9);
        assert!(end.bounds.max.z > start.bounds.max.z + 0.2);
    }

    /// A tetrahedron of this size, mm.
    fn tetrahedron(size: u32) -> Vec<u8> {
        let corners = "v 0 0 0\nv S 0 0\nv 0 S 0\nv 0 0 S\n".replace('S', &size.to_string());
        format!("{corners}f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n").into_bytes()
    }

    /// The sharp end of the tetrahedron is pulled out; `from` is what is said of its file.
    fn of_file(from: &str) -> Arc<Clay> {
        let text = r#"{ "fabrica": 1, "subject": { "clay": { "from": { FROM, "axes": "ras" }, "detail": 0.1,
            "tools": [{ "radius": 0.2 }], "strokes": [{ "path": [-500, -500, 500, 0, 0, 200] }] } } }"#;
        let document = Document::from_json(&text.replace("FROM", from)).unwrap();
        match &document.illustration().subject {
            SubjectRef::Clay(clay) => Arc::clone(clay),
            other => panic!("{other:?}"),
        }
    }

    /// A clay that begins with a part of a volume.
    fn of_volume(from: &str) -> Arc<Clay> {
        let text = r#"{ "fabrica": 1, "subject": { "clay": { "from": { FROM }, "detail": 0.05,
            "tools": [{ "radius": 0.2 }], "strokes": [{ "path": [0, 0, 450, 0, 0, 200] }] } } }"#;
        let document = Document::from_json(&text.replace("FROM", from)).unwrap();
        assert_eq!(document.notices(), []);
        match &document.illustration().subject {
            SubjectRef::Clay(clay) => Arc::clone(clay),
            other => panic!("{other:?}"),
        }
    }

    /// The ball in the cube is round and 50 mm wide.
    #[test]
    fn a_clay_of_a_built_in_subject_is_made_where_it_is_shaped() {
        let clay = of_volume(r#""of": { "builtin": "cube" }, "segment": "ball""#);
        let mut desk = ClayDesk::default();
        let mut heard = Vec::new();
        let shaped = desk.shape(&clay, &mut |part| {
            heard.push(part);
            true
        });
        let pulled = shaped.unwrap().shaped();
        assert!(heard.is_sorted(), "{heard:?}");
        let start = desk.shape(&clay.cut(0), &mut |_| panic!("it is here"));
        let start = start.unwrap().shaped();
        assert!(pulled.positions.len() > start.positions.len());
        for (shaped, volume) in [(&start, true), (&pulled, false)] {
            let found = Check::of(&shaped.positions, &shaped.triangles, None);
            assert!(found.is_two_manifold(), "{}", found.lines());
            assert_eq!((found.euler, found.pieces, found.border_edges), (2, 1, 0));
            if volume {
                let cube = builtin_voxels(("cube", 1), &mut |_| true).unwrap();
                let labels = cube.segmentation.unwrap().labels;
                let count = labels.iter().filter(|label| **label == 4).count() as f64;
                let wanted = count * cube.grid.spacing_mm().element_product();
                let made = found.volume.unwrap() * shaped.space.mm_per_unit.powi(3);
                assert!((made / wanted - 1.0).abs() < 0.05, "{made} of {wanted}");
            }
        }
        assert!((start.space.mm_per_unit - 50.0).abs() < 1.0);
        assert!(start.space.middle_mm.length() < 0.1);
        // As events, without a file.
        let mut events = Vec::new();
        make_clay(&mut desk, &clay, &Purpose::Show, &mut |event: LoadEvent| {
            events.push(event);
            true
        });
        assert!(surface(&events).is_some());
        assert!(matches!(
            events.last(),
            Some(LoadEvent::Done { sha256: None })
        ));
        let gone = of_volume(r#""of": { "builtin": "cube" }, "segment": "stone""#);
        let gone = desk.shape(&gone, &mut |_| true).unwrap_err().to_string();
        assert!(gone.contains("top, middle, bottom, ball"), "{gone}");
        let none = of_volume(r#""of": { "builtin": "cube" }, "iso": 1e9"#);
        let none = desk.shape(&none, &mut |_| true).unwrap_err().to_string();
        assert!(none.contains("1000000000"), "{none}");
        let mut fresh = ClayDesk::default();
        let stopped = fresh.shape(&clay, &mut |part| part < 0.1);
        assert_eq!(stopped.unwrap_err(), ClayError::Stopped);
    }

    /// What documents take for voxels is what the program makes of voxels.
    #[test]
    fn clays_begin_with_every_built_in_subject_of_voxels() {
        let of = |name: &str| {
            let text =
                r#"{"fabrica":1,"subject":{"clay":{"from":{"of":{"builtin":"NAME"},"iso":0}}}}"#;
            Document::from_json(&text.replace("NAME", name))
        };
        for name in crate::subjects::names() {
            assert_eq!(of(name).unwrap().notices(), [], "{name}");
        }
        let figures = crate::document::DRAWN_FIGURES.iter();
        for name in crate::subjects::mesh_names().iter().chain(figures) {
            assert!(of(name).is_err(), "{name} has no voxels");
        }
    }

    fn make(desk: &mut ClayDesk, clay: &Arc<Clay>, file: Vec<u8>) -> Vec<LoadEvent> {
        let mut files = MemoryFiles::new([("a.obj", file)]);
        let mut events = Vec::new();
        make_clay_of_file(
            desk,
            clay,
            (&mut files, "a.obj"),
            &Purpose::Show,
            &mut |event: LoadEvent| {
                events.push(event);
                true
            },
        );
        events
    }

    fn surface(events: &[LoadEvent]) -> Option<&Surface> {
        events.iter().find_map(|event| match event {
            LoadEvent::Part(SubjectPart::Surface(surface)) => Some(&**surface),
            _ => None,
        })
    }

    fn hash(file: &[u8]) -> String {
        use sha2::Digest as _;
        hex(&sha2::Sha256::digest(file))
    }

    #[test]
    fn a_clay_of_a_file_is_in_its_millimetres() {
        let file = tetrahedron(30);
        let mut desk = ClayDesk::default();
        let clay = of_file(r#""src": "a.obj""#);
        let events = make(&mut desk, &clay, file.clone());
        let made = surface(&events).expect("a surface");
        let is_of = |surface: &Surface, mm: f64| (surface.frame.mm_per_unit - mm).abs() < 1e-9;
        assert!(is_of(made, 30.0));
        assert!(made.frame.middle_mm.distance(glam::DVec3::splat(15.0)) < 1e-9);
        assert!(made.frame.bounds.max.z > 0.6, "it is pulled");
        let Some(LoadEvent::Done {
            sha256: Some(found),
        }) = events.last()
        else {
            panic!("{:?}", events.last())
        };
        assert_eq!(*found, hash(&file));
        // The same bytes are not read again; others at the same address are.
        let reads = |events: &[LoadEvent]| {
            let is_reading = |event: &LoadEvent| matches!(event, LoadEvent::Progress { what, .. } if what == "Reading");
            events.iter().any(is_reading)
        };
        assert!(reads(&events));
        let again = make(&mut desk, &clay.cut(0), file.clone());
        assert!(!reads(&again));
        assert!(surface(&again).expect("a surface").frame.bounds.max.z < 0.501);
        assert!(!reads(&make(&mut desk, &clay, file)));
        let larger = make(&mut desk, &clay, tetrahedron(60));
        assert!(reads(&larger));
        assert!(is_of(surface(&larger).expect("a surface"), 60.0));
        let mut other_units = Clay::clone(&of_file(r#""src": "a.obj", "units": "cm""#));
        other_units.detail = 0.05;
        let coarse = make(&mut desk, &Arc::new(other_units), tetrahedron(60));
        assert!(is_of(surface(&coarse).expect("a surface"), 600.0));
    }

    #[test]
    fn the_wrong_file_is_not_shaped_and_its_hash_tells() {
        let (right, wrong) = (tetrahedron(30), tetrahedron(40));
        let clay = of_file(&format!(r#""sha256": "{}""#, hash(&right)));
        let mut desk = ClayDesk::default();
        let events = make(&mut desk, &clay, wrong.clone());
        assert!(surface(&events).is_none());
        assert!(
            matches!(events.last(), Some(LoadEvent::Done { sha256: Some(found) }) if *found == hash(&wrong)),
            "{:?}",
            events.last()
        );
        assert!(surface(&make(&mut desk, &clay, right)).is_some());
        // Nothing is said of a file that nobody has read.
        let lost = ClayDesk::default().shape(&clay, &mut |_| true).unwrap_err();
        assert_eq!(lost, ClayError::NoFile);
    }

    #[test]
    fn what_is_no_mesh_fails_in_words_and_colours_are_named() {
        let clay = of_file(r#""src": "a.obj""#);
        for (file, part) in [
            (&b"P3 2 2 255"[..], "a.obj"),
            (b"v 0 0 0\nv 1 0 0\n", "there is no triangle"),
            (b"v 0 0 0\nv 1 0 0\nf 1 2 9\n", "line 3"),
        ] {
            let events = make(&mut ClayDesk::default(), &clay, file.to_vec());
            let Some(LoadEvent::Failed { message, .. }) = events.last() else {
                panic!("{:?}", events.last())
            };
            assert!(message.contains(part), "{message}");
            assert!(surface(&events).is_none());
        }
        let colored = String::from_utf8(tetrahedron(30)).unwrap();
        let colored = colored.replacen("v 0 0 0", "mtllib gone.mtl\nv 0 0 0 1 0 0", 1);
        let events = make(&mut ClayDesk::default(), &clay, colored.into_bytes());
        let notices = events.iter().filter_map(|event| match event {
            LoadEvent::Notice(text) => Some(text.as_str()),
            _ => None,
        });
        let notices: Vec<&str> = notices.collect();
        assert!(
            matches!(notices[..], [one] if one.contains("colours")),
            "{notices:?}"
        );
        let mut stopped = Vec::new();
        let mut files = MemoryFiles::new([("a.obj", tetrahedron(30))]);
        let file: (&mut dyn FileSet, &str) = (&mut files, "a.obj");
        make_clay_of_file(
            &mut ClayDesk::default(),
            &clay,
            file,
            &Purpose::Show,
            &mut |event: LoadEvent| {
                stopped.push(event);
                false
            },
        );
        assert!(
            matches!(stopped.last(), Some(LoadEvent::Cancelled)),
            "{stopped:?}"
        );
    }
}
