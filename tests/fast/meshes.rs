//! Mesh files: real ones against the facts known of them, broken ones within bounds of time and memory.

use std::path::Path;
use std::time::Instant;

use crate::data::data_folder;
use crate::scans::{Folder, Random, rounds};
use fabrica::load::{
    FileSet, LoadError, MemoryFiles, MeshDescription, MeshError, MeshOptions, PartsMode,
    describe_mesh, read_mesh,
};

fn describe(path: &Path) -> Result<MeshDescription, MeshError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let mut folder = Folder::new(path.parent().expect("a folder"));
    describe_mesh(&mut folder, &name, &MeshOptions::default(), &mut |_| true)
}

/// Triangles, vertices, pieces and edges of one triangle; those that nothing is known of are not looked at.
type Facts = (
    &'static str,
    usize,
    Option<usize>,
    Option<usize>,
    Option<u64>,
);

/// What other programs found in the files, after welding and dropping.
const FACTS: [Facts; 17] = [
    ("armadillo.obj", 29_170, Some(14_587), None, Some(0)),
    ("Spider_ascii.stl", 1312, Some(722), Some(18), Some(72)),
    ("Spider_binary.stl", 1312, Some(722), Some(18), Some(72)),
    ("teapot.stl", 894, Some(480), Some(3), Some(64)),
    ("footbones.ply", 4204, Some(2154), Some(26), Some(0)),
    (
        "vhf_left_phalanges.stl",
        34_940,
        Some(17_470),
        Some(5),
        None,
    ),
    ("canonical_face_model.obj", 898, Some(468), None, Some(36)),
    ("hand_lowres.obj", 1602, Some(810), None, Some(16)),
    ("spot_control_mesh.obj", 372, Some(188), None, Some(0)),
    ("pepper.ply", 29_956, Some(14_980), None, None),
    ("monkey.glb", 968, Some(505), None, Some(42)),
    ("cube.ply", 12, Some(8), None, None),
    ("cube_binary.ply", 12, Some(8), None, None),
    ("cube_uv.ply", 12, Some(8), None, None),
    ("BoxTextured.glb", 12, Some(8), None, None),
    ("cubevc.glb", 48, Some(26), None, None),
    ("vhf_left_talus.stl", 11_074, Some(5539), None, Some(0)),
];

#[test]
fn real_meshes_are_what_is_known_of_them() {
    let Some(folder) = data_folder("real_meshes_are_what_is_known_of_them") else {
        return;
    };
    let folder = folder.join("mesh");
    for (file, triangles, vertices, pieces, open) in FACTS {
        let told = describe(&folder.join(file)).unwrap_or_else(|error| panic!("{error}"));
        println!("{file}\n{told}");
        let whole = &told.whole;
        assert_eq!(whole.triangle_count, triangles, "{file}");
        assert_eq!(
            whole.vertex_count,
            vertices.unwrap_or(whole.vertex_count),
            "{file}"
        );
        assert_eq!(
            whole.piece_count,
            pieces.unwrap_or(whole.piece_count),
            "{file}"
        );
        assert_eq!(
            whole.open_edge_count,
            open.unwrap_or(whole.open_edge_count),
            "{file}"
        );
        if let Some(open) = open {
            assert_eq!(whole.is_closed, open == 0, "{file}");
        }
    }
    for file in ["Spider_ascii.stl", "Spider_binary.stl"] {
        let repair = describe(&folder.join(file))
            .expect("read above")
            .report
            .repair;
        assert_eq!(
            repair.degenerate + repair.duplicate + repair.short_faces,
            56,
            "{repair:?}"
        );
        assert_eq!(repair.disagreeing_edges, 10, "{repair:?}");
        assert_eq!(repair.one_sided_edges, 0, "{repair:?}");
    }
    let talus = describe(&folder.join("vhf_left_talus.stl")).expect("read above");
    let volume = talus.whole.volume_mm3.expect("closed");
    assert!((volume - 37_584.5).abs() < 0.1, "{volume}");
    let colors = |file: &str| {
        describe(&folder.join(file))
            .expect("read above")
            .colors
            .join(", ")
    };
    assert_eq!(colors("cubevc.glb"), "vertex");
    assert!(
        colors("BoxTextured.glb").starts_with("texture 256 × 256"),
        "{}",
        colors("BoxTextured.glb")
    );
    assert_eq!(colors("fuze.ply"), "vertex");
    assert_eq!(colors("bunny.obj"), "");
}

