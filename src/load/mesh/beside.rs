//! Files that lie beside a mesh: material libraries and pictures.

use super::format::{MeshKind, by_name};
use super::input::{Input, Lines};
use super::mtl::{last_part, picture_name};
use super::read::{MeshOrNot, mesh_or_not};
use crate::load::files::{FileSet, open};

/// Names that a file asks for at most.
const MAX_NAMES: usize = 256;
/// Endings of files that go with a mesh.
const WITH_MESHES: [&str; 4] = [".mtl", ".png", ".jpg", ".jpeg"];

/// True if a file is called like a mesh that is read.
pub fn is_mesh_name(name: &str) -> bool {
    let lower = name.to_lowercase();
    let inner = lower.strip_suffix(".gz").unwrap_or(&lower);
    matches!(by_name(inner), Some(MeshKind::Read(_)))
}

fn goes_with_meshes(name: &str) -> bool {
    let lower = name.to_lowercase();
    WITH_MESHES.iter().any(|ending| lower.ends_with(ending))
}

/// True if files that were given together are called like meshes and what goes with them.
pub fn are_mesh_names<'n>(names: impl IntoIterator<Item = &'n str>) -> bool {
    let mut has_mesh = false;
    let all = names.into_iter().all(|name| {
        has_mesh |= is_mesh_name(name);
        is_mesh_name(name) || goes_with_meshes(name)
    });
    all && has_mesh
}

/// The first mesh among files that were given together, if the others are meshes or go with one.
pub fn mesh_among(files: &mut dyn FileSet, names: &[String]) -> Option<String> {
    let mut found = None;
    for name in names {
        let is_mesh = matches!(mesh_or_not(files, name), Ok(MeshOrNot::Mesh(_)));
        if is_mesh && found.is_none() {
            found = Some(name.clone());
        }
        if !is_mesh && !goes_with_meshes(name) {
            return None;
        }
    }
    found
}

/// Names of the files beside it that an OBJ or a material library asks for: the last parts of their paths. None of
/// other files, and of one that cannot be read.
pub fn names_beside(files: &mut dyn FileSet, name: &str) -> Vec<String> {
    let lower = name.to_lowercase();
    let is_text = [".obj", ".obj.gz", ".mtl"]
        .iter()
        .any(|ending| lower.ends_with(ending));
    let mut names: Vec<String> = Vec::new();
    let Some(mut stream) = open(files, name, name, None).ok().filter(|_| is_text) else {
        return names;
    };
    if stream.peek(2).is_ok_and(|start| start == [0x1f, 0x8b]) {
        stream.unpack(crate::load::stream::Packing::Gzip);
    }
    let mut go_on = |_: f32| true;
    let mut input = Input::new(stream, &mut go_on);
    let mut lines = Lines::new(&mut input, 0);
    while names.len() < MAX_NAMES && lines.advance(true).unwrap_or(false) {
        let text = lines.text();
        let asked = match text.trim_start().split_once(char::is_whitespace) {
            Some(("mtllib", path)) => path.to_owned(),
            Some(("map_Kd", rest)) => picture_name(rest.split_whitespace()),
            _ => continue,
        };
        let asked = last_part(&asked).to_owned();
        if !asked.is_empty() && !names.contains(&asked) {
            names.push(asked);
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::MemoryFiles;

    #[test]
    fn a_mesh_is_found_among_what_goes_with_it() {
        let obj =
            b"mtllib x/a b.mtl\r\nmtllib C:\\Jane\\c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        let mtl = b"newmtl a\nmap_Kd -s 2 2 2 ../skin of a hand.png\nmap_Kd -clamp on b.jpg\n";
        let mut files = MemoryFiles::new([
            ("a.mtl", mtl.to_vec()),
            ("a.png", b"\x89PNG".to_vec()),
            ("a.obj", obj.to_vec()),
            ("scan.nrrd", b"NRRD0004\n".to_vec()),
        ]);
        let names = |names: &[&str]| {
            names
                .iter()
                .map(|&name| name.to_owned())
                .collect::<Vec<_>>()
        };
        let with = names(&["a.mtl", "a.png", "a.obj"]);
        assert_eq!(mesh_among(&mut files, &with).as_deref(), Some("a.obj"));
        assert_eq!(mesh_among(&mut files, &with[..2]), None);
        assert_eq!(
            mesh_among(&mut files, &names(&["a.obj", "scan.nrrd"])),
            None
        );
        assert!(are_mesh_names(["A.MTL", "x.stl.gz"]) && !are_mesh_names(["a.png"]));
        assert!(!are_mesh_names(["a.obj", "scan.nrrd"]) && !are_mesh_names([]));
        assert_eq!(names_beside(&mut files, "a.obj"), ["a b.mtl", "c.mtl"]);
        let of_library = names_beside(&mut files, "a.mtl");
        assert_eq!(of_library, ["skin of a hand.png", "b.jpg"]);
        assert!(names_beside(&mut files, "a.png").is_empty());
    }
}
