//! The mesh, looked at from outside (issue 18, must show 3 and "Bad input").

use std::time::Instant;

use super::common::*;
use fabrica::document::figure::{Figure, Rest, Rigidity};
use fabrica::figure::Notice;
use fabrica::figure::mesh::{Mesh, Part};
use fabrica::figure::regions::{REST, RegionMap};
use fabrica::pictures::Picture;
use glam::dvec2;
use std::path::Path;

use crate::data::data_folder;

/// What a mesh looks like from outside.
#[derive(Debug)]
struct Facts {
    triangles: usize,
    #[expect(dead_code, reason = "for the eye")]
    least_angle_deg: f64,
    /// Part of the angles that are 20° or more.
    wide: f64,
    least_area: f64,
}

fn facts(mesh: &Mesh) -> Facts {
    let mut angles = Vec::new();
    let mut least_area = f64::INFINITY;
    for t in 0..mesh.triangle_count() {
        let corners = mesh.corners(t, &mesh.vertices);
        least_area = least_area.min(mesh.area(t));
        for i in 0..3 {
            let (u, v) = (
                corners[(i + 1) % 3] - corners[i],
                corners[(i + 2) % 3] - corners[i],
            );
            angles.push(u.angle_to(v).abs().to_degrees());
        }
    }
    let wide = angles.iter().filter(|angle| **angle >= 20.0).count() as f64 / angles.len() as f64;
    Facts {
        triangles: mesh.triangle_count(),
        least_angle_deg: angles.iter().copied().fold(f64::INFINITY, f64::min),
        wide,
        least_area,
    }
}

fn elbow(folder: &Path) -> (Picture, Figure) {
    let picture = picture(folder, "elbow-joint-gray.png");
    let mut paper = flooded("paper", centre(&picture, 3, 3), 24.0);
    paper.hide = true;
    let bone = rectangle("humerus", [-0.1, 0.0], [0.1, 0.45], Rigidity::Rigid);
    let figure = Figure {
        regions: vec![bone, paper],
        ..Figure::default()
    };
    (picture, figure)
}

fn spine(folder: &Path) -> (Picture, Figure) {
    let picture = picture(folder, "vertebral-column-colored.png");
    let mut paper = flooded("paper", centre(&picture, 2, 2), 10.0);
    paper.hide = true;
    let mut regions = Vec::new();
    for (name, column, row) in [
        ("neck", 100, 55),
        ("chest", 155, 330),
        ("loin", 90, 620),
        ("sacrum", 150, 720),
    ] {
        let mut region = flooded(name, centre(&picture, column, row), 90.0);
        region.least = 8;
        regions.push(region);
    }
    regions.push(paper);
    let figure = Figure {
        regions,
        ..Figure::default()
    };
    (picture, figure)
}

/// Checks what the contract says of every mesh, and gives its facts.
fn checked(name: &str, picture: &Picture, figure: &Figure) -> Facts {
    let start = Instant::now();
    let (mesh, notices) = mesh(picture, figure);
    let facts = facts(&mesh);
    println!(
        "{name}: {facts:?}, {} vertices, {notices:?}, {:?}",
        mesh.vertices.len(),
        start.elapsed()
    );
    assert!(
        facts.least_area > 0.0,
        "{name}: no triangle of area 0: {facts:?}"
    );
    assert!(
        facts.wide >= 0.99,
        "{name}: 99 % of the angles are 20° or more: {facts:?}"
    );
    let mut ignored = Vec::new();
    let map = RegionMap::new(&canvas(picture), &figure.regions, &mut ignored);
    check_areas(name, &mesh, &map);
    check_centres(name, picture, &mesh, &map, figure);
    facts
}

