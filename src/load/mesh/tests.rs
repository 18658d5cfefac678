//! Files of a few bytes in every form that the readers know, and in every way to be wrong that the contract names.

use glam::Vec3;

use super::*;
use crate::data::{Mesh, Wrap};
use crate::load::{LoadError, MemoryFiles};
use crate::pictures::PictureError;

fn read_as(
    files: &[(&str, &[u8])],
    options: &MeshOptions,
) -> Result<(Mesh, MeshReport), MeshError> {
    let mut set = MemoryFiles::new(files.iter().map(|(name, bytes)| (*name, bytes.to_vec())));
    read_mesh(&mut set, files[0].0, options, &mut |_| true)
}

fn read(name: &str, bytes: impl AsRef<[u8]>) -> Result<(Mesh, MeshReport), MeshError> {
    read_as(&[(name, bytes.as_ref())], &MeshOptions::default())
}

#[track_caller]
fn good(name: &str, bytes: impl AsRef<[u8]>) -> (Mesh, MeshReport) {
    read(name, bytes).unwrap_or_else(|error| panic!("{error}"))
}

/// One line that holds all of these.
#[track_caller]
fn bad(name: &str, bytes: impl AsRef<[u8]>, words: &[&str]) {
    let line = read(name, bytes).expect_err("it is wrong").to_string();
    assert!(!line.contains('\n'), "one line: {line}");
    for word in words {
        assert!(line.contains(word), "“{word}” is not in “{line}”");
    }
}

const CORNER: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\n";

fn obj(rest: &str) -> String {
    format!("{CORNER}{rest}")
}

mod glbs;

mod objs {
    use super::*;

    #[test]
    fn faces_are_written_in_all_forms() {
        let values = "vt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n";
        for face in [
            "f 1 2 3",
            "f 1/1 2/2 3/3",
            "f 1//1 2//1 3//1",
            "f 1/1/1 2/2/1 3/3/1",
            "f -5 -4 -3",
            "f -5/-3/-1 -4/-2/-1 -3/-1/-1",
            "f 1// 2// 3//",
            "f 1/ 2/ 3/",
            "f 1 2 \\\n3",
            "f\t1  2\t3 # a remark",
        ] {
            let (mesh, report) = good("a.obj", obj(&format!("{values}{face}\n")));
            assert_eq!(
                (mesh.triangles.len(), mesh.positions.len()),
                (1, 3),
                "{face}"
            );
            assert_eq!(report.repair, Repair::default(), "{face}");
            let has_uv = face.contains("1/1") || face.contains("5/-3");
            assert_eq!(mesh.uvs.is_some(), has_uv, "{face}");
            assert_eq!(
                mesh.normals.is_some(),
                face.contains("/1 ") && face.contains("//1")
                    || face.contains("/1/1")
                    || face.contains("/-1 "),
                "{face}"
            );
        }
    }

    #[test]
    fn textures_point_down_and_axes_are_turned() {
        let (mesh, report) = good(
            "a.obj",
            obj("vt 0.25 0.25\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\n"),
        );
        let uvs = mesh.uvs.expect("they are there");
        assert_eq!(uvs.get(0, 0).expect("there").to_array(), [0.25, 0.75]);
        // y-up: RAS = −x, z, y.
        assert_eq!(mesh.positions, [Vec3::ZERO, -Vec3::X, Vec3::Z]);
        assert_eq!(mesh.normals.expect("there").get(0, 0), Some(Vec3::Y));
        assert_eq!(report.axes, (Axes::YUp, Origin::Format));
        assert_eq!(report.units, (Units::Millimetre, Origin::Format));
    }