/// Files under `malformed/mesh` that load, with their triangles, pieces, and a word of what was repaired.
const LOADED: [(&str, Option<usize>, Option<usize>); 12] = [
    ("trimesh_singlevn.obj", Some(2), None),
    ("trimesh_negative_indices.obj", Some(12), None),
    ("trimesh_nancolor.obj", Some(12), None),
    ("assimp_box_without_lineending.obj", Some(12), None),
    ("assimp_box_UTF16BE.obj", Some(12), None),
    (
        "assimp_cube_binary_header_with_RN_newline.ply",
        Some(12),
        None,
    ),
    ("assimp_cube_binary_starts_with_nl.ply", Some(12), None),
    ("assimp_BoxBadNormals.glb", Some(12), None),
    ("trimesh_notenoughindices.obj", Some(1), None),
    ("trimesh_soup.stl", Some(100), Some(100)),
    ("assimp_triangle_with_two_solids.stl", Some(2), None),
    ("assimp_triangle_with_empty_solid.stl", Some(1), None),
];

/// Those that do not, with words of the message.
const FAILED: [(&str, &[&str]); 14] = [
    ("assimp_malformed.obj", &["line", "out of range"]),
    ("assimp_number_formats.obj", &["line 11", "3.1+e2"]),
    ("assimp_empty.obj", &["empty"]),
    ("assimp_empty.ply", &["empty"]),
    ("trimesh_empty.obj", &["no triangle", "no faces"]),
    ("trimesh_empty.ply", &["no triangle", "no faces"]),
    ("trimesh_empty.stl", &["no triangle", "no faces"]),
    ("trimesh_stl_empty_bin.stl", &["no triangle", "no faces"]),
    ("trimesh_ply_empty_header.ply", &["no triangle", "no faces"]),
    ("trimesh_empty_nodes.glb", &["no triangle", "no faces"]),
    (
        "trimesh_points_emptyascii.ply",
        &["no triangle", "12 points, no faces"],
    ),
    (
        "trimesh_face_in_group_name.obj",
        &["no triangle", "1 points"],
    ),
    ("assimp_OutOfMemory.off", &["OFF", "save as PLY or GLB"]),
    ("trimesh_headless.ctm", &["CTM", "save as PLY or GLB"]),
];

#[test]
fn broken_meshes_are_repaired_or_told_in_a_line() {
    let Some(folder) = data_folder("broken_meshes_are_repaired_or_told_in_a_line") else {
        return;
    };
    let folder = folder.join("malformed/mesh");
    let mut seen = 0;
    for name in Folder::new(&folder).names() {
        let start = Instant::now();
        let outcome = describe(&folder.join(&name));
        let took = start.elapsed();
        assert!(took.as_millis() < 1000, "{name}: {took:?}");
        let loaded = LOADED.iter().find(|(file, ..)| *file == name);
        let failed = FAILED.iter().find(|(file, _)| *file == name);
        match (outcome, loaded, failed) {
            (Ok(told), Some(&(_, triangles, pieces)), None) => {
                println!("{name}\n{told}");
                assert_eq!(told.whole.triangle_count, triangles.unwrap_or(0), "{name}");
                assert_eq!(
                    told.whole.piece_count,
                    pieces.unwrap_or(told.whole.piece_count),
                    "{name}"
                );
            }
            (Ok(told), None, None) => assert_eq!(name, "assimp_box_longline.obj", "{told}"),
            (Err(error), None, Some((_, words))) => {
                let line = error.to_string();
                println!("{name}: {line}");
                assert!(!line.contains('\n'), "one line: {line}");
                for word in *words {
                    assert!(line.contains(word), "{name}: “{word}” is not in “{line}”");
                }
            }
            (Ok(told), ..) => panic!("{name} loads:\n{told}"),
            (Err(error), ..) => panic!("{name}: {error}"),
        }
        seen += 1;
    }
    assert_eq!(
        seen,
        LOADED.len() + FAILED.len() + 1,
        "every file is looked at"
    );
    let soup = describe(&folder.join("trimesh_soup.stl")).expect("read above");
    assert!(!soup.whole.is_closed, "a soup is open");
    let bad_normals = describe(&folder.join("assimp_BoxBadNormals.glb")).expect("read above");
    println!("{:?}", bad_normals.report.repair);
    let short = describe(&folder.join("trimesh_notenoughindices.obj")).expect("read above");
    assert_eq!(short.report.repair.short_faces, 1);
}

