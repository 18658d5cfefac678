//! Surgical instruments of steel, as closed triangles in mm: what stands in an illustration beside the subject.
//!
//! Each lies about the origin, its longest side along z and its working end towards −z.

mod forceps;
mod needle;
mod retractor;
mod scalpel;
mod steel;

use super::loft::Loft;
use crate::data::Mesh;

/// A built-in tool, mm, of one part with the tool's name: the same vertices bit for bit on every machine. `None` for a
/// name that means none.
pub fn tool(name: &str) -> Option<Mesh> {
    let mut loft = Loft::new();
    match name {
        "scalpel" => scalpel::add(&mut loft),
        "forceps" => forceps::add(&mut loft),
        "retractor" => retractor::add(&mut loft),
        "needle" => needle::add(&mut loft),
        _ => return None,
    }
    loft.end_part(name);
    Some(loft.finish())
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::data::measure;

    /// Names with a sum over the bits of their vertices and triangles, and the sides of their boxes, mm.
    const TOOLS: [(&str, u64, [f64; 3]); 4] = [
        ("scalpel", 0x9a06_19c3_bb36_a299, [10.0, 3.5, 160.0]),
        ("forceps", 0x4e04_ef1e_44a8_d373, [18.4, 10.4, 140.0]),
        ("retractor", 0x2e71_0c3c_d24b_82cb, [41.5, 20.2, 160.0]),
        ("needle", 0x90fc_c270_e4a4_2253, [2.6, 1.7, 60.0]),
    ];

    fn made(name: &str) -> Mesh {
        tool(name).expect("a built-in tool")
    }

    #[test]
    fn every_tool_is_closed_and_right_side_out() {
        assert!(tool("hammer").is_none());
        for (name, _, size) in TOOLS {
            let mesh = made(name);
            let all = measure(&mesh.positions, &mesh.triangles);
            assert!(all.is_closed && all.crowded_edge_count == 0, "{name}");
            assert_eq!(all.vertex_count, mesh.positions.len(), "{name}");
            assert!(
                (1500..=8000).contains(&all.triangle_count),
                "{name}: {all:?}"
            );
            let pieces = if name == "scalpel" { 2 } else { 1 };
            assert_eq!(all.piece_count, pieces, "{name}");
            let [low, high] = all.bounds_mm;
            let wrong = (high - low - DVec3::from(size)).abs().max_element();
            assert!(wrong < 0.1, "{name}: {low} to {high}");
            // The retractor, of thin steel at a right angle, fills least of its box.
            let volume = all.volume_mm3.unwrap_or_default();
            assert!(
                volume > 0.02 * size.iter().product::<f64>(),
                "{name}: {volume}"
            );
            let colors = mesh.colors.as_ref().expect("colours");
            assert_eq!(colors.at, mesh.triangles);
            assert_eq!(colors.values.len(), mesh.positions.len());
            assert!(matches!(&mesh.parts[..], [part] if part.name == name));
            assert_eq!(mesh.parts[0].triangles, 0..mesh.triangles.len());
        }
    }

    #[test]
    fn no_triangle_is_flat_and_no_vertex_is_there_twice() {
        for (name, ..) in TOOLS {
            let mesh = made(name);
            for &triangle in &mesh.triangles {
                let [a, b, c] = mesh.corners_of(triangle).map(|p| p.as_dvec3());
                let longest = (b - a).length().max((c - b).length()).max((a - c).length());
                let height = (b - a).cross(c - a).length() / longest;
                assert!(height > 1e-4, "{name}: {a} {b} {c}");
            }
            let mut places: Vec<_> = mesh
                .positions
                .iter()
                .map(|p| p.to_array().map(|v| (v + 0.0).to_bits()))
                .collect();
            places.sort_unstable();
            places.dedup();
            assert_eq!(places.len(), mesh.positions.len(), "{name}");
        }
    }

    #[test]
    fn the_working_end_is_below() {
        // Below the tools hardly leave their axis; the retractor alone has a blade at a right angle there.
        for (name, ..) in TOOLS {
            let mesh = made(name);
            let heights = mesh.positions.iter().map(|p| p.z);
            let low = heights.clone().fold(f32::INFINITY, f32::min);
            let high = heights.fold(f32::NEG_INFINITY, f32::max);
            let tenth = 0.1 * (high - low);
            let reach = |is_within: &dyn Fn(f32) -> bool| {
                let near = mesh.positions.iter().filter(|p| is_within(p.z));
                near.map(|p| p.truncate().length()).fold(0.0, f32::max)
            };
            let below = reach(&|z| z < low + 0.2 * tenth);
            let above = reach(&|z| z > high - tenth);
            let is_wide = below > 2.0 * above;
            assert_eq!(is_wide, name == "retractor", "{name}: {below} {above}");
        }
    }

    #[test]
    fn vertices_are_the_same_bits_as_ever() {
        let sums = TOOLS.map(|(name, ..)| {
            let mesh = made(name);
            let bits = mesh
                .positions
                .iter()
                .flat_map(|p| p.to_array())
                .map(f32::to_bits);
            let indices = mesh.triangles.iter().flatten().copied();
            let sum = bits.chain(indices).fold(0_u64, |sum, n| {
                sum.wrapping_mul(0x100_0000_01b3).wrapping_add(n.into())
            });
            (name, sum)
        });
        assert_eq!(sums, TOOLS.map(|(name, sum, _)| (name, sum)));
    }
}