    #[test]
    fn a_comment_says_the_space_and_the_document_before_it() {
        let text = format!("# SPACE=LPS\n{}", obj("f 1 2 3\n"));
        let (mesh, report) = good("a.obj", &text);
        assert_eq!(report.axes, (Axes::Lps, Origin::File));
        assert_eq!(mesh.positions[1], -Vec3::X);
        let options = MeshOptions {
            axes: Some(Axes::Ras),
            units: Some(Units::Inch),
            ..MeshOptions::default()
        };
        let (mesh, report) = read_as(&[("a.obj", text.as_bytes())], &options).expect("a mesh");
        assert_eq!(
            (report.axes.1, report.units),
            (Origin::Given, (Units::Inch, Origin::Given))
        );
        assert_eq!(mesh.positions[1], Vec3::new(25.4, 0.0, 0.0));
    }

    #[test]
    fn parts_are_objects_or_else_groups() {
        let names = |text: &str| -> Vec<(String, usize)> {
            let (mesh, _) = good("a.obj", obj(text));
            mesh.parts
                .into_iter()
                .map(|part| (part.name, part.triangles.len()))
                .collect()
        };
        let objects = "f 1 2 4\no a\ng x\nf 1 2 3\no b\nf 2 3 4\no a\nf 3 4 5\n";
        let expected = [("surface", 1), ("a", 2), ("b", 1)].map(|(n, c)| (n.to_owned(), c));
        assert_eq!(names(objects), expected);
        let groups = "g x\nf 1 2 3\ng An f Three\nf 2 3 4\ng x\nf 3 4 5\n";
        let expected = [("x", 2), ("An f Three", 1)].map(|(n, c)| (n.to_owned(), c));
        assert_eq!(names(groups), expected);
        assert_eq!(names("o Jane Doe\nf 1 2 3\n"), [("surface".to_owned(), 1)]);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        bad(
            "a.obj",
            obj("f 1 2 9\n"),
            &["line 6", "vertex 9 is out of range", "there are 5", "a.obj"],
        );
        bad(
            "a.obj",
            obj("f 0 1 2\n"),
            &["line 6", "vertex 0 is out of range"],
        );
        bad("a.obj", obj("f -6 1 2\n"), &["line 6", "-6"]);
        bad(
            "a.obj",
            obj("f 1/1 2/1 3/1\n"),
            &["line 6", "texture coordinate 1", "there are 0"],
        );
        bad("a.obj", obj("f 1//2 2//2 3//2\n"), &["line 6", "normal 2"]);
        bad("a.obj", obj("f 1 2 x\n"), &["line 6", "“x”"]);
        bad("a.obj", obj("f 1 2 1/1/1/1\n"), &["line 6"]);
        bad("a.obj", obj("f 99999999999999999999 1 2\n"), &["line 6"]);
        bad("a.obj", "v 1 2 3.1+e2\nf 1 1 1\n", &["line 1", "“3.1+e2”"]);
        bad("a.obj", "v 1 2\n", &["line 1", "expected a number"]);
        bad("a.obj", obj("vn 0 x 1\n"), &["line 6"]);
        let many = (0..10_001)
            .map(|i| format!(" {}", i % 5 + 1))
            .collect::<String>();
        bad(
            "a.obj",
            obj(&format!("f{many}\n")),
            &["line 6", "10000 corners"],
        );
    }

    #[test]
    fn vertices_may_stand_behind_their_faces() {
        let (mesh, _) = good("a.obj", format!("f 1 2 3\n{CORNER}"));
        assert_eq!(mesh.triangles.len(), 1);
    }

    #[test]
    fn without_a_triangle_it_says_what_is_there() {
        bad("a.obj", obj(""), &["no triangle", "5 points, no faces"]);
        bad(
            "a.obj",
            obj("p 1 2\nl 1 2\n"),
            &["5 vertices", "1 points", "1 lines", "no faces"],
        );
        bad("a.obj", "# nothing\n", &["no triangle", "no faces"]);
        bad("a.obj", "", &["empty"]);
        bad(
            "a.obj",
            "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n",
            &["has no size"],
        );
        bad(
            "a.obj",
            "v nan 1 1\nv 1 1 1\nv 1 2 1\nf 1 2 3\n",
            &["1 faces, none of them usable"],
        );
    }

