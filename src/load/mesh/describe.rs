use std::fmt;

use super::error::MeshError;
use super::input::Progress;
use super::options::MeshOptions;
use super::read::read_mesh;
use super::report::{Aside, MeshReport, Origin};
use super::textures::take_packed;
use crate::data::Mesh;
use crate::data::mesh::{Measure, measure};
use crate::load::FileSet;
use crate::load::describe::{short, times};

/// Parts listed at most.
const MAX_PARTS_SHOWN: usize = 64;

/// What a mesh file holds, in words. Of the words of the file only the names of several parts are in it.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshDescription {
    /// What reading found out.
    pub report: MeshReport,
    /// All triangles together.
    pub whole: Measure,
    /// The parts with their names, in the order of the file.
    pub parts: Vec<(String, Measure)>,
    /// Where colours come from: texture, vertex, material; empty if there are none.
    pub colors: Vec<String>,
    /// Corners with a normal of the file that can be used, and all corners.
    pub normals: [u64; 2],
}

/// Reads and repairs a mesh and describes what comes of it.
///
/// # Errors
/// As [`read_mesh`].
pub fn describe_mesh(
    files: &mut dyn FileSet,
    name: &str,
    options: &MeshOptions,
    progress: &mut Progress<'_>,
) -> Result<MeshDescription, MeshError> {
    let (mut mesh, mut report) = read_mesh(files, name, options, progress)?;
    for (_, packed) in take_packed(&mut mesh) {
        let why = crate::pictures::decode(&packed).err().map(Aside::Picture);
        report.aside.extend(why);
    }
    let parts = mesh.parts.iter().map(|part| {
        let triangles = mesh
            .triangles
            .get(part.triangles.clone())
            .unwrap_or_default();
        (part.name.clone(), measure(&mesh.positions, triangles))
    });
    let parts = parts.collect::<Vec<_>>();
    let whole = match &parts[..] {
        [(_, only)] => only.clone(),
        _ => measure(&mesh.positions, &mesh.triangles),
    };
    let corners = mesh
        .normals
        .iter()
        .flat_map(|normals| normals.at.iter().flatten());
    let with_normal = corners
        .filter(|index| **index != crate::data::NO_INDEX)
        .count();
    Ok(MeshDescription {
        report,
        whole,
        parts,
        colors: colors(&mesh),
        normals: [with_normal as u64, 3 * mesh.triangles.len() as u64],
    })
}

/// Where the colours of a mesh come from. Only what its triangles use counts.
fn colors(mesh: &Mesh) -> Vec<String> {
    let mut is_used = vec![false; mesh.materials.len()];
    for &index in &mesh.material_of {
        if let Some(used) = is_used.get_mut(index as usize) {
            *used = true;
        }
    }
    let used = || {
        mesh.materials
            .iter()
            .zip(&is_used)
            .filter(|(_, used)| **used)
    };
    let mut found = Vec::new();
    if mesh.uvs.is_some() {
        let mut textures: Vec<u32> = used()
            .filter_map(|(material, _)| material.texture)
            .collect();
        textures.sort_unstable();
        textures.dedup();
        let sizes = textures
            .iter()
            .filter_map(|&index| mesh.textures.get(index as usize));
        found.extend(
            sizes.map(|texture| format!("texture {} × {}", texture.size[0], texture.size[1])),
        );
    }
    if mesh.colors.is_some() {
        found.push("vertex".to_owned());
    }
    if used().any(|(material, _)| material.has_color) {
        found.push("material".to_owned());
    }
    found
}

/// One thing in words, or several.
fn count(n: u64, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

/// Closed or open, and how.
fn surface(measure: &Measure) -> String {
    let mut text = if measure.is_closed { "closed" } else { "open" }.to_owned();
    if measure.open_edge_count > 0 {
        let edges = count(measure.open_edge_count, "edge", "edges");
        let rims = count(measure.rim_count as u64, "rim", "rims");
        text += &format!(", {edges} of one triangle in {rims}");
    }
    if measure.crowded_edge_count > 0 {
        let edges = count(measure.crowded_edge_count, "edge", "edges");
        text += &format!(", {edges} of more than two triangles");
    }
    text
}

/// A volume in mm³, to a tenth where it is large.
pub fn cubic(volume: f64) -> String {
    match volume.abs() >= 100.0 && volume.abs() < 1e12 {
        true => format!("{volume:.1} mm³"),
        false => format!("{} mm³", short(volume)),
    }
}

impl fmt::Display for MeshDescription {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (whole, report) = (&self.whole, &self.report);
        let form = match report.form {
            "" => String::new(),
            form => format!(" ({form})"),
        };
        let format = report.format;
        writeln!(f, "kind: {format}{form}, mesh")?;
        writeln!(f, "triangles: {}", whole.triangle_count)?;
        writeln!(f, "vertices: {} (welded)", whole.vertex_count)?;
        writeln!(f, "parts: {}", self.parts.len())?;
        if self.parts.len() > 1 {
            for (name, part) in self.parts.iter().take(MAX_PARTS_SHOWN) {
                let triangles = count(part.triangle_count as u64, "triangle", "triangles");
                write!(f, "  {name} ({triangles}, {}", surface(part))?;
                if let Some(volume) = part.volume_mm3 {
                    write!(f, ", {}", cubic(volume))?;
                }
                writeln!(f, ")")?;
            }
            if self.parts.len() > MAX_PARTS_SHOWN {
                writeln!(f, "  …")?;
            }
        }
        writeln!(f, "pieces: {}", whole.piece_count)?;
        let [least, greatest] = whole.bounds_mm;
        writeln!(f, "size: {} mm", times(greatest - least))?;
        let origin = |origin: Origin| match origin {
            Origin::Given => "as asked for".to_owned(),
            Origin::File => "the file says so".to_owned(),
            Origin::Format => format!("the default of {format}"),
        };
        writeln!(f, "units: {} ({})", report.units.0, origin(report.units.1))?;
        writeln!(f, "axes: {} ({})", report.axes.0, origin(report.axes.1))?;
        writeln!(f, "surface: {}", surface(whole))?;
        let repaired = report.repair.phrases();
        let repaired = if repaired.is_empty() {
            "nothing".to_owned()
        } else {
            repaired.join("; ")
        };
        writeln!(f, "repaired: {repaired}")?;
        let colors = if self.colors.is_empty() {
            "none".to_owned()
        } else {
            self.colors.join(", ")
        };
        writeln!(f, "colours: {colors}")?;
        match self.normals {
            [0, _] => writeln!(f, "normals: none")?,
            [some, all] if some == all => writeln!(f, "normals: of the file")?,
            [some, all] => writeln!(f, "normals: of the file at {some} of {all} corners")?,
        }
        if let Some(volume) = whole.volume_mm3 {
            writeln!(f, "volume: {}", cubic(volume))?;
        }
        writeln!(f, "sha256: {}", report.sha256_hex())
    }
}