/// Areas of regions differ from the pixels' by at most ¾ px times the length of their outline.
fn check_areas(name: &str, mesh: &Mesh, map: &RegionMap) {
    let longest = map.size[0].max(map.size[1]) as f64;
    let counts = map.counts();
    for (i, tissue) in mesh.tissues.iter().enumerate() {
        let label = match tissue.part {
            Part::Region(region) => region as u8,
            Part::Behind(_) => continue,
            Part::Rest => REST,
        };
        if tissue.is_hidden {
            continue;
        }
        let mut area = 0.0;
        let mut edges = std::collections::BTreeSet::new();
        for t in 0..mesh.triangle_count() {
            if usize::from(mesh.tissue_of[t]) == i {
                area += mesh.area(t) * longest * longest;
                for k in 0..3 {
                    let (a, b) = (mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
                    if !edges.remove(&(b, a)) {
                        edges.insert((a, b));
                    }
                }
            }
        }
        let length =
            |(a, b): &(u32, u32)| mesh.vertices[*a as usize].distance(mesh.vertices[*b as usize]);
        let outline: f64 = edges.iter().map(length).sum::<f64>() * longest;
        let difference = (area - counts[usize::from(label)] as f64).abs();
        println!(
            "  {}: {area:.1} px², {} px, outline {outline:.1} px",
            tissue.name,
            counts[usize::from(label)]
        );
        assert!(
            difference <= 0.75 * outline,
            "{name}, {}: {difference} px, outline {outline} px",
            tissue.name
        );
    }
}

/// Every triangle's centre is a pixel of its region, but for those within 2 px (+ `smooth`) of an outline.
fn check_centres(name: &str, picture: &Picture, mesh: &Mesh, map: &RegionMap, figure: &Figure) {
    let plane = canvas(picture).plane;
    for t in 0..mesh.triangle_count() {
        let label = match mesh.tissue(t).part {
            Part::Region(region) | Part::Behind(region) => region as u8,
            Part::Rest => REST,
        };
        let smooth = figure
            .regions
            .iter()
            .map(|region| region.smooth)
            .fold(1.5, f64::max);
        let [a, b, c] = mesh.corners(t, &mesh.vertices);
        let at = plane.map_from_figure((a + b + c) / 3.0);
        let reach = 2.0 + smooth;
        let steps = (reach * 2.0) as i32;
        let near = (-steps..=steps).flat_map(|dx| {
            (-steps..=steps).map(move |dy| (f64::from(dx) / 2.0, f64::from(dy) / 2.0))
        });
        let found = near
            .filter(|(dx, dy)| dx.hypot(*dy) <= reach)
            .any(|(dx, dy)| {
                let pixel = at + dvec2(dx, dy);
                let (column, row) = (pixel.x.floor(), pixel.y.floor());
                let is_inside = column >= 0.0
                    && row >= 0.0
                    && column < map.size[0] as f64
                    && row < map.size[1] as f64;
                is_inside && map.labels[row as usize * map.size[0] + column as usize] == label
            });
        assert!(found, "{name}: triangle {t} lies away from its region");
    }
}

#[test]
fn meshes_of_plates_keep_what_the_contract_says() {
    let Some(folder) = data_folder("figures::mesh::meshes_of_plates_keep_what_the_contract_says")
    else {
        return;
    };
    let bare = |name: &str| (picture(&folder, name), Figure::default());
    for (name, (picture, figure)) in [
        ("elbow", elbow(&folder)),
        ("spine", spine(&folder)),
        ("bare foot", bare("foot-bones-gray.png")),
        ("bare atlas", bare("atlas-axis-gray.png")),
    ] {
        let facts = checked(name, &picture, &figure);
        let aim = f64::from(figure.detail);
        let count = facts.triangles as f64;
        // Where the outlines alone need more, half of the detail takes away no more than half of what it means.
        let half = Figure {
            detail: figure.detail / 2,
            ..figure
        };
        let (coarser, notices) = mesh(&picture, &half);
        println!(
            "  at half of the detail: {}, {notices:?}",
            coarser.triangle_count()
        );
        let is_by_outlines = count - coarser.triangle_count() as f64 <= 0.8 * aim;
        assert!(
            count >= 0.5 * aim && (count <= 1.6 * aim || is_by_outlines),
            "{name}: {count} triangles of {aim}"
        );
    }
}

#[test]
fn counts_follow_the_detail() {
    let Some(folder) = data_folder("figures::mesh::counts_follow_the_detail") else {
        return;
    };
    let (picture, mut figure) = elbow(&folder);
    for detail in [500, 2000, 20_000, 60_000] {
        figure.detail = detail;
        let facts = checked(&format!("elbow at {detail}"), &picture, &figure);
        let aim = f64::from(detail);
        let count = facts.triangles as f64;
        println!("{detail}: {:.3}", count / aim);
        // At 500 the outlines alone need more.
        assert!(
            (0.5 * aim..=1.6 * aim).contains(&count) || detail == 500,
            "{count} triangles of {aim}"
        );
    }
}

#[test]
fn the_same_mesh_is_made_again() {
    let Some(folder) = data_folder("figures::mesh::the_same_mesh_is_made_again") else {
        return;
    };
    let (picture, figure) = spine(&folder);
    let (one, _) = mesh(&picture, &figure);
    let (other, _) = mesh(&picture, &figure);
    assert_eq!(one.vertices, other.vertices, "vertices");
    assert_eq!(one.triangles, other.triangles, "triangles");
    let mut stiff = figure.clone();
    stiff.regions[1].rigidity = Rigidity::Rigid;
    stiff.regions[1].order = 3.0;
    stiff.regions[1].fixed = true;
    assert_eq!(
        mesh(&picture, &stiff).0.vertices,
        one.vertices,
        "rigidity, order, fixed change no vertex"
    );
}

#[test]
fn noise_is_cleaned_within_the_limits() {
    let mut noise = Noise(88_172_645_463_325_252);
    for side in [256_u32, 1024] {
        let mut picture = plain(side, side);
        for pixel in &mut picture.pixels {
            let value = (noise.next() * 256.0) as u8;
            *pixel = [value, (noise.next() * 256.0) as u8, value, 255];
        }
        let mut regions = Vec::new();
        for i in 0..6 {
            let mut region = flooded(&format!("noise {i}"), centre(&picture, 10 * i, 20), 60.0);
            if let Some(fabrica::document::figure::Source::Flood(flood)) = &mut region.from {
                flood.connected = false;
            }
            region.least = 0;
            region.fill = Some(false);
            region.rigidity = Rigidity::Rigid;
            regions.push(region);
        }
        let figure = Figure {
            regions,
            ..Figure::default()
        };
        let start = Instant::now();
        let (mesh, notices) = mesh(&picture, &figure);
        println!(
            "{side}: {} triangles, {notices:?}, {:?}",
            mesh.triangle_count(),
            start.elapsed()
        );
        let is_ragged = |notice: &Notice| matches!(notice, Notice::RaggedOutlines { .. });
        assert_eq!(
            notices.iter().any(is_ragged),
            side == 1024,
            "{side}: named where outlines are too long"
        );
        assert!(
            (0..mesh.triangle_count()).all(|t| mesh.area(t) > 0.0),
            "{side}: no triangle of area 0"
        );
    }
}

#[test]
fn what_is_cut_has_its_own_vertices() {
    let picture = plain(200, 100);
    let mut organ = rectangle("organ", [-0.1, -0.1], [0.1, 0.1], Rigidity::SOFT);
    let mut figure = Figure {
        regions: vec![organ.clone()],
        detail: 1000,
        ..Figure::default()
    };
    let (joined, _) = mesh(&picture, &figure);
    assert_eq!(joined.sheet_of.iter().max(), Some(&0), "one sheet");
    organ.cut = true;
    figure.regions = vec![organ.clone()];
    let (cut, _) = mesh(&picture, &figure);
    assert_eq!(cut.sheet_of.iter().max(), Some(&1), "two sheets");
    assert_eq!(
        cut.triangle_count(),
        joined.triangle_count(),
        "a hole lies behind it"
    );
    organ.behind = fabrica::document::figure::Behind::Smooth;
    figure.regions = vec![organ];
    let (behind, _) = mesh(&picture, &figure);
    assert!(
        behind.triangle_count() > cut.triangle_count(),
        "soft tissue lies behind it"
    );
    let names: Vec<&str> = behind
        .tissues
        .iter()
        .map(|tissue| tissue.name.as_str())
        .collect();
    assert_eq!(names, ["organ (behind)", "organ", "rest"], "tissues");
    assert_eq!(behind.tissue(0).name, "organ", "front first");
    let area = |mesh: &Mesh| {
        (0..mesh.triangle_count())
            .map(|t| mesh.area(t))
            .sum::<f64>()
    };
    assert!((area(&cut) - 0.5).abs() < 1e-9, "the picture's area");
    // Its outline is 160 px long, a pixel's area is 1/200².
    let bound = 0.75 * 160.0 / 40_000.0;
    assert!(
        (area(&behind) - 0.54).abs() < bound,
        "and the organ's once more: {}",
        area(&behind)
    );
}

#[test]
fn the_rest_is_bent_kept_or_dropped() {
    let picture = plain(200, 100);
    let mut figure = Figure {
        regions: vec![rectangle("organ", [-0.1, -0.1], [0.1, 0.1], Rigidity::SOFT)],
        detail: 1000,
        rest: Rest::Keep,
        ..Figure::default()
    };
    let (kept, _) = mesh(&picture, &figure);
    assert_eq!(
        kept.sheet_of.iter().max(),
        Some(&1),
        "the rest is a sheet of its own"
    );
    figure.rest = Rest::Drop;
    let (dropped, _) = mesh(&picture, &figure);
    assert!(
        (0..dropped.triangle_count()).all(|t| dropped.tissue(t).name == "organ"),
        "the organ alone"
    );
}

#[test]
fn a_mesh_tells_its_progress_and_can_be_stopped() {
    let Some(folder) = data_folder("figures::mesh::a_mesh_tells_its_progress_and_can_be_stopped")
    else {
        return;
    };
    let (picture, figure) = elbow(&folder);
    let mut told = Vec::new();
    let mut notices = Vec::new();
    let mut watch = |part| {
        told.push(part);
        true
    };
    assert!(
        Mesh::new(&canvas(&picture), &figure, &mut notices, &mut watch).is_some(),
        "it is made"
    );
    assert!(
        told.windows(2).all(|pair| pair[0] <= pair[1]) && told.len() > 3,
        "it goes on: {told:?}"
    );
    for stop in 0..told.len() {
        let mut calls = 0;
        let mut watch = |_| {
            calls += 1;
            calls <= stop
        };
        assert!(
            Mesh::new(&canvas(&picture), &figure, &mut notices, &mut watch).is_none(),
            "stopped at {stop}"
        );
    }
}

#[test]
fn colours_behind_a_cut_region_are_interpolated() {
    // Red grows from left to right around a blue organ.
    let mut picture = plain(200, 100);
    for (i, pixel) in picture.pixels.iter_mut().enumerate() {
        let (x, y) = (i % 200, i / 200);
        // Blue keeps away from the outline, which may be three quarters of a pixel inside the region.
        let is_organ = (83..117).contains(&x) && (33..67).contains(&y);
        *pixel = if is_organ {
            [0, 0, 255, 255]
        } else {
            [x as u8, 100, 0, 255]
        };
    }
    let mut organ = rectangle("organ", [-0.1, -0.1], [0.1, 0.1], Rigidity::SOFT);
    organ.cut = true;
    organ.behind = fabrica::document::figure::Behind::Smooth;
    let figure = Figure {
        regions: vec![organ],
        detail: 1000,
        ..Figure::default()
    };
    let (mesh, _) = mesh(&picture, &figure);
    let colors = fabrica::figure::smooth_colors(&mesh, &canvas(&picture).plane, &picture, 0);
    let linear = |byte: u8| f64::from(fabrica::math::linear_from_srgb(byte));
    assert!(colors.len() > 30, "{} vertices", colors.len());
    for (vertex, [r, g, b]) in &colors {
        let x = mesh.vertices[*vertex as usize].x;
        assert!(b.abs() < 1e-12, "no blue of the organ: {b}");
        assert!((g - linear(100)).abs() < 1e-9, "one green: {g}");
        assert!(
            (linear(76)..=linear(124)).contains(r),
            "a red from around it: {r}"
        );
        // The values around are those of the pixels, which are nearly linear here.
        let wanted = linear((100.0 + 200.0 * x) as u8);
        assert!((r - wanted).abs() < 0.02, "{x}: {r} {wanted}");
    }
}