    #[test]
    fn lines_points_and_curves_are_left_aside() {
        let (_, report) = good("a.obj", obj("p 1\nl 1 2\nl 2 3\ncurv 0 1 1 2\nf 1 2 3\n"));
        assert_eq!(report.aside, [Aside::Points, Aside::Lines, Aside::Curves]);
    }

    #[test]
    fn colours_may_be_missing_at_a_vertex() {
        let text =
            "v 0 0 0 1 0 0\nv 1 0 0 nan nan nan\nv 0 1 0\nv 0 0 1 1 0 1 0\nf 1 2 3\nf 2 1 4\n";
        let (mesh, _) = good("a.obj", text);
        let colors = mesh.colors.expect("two");
        assert_eq!(
            (colors.get(0, 0), colors.get(0, 1), colors.get(0, 2)),
            (Some(Vec3::X), None, None)
        );
        assert_eq!(colors.get(1, 2), Some(Vec3::Y), "behind a weight");
    }

    #[test]
    fn materials_come_from_the_file_beside() {
        let text = obj(
            "mtllib C:\\Jane Doe\\skin.mtl\nusemtl a\nf 1 2 3\nusemtl b\nf 2 3 4\nusemtl none\nf 1 2 4\n",
        );
        let library = "newmtl a\nKd 1 0 0\nd 0\nnewmtl b\nKd 0 1 1\nd 0.5\nmap_Kd -s 1 1 1 textures/skin.png\n";
        let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\x07\0\0\0\x05".to_vec();
        png.extend([8, 2, 0, 0, 0]);
        let options = MeshOptions::default();
        let files: [(&str, &[u8]); 3] = [
            ("a.obj", text.as_bytes()),
            ("skin.mtl", library.as_bytes()),
            ("skin.png", &png),
        ];
        let (mesh, report) = read_as(&files, &options).expect("a mesh");
        assert_eq!(report.aside, []);
        assert_eq!(mesh.material_of, [0, 1, 2]);
        let [a, b, none] = mesh.materials[..] else {
            panic!("three")
        };
        assert_eq!(
            (a.color, a.opacity, a.texture),
            (Vec3::X, 1.0, None),
            "0 counts as 1"
        );
        assert_eq!(
            (b.color, b.opacity, b.texture),
            (Vec3::new(0.0, 1.0, 1.0), 0.5, Some(0))
        );
        assert_eq!((none.color, none.has_color), (Vec3::ONE, false));
        assert_eq!(
            (mesh.textures[0].size, mesh.textures[0].wrap),
            ([7, 5], [Wrap::Repeat; 2])
        );
        // Without the picture, without the library, with one that is none.
        let (_, report) = read_as(&files[..2], &options).expect("a mesh");
        assert_eq!(report.aside, [Aside::NoPicture]);
        let (mesh, report) = read_as(&files[..1], &options).expect("a mesh");
        assert_eq!(report.aside, [Aside::NoLibrary]);
        assert_eq!(mesh.materials.len(), 3);
        let (_, report) =
            read_as(&[files[0], files[1], ("skin.png", b"GIF89a")], &options).expect("a mesh");
        assert_eq!(report.aside, [Aside::Picture(PictureError::Unknown)]);
    }

    #[test]
    fn nothing_outside_the_folder_is_asked_for() {
        struct Spy(Vec<String>, Vec<u8>);
        impl crate::load::FileSet for Spy {
            fn open(&mut self, name: &str) -> std::io::Result<crate::load::FileHandle<'_>> {
                self.0.push(name.to_owned());
                match name {
                    "a.obj" => Ok(crate::load::FileHandle {
                        read: Box::new(&self.1[..]),
                        byte_len: Some(self.1.len() as u64),
                    }),
                    _ => Err(std::io::ErrorKind::NotFound.into()),
                }
            }
        }
        let text = obj("mtllib ../../etc/passwd\nmtllib /root/x.mtl\nf 1 2 3\n");
        let mut spy = Spy(Vec::new(), text.into_bytes());
        read_mesh(&mut spy, "a.obj", &MeshOptions::default(), &mut |_| true).expect("a mesh");
        spy.0.dedup();
        assert_eq!(spy.0, ["a.obj", "passwd", "x.mtl"]);
    }
}