/// Small whole files of each format.
fn small_files() -> Vec<(&'static str, Vec<u8>)> {
    let obj = "mtllib a.mtl\no a\nv 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 1\nvn 0 0 1\nusemtl a\nf 1/1/1 3/1/1 2/1/1\nf -4 -3 -1\ng b\nf 2 3 4 1\n";
    let ascii_stl = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
    let mut binary_stl = b"by hand".to_vec();
    binary_stl.resize(80, 0);
    binary_stl.extend(2u32.to_le_bytes());
    for x in [0f32, 1.0] {
        let floats = [0., 0., 1., x, 0., 0., 1., x, 0., 0., 1., 1.];
        binary_stl.extend(floats.iter().flat_map(|x: &f32| x.to_le_bytes()));
        binary_stl.extend([0, 0]);
    }
    let header = |form: &str| {
        format!(
            "ply\nformat {form} 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        )
    };
    let ascii_ply = header("ascii") + "0 0 0 1 2 3\n1 0 0 4 5 6\n0 1 0 7 8 9\n3 0 1 2\n";
    let mut binary_ply = header("binary_little_endian").into_bytes();
    for [x, y] in [[0f32, 0.], [1., 0.], [0., 1.]] {
        binary_ply.extend([x, y, 0.].iter().flat_map(|x| x.to_le_bytes()));
        binary_ply.extend([1, 2, 3]);
    }
    binary_ply.extend([3, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]);
    let mut json = br#"{"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[1,2,3]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":5}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},{"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":4}],"buffers":[{"byteLength":40}]}"#.to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut glb = b"glTF\x02\0\0\0".to_vec();
    glb.extend((json.len() as u32 + 12 + 8 + 8 + 40).to_le_bytes());
    glb.extend((json.len() as u32).to_le_bytes());
    glb.extend(b"JSON");
    glb.extend(&json);
    glb.extend(b"\x28\0\0\0BIN\0");
    glb.extend(
        [0f32, 0., 0., 1., 0., 0., 0., 1., 0.]
            .iter()
            .flat_map(|x| x.to_le_bytes()),
    );
    glb.extend([0, 1, 2, 0]);
    vec![
        ("a.obj", obj.as_bytes().to_vec()),
        ("a.stl", ascii_stl.as_bytes().to_vec()),
        ("b.stl", binary_stl),
        ("a.ply", ascii_ply.into_bytes()),
        ("b.ply", binary_ply),
        ("a.glb", glb),
    ]
}

/// What holds of every mesh that is read, and of every error.
fn check(name: &str, bytes: Vec<u8>) -> bool {
    let library = b"newmtl a\nKd 1 0 0\nmap_Kd a.png\n".to_vec();
    let most = bytes.len();
    let mut files = MemoryFiles::new([(name, bytes), ("a.mtl", library)]);
    let options = MeshOptions {
        parts: PartsMode::Pieces,
        ..MeshOptions::default()
    };
    match read_mesh(&mut files, name, &options, &mut |_| true) {
        Ok((mesh, report)) => {
            let count = mesh.positions.len();
            assert!(mesh.positions.iter().all(|p| p.is_finite()), "finite");
            assert!(
                (1..=most).contains(&mesh.triangles.len()),
                "no triangle from nowhere"
            );
            for triangle in &mesh.triangles {
                let [a, b, c] = *triangle;
                assert!(
                    a != b && b != c && c != a && triangle.iter().all(|i| (*i as usize) < count)
                );
            }
            let parts: usize = mesh.parts.iter().map(|part| part.triangles.len()).sum();
            assert_eq!(parts, mesh.triangles.len(), "every triangle has a part");
            assert!(
                report.notices().iter().all(|line| !line.contains('\n')),
                "lines"
            );
            true
        }
        Err(error) => {
            let line = error.to_string();
            assert!(
                !line.contains('\n') && line.contains(name),
                "one line with the name: {line}"
            );
            false
        }
    }
}

#[test]
fn meshes_cut_anywhere_give_a_mesh_or_a_message() {
    for (name, bytes) in small_files() {
        assert!(check(name, bytes.clone()), "{name} is whole");
        for len in 0..bytes.len() {
            check(name, bytes[..len].to_vec());
        }
    }
}

#[test]
fn flipped_meshes_give_a_mesh_or_a_message() {
    let mut random = Random(0x51ab_17e5_0f3d_9e4b);
    let (mut loaded, mut refused) = (0, 0);
    let start = Instant::now();
    for (name, bytes) in small_files() {
        for _ in 0..rounds(3000) {
            let mut bytes = bytes.clone();
            for _ in 0..1 + random.next() % 4 {
                let at = random.next() % bytes.len();
                bytes[at] ^= 1 << (random.next() % 8);
            }
            match check(name, bytes) {
                true => loaded += 1,
                false => refused += 1,
            }
        }
    }
    println!(
        "{loaded} loaded, {refused} refused in {:?}",
        start.elapsed()
    );
    assert!(
        loaded > 1000 && refused > 1000,
        "the flips reach both: {loaded} {refused}"
    );
}

#[test]
fn a_mesh_where_a_scan_is_meant_says_so() {
    for (name, bytes) in small_files() {
        let mut files = MemoryFiles::new([(name, bytes)]);
        let error = crate::scans::load_files(&mut files, name, 0).expect_err("no scan");
        assert!(matches!(error, LoadError::NoScan { .. }), "{error}");
        let line = error.to_string();
        assert!(
            line.contains("mesh") && line.contains("not a scan") && line.contains("by itself"),
            "{line}"
        );
    }
}
