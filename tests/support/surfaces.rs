//! Surfaces made of the bytes of a mesh file, as the program makes them, and a plain one.

#![allow(dead_code, reason = "each test uses a part of it")]

use fabrica::data::{Mesh, MeshPart, SubjectPart, SubjectSink, Surface};
use fabrica::load::{LoadReport, MemoryFiles, MeshFile, read_mesh_subject};
use glam::{DVec3, Vec3};
use std::sync::Arc;

struct Taken(Option<Arc<Surface>>);

impl SubjectSink for Taken {
    fn take(&mut self, part: SubjectPart) -> Result<(), String> {
        if let SubjectPart::Surface(surface) = part {
            self.0 = Some(surface);
        }
        Ok(())
    }

    fn progress(&mut self, _fraction: f32) -> bool {
        true
    }
}

/// The surface of a mesh file; its name tells the format where the bytes do not.
pub(crate) fn surface_of(name: &str, bytes: Vec<u8>) -> Arc<Surface> {
    surface_of_files(&[(name, bytes)])
}

/// As [`surface_of`], laid in a box (corners, mm), such as that of a volume beside it.
pub(crate) fn surface_within(name: &str, bytes: Vec<u8>, within: [DVec3; 2]) -> Arc<Surface> {
    read_first(&[(name, bytes)], Some(within))
}

/// The surface of the first of these files, beside the others.
pub(crate) fn surface_of_files(files: &[(&str, Vec<u8>)]) -> Arc<Surface> {
    read_first(files, None)
}

fn read_first(files: &[(&str, Vec<u8>)], within: Option<[DVec3; 2]>) -> Arc<Surface> {
    let name = files[0].0;
    let (mut files, mut taken) = (MemoryFiles::new(files.to_vec()), Taken(None));
    let mesh = MeshFile {
        file: name.to_owned(),
        ..MeshFile::default()
    };
    let mut report = LoadReport::default();
    read_mesh_subject(&mut files, &[mesh], within, &mut taken, &mut report).expect("a mesh");
    taken.0.expect("it came")
}

/// A box of 100 × 60 × 80 mm.
pub(crate) fn brick() -> Arc<Surface> {
    let mesh = brick_mesh(Vec3::new(50.0, 30.0, 40.0));
    Arc::new(Surface::new(&mesh, None, &mut |_| true).expect("it has a size"))
}

/// A box of these half sides, mm.
pub(crate) fn brick_mesh(half: Vec3) -> Mesh {
    let corner = |i: u32| {
        let sign = |bit: u32| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
        half * Vec3::new(sign(0), sign(1), sign(2))
    };
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    Mesh {
        positions: (0..8).map(corner).collect(),
        triangles: quads
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
            .collect(),
        parts: vec![MeshPart {
            name: "brick".to_owned(),
            triangles: 0..12,
        }],
        ..Mesh::default()
    }
}

/// A closed ball of triangles, radius 50 mm, in so many rings from pole to pole, twice as many sides around.
pub(crate) fn ball_mesh(rings: u32) -> Mesh {
    let around = 2 * rings;
    let mut positions = vec![Vec3::new(0.0, 0.0, -50.0), Vec3::new(0.0, 0.0, 50.0)];
    for ring in 1..rings {
        let theta = std::f64::consts::PI * f64::from(ring) / f64::from(rings);
        for side in 0..around {
            let phi = std::f64::consts::TAU * f64::from(side) / f64::from(around);
            let (sin, cos) = theta.sin_cos();
            let place = DVec3::new(sin * phi.cos(), sin * phi.sin(), -cos) * 50.0;
            positions.push(place.as_vec3());
        }
    }
    let at = |ring: u32, side: u32| 2 + (ring - 1) * around + side % around;
    let mut triangles = Vec::new();
    for side in 0..around {
        triangles.push([0, at(1, side + 1), at(1, side)]);
        triangles.push([1, at(rings - 1, side), at(rings - 1, side + 1)]);
        for ring in 1..rings - 1 {
            let [a, b] = [at(ring, side), at(ring, side + 1)];
            let [c, d] = [at(ring + 1, side), at(ring + 1, side + 1)];
            triangles.extend([[a, b, c], [b, d, c]]);
        }
    }
    let parts = vec![MeshPart {
        name: "ball".to_owned(),
        triangles: 0..triangles.len(),
    }];
    Mesh {
        positions,
        triangles,
        parts,
        ..Mesh::default()
    }
}