mod stls {
    use super::*;

    fn binary(header: &str, count: u32, triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
        let mut bytes = header.as_bytes().to_vec();
        bytes.resize(80, b' ');
        bytes.extend(count.to_le_bytes());
        for triangle in triangles {
            bytes.extend([0; 12]);
            bytes.extend(triangle.iter().flatten().flat_map(|x| x.to_le_bytes()));
            bytes.extend([0; 2]);
        }
        bytes
    }

    const TWO: [[[f32; 3]; 3]; 2] = [
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    ];

    #[test]
    fn binary_ones_are_told_by_their_length() {
        for (name, header) in [
            ("a.stl", "made by hand"),
            ("a", "solid but binary"),
            ("a.obj", "solid"),
        ] {
            let (mesh, report) = good(name, binary(header, 2, &TWO));
            assert_eq!(
                (mesh.triangles.len(), mesh.positions.len()),
                (2, 4),
                "{header}"
            );
            assert_eq!((report.form, report.format), ("binary", MeshFormat::Stl));
            assert_eq!(report.aside, []);
        }
        // Packed, the length is not known beforehand.
        for header in ["solid", "binary"] {
            let (mesh, report) = good("a.stl.gz", gzip(&binary(header, 2, &TWO)));
            assert_eq!((mesh.triangles.len(), report.form), (2, "binary"));
        }
        let (mesh, report) = good("a.stl", binary("x SPACE=LPS", 2, &TWO));
        assert_eq!(report.axes, (Axes::Lps, Origin::File));
        assert_eq!(mesh.positions[1], -Vec3::X);
    }

    #[test]
    fn counts_may_be_wrong_if_the_rest_is_whole() {
        for count in [0, 1, 3, u32::MAX] {
            let (mesh, report) = good("a.stl", binary("", count, &TWO));
            assert_eq!(
                (mesh.triangles.len(), &report.aside[..]),
                (2, &[Aside::WrongCount][..])
            );
        }
        let mut longer = binary("", 2, &TWO);
        longer.extend([1, 2, 3]);
        let (mesh, report) = good("a.stl", &longer);
        assert_eq!(
            (mesh.triangles.len(), &report.aside[..]),
            (2, &[Aside::TrailingBytes][..])
        );
        let whole = binary("", 2, &TWO);
        bad("a.stl", &whole[..170], &["byte 170", "triangle 2 of 2"]);
        bad(
            "a.stl",
            &binary("", u32::MAX, &TWO)[..170],
            &["triangle 2 of 4294967295"],
        );
        bad("a.stl", &whole[..50], &["byte 50", "header"]);
        bad("a.stl", binary("", 0, &[]), &["no triangle"]);
        bad("a.stl", binary("solid", 0, &[]), &["no triangle"]);
        let mut colored = binary("", 2, &TWO);
        colored[132] = 7;
        assert_eq!(good("a.stl", colored).1.aside, [Aside::Attributes]);
    }

    const SOLID: &str = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

    #[test]
    fn ascii_has_several_solids() {
        let text = format!(
            "solid a\n{SOLID}endsolid a\nsolid empty\nendsolid\nSOLID b\n{}endsolid",
            SOLID.replace("0 1 0", "0 2 0").to_uppercase()
        );
        for text in [
            text.clone(),
            text.replace('\n', "\r\n"),
            text.replace('\n', "\r"),
        ] {
            let (mesh, report) = good("a.stl", text);
            let parts: Vec<&str> = mesh.parts.iter().map(|part| part.name.as_str()).collect();
            assert_eq!((parts, report.form), (vec!["a", "b"], "ASCII"));
        }
        let (_, report) = good(
            "a.stl",
            format!("solid a SPACE=LPS\n{SOLID}endsolid\nthe end"),
        );
        assert_eq!(
            (report.axes.0, &report.aside[..]),
            (Axes::Lps, &[Aside::TrailingBytes][..])
        );
    }

