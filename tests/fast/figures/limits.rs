//! Documents that are wrong or hostile (issue 18, "Bad input").

use std::time::Instant;

use super::common::*;
use fabrica::document::figure::{Figure, Flood, Handle, Region, Rigidity, Source};
use fabrica::figure::Notice;
use fabrica::figure::solve::Rig;
use glam::dvec2;

#[test]
fn crossing_and_empty_polygons_are_drawn_around() {
    let picture = plain(200, 100);
    let figure = Figure {
        regions: vec![
            polygon(
                "bow tie",
                &[[-0.4, -0.2], [0.0, 0.2], [0.0, -0.2], [-0.4, 0.2]],
                Rigidity::SOFT,
            ),
            polygon(
                "line",
                &[[0.1, 0.0], [0.3, 0.0], [0.2, 0.0]],
                Rigidity::SOFT,
            ),
            polygon(
                "far",
                &[[1e300, 0.0], [1e300, 1e300], [-1e300, 1e300]],
                Rigidity::Rigid,
            ),
        ],
        detail: 1000,
        ..Figure::default()
    };
    let (mesh, notices) = mesh(&picture, &figure);
    assert!(
        notices.contains(&Notice::SelfCrossing {
            name: "bow tie".to_owned()
        }),
        "{notices:?}"
    );
    assert!(
        notices.contains(&Notice::EmptyRegion {
            name: "line".to_owned()
        }),
        "{notices:?}"
    );
    assert!(
        (0..mesh.triangle_count()).all(|t| mesh.area(t) > 0.0),
        "no triangle of area 0"
    );
}

#[test]
fn the_most_floods_on_the_largest_plain_map_end_in_time() {
    let mut picture = plain(1024, 1024);
    let mut noise = Noise(5);
    for pixel in &mut picture.pixels {
        let value = 200 + (noise.next() * 40.0) as u8;
        *pixel = [value, value, value, 255];
    }
    let regions = (0..16).map(|i| {
        let at = |k: u32| centre(&picture, 30 + 60 * k, 30 + 60 * i);
        let mut source = Flood::new((0..16).map(at).collect());
        source.gap = 2.0;
        source.tolerance = 35.0;
        Region {
            from: Some(Source::Flood(source)),
            grow: if i % 2 == 0 { 2.0 } else { -1.0 },
            ..Region::new(&format!("region {i}"))
        }
    });
    let mut figure = Figure {
        regions: regions.collect(),
        detail: 60_000,
        ..Figure::default()
    };
    figure
        .regions
        .iter_mut()
        .for_each(|region| region.rigidity = Rigidity::Rigid);
    figure.handles = (0..64)
        .map(|i| Handle::pin(dvec2(f64::from(i) / 70.0 - 0.45, 0.1), dvec2(0.01, 0.0)))
        .collect();
    figure.propagation = fabrica::document::figure::Propagation::Gaussian;
    let start = Instant::now();
    let (mesh, mut notices) = mesh(&picture, &figure);
    let meshed = start.elapsed();
    let posed = Rig::new(&mesh, &figure, &mut notices).posed(&figure, &mut notices);
    println!(
        "{} triangles in {meshed:?}, {} rounds, {:?}, {notices:?}",
        mesh.triangle_count(),
        posed.rounds,
        start.elapsed()
    );
    assert!(posed.places.iter().all(|place| place.is_finite()), "finite");
}

#[test]
fn as_many_noisy_regions_as_there_may_be_end_in_time() {
    let mut picture = plain(1024, 1024);
    let mut noise = Noise(13);
    for pixel in &mut picture.pixels {
        *pixel = [
            (noise.next() * 256.0) as u8,
            (noise.next() * 256.0) as u8,
            (noise.next() * 256.0) as u8,
            255,
        ];
    }
    let regions = (0..64).map(|i| {
        let mut region = flooded(&format!("noise {i}"), centre(&picture, 15 * i, 20), 80.0);
        if let Some(Source::Flood(flood)) = &mut region.from {
            flood.connected = false;
        }
        Region {
            least: 0,
            fill: Some(false),
            rigidity: Rigidity::Rigid,
            ..region
        }
    });
    let figure = Figure {
        regions: regions.collect(),
        ..Figure::default()
    };
    let start = Instant::now();
    let (mesh, mut notices) = mesh(&picture, &figure);
    println!("{} triangles, {:?}", mesh.triangle_count(), start.elapsed());
    let posed = Rig::new(&mesh, &figure, &mut notices).posed(&figure, &mut notices);
    notices.retain(|notice| !matches!(notice, Notice::EmptyRegion { .. }));
    println!(
        "{} rounds, {notices:?}, {:?}",
        posed.rounds,
        start.elapsed()
    );
}
