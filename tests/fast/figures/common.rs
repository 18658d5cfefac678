//! Pictures and figures that several tests use.
use fabrica::document::figure::{Figure, Flood, Region, Rigidity, Source};
use fabrica::figure::Notice;
use fabrica::figure::mesh::Mesh;
use fabrica::figure::regions::Canvas;
use fabrica::figure::{Plane, unwatched};
use fabrica::pictures::{Picture, decode};
use glam::{DVec2, dvec2};
use std::path::Path;
use std::sync::Arc;

/// A picture of the test data, which lie in this folder.
pub(super) fn picture(folder: &Path, name: &str) -> Picture {
    let bytes = std::fs::read(folder.join("image2d").join(name)).expect("the picture is there");
    decode(&bytes).expect("a picture")
}

/// A picture of one colour.
pub(super) fn plain(width: u32, height: u32) -> Picture {
    Picture {
        size: [width, height],
        pixels: vec![[200, 180, 160, 255]; (width * height) as usize],
        is_of_inks: false,
    }
}

pub(super) fn canvas(picture: &Picture) -> Canvas<'_> {
    Canvas {
        plane: Plane::of_picture(picture.size),
        picture: Some(picture),
        drawn: None,
        shapes: &|_| None,
    }
}

pub(super) fn mesh(picture: &Picture, figure: &Figure) -> (Arc<Mesh>, Vec<Notice>) {
    let mut notices = Vec::new();
    let mesh =
        Mesh::new(&canvas(picture), figure, &mut notices, &mut unwatched).expect("not stopped");
    (Arc::new(mesh), notices)
}

pub(super) fn polygon(name: &str, points: &[[f64; 2]], rigidity: Rigidity) -> Region {
    Region {
        from: Some(Source::Polygon(
            points.iter().map(|p| dvec2(p[0], p[1])).collect(),
        )),
        rigidity,
        ..Region::new(name)
    }
}

pub(super) fn rectangle(name: &str, low: [f64; 2], high: [f64; 2], rigidity: Rigidity) -> Region {
    polygon(
        name,
        &[low, [high[0], low[1]], high, [low[0], high[1]]],
        rigidity,
    )
}

pub(super) fn flooded(name: &str, at: DVec2, tolerance: f64) -> Region {
    Region {
        from: Some(Source::Flood(Flood {
            tolerance,
            ..Flood::new(vec![at])
        })),
        ..Region::new(name)
    }
}

/// The centre of a pixel of a picture, figure space.
pub(super) fn centre(picture: &Picture, column: u32, row: u32) -> DVec2 {
    let plane = Plane::of_picture(picture.size);
    plane.figure_from_map(dvec2(f64::from(column) + 0.5, f64::from(row) + 0.5))
}

/// Numbers that look random, the same in each run (xorshift).
pub(super) struct Noise(pub(super) u64);

impl Noise {
    pub(super) fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}