    #[test]
    fn ascii_that_is_wrong_is_told_with_its_line() {
        bad(
            "a.stl",
            format!("solid\n{}", SOLID.replace("1 0 0", "1 x 0")),
            &["line 5", "“x”"],
        );
        bad(
            "a.stl",
            format!("solid\n{}", SOLID.replace("1 0 0", "1 0")),
            &["line 5", "expected a number"],
        );
        bad("a.stl", format!("solid\n{SOLID}"), &["line 9", "endsolid"]);
        bad(
            "a.stl",
            "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0",
            &["line 5", "endsolid"],
        );
        bad(
            "a.stl",
            "solid\nvertex 0 0 0\nendsolid",
            &["line 2", "expected facet"],
        );
        bad(
            "a.stl",
            "solid\nfacet\nfacet\nendsolid",
            &["line 3", "endfacet"],
        );
        bad(
            "a.stl",
            "solid Empty\nendsolid Empty",
            &["no triangle", "no faces"],
        );
    }
}

mod plys {
    use super::*;

    const HEADER: &str = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
    const FACES: &str = "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    const BODY: &str = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n4 0 1 2 3\n";

    fn ascii(elements: &str, body: &str) -> String {
        format!("ply\nformat ascii 1.0\ncomment SPACE=RAS\n{elements}{body}")
    }

    #[test]
    fn ascii_and_both_binary_orders_are_the_same() {
        let text = ascii(&format!("{HEADER}{FACES}"), BODY);
        let (expected, report) = good("a.ply", &text);
        assert_eq!(
            (expected.triangles.len(), report.axes),
            (2, (Axes::Ras, Origin::File))
        );
        for text in [
            text.replace('\n', "\r\n"),
            text.replace('\n', "\r"),
            text.replace("1 0 0", "\n\n 1\t0  0 "),
        ] {
            assert_eq!(good("a.ply", text).0, expected);
        }
        for (order, is_big) in [("big", true), ("little", false)] {
            for end in ["\n", "\r\n"] {
                let header = format!("ply\nformat binary_{order}_endian 1.0\n{HEADER}{FACES}");
                let mut bytes = header.replace('\n', end).into_bytes();
                let mut put = |little: &[u8]| {
                    let mut raw = little.to_vec();
                    if is_big {
                        raw.reverse();
                    }
                    bytes.extend(raw);
                };
                for x in [0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0] {
                    put(&x.to_le_bytes());
                }
                for face in [&[0i32, 1, 2][..], &[0, 1, 2, 3]] {
                    put(&[face.len() as u8]);
                    for index in face {
                        put(&index.to_le_bytes());
                    }
                }
                assert_eq!(good("a.ply", &bytes).0, expected, "{order} {end:?}");
                for len in (bytes.len() - 60)..bytes.len() {
                    bad("a.ply", &bytes[..len], &["byte", "the file ends in"]);
                }
                bytes.push(0);
                assert_eq!(good("a.ply", bytes).1.aside, [Aside::TrailingBytes]);
            }
        }
    }

    #[test]
    fn values_of_vertices_are_read_and_the_rest_is_skipped() {
        let elements = "element extra 2\nproperty list uchar float many\nproperty short one\nelement vertex 3\nproperty double x\nproperty float y\nproperty float z\nproperty list uchar uchar more\nproperty float nx\nproperty float ny\nproperty float nz\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty float s\nproperty float t\nelement nothing 9999999999999\nelement face 1\nproperty list uchar uint vertex_index\nproperty uchar red\nend_header\n";
        let body = "2 1 2 3\n0 7\n0 0 0 2 1 1 0 0 1 255 0 0 0 0\n1 0 0 0 0 0 1 0 255 0 0.5 0.25\n0 1 0 0 0 0 1 0 0 255 1 1\n3 0 1 2 9\n";
        let (mesh, report) = good("a.ply", ascii(elements, body));
        assert_eq!(report.aside, [Aside::FaceProperties]);
        assert_eq!(mesh.normals.expect("there").get(0, 1), Some(Vec3::Z));
        assert_eq!(mesh.colors.expect("there").get(0, 1), Some(Vec3::Y));
        assert_eq!(
            mesh.uvs
                .expect("there")
                .get(0, 1)
                .expect("there")
                .to_array(),
            [0.5, 0.75]
        );
    }

