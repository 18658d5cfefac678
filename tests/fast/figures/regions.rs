//! Regions of the pictures in ../shared/data/image2d, counted to the pixel (issue 18, must show 2).

use fabrica::document::figure::{Flood, Region, Source};
use fabrica::figure::regions::{Canvas, RegionMap};
use fabrica::figure::{Notice, Plane};
use glam::dvec2;
use std::path::Path;

use super::common::picture;
use crate::data::data_folder;

fn taken(folder: &Path, name: &str, pixel: [u32; 2], tolerance: f64) -> usize {
    let picture = picture(folder, name);
    let plane = Plane::of_picture(picture.size);
    let centre = dvec2(f64::from(pixel[0]) + 0.5, f64::from(pixel[1]) + 0.5);
    let mut region = Region::new("paper");
    region.fill = Some(false);
    region.from = Some(Source::Flood(Flood {
        tolerance,
        ..Flood::new(vec![plane.figure_from_map(centre)])
    }));
    let canvas = Canvas {
        plane,
        picture: Some(&picture),
        drawn: None,
        shapes: &|_| None,
    };
    let mut notices: Vec<Notice> = Vec::new();
    let map = RegionMap::new(&canvas, &[region], &mut notices);
    assert_eq!(notices, [], "no notices");
    map.counts()[0]
}

#[test]
fn floods_take_the_pixels_that_the_contract_counts() {
    let Some(folder) =
        data_folder("figures::regions::floods_take_the_pixels_that_the_contract_counts")
    else {
        return;
    };
    assert_eq!(
        taken(&folder, "vertebral-column-colored.png", [2, 2], 10.0),
        126_222,
        "vertebral column"
    );
    assert_eq!(
        taken(&folder, "elbow-joint-gray.png", [3, 3], 24.0),
        76_732,
        "elbow joint"
    );
    assert_ne!(
        taken(&folder, "elbow-joint-gray.png", [3, 3], 8.0),
        76_732,
        "another tolerance takes others"
    );
}