    #[test]
    fn strips_turn_every_second_triangle() {
        let elements = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n";
        let body = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 2 1 0\n";
        let (mesh, report) = good("a.ply", ascii(elements, body));
        assert_eq!(
            mesh.triangles.len(),
            3,
            "the last is the first, turned over"
        );
        assert_eq!(
            (report.repair.disagreeing_edges, report.repair.duplicate),
            (0, 0)
        );
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        let wrong =
            |elements: &str, body: &str, words: &[&str]| bad("a.ply", ascii(elements, body), words);
        let whole = format!("{HEADER}{FACES}");
        wrong(
            &whole,
            &BODY.replace("0 1 2 3", "0 1 2 4"),
            &["line 16", "vertex 4 is out of range", "there are 4"],
        );
        wrong(
            &whole,
            &BODY.replace("3 0 1 2\n", "3 0 1 -1\n"),
            &["line 15", "-1"],
        );
        wrong(&whole, &BODY.replace("1 0 0", "1 x 0"), &["line 12", "“x”"]);
        wrong(
            &whole,
            &BODY.replace("1 0 0", "1 0"),
            &["line 12", "the line ends"],
        );
        wrong(
            &whole,
            "0 0 0\n",
            &["line 12", "the file ends before vertex 2 of 4"],
        );
        wrong(
            &whole,
            &BODY.replace("4 0 1 2 3\n", ""),
            &["the file ends before face 2 of 2"],
        );
        wrong(
            "element vertex 4\nproperty float x\nend_header\n",
            "",
            &["no x, y and z"],
        );
        wrong(
            "element vertex many\n",
            "",
            &["line 4", "number of elements"],
        );
        wrong("property float x\n", "", &["line 4", "before any element"]);
        wrong(
            "element vertex 4\nproperty number x\n",
            "",
            &["line 5", "type of numbers"],
        );
        wrong("Jane Doe\n", "", &["line 4", "expected format"]);
        wrong(HEADER, "", &["the file ends before end_header"]);
        wrong("end_header\n", "", &["no triangle", "no faces"]);
        wrong(
            &format!("{HEADER}end_header\n"),
            "0 0 0\n1 0 0\n0 1 0\n0 0 1\n",
            &["4 points, no faces"],
        );
        bad("a.ply", "ply\nend_header\n", &["format"]);
        let many = format!("{}{}", HEADER, FACES.replace("uchar int", "int int"));
        wrong(
            &many,
            &BODY.replace("4 0 1 2 3", "99999 0 1 2"),
            &["line 16", "99999 corners"],
        );
        wrong(
            &many,
            &BODY.replace("4 0 1 2 3", "-3 0 1 2"),
            &["line 16", "a list of -3"],
        );
        let error = read(
            "a.ply",
            ascii(&whole.replace("vertex 4", "vertex 353535235358"), BODY),
        )
        .expect_err("more");
        assert!(
            error.to_string().contains("expected a number") || error.to_string().contains("ends"),
            "{error}"
        );
        assert_eq!(
            good("a.ply", ascii(&whole, &format!("{BODY}9\n"))).1.aside,
            [Aside::TrailingBytes]
        );
    }

    #[test]
    fn header_text_is_never_shown() {
        let text = ascii(
            "comment TextureFile Jane Doe.jpg\nobj_info Jane Doe\n",
            &format!("{HEADER}{FACES}{BODY}"),
        );
        let (mesh, report) = good("a.ply", &text);
        assert_eq!(report.aside, [Aside::NamedTexture]);
        assert!(!format!("{mesh:?}{report:?}").contains("Jane"));
        let mut files = MemoryFiles::new([("a.ply", text.into_bytes())]);
        let told = describe_mesh(&mut files, "a.ply", &MeshOptions::default(), &mut |_| true)
            .expect("a mesh");
        assert!(!told.to_string().contains("Jane"), "{told}");
    }
}

#[test]
fn limits_hold_before_memory_is_asked_for() {
    let options = MeshOptions {
        max_triangles: 3,
        ..MeshOptions::default()
    };
    let fails = |name: &str, bytes: &[u8]| {
        read_as(&[(name, bytes)], &options)
            .expect_err("too much")
            .to_string()
    };
    let four = obj("f 1 2 3\nf 2 3 4\nf 1 3 5 4\n");
    assert!(fails("a.obj", four.as_bytes()).starts_with("4 triangles so far are more than the 3"));
    let vertices = "v 1 2 3\n".repeat(10);
    assert!(fails("a.obj", vertices.as_bytes()).starts_with("10 vertices so far"));
    let mut stl = vec![0; 84 + 4 * 50];
    stl[80] = 4;
    assert!(fails("a.stl", &stl).starts_with("4 triangles so far are more than the 3"));
    let facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    let ascii = format!("solid a\n{}endsolid a\n", facet.repeat(4));
    assert!(fails("a.stl", ascii.as_bytes()).starts_with("4 triangles so far"));
    let normals = "vn 1 2 3\n".repeat(10);
    assert!(fails("a.obj", normals.as_bytes()).starts_with("10 normals so far"));
    read_as(&[("a.obj", obj("f 1 2 3 4 5\n").as_bytes())], &options).expect("three");
}

#[test]
fn reading_is_told_and_can_be_stopped() {
    let mut text = obj("f 1 2 3\n").into_bytes();
    text.extend(std::iter::repeat_n(&b"# nothing\n"[..], 200_000).flatten());
    let mut files = MemoryFiles::new([("a.obj", text)]);
    let options = MeshOptions::default();
    let mut told = Vec::new();
    read_mesh(&mut files, "a.obj", &options, &mut |fraction| {
        told.push(fraction);
        true
    })
    .expect("a mesh");
    assert!(told.len() > 5 && told.is_sorted(), "{told:?}");
    assert!(
        told.iter().all(|fraction| (0.0..=1.0).contains(fraction)),
        "{told:?}"
    );
    let mut calls = 0;
    let stopped = read_mesh(&mut files, "a.obj", &options, &mut |_| {
        calls += 1;
        calls < 3
    });
    assert_eq!(
        stopped.expect_err("stopped"),
        MeshError::File(LoadError::Cancelled)
    );
    assert_eq!(calls, 3);
}

fn gzip(bytes: &[u8]) -> Vec<u8> {
    use std::io::Write as _;
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    encoder.write_all(bytes).expect("memory takes it");
    encoder.finish().expect("memory takes it")
}

#[test]
fn gzip_is_unpacked_and_the_hash_is_that_of_the_file() {
    let text = obj("f 1 2 3\n");
    let (plain, a) = good("a.obj", &text);
    let (packed, b) = good("a.obj.gz", gzip(text.as_bytes()));
    assert_eq!(plain, packed);
    assert_ne!(a.sha256, b.sha256);
    use sha2::Digest as _;
    assert_eq!(
        b.sha256,
        <[u8; 32]>::from(sha2::Sha256::digest(gzip(text.as_bytes())))
    );
    let cut = &gzip(text.as_bytes())[..30];
    bad("a.obj.gz", cut, &["gzip"]);
}

#[test]
fn what_is_no_mesh_says_so() {
    bad("a.nrrd", "NRRD0004\n", &["not a mesh"]);
    bad("letter.txt", "Dear Sir or Madam", &["not a mesh"]);
    bad("a.off", "OFF\n8 6 0\n", &["OFF", "save as PLY or GLB"]);
}
